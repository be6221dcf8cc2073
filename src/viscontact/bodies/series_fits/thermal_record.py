"""Creep or relaxation under a temperature that varies, over the reduced time of a shift."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Shift
from viscontact.bodies.loads.clock import ReducedTime
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.series_fits.responses import (
    CreepResponse,
    ExpandingCreepResponse,
    RelaxationResponse,
)
from viscontact.bodies.series_fits.spectrum import Observed, Spectrum, unweighted
from viscontact.units.formatting import format_number

#: Change of the temperature below which it is taken as constant [K].
LEAST_CHANGE = 2.0

#: Largest distance from a straight line, over the change of temperature, of a single ramp.
RAMP = 0.1

#: Deviation of the temperature within a level [K], and its least part of the record's duration.
SAME_LEVEL, LEAST_LEVEL = 1.0, 0.02

#: Change of an unknown of a rule for differences of the reduced times.
DIFFERENCE = 1e-5


@dataclass(frozen=True, eq=False)
class ThermalRecord:
    """Values measured at increasing times [s] after a step, under a temperature history."""

    times: Floats
    history: TemperatureHistory
    values: Floats
    rises: bool  # creep under a constant stress; else relaxation at a constant strain
    fluid: bool
    expands: bool = False  # by a strain proportional to the change of temperature

    @cached_property
    def temperatures(self) -> Floats:
        """Temperature at each row [K]."""
        return self.history.at(self.times)

    @property
    def warmer(self) -> Floats:
        """Temperature of each row above that at time 0 [K]."""
        return np.asarray(self.temperatures - self.history.at(0.0))

    def reduced(self, shift: Shift) -> Floats:
        """Reduced times of the rows [s]."""
        return ReducedTime(self.history, shift).reduced(self.times)

    def observed(self, shift: Shift) -> Observed:
        """The rows over the reduced time, with equal weights of their relative residuals."""
        reduced = self.reduced(shift)
        if self.expands:
            response = ExpandingCreepResponse(reduced, self.fluid, self.warmer)
            return unweighted(response, self.values)
        kind = CreepResponse if self.rises else RelaxationResponse
        return unweighted(kind(reduced, self.fluid), self.values)

    def expansion_of(self, spectrum: Spectrum) -> float:
        """Strength of the thermal strain in a spectrum [per K]."""
        return float(spectrum.constants[-2] - spectrum.constants[-1]) if self.expands else 0.0

    @cached_property
    def levels(self) -> Floats:
        """Different temperatures at which the record dwells, increasing [K]."""
        found: list[float] = []
        for rows in self._dwells():
            level = float(np.median(self.temperatures[rows]))
            if all(abs(level - other) > SAME_LEVEL for other in found):
                found.append(level)
        lowest, highest = self.history.range
        return np.asarray(np.clip(np.sort(found), lowest, highest))  # medians are rounded

    @property
    def first_level(self) -> float:
        """Temperature of the first dwell, or that at time 0 [K]."""
        first = next(iter(self._dwells()), None)
        return float(self.history.at(0.0) if first is None else np.median(self.temperatures[first]))

    def _dwells(self) -> list[slice]:
        """Successive rows of nearly one temperature, for a notable part of the record."""
        dwells, begin = [], 0
        least = LEAST_LEVEL * float(self.times[-1])
        for row in range(1, self.times.size + 1):
            ended = row == self.times.size
            if not ended and abs(self.temperatures[row] - self.temperatures[begin]) <= SAME_LEVEL:
                continue
            if row - begin >= 3 and self.times[row - 1] - self.times[begin] >= least:
                dwells.append(slice(begin, row))
            begin = row
        return dwells


def require_steps(owner: str, record: ThermalRecord) -> None:
    """Refuse a temperature that hardly varies, or changes along one ramp only."""
    change = float(np.ptp(record.temperatures))
    if change < LEAST_CHANGE:
        raise ValueError(
            f"{owner}: temperature varies by {format_number(change, 2)} K only, and a shift can be "
            f"found from {LEAST_CHANGE:g} K on; leave temperature out, or give the shift"
        )
    times = np.linspace(0.0, float(record.times[-1]), 200)
    line = np.polynomial.Polynomial.fit(times, record.history.at(times), 1)
    if float(np.abs(line(times) - record.history.at(times)).max()) < RAMP * change:
        raise ValueError(
            f"{owner}: temperature changes along one ramp, in which temperature and time cannot be "
            "told apart: for any faster clock there is a law that fits as well. Hold the "
            "temperature in steps (stepped isothermal method), or give the shift"
        )


def log_rates(record: ThermalRecord, shifts: list[tuple[Shift, Shift]]) -> Floats:
    """Changes of the logarithms of the reduced times with each unknown, shape (rows, unknowns)."""
    rates = []
    for below, above in shifts:
        low, high = record.reduced(below), record.reduced(above)
        ratio = np.divide(high, low, out=np.ones_like(low), where=low > 0)
        rates.append(np.log(ratio) / (2 * DIFFERENCE))
    return np.stack(rates, axis=1)
