"""Fit of a law to a force curve: contact point, force over approach, and residuals."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import plotly.graph_objects as go

from viscontact.drawing.content.fit_course import contact_panel, course_of, force_panel
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.identification import ContactPoint, IndentationFit

#: Part of the figure above the residuals.
_ABOVE, _BELOW = [0.36, 1.0], [0.0, 0.22]


def contact_point(contact: ContactPoint, look: Look = LIGHT) -> go.Figure:
    """Draw a force curve with its baseline, and the elastic body that gives the contact point."""
    panel = contact_panel(contact, look.unit)
    (mark,) = panel.marks
    at = float(panel.x.unit(mark.place))
    line = {"type": "line", "yref": "paper", "y0": 0, "y1": 1, "x0": at, "x1": at}
    return _draw_fit(
        panel, look, "fit-contact", shapes=[line | {"line": {"color": look.edge, "width": 1}}]
    )


def force_over_approach(fit: IndentationFit, look: Look = LIGHT) -> go.Figure:
    """Draw force over approach, measured and from the fitted law."""
    panel = replace(force_panel(fit, look.unit), note="points: measured")
    return _draw_fit(panel, look, "fit-loop")


def fit_over_time(fit: IndentationFit, look: Look = LIGHT) -> go.Figure:
    """Draw the fitted quantity over time, and below it the residuals [%]."""
    above, below = course_of(fit, look.unit)
    percent = {"yaxis": "y2", "hovertemplate": "%{y:.2f} %<extra></extra>"}
    traces = _traces(above, look) + [trace | percent for trace in _traces(below, look)]
    residual = {"title": {"text": below.y.label}, "zeroline": True, "domain": _BELOW}
    return drawn(
        traces,
        look,
        {"name": "fit-time", "title": above.y.label, "note": "below: residuals"},
        xaxis={"title": {"text": above.x.label}, "anchor": "y2"},
        yaxis={"domain": _ABOVE},
        yaxis2=residual,
        hovermode="x",
    )


def _draw_fit(panel: Panel, look: Look, name: str, **layout: Any) -> go.Figure:
    across: Part = {"title": {"text": panel.x.label}}
    if panel.x.limits is not None:
        across["range"] = panel.x.unit(panel.x.limits).tolist()
    meta = {"name": name, "title": panel.y.label, "note": panel.note}
    return drawn(_traces(panel, look), look, meta, xaxis=across, **layout)


def _traces(panel: Panel, look: Look) -> list[Part]:
    """Points of what was measured, and lines of what was fitted."""
    traces = []
    for curve in panel.curves:
        colour = look.colour(curve.ink)
        trace: Part = {
            **{"x": numbers(panel.x.unit(curve.x)), "y": numbers(panel.y.unit(curve.y))},
            "hovertemplate": f"%{{y:.4g}} {panel.y.unit.symbol}<extra></extra>",
        }
        if curve.look == "hollow":
            trace |= {"mode": "markers", "marker": {"color": colour, "size": 4}}
        else:
            dashes = {"width": 1.4, "dash": "dash"} if curve.look == "dashed" else {"width": 2}
            trace |= {"mode": "lines", "line": {"color": colour} | dashes}
        traces.append(trace)
    return traces
