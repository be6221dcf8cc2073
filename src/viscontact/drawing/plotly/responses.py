"""Largest values of the runs of a sweep over a varied key, with the allowable limit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.key_axis import key_axis
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Axis
from viscontact.drawing.content.response import RunGroup, curves_over, points_over, swept_keys
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.results.sweep_axes import key_label
from viscontact.results.variables import SCALARS
from viscontact.results.verdicts import limits_of
from viscontact.units.formatting import ReadableUnit, format_compact, format_quantity

#: Most curves in the legend.
_MOST_CURVES = 10
#: A limit beyond this multiple of the largest value is named, but not drawn.
_FAR = 2.5
#: Colour of what exceeds its limit.
_RED = "#b00020"
#: Part of the space beyond the values.
_MARGIN = 0.06


def responses(ds: xr.Dataset, look: Look = LIGHT) -> list[go.Figure]:
    """Draw each chief scalar of a sweep over its varied keys; ValueError if nothing differs."""
    swept, limits = swept_keys(ds, "responses"), limits_of(ds)
    ds, keys = swept.ds, swept.keys
    if not swept.is_grid:
        return [
            _figure(
                name,
                key_axis(ds, key),
                [points_over(ds, name, key)],
                look,
                limits,
                mark=str(number),
            )
            for name in swept.scalars
            for number, key in enumerate(keys)
        ]
    axis, by = key_axis(ds, keys[0]), ", ".join(map(key_label, keys[1:]))
    return [
        _figure(name, axis, list(curves_over(ds, name, keys)), look, limits, by=by)
        for name in swept.scalars
    ]


def _figure(
    name: str,
    axis: Axis,
    groups: list[RunGroup],
    look: Look,
    limits: Mapping[str, float],
    mark: str = "",
    by: str = "",
) -> go.Figure:
    sizes = np.concatenate([group.values for group in groups])
    unit = look.unit(SCALARS[name].units, sizes)
    limit = limits.get(name, np.nan)
    colours = look.instants(len(groups)) if len(groups) > 1 else [look.blue]
    traces = [
        trace
        for group, colour in zip(groups, colours, strict=True)
        for trace in _traces(group, axis, colour, SCALARS[name].units, unit, look, limit)
    ]
    is_near = bool(limit <= _FAR * np.nanmax(sizes))
    line, words = _limit_line(unit, limit, look) if is_near else ([], [])
    allowed = format_quantity(limit, SCALARS[name].units)
    labelled = [group for group in groups if group.label]
    meta = {
        "name": "-".join(filter(None, ["response", name, mark])),
        "title": unit.label(SCALARS[name].label),
        "note": "" if is_near or np.isnan(limit) else f"allowable {allowed}: beyond the figure",
    }
    return drawn(
        traces,
        look,
        meta,
        xaxis=_across(axis),
        yaxis={"range": _range(groups, unit, limit if is_near else np.nan)},
        yaxis2={"overlaying": "y", "range": [0, 1], "visible": False, "fixedrange": True},
        shapes=line,
        annotations=words,
        showlegend=0 < len(labelled) <= _MOST_CURVES,
        legend={"orientation": "h", "y": -0.3, "font": {"size": 11}, "title": {"text": by}},
    )


def _limit_line(unit: ReadableUnit, limit: float, look: Look) -> tuple[list[Part], list[Part]]:
    """Dashed line at a limit, and its words."""
    at = limit / unit.factor
    both = {"xref": "paper", "y0": at, "y1": at, "x0": 0, "x1": 1, "type": "line"}
    text = f"allowable {format_compact(at, 4)} {unit.symbol}"
    words = {"xref": "paper", "x": 1, "xanchor": "right", "y": at, "yanchor": "bottom"}
    font = {"size": 11, "color": look.warm}
    line = {"color": look.warm, "width": 1.4, "dash": "dash"}
    return [both | {"line": line}], [words | {"text": text, "showarrow": False, "font": font}]


def _traces(
    group: RunGroup,
    axis: Axis,
    colour: str,
    si: str,
    unit: ReadableUnit,
    look: Look,
    limit: float,
) -> Iterator[Part]:
    """Curve with error bars, hollow points that depend on the mesh, crosses without a result."""
    places, values, errors = axis.unit(group.places), unit(group.values), unit(group.errors)
    on_mesh = np.isposinf(group.errors)
    sure = np.where(on_mesh, np.nan, values)
    bars = np.where(np.isfinite(errors), errors, 0.0)
    beyond = group.values - np.nan_to_num(group.errors, posinf=0.0) > limit
    sizes = zip(group.names, group.values.tolist(), group.errors.tolist(), strict=True)
    hover = [
        "" if np.isnan(value) else f"{escape(run)}: {look.text(value, error, si)}"
        for run, value, error in sizes
    ]
    curve: Part = {
        **{"x": numbers(places), "y": numbers(sure), "name": escape(group.label)},
        "mode": "lines+markers" if group.is_joined else "markers",
        "line": {"color": colour, "width": 1.8},
        "marker": {"color": colour, "size": 7},
        "error_y": {"array": numbers(bars), "color": colour, "thickness": 1, "width": 3},
        **{"text": hover, "hovertemplate": "%{text}<extra></extra>", "legendgroup": group.label},
    }
    yield curve
    lost = [f"{escape(run)}: no result" for run in group.names]
    edge = np.full(values.size, 0.02)
    for chosen, symbol, ink, up, text in (
        (beyond & ~on_mesh, "circle", _RED, values, hover),
        (beyond & on_mesh, "circle-open", _RED, values, hover),
        (~beyond & on_mesh, "circle-open", colour, values, hover),
        (group.missing, "x-thin-open", colour, edge, lost),
    ):
        if chosen.any():
            yield {
                **{"x": numbers(places[chosen]), "y": numbers(up[chosen])},
                **{"mode": "markers", "showlegend": False, "legendgroup": group.label},
                "marker": {"color": ink, "size": 8, "symbol": symbol},
                "text": np.array(text)[chosen].tolist(),
                "hovertemplate": "%{text}<extra></extra>",
                "yaxis": "y2" if text is lost else "y",
            }


def _across(axis: Axis) -> Part:
    """Axis of a key: texts at equal distances, or numbers, logarithmic over decades."""
    found: Part = {"title": {"text": axis.label}}
    if axis.texts:
        return found | {
            "tickvals": list(range(len(axis.texts))),
            "ticktext": list(map(escape, axis.texts)),
        }
    return found | ({"type": "log", "dtick": "D2"} if axis.scale == "log" else {})


def _range(groups: list[RunGroup], unit: ReadableUnit, limit: float) -> list[float]:
    """Range of all values with their errors, and of a limit."""
    sizes = [unit(group.values) for group in groups]
    bars = [np.where(np.isfinite(group.errors), unit(group.errors), 0.0) for group in groups]
    ends = [value + sign * bar for value, bar in zip(sizes, bars, strict=True) for sign in (-1, 1)]
    known = np.concatenate([*ends, [limit / unit.factor]])
    low, high = float(np.nanmin(known)), float(np.nanmax(known))
    room = _MARGIN * (high - low) or 0.5 * abs(high)
    return [low - room, high + room]
