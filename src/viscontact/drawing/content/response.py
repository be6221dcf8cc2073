"""Largest values of the runs of a sweep over its varied keys, with the allowable limit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.key_axis import (
    is_number,
    key_axis,
    key_labels,
    numbered_texts,
    places_on,
)
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import Axis, Curve, Ink, Mark, MarkLook, Panel
from viscontact.results.largest_values import compared_scalars, largest_values
from viscontact.results.sweep_axes import over_of, run_dims, varied_keys
from viscontact.results.variables import variable_of
from viscontact.results.verdicts import limits_of
from viscontact.units.formatting import format_compact, format_quantity

#: Most keys of runs that are no grid, and most curves that all have a name.
_MOST_KEYS, _MOST_CURVES = 4, 8
#: Least number of values of both keys for a contour map, and of points that are small.
_LEAST_MAP, _MANY = 5, 200
#: A limit beyond this multiple of the largest value is named, but not drawn.
_FAR = 2.5
#: Part of the space beyond the values.
_MARGIN = 0.06


@dataclass(frozen=True)
class SweptKeys:
    """Runs of a sweep: the chief scalars, and the keys, the longest axis first."""

    ds: xr.Dataset
    scalars: list[str]
    keys: list[str]
    is_grid: bool  # of one or two keys: curves over the first one; else points over each

    @property
    def numeric(self) -> list[str]:
        """Keys whose values are numbers."""
        return [key for key in self.keys if is_number(self.ds, key)]

    @property
    def suits_map(self) -> bool:
        """True for a grid of two keys with so many values that contours read best."""
        least = min(self.ds.sizes[key] for key in self.keys) if self.is_grid else 0
        return len(self.numeric) == 2 and least >= _LEAST_MAP


@dataclass(frozen=True)
class _RunGroup:
    """Some runs: places, largest values, errors [SI], and those without a result."""

    places: Floats  # on the axis
    values: Floats
    errors: Floats  # inf for a value that depends on the mesh
    missing: Bools
    names: list[str]
    label: str = ""
    is_joined: bool = False


def swept_keys(ds: xr.Dataset, figure: str) -> SweptKeys:
    """Scalars and keys to draw; ValueError, naming the figure, if there are none."""
    scalars, keys = compared_scalars(ds), varied_keys(ds)
    if not scalars or not keys:
        what = "scalar differs between the finished runs" if keys else "key is varied"
        raise ValueError(f"{figure}: no {what}; give a sweep of two finished runs or more")
    ds = ds.squeeze([dim for dim in run_dims(ds) if ds.sizes[dim] == 1], drop=True)
    ds = ds.assign_coords(numbered_texts(ds, keys))
    if not set(keys) <= set(run_dims(ds)) or len(keys) > 2:
        return SweptKeys(ds, scalars, keys[:_MOST_KEYS], is_grid=False)
    numeric = [key for key in keys if is_number(ds, key)]
    ds = ds.sortby(numeric)
    keys = sorted(keys, key=lambda key: (key in numeric) * ds.sizes[key], reverse=True)
    return SweptKeys(ds, scalars, keys, is_grid=True)


def response_panels(swept: SweptKeys, name: str, look: Look = LIGHT) -> list[Panel]:
    """Panel of a scalar over the first key of a grid; of other runs a panel over each key."""
    ds, keys = swept.ds, swept.keys
    if swept.is_grid:
        return [_panel(ds, name, keys[0], list(_curves_over(ds, name, keys)), look)]
    return [_panel(ds, name, key, [_points_over(ds, name, key)], look) for key in keys]


def response_note(swept: SweptKeys, *, has_bars: bool) -> str:
    """Description of the values, and the number of runs without one."""
    ds = swept.ds
    errors = [largest_values(ds, name)[1].values for name in swept.scalars]
    note = f"Largest values over {over_of(ds)}"
    if has_bars and any((np.isfinite(each) & (each > 0)).any() for each in errors):
        note += ", with error bars"
    if has_bars and any(np.isposinf(each).any() for each in errors):
        note += "; hollow: depends on the mesh"
    if missing := int((ds["state"] != "done").sum()):
        runs = "1 run" if missing == 1 else f"{missing} runs"
        note += f"; ×: no result ({runs} of {ds['state'].size})"
    return note


def _panel(ds: xr.Dataset, name: str, key: str, groups: list[_RunGroup], look: Look) -> Panel:
    """Panel of groups of runs over a key, with the allowable value if it is near."""
    variable, limit = variable_of(name), limits_of(ds).get(name, np.nan)
    values = np.concatenate([group.values for group in groups])
    unit, is_near = look.unit(variable.units, values), bool(limit <= _FAR * np.nanmax(values))
    text = f"allowable {format_compact(float(unit(limit)), 4)} {unit.symbol}".rstrip()
    allowed = f"allowable {format_quantity(limit, variable.units)}: beyond the figure"
    marks = [Mark(limit, "y", text, "dashed", Ink("fit"))] if is_near else []
    few, last = len(groups) <= _MOST_CURVES, len(groups) - 1
    inks = inks_of([group.label for group in groups])
    if not few:
        inks = [Ink("ordered", number / last) for number in range(len(groups))]
    curves: list[Curve] = []
    for number, (group, ink) in enumerate(zip(groups, inks, strict=True)):
        label = group.label if few or number in (0, last) else ""
        curves += _curves_of(group, label, ink, limit, partial(look.text, si=variable.units))
        lost = zip(group.places[group.missing].tolist(), np.flatnonzero(group.missing), strict=True)
        marks += [
            Mark(place, text=f"{group.names[run]}: no result", look="cross", ink=ink)
            for place, run in lost
        ]
    return Panel(
        key_axis(ds, key),
        Axis(variable.label, unit, _limits(groups, limit if is_near else np.nan)),
        tuple(curves),
        marks=tuple(marks),
        note="" if is_near or np.isnan(limit) else allowed,
        name=name,
    )


def _curves_of(
    group: _RunGroup, label: str, ink: Ink, limit: float, text: Callable[[float, float], str]
) -> Iterator[Curve]:
    """Yield a curve with errors, and values beyond the limit, or on the mesh, on no curve."""
    on_mesh = np.isposinf(group.errors)
    known = np.where(np.isfinite(group.errors), group.errors, 0.0)
    beyond = group.values - known > limit
    texts = [
        "" if np.isnan(value) else f"{run}: {text(value, error)}"
        for run, value, error in zip(
            group.names, group.values.tolist(), group.errors.tolist(), strict=True
        )
    ]
    yield Curve(
        *(group.places, np.where(on_mesh, np.nan, group.values), label, ink),
        look="joined" if group.is_joined else "points",
        error=known,
        texts=tuple(texts),
        is_fine=group.values.size > _MANY,
    )
    parts: tuple[tuple[Bools, MarkLook, Ink], ...] = (
        (beyond & ~on_mesh, "points", Ink("beyond")),
        (beyond & on_mesh, "white", Ink("beyond")),
        (~beyond & on_mesh, "white", ink),
    )
    for chosen, look, of in parts:
        if chosen.any():
            shown = tuple(np.array(texts, dtype=object)[chosen].tolist())
            yield Curve(group.places[chosen], group.values[chosen], "", of, look, texts=shown)


def _limits(groups: list[_RunGroup], limit: float) -> tuple[float, float]:
    """Range of all values with their errors, and of a limit [SI]."""
    values = np.concatenate([group.values for group in groups])
    errors = np.concatenate([group.errors for group in groups])
    bars = np.where(np.isfinite(errors), errors, 0.0)
    known = np.concatenate([values - bars, values + bars, [limit]])
    low, high = float(np.nanmin(known)), float(np.nanmax(known))
    room = _MARGIN * (high - low) or 0.5 * abs(high)
    return low - room, high + room


def _points_over(ds: xr.Dataset, name: str, key: str) -> _RunGroup:
    """All runs over one key."""
    values, errors = (each.values.ravel() for each in largest_values(ds, name))
    places = xr.broadcast(ds[key], ds["state"])[0].transpose(*ds["state"].dims).values.ravel()
    missing = (ds["state"] != "done").values.ravel()
    return _RunGroup(places_on(key_axis(ds, key), places), values, errors, missing, _names(ds))


def _curves_over(ds: xr.Dataset, name: str, keys: list[str]) -> Iterator[_RunGroup]:
    """Runs over the first key, for each value of the second one."""
    axis, missing = key_axis(ds, keys[0]), ds["state"] != "done"
    arrays = (*largest_values(ds, name), missing)
    values, errors, lost = (each.transpose(*keys).values for each in arrays)
    shape = (values.shape[0], -1)
    names = np.array(_names(ds.transpose(*keys, ...)), dtype=object).reshape(shape)
    labels = key_labels(ds, keys[1]) if len(keys) > 1 else [""]
    places = places_on(axis, ds[keys[0]].values)
    for row, label in enumerate(labels):
        value, error, is_lost = (each.reshape(shape)[:, row] for each in (values, errors, lost))
        yield _RunGroup(
            places, value, error, is_lost, list(names[:, row]), label, is_joined=not axis.texts
        )


def _names(ds: xr.Dataset) -> list[str]:
    names = ds["name"].values.ravel() if "name" in ds else np.full(ds["state"].size, "")
    return [str(name) for name in names]
