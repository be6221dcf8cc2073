"""Figures to files."""

from __future__ import annotations

import io
import threading
from os import PathLike
from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure

_FORMATS = (".png", ".pdf", ".svg")
_DOTS_PER_INCH = 200

# matplotlib knows how to embed fonts only as a global setting.
_SAVING = threading.Lock()


def save_figure(figure: Figure, path: str | PathLike[str]) -> None:
    """Write a figure to a file.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What one of the figures returned.
    path : path-like
        Where to; the suffix .png, .pdf or .svg says which format.

    Raises
    ------
    ValueError
        If the suffix is another one.
    OSError
        If the file cannot be written.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _FORMATS:
        raise ValueError(
            f"path must end in {', '.join(_FORMATS[:-1])} or {_FORMATS[-1]}, got {str(path)!r}; "
            "choose one of these formats"
        )
    _write(figure, path, suffix[1:])


def as_svg(figure: Figure) -> bytes:
    """Return a figure as a drawing that stands in other files.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What one of the figures returned.

    Returns
    -------
    bytes
        SVG, its texts as outlines: it looks alike everywhere.

    Examples
    --------
    >>> as_svg(Figure())[:5]
    b'<?xml'
    """
    return written(figure, "svg")


def written(figure: Figure, kind: str) -> bytes:
    """Return what a file of a figure would hold.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What one of the figures returned.
    kind : str
        ``"png"``, ``"pdf"`` or ``"svg"``.

    Returns
    -------
    bytes
        The file's content.

    Examples
    --------
    >>> written(Figure(), "pdf")[:4]
    b'%PDF'
    """
    drawing = io.BytesIO()
    _write(figure, drawing, kind)
    return drawing.getvalue()


def _write(figure: Figure, where: str | PathLike[str] | io.BytesIO, kind: str) -> None:
    dated = {"pdf": "CreationDate", "svg": "Date"}
    metadata = {dated[kind]: None} if kind in dated else None
    # Fonts embedded whole, as journals ask; equal figures give equal files.
    with _SAVING, rc_context({"pdf.fonttype": 42, "svg.hashsalt": "viscontact"}):
        figure.savefig(where, format=kind, dpi=_DOTS_PER_INCH, metadata=metadata)
