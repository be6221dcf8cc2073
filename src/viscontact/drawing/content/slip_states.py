"""Instants of a run, or speeds and creepages of steady motion, at which tractions are shown."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.fretting import fretting_cycles, require_tractions
from viscontact.results.rolling import has_creepages
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_rows import shown_rows
from viscontact.results.snapshots import (
    Snapshot,
    field_times,
    headings_of,
    labels_of,
    take_snapshots,
)
from viscontact.results.stress_source import at_largest_traction

#: Instants, or creepages, that are shown by default.
_SHOWN = 4


@dataclass(frozen=True, eq=False)
class SlipState:
    """Tractions at one instant, or at a speed and a creepage."""

    run: xr.Dataset  # with the tractions of one creepage
    shown: Snapshot
    label: str  # of a curve
    heading: str  # of a map


def slip_states(run: xr.Dataset, times: ArrayLike | None, figure: str) -> list[SlipState]:
    """States at the stored instants [s], or speeds [m/s], nearest to those requested.

    Of one speed up to four creepages are shown, of several that of the largest traction. By default
    the speed is the largest, and the instants are some of the last cycle.
    """
    require_tractions(run, figure)
    if run_axis(run).is_history:
        instants = slip_instants(run, figure) if times is None else times
        return _states(run, take_snapshots(run, instants, figure))
    shown = take_snapshots(run, times, figure, count=1)
    if not has_creepages(run):
        return _states(run, shown)
    if len(shown) > 1:
        return _states(at_largest_traction(run), shown)
    ordered = run.sortby("creepage")
    chosen = shown_rows(ordered.sizes["creepage"], _SHOWN).tolist()
    return [state for at in chosen for state in _states(ordered.isel(creepage=at), shown)]


def slip_instants(run: xr.Dataset, figure: str) -> Floats:
    """Instants of the last cycle, or under a tangential load, at which slip is shown [s]."""
    stored = field_times(run, figure)
    if cycles := fretting_cycles(run, figure):
        return np.linspace(cycles[-1].begin, cycles[-1].end, _SHOWN, endpoint=False)
    scalars = run.sel(time=stored, method="nearest")
    names = ("tangential_force_x", "tangential_force_y", "torque")
    pulled = np.any([np.nan_to_num(scalars[name].values) != 0 for name in names], axis=0)
    shown = stored[pulled] if pulled.any() else stored
    chosen = shown_rows(shown.size, _SHOWN)
    return np.asarray(shown[chosen])


def _states(run: xr.Dataset, shown: Sequence[Snapshot]) -> list[SlipState]:
    """States of a run with the tractions of one creepage."""
    short = long = ""
    if "creepage" in run.coords:
        percent = f"{100 * float(run['creepage']):.4g} %"
        short, long = f", {percent}", f", creepage {percent}"
    return [
        SlipState(run, each, label + short, heading + long)
        for each, label, heading in zip(shown, labels_of(shown), headings_of(shown), strict=True)
    ]
