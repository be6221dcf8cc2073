"""Small drawings over time: creep laws and load histories."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from xml.etree.ElementTree import Element

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import Elastic, Law, SeriesLaw, TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.loads import LoadHistory
from viscontact.drawing.content.load_course import whole_load_panel
from viscontact.drawing.content.look import ORANGE
from viscontact.drawing.svg.svg_axes import AxisScale, linear, logarithmic
from viscontact.drawing.svg.svg_panel import SvgCurve, panel

_POINTS = 121
#: A formula is drawn over its own times, and times shorter and longer by this factor.
_AROUND = 100.0
#: Beyond this ratio of last to first compliance its axis is logarithmic.
_DECADES = 20.0
#: Number of rows of a long table that are drawn as points.
_MOST_DOTS = 40
_PHI, _G = ("creep compliance Φ", "1/Pa"), ("relaxation modulus G", "Pa")


def law_drawings(law: Law, part: str = "") -> list[Element]:
    """Draw compliance and relaxation modulus of a law over log time; none if elastic."""
    if isinstance(law, Elastic):
        return []
    span = law_span(law)
    if isinstance(law, TabulatedCreep):
        return [_curve(law, *_PHI, span, (law.times, law.compliance), part)]
    if isinstance(law, TabulatedRelaxation):
        return [_curve(law.relaxation, *_G, span, (law.times, law.modulus), part)]
    drawn = [_curve(law, *_PHI, span, aside=part)]
    if law(0.0) > 0 and law.inversion_error == 0:
        drawn.append(_curve(law.relaxation, *_G, span, aside=part))
    return drawn


def law_span(law: Law) -> tuple[float, float]:
    """Return the first and the last time worth drawing, whole decades [s]."""
    if isinstance(law, TabulatedCreep | TabulatedRelaxation):
        times = [time for time in law.times if time > 0]
        return min(times), max(times) if len(times) > 1 else 10 * min(times)
    own = _own_times(law)
    if isinstance(law, SeriesLaw):
        own = (*own, *law.creep_series().times)
        own = (*own, *law.relaxation_series().times) if law(0.0) > 0 else own
    first, last = (min(own) / _AROUND, max(own) * _AROUND) if own else (1e-3, 1e3)
    return 10.0 ** math.floor(math.log10(first) + 1e-9), 10.0 ** math.ceil(math.log10(last) - 1e-9)


def load_drawings(load: LoadHistory) -> list[Element]:
    """Draw force or approach over time."""
    drawn = whole_load_panel(load)
    (curve,), name = drawn.curves, drawn.y.quantity.lower()
    x = linear("time", "s", *(drawn.x.limits or (0.0, 1.0)))
    if load.kinks[-1] == 0:  # the drawing's end means nothing
        x = AxisScale("time", x.low, x.high, tuple(tick for tick in x.ticks if tick[1] == "0"))
    y = linear(name, load.unit, *(drawn.y.limits or (0.0, 1.0)), 3)
    return [panel(f"{name} over time", x, y, [SvgCurve(curve.x, curve.y)], aside=drawn.note)]


def _curve(
    of: Callable[[Floats], Floats],
    quantity: str,
    unit: str,
    span: tuple[float, float],
    rows: tuple[Sequence[float], Sequence[float]] | None = None,
    aside: str = "",
) -> Element:
    times = np.geomspace(*span, _POINTS)
    values = of(times)
    good = values[np.isfinite(values)]
    marks = [SvgCurve(times, values)]
    if rows is not None:
        some = slice(None, None, math.ceil(len(rows[0]) / _MOST_DOTS))
        marks.append(SvgCurve(np.array(rows[0][some]), np.array(rows[1][some]), "dots", ORANGE))
    x = logarithmic("time", "s", *span, each_with_unit=True)
    return panel(quantity, x, _positive_axis(quantity.split()[-1], unit, good), marks, aside=aside)


def _positive_axis(symbol: str, unit: str, values: Floats) -> AxisScale:
    """The axis for values above zero."""
    low, high = float(values.min()), float(values.max())
    if values[-1] > _DECADES * values[0]:  # what flows; what relaxes goes to zero on a linear one
        return logarithmic(symbol, unit, 0.8 * low, 1.2 * high)
    top = 1.08 * high
    # A curve that moves little is drawn around itself; others down to zero.
    return linear(symbol, unit, low - 0.15 * (top - low) if low > 0.5 * top else 0.0, top, 3)


def _own_times(law: Law) -> tuple[float, ...]:
    """All arguments above 0 that are times, those of laws within laws as well [s]."""
    found: list[float] = []
    for item in dataclasses.fields(law):
        value = getattr(law, item.name)
        if isinstance(value, Law):
            found += _own_times(value)
        elif item.metadata.get("unit") == "s":
            found += np.atleast_1d(np.asarray(value, dtype=np.float64)).tolist()
    return tuple(time for time in found if 0 < time < math.inf)
