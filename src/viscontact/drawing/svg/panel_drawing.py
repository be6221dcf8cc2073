"""Small drawing of a panel of curves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from viscontact.drawing.content.look import BLUE, ORANGE
from viscontact.drawing.content.panel import FIRST, Curve, Panel
from viscontact.drawing.svg.svg_axes import scale_of
from viscontact.drawing.svg.svg_panel import SvgCurve, panel

#: Most dots of all curves together, and fewest of one of them.
_MOST, _FEWEST = 40, 4


def panel_drawing(drawn: Panel) -> Element:
    """Draw curves with their errors, and measured points as dots."""
    sets = sum(not _is_line(curve) for curve in drawn.curves)
    dots = max(_FEWEST, _MOST // max(sets, 1))
    marks = [mark for curve in drawn.curves for mark in _marks(curve, dots)]
    x, y = scale_of(drawn.x), scale_of(drawn.y, 3)
    return panel(drawn.title, x, y, marks, aside=drawn.note)


def _marks(curve: Curve, dots: int) -> Iterator[SvgCurve]:
    colour = BLUE if curve.ink == FIRST else ORANGE
    if not _is_line(curve):
        some = slice(None, None, math.ceil(curve.x.size / dots))
        yield SvgCurve(curve.x[some], curve.y[some], "dots", colour)
        return
    yield SvgCurve(curve.x, curve.y, colour=colour, dashed=curve.look == "dashed")
    if curve.error is not None and np.isfinite(curve.error).all():
        for side in (-1.0, 1.0):
            yield SvgCurve(curve.x, curve.y + side * curve.error, colour=colour, dashed=True)


def _is_line(curve: Curve) -> bool:
    """True for a line, without its markers if it has some."""
    return curve.is_line or curve.look in ("joined", "linked")
