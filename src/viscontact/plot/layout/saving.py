"""Figures to files."""

from __future__ import annotations

import io
import threading
from collections.abc import Sequence
from os import PathLike
from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure

#: Formats of figures.
FIGURE_SUFFIXES = (".png", ".pdf", ".svg")
# What journals ask of pictures in grey and colour.
_DOTS_PER_INCH = 300

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

    Examples
    --------
    >>> import tempfile
    >>> import viscontact as vc
    >>> from viscontact.plot import draw_load
    >>> figure = draw_load(vc.step(10e3), 60.0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_figure(figure, Path(folder) / "load.svg")
    ...     (Path(folder) / "load.svg").read_text(encoding="utf-8")[:5]
    '<?xml'
    """
    _write(figure, path, require_suffix(path, FIGURE_SUFFIXES)[1:])


def require_suffix(path: str | PathLike[str], suffixes: Sequence[str]) -> str:
    """Return the suffix of a file that says its format.

    Parameters
    ----------
    path : path-like
        The file.
    suffixes : sequence of str
        Those there are, such as `FIGURE_SUFFIXES`.

    Returns
    -------
    str
        One of them.

    Raises
    ------
    ValueError
        If the file has another one.

    Examples
    --------
    >>> require_suffix("map.PDF", FIGURE_SUFFIXES)
    '.pdf'
    """
    suffix = Path(path).suffix.lower()
    if suffix not in suffixes:
        allowed = " or ".join([", ".join(suffixes[:-1]), suffixes[-1]])
        raise ValueError(
            f"path must end in {allowed}, got {str(path)!r}; choose one of these formats"
        )
    return suffix


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
