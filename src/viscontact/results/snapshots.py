"""The stored fields of a result, one instant at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from viscontact.contact.body_edge import Outline, trace_outline
from viscontact.grid import Grid
from viscontact.results.recorded_case import recorded_grid, recorded_object
from viscontact.results.snapshot import Snapshot as Snapshot
from viscontact.units.formatting import format_quantity

#: Cells that a single one along a period is shown as.
SHOWN_CELLS = 4


def field_times(results: xr.Dataset, figure: str) -> NDArray[np.float64]:
    """Instants at which pressure and gap are stored [s], ascending."""
    missing = [name for name in ("pressure", "gap") if name not in results]
    if missing:
        raise ValueError(
            f"{figure}: needs stored fields, but this result has no {' and no '.join(missing)}; "
            "run again with fields stored ('output: fields: all' or a list of instants in the "
            "case file, fields= in Python)"
        )
    instants = np.asarray(results[_time_dimension(results)].values, dtype=np.float64)
    if instants.size == 0:
        raise ValueError(f"{figure}: needs stored fields, but this result holds none yet")
    return instants


def take_snapshots(
    results: xr.Dataset, times: ArrayLike | None, figure: str, *, count: int = 5
) -> list[Snapshot]:
    """Fields at the stored instants nearest to those requested [s].

    By default the first instant in contact, the last one, and some in between that are spread
    evenly on a logarithmic scale.
    """
    stored = field_times(results, figure)
    if times is None:
        chosen = _spread(stored, _in_contact(results, stored), count)
    else:
        chosen = _nearest(stored, times, figure)
    snapshot_of = snapshot_reader(results)
    snapshots = [snapshot_of(index) for index in chosen]
    if not any(snapshot.touching for snapshot in snapshots):
        instants = ", ".join(format_quantity(s.time, "s") for s in snapshots)
        raise ValueError(
            f"{figure}: the bodies do not touch at t = {instants or 'any stored instant'}; "
            "choose other times"
        )
    return snapshots


def snapshot_reader(results: xr.Dataset) -> Callable[[int], Snapshot]:
    """Prepare to read fields one stored instant at a time."""
    grid = recorded_grid(results)
    single = tuple(map(_shown_cells, grid.shape))
    shown = replace(grid, shape=(grid.shape[0] * single[0], grid.shape[1] * single[1]))
    body_end = _body_end(results, shown)

    def read(index: int) -> Snapshot:
        dimension = _time_dimension(results)
        fields = results[["pressure", "gap"]].isel({dimension: index})
        pressure, gap = (_as_shown(fields[name]) for name in ("pressure", "gap"))
        x, y = (
            results[name].values if cells == 1 else lines
            for name, cells, lines in zip("xy", single, (shown.x, shown.y), strict=True)
        )
        return Snapshot(float(fields[dimension]), x, y, pressure, gap, body_end, grid.periodic)

    return read


def field_at(results: xr.Dataset, name: str, time: float, figure: str) -> NDArray[np.float64]:
    """Return a field at a stored instant [s]: shape (nx, ny), in SI units."""
    if name not in results:
        raise ValueError(
            f"{figure}: needs the stored field {name}, which this result does not have; run again "
            "with fields stored"
        )
    field = results[name].sel({_time_dimension(results): time}, method="nearest")
    return _as_shown(field)


def _as_shown(field: xr.DataArray) -> NDArray[np.float64]:
    """Values of a field in SI units, a single cell along a period as several; shape (nx, ny)."""
    values = np.asarray(field.transpose("x", "y").values, dtype=np.float64)
    for axis, count in enumerate(values.shape):
        values = values.repeat(_shown_cells(count), axis=axis)
    return values


def _shown_cells(count: int) -> int:
    return SHOWN_CELLS if count == 1 else 1


def _time_dimension(results: xr.Dataset) -> str:
    return "field_time" if "field_time" in results["pressure"].dims else "time"


def _in_contact(results: xr.Dataset, instants: NDArray[np.float64]) -> NDArray[np.bool_]:
    # From the scalars: all fields of a long run need not fit in memory.
    peak = results["peak_pressure"].sel(time=instants, method="nearest")
    return np.asarray(peak.values > 0, dtype=np.bool_)


def _body_end(results: xr.Dataset, grid: Grid) -> Outline | None:
    # Only a body that ends has an infinite gap next to it.
    # The last is known on all of the grid, should that have been enlarged meanwhile.
    last = results["gap"].isel({_time_dimension(results): -1}).values
    if np.isfinite(last).all() or "case" not in results.attrs:
        return None
    try:
        indenter = recorded_object(results, "indenter", "snapshot")
    except ValueError:  # a measured surface is not kept with the result
        return None
    return trace_outline(indenter, grid)


def _nearest(stored: NDArray[np.float64], times: ArrayLike, figure: str) -> Sequence[int]:
    wanted = np.atleast_1d(np.asarray(times, dtype=np.float64))
    if wanted.size == 0 or not np.all(np.isfinite(wanted)):
        raise ValueError(f"{figure}: times must be finite numbers of seconds, got {times!r}")
    return sorted({int(np.argmin(np.abs(stored - instant))) for instant in wanted})


def _spread(
    stored: NDArray[np.float64], in_contact: NDArray[np.bool_], count: int
) -> Sequence[int]:
    candidates = np.flatnonzero(in_contact)
    if candidates.size <= count:
        return [int(index) for index in candidates]
    instants = stored[candidates]
    # Two decades back from the end is where creep is seen to happen; earlier, a picture at
    # each decade would repeat the first one.
    earliest = max(instants[instants > 0][0], instants[-1] / 100)
    targets = np.concatenate([instants[:1], np.geomspace(earliest, instants[-1], count)[1:]])
    return sorted({int(candidates[np.argmin(np.abs(instants - t))]) for t in targets})
