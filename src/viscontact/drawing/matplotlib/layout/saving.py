"""Writer of figures to files."""

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
# Resolution that journals require for images.
_DOTS_PER_INCH = 300

# Embedding of fonts is a global setting of matplotlib.
_SAVING = threading.Lock()


def save_figure(figure: Figure, path: str | PathLike[str]) -> None:
    """Write a figure to a file.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Figure of a run, a material or a shape.
    path : path-like
        The file, in the format of its suffix: .png, .pdf or .svg.

    Raises
    ------
    ValueError
        If the suffix is not one of these.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> import viscontact as vc
    >>> from viscontact.drawing.matplotlib import draw_load
    >>> figure = draw_load(vc.step(10e3), 60.0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_figure(figure, Path(folder) / "load.svg")
    ...     (Path(folder) / "load.svg").read_text(encoding="utf-8")[:5]
    '<?xml'
    """
    _write(figure, path, require_suffix(path, FIGURE_SUFFIXES)[1:])


def require_suffix(path: str | PathLike[str], suffixes: Sequence[str]) -> str:
    """Return the suffix of a file, which must be one of the given formats.

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
        If the file has a different suffix.

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
    """SVG of a figure for embedding, its texts as outlines."""
    return written(figure, "svg")


def written(figure: Figure, kind: str) -> bytes:
    """Content of a file of a figure: ``"png"``, ``"pdf"`` or ``"svg"``."""
    drawing = io.BytesIO()
    _write(figure, drawing, kind)
    return drawing.getvalue()


def _write(figure: Figure, where: str | PathLike[str] | io.BytesIO, kind: str) -> None:
    dated = {"pdf": "CreationDate", "svg": "Date"}
    metadata = {dated[kind]: None} if kind in dated else None
    # Complete embedded fonts, as journals require; equal figures give equal files.
    with _SAVING, rc_context({"pdf.fonttype": 42, "svg.hashsalt": "viscontact"}):
        figure.savefig(where, format=kind, dpi=_DOTS_PER_INCH, metadata=metadata)
