"""Friction coefficient over speed with the limits of slow and fast motion."""

from __future__ import annotations

import math

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.friction import friction_panel
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Curve, Panel
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.results.shown_scalars import has_friction
from viscontact.units.formatting import format_compact


def friction(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> list[go.Figure]:
    """Draw the friction coefficient over speeds, if there is any; both axes are logarithmic."""
    if not has_friction(ds) or ds.sizes["speed"] < 2:
        return []
    panel = friction_panel(ds, look.unit, reference)
    results = [curve for curve in panel.curves if curve.look == "joined"]
    limits = [curve for curve in panel.curves if curve.look != "joined"]
    lines = ({"color": look.blue, "width": 2}, {"color": look.warm, "width": 2, "dash": "dash"})
    traces = [_limit(panel, curve, look) for curve in limits]
    traces += [_curve(panel, curve, line) for curve, line in zip(results, lines, strict=False)][
        ::-1
    ]
    lowest, highest = panel.y.limits or (0.1, 1.0)
    meta = {"name": "friction", "title": panel.y.label, "note": ""}
    figure = drawn(
        traces,
        look,
        meta,
        showlegend=len(traces) > 1,
        legend={"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom"},
        margin={"l": 50, "r": 24, "t": 34, "b": 42},
        xaxis={"title": {"text": panel.x.label}, **_log_ticks(panel.x.unit(results[0].x))},
        yaxis={
            "range": [math.log10(lowest), math.log10(highest)],
            **_log_ticks(np.array([lowest, highest])),
        },
    )
    return [figure]


def _limit(panel: Panel, curve: Curve, look: Look) -> Part:
    dashes = {"dashed": "dash", "dotted": "dot"}[curve.look]
    return {
        **{"x": numbers(panel.x.unit(curve.x)), "y": numbers(curve.y)},
        **{"name": curve.name, "mode": "lines", "hoverinfo": "skip"},
        "line": {"color": look.faint, "width": 1.2, "dash": dashes},
    }


def _curve(panel: Panel, curve: Curve, line: Part) -> Part:
    errors = np.zeros(curve.x.shape) if curve.error is None else curve.error
    bars = {"type": "data", "array": numbers(np.nan_to_num(errors, posinf=0.0))}
    return {
        **{"x": numbers(panel.x.unit(curve.x)), "y": numbers(curve.y), "name": curve.name},
        **{"mode": "lines+markers", "line": line, "marker": {"color": line["color"], "size": 6}},
        "error_y": bars | {"color": line["color"], "thickness": 1.2, "width": 3},
        "text": curve.texts,
        "hovertemplate": "%{text}<extra></extra>",
    }


def _log_ticks(values: Floats) -> Part:
    """Logarithmic axis with its decades, and within two of them 1, 2 and 5 of each."""
    first, last = math.log10(values.min()), math.log10(values.max())
    steps = (1,) if last - first > 2 else (1, 2, 5)
    decades = range(math.floor(first), math.floor(last) + 1)
    ticks = [step * 10.0**decade for decade in decades for step in steps]
    texts = [format_compact(tick) for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": texts}
