"""Widths of figures on a page."""

from __future__ import annotations

import math
from typing import Literal

#: Width of a figure: a column of a journal, or a number [m].
Width = Literal["single", "double"] | float

_INCH = 25.4e-3
#: Column widths of most publishers [m].
COLUMNS = {"single": 89e-3, "double": 183e-3}
#: Least width with room for labels, and largest printable width [m].
_LEAST, _MOST = 60e-3, 1.2
#: Largest width of a page with room for one panel and a legend only [inch].
NARROW = 4.3


def page_width(width: Width | None, usual: float) -> float:
    """Width of a figure [inch] from "single", "double" or a width [m]; `usual` [inch] if None."""
    if width is None:
        return usual
    metres = COLUMNS.get(width, math.nan) if isinstance(width, str) else float(width)
    if not _LEAST <= metres <= _MOST:
        raise ValueError(
            f"width must be 'single', 'double' or from {_LEAST * 1e3:g} mm to {_MOST:g} m, got "
            f"{width!r}"
        )
    return metres / _INCH
