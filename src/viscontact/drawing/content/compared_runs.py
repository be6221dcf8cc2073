"""Runs that are drawn in one figure: their number, their snapshots and headings."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from numpy.typing import ArrayLike

from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import Snapshot, headings_of, take_snapshots


def require_runs(runs: Mapping[str, xr.Dataset], figure: str) -> None:
    """Check that there is a run to draw; ValueError otherwise."""
    if not runs:
        raise ValueError(f"{figure}: needs at least one run to compare, got none")


def runs_of(
    results: xr.Dataset | Mapping[str, xr.Dataset], figure: str
) -> Mapping[str, xr.Dataset]:
    """Runs by the names to print; a single result has the name ""."""
    if isinstance(results, xr.Dataset):
        return {"": results}
    require_runs(results, figure)
    return results


def headed_snapshots(
    runs: Mapping[str, xr.Dataset], times: ArrayLike | None, figure: str, *, count: int = 1
) -> tuple[list[Snapshot], list[str]]:
    """Fields of runs at requested instants [s], and their headings; a single run is named "".

    By default the last instant or speed of each run, or `count` > 1 as `take_snapshots` chooses.
    """
    require_runs(runs, figure)
    snapshots: list[Snapshot] = []
    headings: list[str] = []
    for name, run in runs.items():
        last = float(run_axis(run).values(run)[-1])
        wanted = last if times is None and count == 1 else times
        taken = take_snapshots(run, wanted, figure, count=count)
        snapshots += taken
        prefix = f"{name}, " if name else ""
        headings += [f"{prefix}{heading}" for heading in headings_of(taken)]
    return snapshots, headings
