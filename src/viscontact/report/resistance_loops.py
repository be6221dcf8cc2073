"""Resistance over the position of a body that moves back and forth, as plain data for a page."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from viscontact.report.map_data import finite_or_none, rounded
from viscontact.results.formatting import format_with_error
from viscontact.results.recorded_case import case_of, recorded_object
from viscontact.results.stated_errors import drawn_values, errors_of, is_rounding
from viscontact.units.formatting import format_quantity, readable_unit


def loops_data(ds: xr.Dataset) -> list[dict[str, Any]]:
    """Return the resistance over the position along each axis on which the body turns back.

    `last` is the index of the first instant of the last cycle, 0 if the path has no cycles.
    """
    return [_loop(ds, axis) for axis in "xy" if _turns_back(ds, axis)]


def _turns_back(ds: xr.Dataset, axis: str) -> bool:
    if f"position_{axis}" not in ds or is_rounding(ds, f"resistance_{axis}"):
        return False
    ways = np.diff(ds[f"position_{axis}"].values)
    return bool((ways > 0).any() and (ways < 0).any())


def _loop(ds: xr.Dataset, axis: str) -> dict[str, Any]:
    name = f"resistance_{axis}"
    position, resistance = ds[f"position_{axis}"].values, drawn_values(ds, name)
    length, force = readable_unit("m", position), readable_unit("N", resistance)
    return {
        "name": f"loop-{axis}",
        "along": axis,
        "position": rounded(length(position)),
        "unit": length.symbol,
        "lengthFactor": length.factor,
        "values": finite_or_none(force(resistance)),
        "valueUnit": force.symbol,
        "valueFactor": force.factor,
        "last": _last_cycle(ds),
        "hover": [
            f"t = {format_quantity(float(time), 's')}: {format_with_error(value, error, 'N')}"
            for time, value, error in zip(
                ds["time"].values, resistance.tolist(), errors_of(ds, name).tolist(), strict=True
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
