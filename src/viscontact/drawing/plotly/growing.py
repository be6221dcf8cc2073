"""Small curve of a scalar of an active run, as far as it is computed."""

from __future__ import annotations

import math

import plotly.graph_objects as go
from numpy.typing import ArrayLike

from viscontact.drawing.content.growing import growing_panel
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.results.run_axis import RunAxis


def growing(
    name: str,
    places: ArrayLike,
    values: ArrayLike,
    axis: RunAxis,
    ends: tuple[float, float],
    look: Look = LIGHT,
) -> go.Figure:
    """Draw a scalar [SI] of an active run at its finished instants or speeds, from end to end."""
    panel = growing_panel(name, places, values, axis, ends, look.unit)
    (curve,), along, unit = panel.curves, panel.x.unit, panel.y.unit
    trace: Part = {
        **{"x": numbers(along(curve.x)), "y": numbers(unit(curve.y))},
        "mode": "lines" if curve.x.size > 1 else "markers",
        "line": {"color": look.blue, "width": 2},
        "marker": {"color": look.blue, "size": 5},
        "hovertemplate": f"%{{x:.4g}} {along.symbol}: %{{y:.4g}} {unit.symbol}<extra></extra>",
    }
    across: Part = {"nticks": 4, "ticksuffix": f" {along.symbol}"}
    if panel.x.limits is not None:
        across["range"] = along(panel.x.limits).tolist()
    if panel.x.scale == "log":
        across |= {"type": "log", "range": [math.log10(end) for end in across["range"]]}
    return drawn(
        [trace],
        look,
        {"name": f"growing-{name}", "title": panel.y.label, "note": ""},
        xaxis=across,
        yaxis={"rangemode": "tozero", "nticks": 4},
        margin={"l": 40, "r": 18, "t": 6, "b": 24},
    )
