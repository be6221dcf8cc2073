"""Largest stress in a half-space or layers below the largest pressure of a run, with its error."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.last_cycle_values import first_largest
from viscontact.results.recorded_case import is_layered, recorded_ends, recorded_grid
from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import errors_of
from viscontact.results.stress_source import (
    BENEATH,
    LOADS,
    at_largest_traction,
    stress_source,
)
from viscontact.results.stresses import REACH, section_stresses

#: Number of depths of the search, of those around the deepest of them, and least of a layer.
_DEPTHS, _CLOSE, _PER_LAYER = 14, 7, 5

#: Body whose stress is found.
BODY = "material"

#: Relative difference of stresses of two planes that are equal.
_EQUAL = 1e-3


@dataclass(frozen=True)
class PeakStress:
    """The largest stress below the largest pressure."""

    value: float  # [Pa]
    error: float  # half width of its error bar [Pa]; inf if mesh-dependent, NaN if unknown
    place: float  # instant [s] or speed [m/s]
    depth: float  # [m]
    plane: str = ""  # axis along which its vertical plane runs, "x" or "y"; empty for both
    layer: int = 0  # from the surface on; one more than there are is the base; 0 without layers


def peak_stress(ds: xr.Dataset, name: str) -> PeakStress:
    """Return the largest stress on the two vertical planes through the largest pressure of a run.

    Under friction also at the instant of the largest force along the surface, if its fields are
    stored, and of several creepages under that of the largest traction.

    ValueError, with the reason, where that instant has no stored fields, or no known stresses.
    """
    ds = at_largest_traction(ds)
    pressed, pulled = row_of_largest_pressure(ds), _row_of_largest_pull(ds)
    found = _peak_at(ds, pressed, name)
    if pulled is None or pulled == pressed:
        return found
    other = _peak_at(ds, pulled, name)
    return other if other.value > found.value else found


def row_of_largest_pressure(ds: xr.Dataset) -> int:
    """Row of the largest pressure of a run."""
    return first_largest(np.nan_to_num(ds["peak_pressure"].values))


def _row_of_largest_pull(ds: xr.Dataset) -> int | None:
    """That of the largest force of friction; None without one, or where fields are not stored."""
    names = [f"tangential_force_{axis}" for axis in "xy"]
    if not all(name in ds for name in (*names, *LOADS)):
        return None
    forces = np.hypot(*(np.nan_to_num(ds[name].values) for name in names))
    row = first_largest(forces)
    stored = _stored_rows(ds, float(run_axis(ds).values(ds)[row]))
    return row if forces[row] > 0 and stored.size else None


def _peak_at(ds: xr.Dataset, row: int, name: str) -> PeakStress:
    """Largest stress at an instant or a speed."""
    # The error is the sum of the relative error of the peak pressure, to which stresses are
    # proportional, the change of the stress on cells of twice the size, and that between the depths
    # of the search.
    peaks = np.nan_to_num(ds["peak_pressure"].values)
    place = float(run_axis(ds).values(ds)[row])
    if peaks[row] == 0:
        return PeakStress(0.0, 0.0, place, 0.0)
    field = _loaded_part(_field_at(ds, place))
    parts = _depths(field, ds, row)
    found = _locate_largest(field, parts, name)
    relative = float(errors_of(ds, "peak_pressure")[row]) / float(peaks[row])
    coarse = _coarser(field)
    change = (
        np.nan if coarse is None else abs(_peaks(coarse, found.around, name).max() - found.value)
    )
    error = found.value * relative + change + found.error
    plane = _plane(field, found.depth, name)
    layer = found.part + 1 if len(parts) > 1 or is_layered(ds) else 0
    return PeakStress(found.value, error, place, found.depth, plane, layer)


def _field_at(ds: xr.Dataset, place: float) -> xr.Dataset:
    """Loads at an instant or a speed; ValueError if they are not stored, or do not suffice."""
    axis = run_axis(ds)
    if "pressure" not in ds:
        raise ValueError("no fields are stored (output.fields)")
    over, stored = str(ds["pressure"].dims[0]), _stored_rows(ds, place)
    if not stored.size:
        raise ValueError(
            f"the largest pressure is at {axis.place(place)}, whose fields are not stored; add it "
            "to output.fields"
        )
    loads = [name for name in LOADS if name in ds]
    if stress_source(ds).follows_history:
        raise ValueError(
            "in these layers, which creep differently, stresses depend on the history of the "
            "pressure, and the largest one is not searched for; see section_stresses"
        )
    return ds[loads].isel({over: stored[:1]}).load()


def _stored_rows(ds: xr.Dataset, place: float) -> Integers:
    """Rows of the stored fields at an instant or a speed."""
    stored = ds[str(ds["pressure"].dims[0])].values
    return np.flatnonzero(np.isclose(stored, place, rtol=1e-9, atol=0.0))


def _loaded_part(field: xr.Dataset) -> xr.Dataset:
    """Smallest part of the grid that contains all pressure; a period is kept."""
    pressed = (field["pressure"] != 0).any(str(field["pressure"].dims[0]))
    grid = recorded_grid(field)
    for axis, periodic in zip("xy", grid.periodic, strict=True):
        cells = np.flatnonzero(pressed.any("yx"["xy".index(axis)]).values)
        if not periodic:
            field = field.isel({axis: slice(max(cells[0] - 1, 0), cells[-1] + 2)})
    return field


def _depths(field: xr.Dataset, ds: xr.Dataset, row: int) -> list[Floats]:
    """Depths deep enough for the whole contact, and close to the surface for its single spots.

    Those of each layer and of the base are apart, as most stresses jump in between.
    """
    least = min(_cell(field, axis) for axis in "xy")
    extents = [float(ds[f"contact_{each}"][row]) for each in ("length", "width")]
    reach = REACH * min(extents) / 2
    depths = np.append(0.0, np.geomspace(least / 2, max(reach, 2 * least), _DEPTHS))
    source = stress_source(field)
    deepest = float(depths[-1])
    if source.on_rigid_base:
        deepest = min(deepest, source.interfaces[-1])
    inside = [each for each in source.interfaces if each < deepest]
    if not inside and deepest == depths[-1]:
        return [depths]
    found = []
    for top, bottom in zip([0.0, *inside], [*inside, deepest], strict=True):
        ends = np.linspace(top * (1 + BENEATH), bottom, _PER_LAYER)
        found.append(np.union1d(ends, depths[(depths > ends[0]) & (depths < bottom)]))
    return found


@dataclass(frozen=True)
class _LocatedPeak:
    value: float  # [Pa]
    depth: float  # [m]
    error: float  # of the search in depth [Pa]
    around: Floats  # depths searched last [m]
    part: int  # of the depths, from the surface on


def _locate_largest(field: xr.Dataset, parts: list[Floats], name: str) -> _LocatedPeak:
    """Search for the largest of a stress over depths [m] of parts, then between two of them."""
    peaks = np.split(_peaks(field, np.concatenate(parts), name), np.cumsum([*map(len, parts)])[:-1])
    part = int(np.argmax([each.max() for each in peaks]))
    depths, at = parts[part], int(peaks[part].argmax())
    close = np.linspace(depths[max(at - 1, 0)], depths[min(at + 1, depths.size - 1)], _CLOSE)
    finer = _peaks(field, close, name)
    best = int(finer.argmax())
    value, depth, error = float(finer[best]), float(close[best]), 0.0
    if 0 < best < _CLOSE - 1:  # up to the vertex of the parabola through three depths
        before, here, after = finer[best - 1 : best + 2].tolist()
        bend = 2 * here - before - after
        if bend > 0:
            error = (after - before) ** 2 / (8 * bend)
            depth += float(close[1] - close[0]) * (after - before) / (2 * bend)
    return _LocatedPeak(value + error, depth, error, close, part)


def _peaks(field: xr.Dataset, depths: Floats, name: str) -> Floats:
    """Largest stress at each depth on the planes of x and y through the largest pressure [Pa]."""
    return np.asarray(np.maximum(*_on_planes(field, depths, name)))


def _plane(field: xr.Dataset, depth: float, name: str) -> str:
    """Axis along which the plane of the larger stress at a depth [m] runs; empty for equal ones."""
    along, across = (float(each[0]) for each in _on_planes(field, np.array([depth]), name))
    if abs(along - across) <= _EQUAL * max(along, across):
        return ""
    return "x" if along > across else "y"


def _on_planes(field: xr.Dataset, depths: Floats, name: str) -> tuple[Floats, Floats]:
    """Largest stress at each depth on the plane along x, and on that along y [Pa]."""
    cells = field["pressure"].isel({str(field["pressure"].dims[0]): 0}).transpose("x", "y")
    i, j = np.unravel_index(int(cells.values.argmax()), cells.shape)
    along = section_stresses(field, depths, y=float(field["y"][j]))[name].values[0]
    across = section_stresses(field, depths, x=float(field["x"][i]))[name].values[0]
    # There is no stress beyond the ends of a body.
    return np.nanmax(along, axis=1), np.nanmax(across, axis=1)


def _coarser(field: xr.Dataset) -> xr.Dataset | None:
    """Loads on cells of twice the size; None where a period or a body has an odd number."""
    grid = recorded_grid(field)
    for axis, periodic, count in zip("xy", grid.periodic, grid.shape, strict=True):
        if count == 1:
            continue
        odd = _parities_of_ends(field) if axis == "x" else set()
        if len(odd) > 1:
            return None
        first = max(odd, default=0)
        if (count + first) % 2 and periodic:
            return None
        for before, after in ((first, 0), (0, (count + first) % 2)):
            field = _padded(field, axis, before, after)
        field = field.coarsen({axis: 2}).mean()
    return field


def _parities_of_ends(field: xr.Dataset) -> set[int]:
    """Rows of cells from the first one to each end of the body, odd (1) or even (0)."""
    begin, cell = float(field["x"][0]), _cell(field, "x")
    places = [end.place for end in recorded_ends(field) if end.part == BODY]
    return {round((place - begin) / cell + 0.5) % 2 for place in places}


def _padded(field: xr.Dataset, axis: str, before: int, after: int) -> xr.Dataset:
    """Loads on a grid with some more cells, which bear nothing."""
    if not before + after:
        return field
    places, cell = field[axis].values, _cell(field, axis)
    begin = [places[0] - cell] * before
    end = [places[-1] + cell] * after
    padded = field.pad({axis: (before, after)}, constant_values=0.0)
    return padded.assign_coords({axis: np.concatenate([begin, places, end])})


def _cell(field: xr.Dataset, axis: str) -> float:
    """Edge of a cell along an axis [m]; that of the other axis for a single cell."""
    places = field[axis].values
    return float(places[1] - places[0]) if places.size > 1 else _cell(field, "yx"["xy".index(axis)])
