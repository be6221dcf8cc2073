"""Small curve of a scalar of an active run, as far as it is computed."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike

from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.results.run_axis import TIME, RunAxis
from viscontact.results.variables import SCALARS

#: Most points of a curve; of longer ones, every so many and the last.
_MOST = 400
#: Ratio of the end to the first instant from which on time is logarithmic if the steps grow.
_DECADES = 200.0
#: Number of steps from which on it is known whether they grow.
_EARLY = 20


def growing(
    name: str,
    places: ArrayLike,
    values: ArrayLike,
    axis: RunAxis,
    ends: tuple[float, float],
    look: Look = LIGHT,
) -> go.Figure:
    """Draw a scalar [SI] of an active run at its finished instants or speeds, from end to end."""
    x, y = (np.asarray(each, dtype=np.float64) for each in (places, values))
    order = np.argsort(x, kind="stable")
    every = max(1, -(-x.size // _MOST))
    kept = order[sorted({*range(0, x.size, every), *range(x.size)[-1:]})]
    unit, along = look.unit(SCALARS[name].units, y), look.unit(axis.unit, *ends)
    trace: Part = {
        **{"x": numbers(along(x[kept])), "y": numbers(unit(y[kept]))},
        "mode": "lines" if x.size > 1 else "markers",
        "line": {"color": look.blue, "width": 2},
        "marker": {"color": look.blue, "size": 5},
        "hovertemplate": f"%{{x:.4g}} {along.symbol}: %{{y:.4g}} {unit.symbol}<extra></extra>",
    }
    meta = {"name": f"growing-{name}", "title": unit.label(SCALARS[name].label), "note": ""}
    return drawn(
        [trace],
        look,
        meta,
        xaxis={
            **_across(x, axis, ends, along.factor),
            "nticks": 4,
            "ticksuffix": f" {along.symbol}",
        },
        yaxis={"rangemode": "tozero", "nticks": 4},
        margin={"l": 40, "r": 18, "t": 6, "b": 24},
    )


def _across(x: np.ndarray, axis: RunAxis, ends: tuple[float, float], factor: float) -> Part:
    """Scale and range of the horizontal axis."""
    begin, end = ends
    if axis is TIME:
        positive = x[x > 0]
        begin = float(positive.min()) if positive.size else end
        steps = np.diff(np.sort(positive))
        is_even = steps.size > _EARLY and steps[-1] < 2.0 * steps[0]
        if begin * _DECADES > end or is_even:
            return {"range": [0.0, end / factor]}
    if not 0 < begin < end:
        return {}
    return {"type": "log", "range": [float(np.log10(each / factor)) for each in (begin, end)]}
