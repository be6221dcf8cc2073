"""Result of `rolling_temperature`."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.heating.heat_notes import celsius
from viscontact.units.display import StudyResult
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True, eq=False)
class RollingTemperature(StudyResult):
    """Heat balances of a rolling body.

    Attributes
    ----------
    table : xarray.Dataset
        Over ``speed`` and ``root``, the number of the balance from the coldest on, NaN where there
        are fewer: ``temperature`` [K] (the mean over the cover) with ``temperature_error``,
        ``stable``, ``power`` [W], and with a conductivity ``surface_temperature`` and ``hot_spot``.
        Over ``speed``: ``coldest`` and ``hottest``, between which the curve gives the power. Over
        ``at_temperature``: ``power_at`` of each speed, ``cooling_at``, and ``speed_at``, the speed
        at which that temperature is a balance. With heat capacity and density over ``time`` [s]:
        ``heating_temperature`` and ``heating_hot_spot`` from the start of the motion.

    Examples
    --------
    See `rolling_temperature`.
    """

    table: xr.Dataset

    @property
    def temperature(self) -> xr.DataArray:
        """Temperatures of the balances over speed and root, the coldest first [K]."""
        return self.table["temperature"]

    @property
    def stable(self) -> xr.DataArray:
        """Whether each balance is stable: less heat is added by a rise than flows off."""
        return self.table["stable"]

    @property
    def runaway_speed(self) -> float:
        """Speed at which the coldest balance ends [m/s]; NaN if it does not on the curve."""
        return float(self.table.attrs["runaway_speed"])

    @property
    def notes(self) -> tuple[str, ...]:
        """What the curve does not reach, and what is left out."""
        return tuple(str(self.table.attrs["notes"]).splitlines())

    def _page(self) -> tuple[Any, ...]:
        return "heat", self.table, {"headline": str(self)}

    def __str__(self) -> str:
        temperature = np.where(self.stable.values, self.temperature.values, np.nan)
        rows = np.flatnonzero(np.isfinite(temperature).any(axis=1))
        if not rows.size:
            return "no stable balance within the reach of the curve"
        own = float(np.nanmin(temperature[rows[-1]]))
        at = format_quantity(float(self.table["speed"].values[rows[-1]]), "m/s", 3)
        if np.isnan(self.runaway_speed):
            return f"coldest stable temperature {celsius(own)} at {at}; no runaway on the curve"
        there = celsius(float(self.table.attrs["runaway_temperature"]))
        runaway = format_quantity(self.runaway_speed, "m/s", 3)
        own_at = f"coldest stable temperature {celsius(own)} at {at}"
        return f"thermal runaway at {runaway} and {there}; {own_at}"
