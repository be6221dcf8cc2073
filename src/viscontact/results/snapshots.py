"""The stored fields of a result, one instant or speed at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.body_edge import Outline, trace_outline
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.run_axis import RunAxis, run_axis
from viscontact.results.shown_rows import shown_rows
from viscontact.results.snapshot import Snapshot as Snapshot
from viscontact.results.stored_contact import cells_in_contact
from viscontact.units.formatting import time_labels
from viscontact.units.numbers import finite_array

#: Relative change of the contact area below which it is final, and share of the time at which it is
#: final so early that most instants are chosen before.
_FINAL, _EARLY = 0.01, 0.3

#: Cells that a single one along a period is shown as.
SHOWN_CELLS = 4


def field_times(results: xr.Dataset, figure: str) -> Floats:
    """Instants at which pressure and gap are stored [s], ascending; or speeds [m/s], as stored."""
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
    """Fields at the stored instants [s], or speeds [m/s], nearest to those requested."""
    # By default the first instant in contact, the last one, and some in between that are spread
    # evenly on a logarithmic scale until the contact area is final.
    stored, axis = field_times(results, figure), run_axis(results)
    if times is not None:
        chosen = _nearest(stored, times, figure, axis)
    elif not axis.is_history:
        chosen = _ranked(stored, count)
    else:
        # From the scalars: all fields of a long run need not fit in memory.
        scalars = results[["contact_area"]].sel(time=stored, method="nearest")
        chosen = _spread(stored, scalars, count)
    snapshot_of = snapshot_reader(results)
    snapshots = [snapshot_of(index) for index in chosen]
    if not any(snapshot.touching for snapshot in snapshots):
        instants = ", ".join(axis.quantity(s.time) for s in snapshots)
        raise ValueError(
            f"{figure}: the bodies do not touch at {axis.symbol}"
            f"{instants or f'any stored {axis.row}'}; choose other {axis.name}s"
        )
    return snapshots


def labels_of(snapshots: Iterable[Snapshot]) -> tuple[str, ...]:
    """Instants or speeds of snapshots of one result, all in one unit."""
    shown = list(snapshots)
    return time_labels((each.time for each in shown), shown[0].axis.unit if shown else "s")


def headings_of(snapshots: Iterable[Snapshot]) -> list[str]:
    """Instants or speeds of snapshots as headings: ``"t = 2 s"``, ``"500 mm/s"``."""
    shown = list(snapshots)
    return [
        f"{each.axis.symbol}{label}" for each, label in zip(shown, labels_of(shown), strict=True)
    ]


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
        place, axis = float(fields[dimension]), run_axis(results)
        touched = _as_shown(cells_in_contact(results, index)) > 0
        options: Any = {"axis": axis, "least_pull": _least_pull(results, index, grid.cell_area)}
        return Snapshot(place, x, y, pressure, gap, touched, body_end, grid.periodic, **options)

    return read


def _least_pull(results: xr.Dataset, index: int, cell_area: float) -> float:
    """Least tension of the cohesive zone, whose area is stored [Pa]; 0 without one."""
    if "tensile_area" not in results:
        return 0.0
    dimension = _time_dimension(results)
    fields = results["pressure"].isel({dimension: index})
    area = results["tensile_area"].sel({"time": fields[dimension]}, method="nearest")
    open_cells = cells_in_contact(results, index).values == 0
    pulls = np.sort(-np.asarray(fields.values, dtype=np.float64)[open_cells])[::-1]
    count = min(round(float(area) / cell_area), pulls.size)
    return max(float(pulls[count - 1]), 0.0) if count else 0.0


def field_at(results: xr.Dataset, name: str, time: float, figure: str) -> Floats:
    """Return a field at a stored instant [s]: shape (nx, ny), in SI units."""
    if name not in results:
        raise ValueError(
            f"{figure}: needs the stored field {name}, which this result does not have; run again "
            "with fields stored"
        )
    field = results[name].sel({_time_dimension(results): time}, method="nearest")
    return _as_shown(field)


def _as_shown(field: xr.DataArray) -> Floats:
    """Values of a field in SI units, a single cell along a period as several; shape (nx, ny)."""
    values = np.asarray(field.transpose("x", "y").values, dtype=np.float64)
    for axis, count in enumerate(values.shape):
        values = values.repeat(_shown_cells(count), axis=axis)
    return values


def _shown_cells(count: int) -> int:
    return SHOWN_CELLS if count == 1 else 1


def _time_dimension(results: xr.Dataset) -> str:
    return str(results["pressure"].dims[0])


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


def _nearest(stored: Floats, times: ArrayLike, figure: str, axis: RunAxis) -> Sequence[int]:
    wanted = finite_array(f"{figure}: {axis.name}s", times, axis.unit).ravel()
    if not wanted.size:
        raise ValueError(f"{figure}: {axis.name}s must be finite numbers, got none")
    found = {int(np.argmin(np.abs(stored - instant))) for instant in wanted}
    return sorted(found, key=lambda index: stored[index])


def _ranked(stored: Floats, count: int) -> Sequence[int]:
    """Some speeds from the slowest to the fastest; a single one is the fastest."""
    order = np.argsort(stored)
    ranks = shown_rows(stored.size, count) if count > 1 else [-1]
    return [int(order[rank]) for rank in ranks]


def _spread(stored: Floats, scalars: xr.Dataset, count: int) -> Sequence[int]:
    candidates = np.flatnonzero(scalars["contact_area"].values > 0)
    if candidates.size <= count:
        return [int(index) for index in candidates]
    instants = stored[candidates]
    # Two decades back from the end of creep is where it is seen to happen; earlier, a picture at
    # each decade would repeat the first one.
    areas = scalars["contact_area"].values[candidates]
    changing = np.abs(areas - areas[-1]) > _FINAL * np.ptp(areas)
    settled = instants[min(int(np.flatnonzero(changing).max(initial=-1)) + 1, instants.size - 1)]
    settled = settled if 0 < settled < _EARLY * instants[-1] else instants[-1]
    earliest = max(instants[instants > 0][0], settled / 100)
    between = np.geomspace(earliest, settled, count)[1:]
    targets = [instants[0], *between[: count - 2], instants[-1]]
    return sorted({int(candidates[np.argmin(np.abs(instants - t))]) for t in targets})
