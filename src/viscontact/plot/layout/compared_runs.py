"""Runs that are drawn in one figure: their number, their snapshots and headings."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from numpy.typing import ArrayLike

from viscontact.results.snapshots import Snapshot, take_snapshots
from viscontact.units.formatting import time_labels


def require_runs(runs: Mapping[str, xr.Dataset], figure: str) -> None:
    """Check that there is a run to draw; ValueError otherwise."""
    if not runs:
        raise ValueError(f"{figure}: needs at least one run to compare, got none")


def headed_snapshots(
    runs: Mapping[str, xr.Dataset], times: ArrayLike | None, figure: str, *, count: int = 1
) -> tuple[list[Snapshot], list[str]]:
    """Fields of runs at requested instants [s], and their headings; a single run is named "".

    By default the last instant of each run, or `count` > 1 instants as chosen by `take_snapshots`.
    """
    require_runs(runs, figure)
    snapshots: list[Snapshot] = []
    headings: list[str] = []
    for name, run in runs.items():
        wanted = float(run["time"][-1]) if times is None and count == 1 else times
        taken = take_snapshots(run, wanted, figure, count=count)
        snapshots += taken
        prefix = f"{name}, " if name else ""
        headings += [f"{prefix}t = {label}" for label in time_labels(s.time for s in taken)]
    return snapshots, headings
