"""Loops of a run: force over approach, resistance over position."""

from __future__ import annotations

import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.along_run import texts_along
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.loop import Loop, cycle_panel, loops_of
from viscontact.drawing.plotly.parts import Part, drawn, numbers


def loops(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> list[go.Figure]:
    """Draw the loops of a run, each beside that of a reference; none of a result over speed."""
    others = [] if reference is None else [each.name for each in loops_of(reference)]
    return [
        _draw(ds, loop, look, reference if loop.name in others else None) for loop in loops_of(ds)
    ]


def _draw(ds: xr.Dataset, loop: Loop, look: Look, reference: xr.Dataset | None) -> go.Figure:
    """Draw a loop: earlier and later cycles thin, the last whole one bold."""
    panel, hover = cycle_panel(ds, loop, look.unit, reference), texts_along(ds, loop.value, look)
    across, up = panel.x, panel.y
    thin, bold = {"color": look.line, "width": 1}, {"color": look.blue, "width": 2.2}
    template = f"{across.quantity} %{{x:.4g}} {across.unit.symbol}, %{{text}}<extra></extra>"
    others = panel.curves[:-3]
    dashed = {"color": look.warm, "width": 1.6, "dash": "dash"}
    texts = hover[: loop.last + 1], hover[loop.last : loop.end + 1], hover[loop.end :]
    traces: list[Part] = [
        {"mode": "lines", "line": dashed, "hoverinfo": "skip"} for _ in others
    ] + [
        {"mode": "lines", "line": line, "text": text, "hovertemplate": template}
        for line, text in zip((thin, bold, thin), texts, strict=True)
    ]
    for trace, curve in zip(traces, panel.curves, strict=True):
        trace |= {"x": numbers(across.unit(curve.x)), "y": numbers(up.unit(curve.y))}
    title = f"{up.quantity} over {across.quantity.lower()} [{up.unit.symbol}]"
    meta = {"name": loop.name, "title": title, "note": panel.note}
    return drawn(
        traces, look, meta, xaxis={"title": {"text": across.label}}, yaxis={"zeroline": True}
    )
