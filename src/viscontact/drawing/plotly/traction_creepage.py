"""Traction of a rolling body over its creepage."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Curve, Panel
from viscontact.drawing.content.traction_creepage import traction_creepage_panel
from viscontact.drawing.plotly.parts import Part, drawn, numbers


def traction_creepage(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> list[go.Figure]:
    """Draw the traction over the creepage at each speed, with the limits of Carter."""
    panel = traction_creepage_panel(ds, look)
    results = [curve for curve in panel.curves if curve.look == "joined"]
    exact = [curve for curve in panel.curves if curve.look != "joined"]
    traces = [_exact(panel, curve, look) for curve in exact]
    traces += [_curve(panel, curve, look.colour(curve.ink)) for curve in results]
    meta = {"name": "traction-creepage", "title": panel.y.label, "note": ""}
    figure = drawn(
        traces,
        look,
        meta,
        showlegend=len(traces) > 1,
        legend={"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom"},
        margin={"l": 50, "r": 24, "t": 34, "b": 42},
        xaxis={
            "title": {"text": panel.x.label},
            "range": numbers(panel.x.unit(np.array(panel.x.limits))).tolist(),
        },
        yaxis={"range": list(panel.y.limits or (0.0, 1.0))},
    )
    return [figure]


def _exact(panel: Panel, curve: Curve, look: Look) -> Part:
    dashes = {"dashed": "dash", "dotted": "dot"}[curve.look]
    return {
        **{"x": numbers(panel.x.unit(curve.x)), "y": numbers(curve.y)},
        **{"name": curve.name, "mode": "lines", "hoverinfo": "skip"},
        "line": {"color": look.faint, "width": 1.2, "dash": dashes},
    }


def _curve(panel: Panel, curve: Curve, colour: str) -> Part:
    errors = np.zeros(curve.x.shape) if curve.error is None else curve.error
    bars = {"type": "data", "array": numbers(np.nan_to_num(errors, posinf=0.0))}
    return {
        **{"x": numbers(panel.x.unit(curve.x)), "y": numbers(curve.y), "name": curve.name},
        **{"mode": "lines+markers", "line": {"color": colour, "width": 2}},
        "marker": {"color": colour, "size": 6},
        "error_y": bars | {"color": colour, "thickness": 1.2, "width": 3},
        "text": curve.texts,
        "hovertemplate": "%{text}<extra></extra>",
    }
