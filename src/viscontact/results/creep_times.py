"""Times for which the bodies of a result have crept, by their clocks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.results.recorded_objects import recorded_temperature
from viscontact.results.run_axis import run_axis

if TYPE_CHECKING:
    import xarray as xr


def law_times(results: xr.Dataset, part: str = "material") -> Floats:
    """Times at which a run's law matters [s]: of its states, or of the passage in steady motion."""
    return np.sort(creep_times(results, part))


def follows_clock(results: xr.Dataset, part: str = "material") -> bool:
    """True if the creep of a body follows a reduced time: at a temperature that varies, or aged."""
    if reduced_name(part) not in results:
        return False
    temperature = recorded_temperature(results)
    # At a constant temperature the law is that at this temperature, over the time.
    return temperature is None or not temperature.is_constant


def reduced_name(part: str) -> str:
    """Name of the reduced time of a body, "material" or "indenter_material"."""
    return "reduced_time" if part == "material" else "reduced_time_indenter"


def creep_times(results: xr.Dataset, part: str = "material") -> Floats:
    """Times for which the material has crept in each state of a run [s], as in `law_times`."""
    axis = run_axis(results)
    if follows_clock(results, part):
        return np.asarray(results[reduced_name(part)].values, dtype=np.float64)
    if axis.is_history:
        return axis.values(results)
    extent = "contact_length" if results.attrs.get("along") == "x" else "contact_width"
    return np.asarray(results[extent].values / axis.values(results), dtype=np.float64)
