"""Largest values of the runs of a sweep over a varied key, with the allowable limit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from html import escape

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.figures.parts import Part, drawn, numbers
from viscontact.plot.sweeps.key_axis import KeyAxis, is_number, key_labels
from viscontact.results.largest_values import (
    compared_scalars,
    key_label,
    largest_values,
    run_dims,
    varied_keys,
)
from viscontact.results.variables import SCALARS
from viscontact.results.verdicts import limits_of
from viscontact.units.formatting import ReadableUnit, format_compact, format_quantity

#: Most keys of runs that are no grid, and most curves in the legend.
_MOST_KEYS, _MOST_CURVES = 4, 10
#: A limit beyond this multiple of the largest value is named, but not drawn.
_FAR = 2.5
#: Colour of what exceeds its limit.
_RED = "#b00020"
#: Part of the space beyond the values.
_MARGIN = 0.06


def responses(ds: xr.Dataset, look: Look = LIGHT) -> list[go.Figure]:
    """Draw each chief scalar of a sweep over its varied keys.

    Parameters
    ----------
    ds : xarray.Dataset
        Runs of a sweep, from `viscontact.open_many`.
    look : Look, optional
        Colours and units.

    Returns
    -------
    list of plotly.graph_objects.Figure
        The largest value over time or speed of each scalar that differs between the runs: curves
        over the key with most values, one for each value of a second key; of runs that are no grid
        of one or two keys, points over each key. Bars are errors, hollow points depend on the
        mesh, crosses at the lower edge are runs without a result. The dashed line is the allowable
        value that all runs have; points beyond it with their errors are red.

    Raises
    ------
    ValueError
        If no scalar differs between the finished runs, or no key is varied.

    Examples
    --------
    >>> coords = {"load.force": ("load.force", [1.0, 8.0], {"units": "N"}), "time": [0.0]}
    >>> approach = (("load.force", "time"), [[1e-5], [4e-5]])
    >>> runs = {"state": ("load.force", ["done", "done"]), "approach": approach}
    >>> (figure,) = responses(xr.Dataset(runs, coords))
    >>> figure.layout.xaxis.title.text, figure.layout.meta["title"], figure.data[0].y.tolist()
    ('Load force [N]', 'Approach [µm]', [10.0, 40.0])
    """
    scalars, keys = compared_scalars(ds), varied_keys(ds)
    if not scalars or not keys:
        what = "scalar differs between the finished runs" if keys else "key is varied"
        raise ValueError(f"responses: no {what}; give a sweep of two finished runs or more")
    limits = limits_of(ds)
    ds = ds.squeeze([dim for dim in run_dims(ds) if ds.sizes[dim] == 1], drop=True)
    if not set(keys) <= set(run_dims(ds)) or len(keys) > 2:
        return [
            _figure(
                ds,
                name,
                KeyAxis.of(ds, key),
                list(_points(ds, name, key, look)),
                look,
                limits,
                str(number),
            )
            for name in scalars
            for number, key in enumerate(keys[:_MOST_KEYS])
        ]
    numeric = [key for key in keys if is_number(ds, key)]
    ds = ds.sortby(numeric)
    keys = sorted(keys, key=lambda key: (key in numeric) * ds.sizes[key], reverse=True)
    axis, by = KeyAxis.of(ds, keys[0]), ", ".join(map(key_label, keys[1:]))
    return [
        _figure(ds, name, axis, list(_curves(ds, name, keys, look)), look, limits, by=by)
        for name in scalars
    ]


@dataclass(frozen=True)
class _Runs:
    """Some runs: places on the axis, largest values [SI] with errors, names, and their colour."""

    places: Floats
    values: Floats
    errors: Floats
    missing: Bools
    names: list[str]
    label: str
    colour: str
    joined: bool


def _points(ds: xr.Dataset, name: str, key: str, look: Look) -> Iterator[_Runs]:
    """All runs over one key."""
    values, errors = (each.values.ravel() for each in largest_values(ds, name))
    places = xr.broadcast(ds[key], ds["state"])[0].transpose(*ds["state"].dims).values.ravel()
    missing = (ds["state"] != "done").values.ravel()
    at = KeyAxis.of(ds, key).at(places)
    yield _Runs(at, values, errors, missing, _names(ds), "", look.blue, joined=False)


def _curves(ds: xr.Dataset, name: str, keys: list[str], look: Look) -> Iterator[_Runs]:
    """Runs over the first key, for each value of the second one."""
    axis, missing = KeyAxis.of(ds, keys[0]), ds["state"] != "done"
    arrays = (*largest_values(ds, name), missing)
    values, errors, lost = (each.transpose(*keys).values for each in arrays)
    shape = (values.shape[0], -1)
    names = np.array(_names(ds.transpose(*keys, ...)), dtype=object).reshape(shape)
    labels = key_labels(ds, keys[1]) if len(keys) > 1 else [""]
    colours = look.instants(len(labels)) if len(labels) > 1 else [look.blue]
    places, joined = axis.at(ds[keys[0]].values), not axis.texts
    for row, (label, colour) in enumerate(zip(labels, colours, strict=True)):
        value, error, is_lost = (each.reshape(shape)[:, row] for each in (values, errors, lost))
        yield _Runs(places, value, error, is_lost, list(names[:, row]), label, colour, joined)


def _names(ds: xr.Dataset) -> list[str]:
    names = ds["name"].values.ravel() if "name" in ds else np.full(ds["state"].size, "")
    return [str(name) for name in names]


def _figure(  # noqa: PLR0913
    ds: xr.Dataset,
    name: str,
    axis: KeyAxis,
    groups: list[_Runs],
    look: Look,
    limits: Mapping[str, float],
    mark: str = "",
    by: str = "",
) -> go.Figure:
    sizes = np.concatenate([group.values for group in groups])
    unit = look.unit(SCALARS[name].units, sizes)
    limit = limits.get(name, np.nan)
    traces = [
        trace
        for group in groups
        for trace in _traces(group, SCALARS[name].units, unit, look, limit)
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


def _traces(group: _Runs, si: str, unit: ReadableUnit, look: Look, limit: float) -> Iterator[Part]:
    """Curve with error bars, hollow points that depend on the mesh, crosses without a result."""
    values, errors = unit(group.values), unit(group.errors)
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
        **{"x": numbers(group.places), "y": numbers(sure), "name": escape(group.label)},
        "mode": "lines+markers" if group.joined else "markers",
        "line": {"color": group.colour, "width": 1.8},
        "marker": {"color": group.colour, "size": 7},
        "error_y": {"array": numbers(bars), "color": group.colour, "thickness": 1, "width": 3},
        **{"text": hover, "hovertemplate": "%{text}<extra></extra>", "legendgroup": group.label},
    }
    yield curve
    lost = [f"{escape(run)}: no result" for run in group.names]
    edge = np.full(values.size, 0.02)
    for chosen, symbol, colour, up, text in (
        (beyond & ~on_mesh, "circle", _RED, values, hover),
        (beyond & on_mesh, "circle-open", _RED, values, hover),
        (~beyond & on_mesh, "circle-open", group.colour, values, hover),
        (group.missing, "x-thin-open", group.colour, edge, lost),
    ):
        if chosen.any():
            yield {
                **{"x": numbers(group.places[chosen]), "y": numbers(up[chosen])},
                **{"mode": "markers", "showlegend": False, "legendgroup": group.label},
                "marker": {"color": colour, "size": 8, "symbol": symbol},
                "text": np.array(text)[chosen].tolist(),
                "hovertemplate": "%{text}<extra></extra>",
                "yaxis": "y2" if text is lost else "y",
            }


def _across(axis: KeyAxis) -> Part:
    """Axis of a key: texts at equal distances, or numbers, logarithmic over decades."""
    found: Part = {"title": {"text": axis.unit.label(axis.name)}}
    if axis.texts:
        return found | {
            "tickvals": list(range(len(axis.texts))),
            "ticktext": list(map(escape, axis.texts)),
        }
    return found | ({"type": "log", "dtick": "D2"} if axis.is_log else {})


def _range(groups: list[_Runs], unit: ReadableUnit, limit: float) -> list[float]:
    """Range of all values with their errors, and of a limit."""
    sizes = [unit(group.values) for group in groups]
    bars = [np.where(np.isfinite(group.errors), unit(group.errors), 0.0) for group in groups]
    ends = [value + sign * bar for value, bar in zip(sizes, bars, strict=True) for sign in (-1, 1)]
    known = np.concatenate([*ends, [limit / unit.factor]])
    low, high = float(np.nanmin(known)), float(np.nanmax(known))
    room = _MARGIN * (high - low) or 0.5 * abs(high)
    return [low - room, high + room]
