"""Loops of a run as plain data for a page: force over approach, resistance over position."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from viscontact.report.map_data import finite_or_none
from viscontact.results.formatting import format_with_error
from viscontact.results.recorded_case import case_of, recorded_object
from viscontact.results.shown_scalars import lacks_datum
from viscontact.results.stated_errors import drawn_values, errors_of, is_rounding
from viscontact.results.worst_values import LoadCycle, last_cycle
from viscontact.units.formatting import format_quantity, readable_unit


def loops_data(ds: xr.Dataset) -> list[dict[str, Any]]:
    """Return force over approach of a cyclic load, and resistance over position along each axis.

    Resistance is shown along axes on which the body turns back. `last` and `end` are the indices of
    the first and last instant of the last cycle, of the whole path if it has no cycles.
    """
    found = [_resistance(ds, axis) for axis in "xy" if _turns_back(ds, axis)]
    cycle = last_cycle(ds, least=1)
    if cycle is None or lacks_datum(ds):
        return found
    return [_hysteresis(ds, cycle), *found]


def _turns_back(ds: xr.Dataset, axis: str) -> bool:
    if f"position_{axis}" not in ds or is_rounding(ds, f"resistance_{axis}"):
        return False
    ways = np.diff(ds[f"position_{axis}"].values)
    return bool((ways > 0).any() and (ways < 0).any())


def _resistance(ds: xr.Dataset, axis: str) -> dict[str, Any]:
    about = {
        "name": f"loop-{axis}",
        "title": f"Resistance along {axis}",
        "across": f"Position along {axis}",
        "area": "motion work",
    }
    return about | _path(
        ds, f"position_{axis}", f"resistance_{axis}", _last_cycle(ds), ds.sizes["time"] - 1
    )


def _hysteresis(ds: xr.Dataset, cycle: LoadCycle) -> dict[str, Any]:
    about = {"name": "loop-force", "title": "Force", "across": "Approach", "area": "loss"}
    return about | _path(ds, "approach", "force", cycle.first, cycle.last)


def _path(ds: xr.Dataset, along: str, name: str, last: int, end: int) -> dict[str, Any]:
    """Points of a loop in readable units, with the factors of the units to SI."""
    position, values = ds[along].values, drawn_values(ds, name)
    length, force = readable_unit("m", position), readable_unit("N", values)
    return {
        "position": finite_or_none(length(position)),
        "unit": length.symbol,
        "lengthFactor": length.factor,
        "values": finite_or_none(force(values)),
        "valueUnit": force.symbol,
        "valueFactor": force.factor,
        **{"last": last, "end": end},
        "hover": [
            f"t = {format_quantity(float(time), 's')}: {format_with_error(value, error, 'N')}"
            for time, value, error in zip(
                ds["time"].values, values.tolist(), errors_of(ds, name).tolist(), strict=True
            )
        ],
    }


def _last_cycle(ds: xr.Dataset) -> int:
    """Index of the instant at which the last complete cycle of the motion begins, or 0."""
    if not case_of(ds).get("motion"):
        return 0
    times = ds["time"].values
    cycles = recorded_object(ds, "motion", "resistance").cycles
    begins = [begin for (begin, _), (end, _) in cycles if end <= times[-1] * (1 + 1e-9)]
    return int(np.abs(times - begins[-1]).argmin()) if begins else 0
