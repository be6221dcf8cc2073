"""Largest stress in the half-space below the largest pressure of a run, with its error."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.last_cycle_values import first_largest
from viscontact.results.recorded_case import recorded_ends, recorded_grid
from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import errors_of
from viscontact.results.stress_source import LOADS, at_largest_traction
from viscontact.results.stresses import REACH, section_stresses

#: Number of depths of the search, and of those around the deepest of them.
_DEPTHS, _CLOSE = 14, 7

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


def peak_stress(ds: xr.Dataset, name: str) -> PeakStress:
    """Return the largest stress on the two vertical planes through the largest pressure of a run.

    Of several creepages under that of the largest traction.

    ValueError, with the reason, where that instant has no stored fields, or no known stresses.
    """
    # The error is the sum of the relative error of the peak pressure, to which stresses are
    # proportional, the change of the stress on cells of twice the size, and that between the depths
    # of the search.
    ds = at_largest_traction(ds)
    peaks = np.nan_to_num(ds["peak_pressure"].values)
    row = first_largest(peaks)
    place = float(run_axis(ds).values(ds)[row])
    if peaks[row] == 0:
        return PeakStress(0.0, 0.0, place, 0.0)
    field = _loaded_part(_field_at(ds, place))
    found = _locate_largest(field, _depths(field, ds, row), name)
    relative = float(errors_of(ds, "peak_pressure")[row]) / float(peaks[row])
    coarse = _coarser(field)
    change = (
        np.nan if coarse is None else abs(_peaks(coarse, found.around, name).max() - found.value)
    )
    error = found.value * relative + change + found.error
    return PeakStress(found.value, error, place, found.depth, _plane(field, found.depth, name))


def _field_at(ds: xr.Dataset, place: float) -> xr.Dataset:
    """Loads at an instant or a speed; ValueError if they are not stored."""
    axis = run_axis(ds)
    if "pressure" not in ds:
        raise ValueError("no fields are stored (output.fields)")
    over = str(ds["pressure"].dims[0])
    stored = np.flatnonzero(np.isclose(ds[over].values, place, rtol=1e-9, atol=0.0))
    if not stored.size:
        raise ValueError(
            f"the largest pressure is at {axis.place(place)}, whose fields are not stored; add it "
            "to output.fields"
        )
    loads = [name for name in LOADS if name in ds]
    return ds[loads].isel({over: stored[:1]}).load()


def _loaded_part(field: xr.Dataset) -> xr.Dataset:
    """Smallest part of the grid that contains all pressure; a period is kept."""
    pressed = (field["pressure"] != 0).any(str(field["pressure"].dims[0]))
    grid = recorded_grid(field)
    for axis, periodic in zip("xy", grid.periodic, strict=True):
        cells = np.flatnonzero(pressed.any("yx"["xy".index(axis)]).values)
        if not periodic:
            field = field.isel({axis: slice(max(cells[0] - 1, 0), cells[-1] + 2)})
    return field


def _depths(field: xr.Dataset, ds: xr.Dataset, row: int) -> Floats:
    """Depths deep enough for the whole contact, and close to the surface for its single spots."""
    least = min(_cell(field, axis) for axis in "xy")
    extents = [float(ds[f"contact_{each}"][row]) for each in ("length", "width")]
    reach = REACH * min(extents) / 2
    return np.append(0.0, np.geomspace(least / 2, max(reach, 2 * least), _DEPTHS))


@dataclass(frozen=True)
class _LocatedPeak:
    value: float  # [Pa]
    depth: float  # [m]
    error: float  # of the search in depth [Pa]
    around: Floats  # depths searched last [m]


def _locate_largest(field: xr.Dataset, depths: Floats, name: str) -> _LocatedPeak:
    """Search for the largest of a stress over some depths [m], and then between two of them."""
    at = int(_peaks(field, depths, name).argmax())
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
    return _LocatedPeak(value + error, depth, error, close)


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
