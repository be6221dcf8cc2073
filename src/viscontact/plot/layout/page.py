"""How wide a figure is on the page it is made for."""

from __future__ import annotations

import math
from typing import Literal

#: What every figure takes: a column of a journal, or a width [m].
Width = Literal["single", "double"] | float

_INCH = 25.4e-3
#: Columns as most publishers set them [m].
COLUMNS = {"single": 89e-3, "double": 183e-3}
#: Below this labels have no room; above it no printer is left [m].
_LEAST, _MOST = 60e-3, 1.2
#: Up to this width a page takes one panel beside a legend, and no more [inch].
NARROW = 4.3


def page_width(width: Width | None, usual: float) -> float:
    """Return a figure's width in inches, as matplotlib counts.

    Parameters
    ----------
    width : {"single", "double"} or float or None
        One or two columns of a journal (89 and 183 mm), or a width [m].
    usual : float
        What None stands for [inch].

    Returns
    -------
    float
        [inch].

    Raises
    ------
    ValueError
        If it is no such word, or no width between 60 mm and 1.2 m.

    Examples
    --------
    >>> round(page_width("single", 7.2), 3)
    3.504
    """
    if width is None:
        return usual
    metres = COLUMNS.get(width, math.nan) if isinstance(width, str) else float(width)
    if not _LEAST <= metres <= _MOST:
        raise ValueError(
            f"width must be 'single', 'double' or from {_LEAST * 1e3:g} mm to {_MOST:g} m, got "
            f"{width!r}"
        )
    return metres / _INCH
