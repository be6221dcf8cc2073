"""Axis of a result: time, or speed in steady motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.results.recorded_case import recorded_temperature
from viscontact.units.formatting import format_quantity

if TYPE_CHECKING:
    import xarray as xr

    from viscontact.results.stored_result import Result


@dataclass(frozen=True)
class RunAxis:
    """Quantity in which the states of a run differ."""

    name: Literal["time", "speed"]  # dimension of the scalars, and label of the axis
    unit: str  # SI
    row: str  # name of a state in sentences
    symbol: str  # before a value
    heading: str  # of the curves over it
    coarser: str  # what the errors are estimated from
    #: True if each state follows from those before: there are steps, cycles and sums over time.
    is_history: bool

    @property
    def rows(self) -> str:
        """Name of the states in sentences."""
        return f"{self.row}s"

    def values(self, results: Result) -> Floats:
        """Instants [s] or speeds [m/s] of a result."""
        return np.asarray(results[self.name].values, dtype=np.float64)

    def quantity(self, value: float, digits: int = 4) -> str:
        """Format an instant or a speed with its unit."""
        return format_quantity(float(value), self.unit, digits)

    def place(self, value: float, digits: int = 4) -> str:
        """Format an instant or a speed for a sentence."""
        return f"{self.symbol}{self.quantity(value, digits)}"


TIME = RunAxis("time", "s", "instant", "t = ", "Over time", "runs", True)
SPEED = RunAxis("speed", "m/s", "speed", "", "Over speed", "contacts at each speed", False)
RUN_AXES: dict[str, RunAxis] = {axis.name: axis for axis in (TIME, SPEED)}


def run_axis(results: Result) -> RunAxis:
    """Return the axis of a result."""
    return SPEED if "speed" in results.dims else TIME


def in_order(results: xr.Dataset) -> xr.Dataset:
    """Return a result over speed from the slowest to the fastest; others unchanged."""
    if run_axis(results).is_history:
        return results
    ordered = results.sortby([name for name in ("speed", "field_speed") if name in results.dims])
    ordered.encoding = results.encoding  # the place of its file
    return ordered


def require_time(results: xr.Dataset, figure: str) -> None:
    """Raise ValueError for a result of steady motion, which has nothing over time."""
    if not run_axis(results).is_history:
        raise ValueError(
            f"{figure}: shows a run over time, and this result is of steady motion, over speed; "
            "draw friction, motion-profile, pressure-map or pressure-profile"
        )


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
