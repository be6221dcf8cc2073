"""Runs that are drawn in one figure: their number, their snapshots and headings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import Snapshot, headings_of, take_snapshots
from viscontact.results.stated_errors import mesh_dependent

#: Result of a run, or several by the names to print.
Runs = xr.Dataset | Mapping[str, xr.Dataset]


def require_runs(runs: Mapping[str, xr.Dataset], figure: str) -> None:
    """Check that there is a run to draw; ValueError otherwise."""
    if not runs:
        raise ValueError(f"{figure}: needs at least one run to compare, got none")


def runs_of(results: Runs, figure: str) -> Mapping[str, xr.Dataset]:
    """Runs by the names to print; a single result has the name ""."""
    if isinstance(results, xr.Dataset):
        return {"": results}
    require_runs(results, figure)
    return results


def headed_snapshots(
    results: Runs, times: ArrayLike | None, figure: str, *, count: int
) -> list[tuple[str, Snapshot, bool]]:
    """Headings, fields at instants [s], and whether the peak depends on the mesh."""
    # By default some instants of a single run, as `take_snapshots` chooses them, and the last of
    # each of several.
    found = []
    for name, run in runs_of(results, figure).items():
        last = float(run_axis(run).values(run)[-1])
        wanted = last if times is None and name else times
        taken = take_snapshots(run, wanted, figure, count=count)
        prefix = f"{name}, " if name else ""
        headings = [f"{prefix}{heading}" for heading in headings_of(taken)]
        marked = depends_on_mesh(run, [each.time for each in taken])
        found += list(zip(headings, taken, marked, strict=True))
    return found


def depends_on_mesh(run: xr.Dataset, places: Iterable[float]) -> list[bool]:
    """Test at instants [s] or speeds [m/s] whether the peak pressure depends on the mesh."""
    marked, known = mesh_dependent(run, "peak_pressure"), run_axis(run).values(run)
    return [bool(marked[np.abs(known - each).argmin()]) for each in places]
