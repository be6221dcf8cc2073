"""Scalars over time or speed: a curve with its band, another dashed, marks, both scales."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.backend.arrays import Singles
from viscontact.drawing.content.along_run import texts_along
from viscontact.drawing.content.history import history_panel, load_names, response_names
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Curve, Panel
from viscontact.drawing.plotly.parts import Part, drawn, numbers, words
from viscontact.drawing.plotly.run_scale import part_along, places_along

#: Names of the frames of a linear and a logarithmic axis.
LINEAR, LOGARITHMIC = "linear", "log"


def panel_over_run(panel: Panel, look: Look, name: str, hover: Sequence[str]) -> go.Figure:
    """Draw a panel over time or speed, with a text at each point of its first curve."""
    shown = _frame(panel, look, log=panel.x.scale != "linear")
    both = [_frame(panel, look, log=log) for log in (False, True)] if panel.x.has_choice else ()
    limits = panel.y.limits
    return drawn(
        [
            style | part
            for style, part in zip(_styles(panel, look, hover), shown["data"], strict=True)
        ],
        look,
        {"name": name, "title": panel.y.label, "note": panel.note},
        frames=both,
        **shown["layout"],
        yaxis={
            "range": [0.0, 1.0] if limits is None else panel.y.unit(limits).tolist(),
            "showticklabels": not panel.in_place,
        },
        hovermode="x",
        annotations=[words(panel.in_place, look)] if panel.in_place else [],
        **_axis_aside(panel, look),
    )


def _axis_aside(panel: Panel, look: Look) -> Part:
    """Axis at the right of a curve that has its own."""
    if panel.aside is None:
        return {}
    axis, colour = panel.aside.axis, look.colour(panel.aside.curve.ink)
    limits = {} if axis.limits is None else {"range": axis.unit(axis.limits).tolist()}
    own = {"overlaying": "y", "side": "right", "showgrid": False, "color": colour}
    own |= {"tickmode": "auto", "nticks": 6}  # by default at the places of the other axis
    return {"yaxis2": {**own, **limits, "title": {"text": axis.label}}}


def _frame(panel: Panel, look: Look, *, log: bool) -> Part:
    """Positions on a linear or a logarithmic axis."""
    name = LOGARITHMIC if log else LINEAR
    return {
        "name": name,
        "traces": list(range(len(panel.curves) + 1 + (panel.aside is not None))),
        "data": _positions(panel, log=log),
        # A part that was enlarged on one scale is elsewhere on the other.
        "layout": {
            "xaxis": part_along(panel.x, log=log),
            "uirevision": name,
            "shapes": _event_lines(panel, look, log=log),
        },
    }


def _styles(panel: Panel, look: Look, hover: Sequence[str]) -> list[Part]:
    """Curves and band without their positions: the reference first, the result on top."""
    shade = {"mode": "lines", "fill": "toself", "fillcolor": look.band, "line": {"width": 0}}
    curve, *others = panel.curves
    line = {"color": look.blue, "width": 2}
    dashed = {"color": look.warm, "width": 2, "dash": "dash"}
    return [
        *_style_aside(panel, look),
        *(_line(panel, other, dashed) | {"hoverinfo": "skip"} for other in others),
        shade | {"y": _band(panel, curve), "hoverinfo": "skip"},
        _line(panel, curve, line) | {"text": hover, "hovertemplate": "%{text}<extra></extra>"},
    ]


def _style_aside(panel: Panel, look: Look) -> list[Part]:
    """Curve on an axis of its own, without its positions."""
    if panel.aside is None:
        return []
    axis, curve = panel.aside.axis, panel.aside.curve
    line = {"color": look.colour(curve.ink), "width": 1}
    values = numbers(axis.unit(curve.y))
    return [{"y": values, "yaxis": "y2", "mode": "lines", "line": line, "hoverinfo": "skip"}]


def _line(panel: Panel, curve: Curve, line: Part) -> Part:
    marked = "lines+markers" if curve.look == "joined" else "lines"
    return {
        "y": numbers(panel.y.unit(curve.y)),
        "mode": "markers" if curve.y.size < 2 else marked,
        "line": line,
        "marker": {"color": line["color"], "size": 5},
    }


def _positions(panel: Panel, *, log: bool) -> list[Part]:
    """Positions along the axis of what `_styles` returns."""
    places = [places_along(panel.x, curve.x, log=log) for curve in panel.curves]
    parts = _parts(panel.curves[0])
    edges = [[*places[0][part], *places[0][part][::-1], np.nan] for part in parts]
    band = np.concatenate(edges or [[]])
    drawn = [*places[1:], band, places[0]]
    if panel.aside is not None:
        drawn.insert(0, places_along(panel.x, panel.aside.curve.x, log=log))
    return [{"x": numbers(each)} for each in drawn]


def _event_lines(panel: Panel, look: Look, *, log: bool) -> list[Part]:
    """Dotted lines at the events of a load program, with their numbers from 1."""
    line = {"color": look.faint, "width": 1, "dash": "dot"}
    label = {"textangle": 0, "textposition": "end", "xanchor": "right", "yanchor": "top"}
    label["font"] = {"size": 10, "color": look.faint}
    return [
        {
            **{"type": "line", "yref": "paper", "y0": 0, "y1": 1, "layer": "below", "line": line},
            **{"x0": place, "x1": place, "label": label | {"text": str(number)}},
        }
        for number, mark in enumerate(panel.marks, start=1)
        for place in places_along(panel.x, np.array([mark.place]), log=log).tolist()
    ]


def _band(panel: Panel, curve: Curve) -> Singles:
    """Edges of the band: a closed polygon for each run of instants whose error is known."""
    error = np.nan if curve.error is None else curve.error
    low, high = (panel.y.unit(curve.y + sign * error) for sign in (-1, 1))
    edges = [[*high[part], *low[part][::-1], np.nan] for part in _parts(curve)]
    return numbers(np.concatenate(edges or [[]]))


def _parts(curve: Curve) -> list[slice]:
    """Runs of two instants or more whose error is known."""
    if curve.error is None:
        return []
    known = np.isfinite(curve.y) & np.isfinite(curve.error)
    changes = np.flatnonzero(np.diff([False, *known, False]))
    return [slice(a, b) for a, b in changes.reshape(-1, 2).tolist() if b - a > 1]


def history(
    ds: xr.Dataset, name: str, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> go.Figure:
    """Draw a scalar over time or speed with its error band, and the same of a reference dashed."""
    panel = history_panel({"": ds}, name, look.unit, reference)
    return panel_over_run(panel, look, f"history-{name}", texts_along(ds, name, look))


def histories(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> list[go.Figure]:
    """Draw what is prescribed, and what answers: a figure for each scalar that has a panel."""
    return [history(ds, name, look, reference) for name in (*load_names(ds), *response_names(ds))]
