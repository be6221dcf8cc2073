"""Largest values of the runs of a sweep over a varied key, with the allowable limit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.key_axis import name_of
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Axis, Curve, Mark, Panel
from viscontact.drawing.content.response import response_panels, swept_keys
from viscontact.drawing.plotly.parts import Part, drawn, literal, numbers

#: Height of the crosses over that of the axes.
_LOW = 0.02


def responses(ds: xr.Dataset, look: Look = LIGHT) -> list[go.Figure]:
    """Draw each chief scalar of a sweep over its varied keys; ValueError if nothing differs."""
    swept = swept_keys(ds, "responses")
    by = ", ".join(name_of(swept.ds, key) for key in swept.keys[1:]) if swept.is_grid else ""
    return [
        _figure(panel, look, by, name if swept.is_grid else f"{name}-{number}")
        for name in swept.scalars
        for number, panel in enumerate(response_panels(swept, name, look))
    ]


def _figure(panel: Panel, look: Look, by: str, name: str) -> go.Figure:
    crosses = [mark for mark in panel.marks if mark.look == "cross"]
    levels = [mark for mark in panel.marks if mark.axis == "y"]
    assert panel.y.limits is not None
    return drawn(
        [*_traces(panel, look), *([_crosses(panel, crosses, look)] if crosses else [])],
        look,
        {"name": f"response-{name}", "title": panel.y.label, "note": panel.note},
        xaxis=_across(panel.x),
        yaxis={"range": panel.y.unit(panel.y.limits).tolist()},
        yaxis2={"overlaying": "y", "range": [0, 1], "visible": False, "fixedrange": True},
        shapes=[_line(panel, mark, look) for mark in levels],
        annotations=[_words(panel, mark, look) for mark in levels],
        showlegend=any(curve.name for curve in panel.curves),
        legend={"orientation": "h", "y": -0.3, "font": {"size": 11}, "title": {"text": by}},
    )


def _line(panel: Panel, mark: Mark, look: Look) -> Part:
    """Dashed line at a level."""
    at = float(panel.y.unit(mark.place))
    line = {"color": look.colour(mark.ink), "width": 1.4, "dash": "dash"}
    ends = {"xref": "paper", "y0": at, "y1": at, "x0": 0, "x1": 1}
    return {"type": "line", "line": line} | ends


def _words(panel: Panel, mark: Mark, look: Look) -> Part:
    """Words of a level."""
    place = {"x": 1, "y": float(panel.y.unit(mark.place)), "xref": "paper"}
    font = {"size": 11, "color": look.colour(mark.ink)}
    anchors = {"xanchor": "right", "yanchor": "bottom", "showarrow": False}
    return {"text": mark.text, "font": font} | place | anchors


def _traces(panel: Panel, look: Look) -> Iterator[Part]:
    """Yield curves with their error bars, and the points beside each, which its legend hides."""
    group = 0
    for curve in panel.curves:
        colour = look.colour(curve.ink)
        group += curve.error is not None
        hollow = {"size": 8, "symbol": "circle-open" if curve.look == "white" else "circle"}
        yield {
            **{"x": numbers(panel.x.unit(curve.x)), "y": numbers(panel.y.unit(curve.y))},
            "mode": "lines+markers" if curve.look == "joined" else "markers",
            "text": list(curve.texts),
            **{"hovertemplate": "%{text}<extra></extra>", "legendgroup": str(group)},
            **({"showlegend": False} if curve.error is None else _main(panel, curve, colour)),
            "marker": {"color": colour} | (hollow if curve.error is None else {"size": 7}),
        }


def _main(panel: Panel, curve: Curve, colour: str) -> Part:
    """Name, line and error bars of a curve."""
    bars = numbers(panel.y.unit(0.0 if curve.error is None else curve.error))
    return {
        **{"name": curve.name, "showlegend": bool(curve.name)},
        "line": {"color": colour, "width": 1.8},
        "error_y": {"array": bars, "color": colour, "thickness": 1, "width": 3},
    }


def _crosses(panel: Panel, marks: list[Mark], look: Look) -> Part:
    """Crosses at the lower border."""
    colours = [look.colour(mark.ink) for mark in marks]
    return {
        "x": numbers(panel.x.unit([mark.place for mark in marks])),
        "y": numbers(np.full(len(marks), _LOW)),
        **{"mode": "markers", "showlegend": False, "yaxis": "y2"},
        "marker": {"color": colours, "size": 8, "symbol": "x-thin-open"},
        "text": [mark.text for mark in marks],
        "hovertemplate": "%{text}<extra></extra>",
    }


def _across(axis: Axis) -> Part:
    """Axis of a key: texts at equal distances, or numbers, logarithmic over decades."""
    found: Part = {"title": {"text": axis.label}}
    if axis.texts:
        return found | {
            "tickvals": list(range(len(axis.texts))),
            "ticktext": list(map(literal, axis.texts)),
        }
    return found | ({"type": "log", "dtick": "D2"} if axis.scale == "log" else {})
