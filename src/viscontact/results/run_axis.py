"""Axis of a result: time, or speed in steady motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
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
    """Return the axis of a result; refuse one of several pressures at each speed."""
    if "speed" not in results.dims:
        return TIME
    if has_contacts_over_creepage(results):
        raise ValueError(
            "creepage: each creepage of these bodies, which are coupled, has a contact of its own; "
            "choose one, as in results.viscontact.at_creepage(0.01)"
        )
    return SPEED


def has_contacts_over_creepage(results: Result) -> bool:
    """True for coupled bodies whose contacts, too, are over the creepage."""
    return "force" in results and "creepage" in results["force"].dims


def listed_creepages(results: Result) -> str:
    """The creepages of a result, in words."""
    return ", ".join(f"{100 * each:g} %" for each in results["creepage"].values.tolist())


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
