"""Scalar of an active run, as far as it is computed."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import Axis, Curve, Panel, Units
from viscontact.results.run_axis import TIME, RunAxis
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Most points of a curve; of longer ones, every so many and the last.
_MOST = 400
#: Ratio of the end to the first instant from which on time is logarithmic if the steps grow.
_DECADES = 200.0
#: Number of steps from which on it is known whether they grow.
_EARLY = 20


def growing_panel(
    name: str,
    places: ArrayLike,
    values: ArrayLike,
    axis: RunAxis,
    ends: tuple[float, float],
    units: Units = readable_unit,
) -> Panel:
    """Panel of a scalar [SI] at the finished instants or speeds, from end to end of the run."""
    x, y = (np.asarray(each, dtype=np.float64) for each in (places, values))
    order = np.argsort(x, kind="stable")
    every = max(1, -(-x.size // _MOST))
    kept = order[sorted({*range(0, x.size, every), *range(x.size)[-1:]})]
    variable = SCALARS[name]
    return Panel(
        _along(x, axis, ends, units(axis.unit, *ends)),
        Axis.of(variable.label, variable.units, y, units=units),
        (Curve(x[kept], y[kept]),),
        name=name,
    )


def _along(x: Floats, axis: RunAxis, ends: tuple[float, float], unit: ReadableUnit) -> Axis:
    """Axis of time, linear from 0 or logarithmic, or of speed; without limits if it has no span."""
    name, (begin, end) = axis.name.capitalize(), ends
    if axis is TIME:
        positive = x[x > 0]
        begin = float(positive.min()) if positive.size else end
        steps = np.diff(np.sort(positive))
        is_even = steps.size > _EARLY and steps[-1] < 2.0 * steps[0]
        if begin * _DECADES > end or is_even:
            return Axis(name, unit, (0.0, end))
    if not 0 < begin < end:
        return Axis(name, unit)
    return Axis(name, unit, (begin, end), "log", begin)
