"""Temperature of the bodies that swings about a mean."""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.harmonic_history import MOST_CYCLES
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.units.numbers import check_fields, finite, real_array, store, whole

#: A value that follows from the others: no part of a description.
_COMPUTED = {"recorded": "never"}


@dataclass(frozen=True)
class HarmonicTemperature(TemperatureHistory):
    """A temperature mean + amplitude sin(2 π t/period + phase), held after the last cycle.

    Parameters
    ----------
    mean : float
        Mean absolute temperature [K].
    amplitude : float
        Amplitude, less than the mean [K].
    period : float
        Time of a cycle > 0, such as a day [s].
    cycles : int
        Number of cycles, at least 1.
    phase : float, optional
        Phase at time 0 [rad].

    Raises
    ------
    ValueError
        If a number is out of range, or the temperature falls to 0 K.

    Notes
    -----
    Exact at every instant. Its extremes and its passages through the mean are steps of a run; in
    between, steps over which the rate of creep changes by more than a factor of two are divided.

    Examples
    --------
    A day between 5 and 25 °C, from the mean in the morning:

    >>> day = HarmonicTemperature(mean=288.15, amplitude=10.0, period=86400.0, cycles=1)
    >>> day.at([0.0, 21600.0, 64800.0]).tolist()
    [288.15, 298.15, 278.15]
    """

    times: Floats = field(
        init=False, repr=False, compare=False, metadata={"unit": "s", **_COMPUTED}
    )
    temperature: Floats = field(
        init=False, repr=False, compare=False, metadata={"unit": "K", **_COMPUTED}
    )
    mean: float = field(metadata={"unit": "K"})
    amplitude: float = field(metadata={"unit": "K"})
    period: float = field(metadata={"unit": "s"})
    cycles: int = field(metadata={"unit": "1"})
    phase: float = field(default=0.0, metadata={"unit": "rad"})

    def __post_init__(self) -> None:
        check_fields(self, "mean", "period")
        check_fields(self, "amplitude", "phase", check=finite)
        store(self, cycles=whole("HarmonicTemperature: cycles", self.cycles, 1, MOST_CYCLES))
        if not abs(self.amplitude) < self.mean:
            raise ValueError(
                "HarmonicTemperature: amplitude must be less than the mean, an absolute "
                f"temperature, got {self.amplitude:.6g} K about {self.mean:.6g} K; 20 °C is 293.15 "
                "K, and an amplitude is a difference"
            )
        store(self, times=self._quarters())
        store(self, temperature=self.at(self.times))

    def _quarters(self) -> Floats:
        """Instants of the extremes and of the passages through the mean, and both ends [s]."""
        first = math.ceil(2 * self.phase / math.pi)
        quarters = np.arange(first, first + 4 * self.cycles + 1) / 4 - self.phase / (2 * math.pi)
        inner = quarters[(quarters > 0) & (quarters < self.cycles)] * self.period
        return np.unique(np.concatenate([[0.0], inner, [self.cycles * self.period]]))

    def at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the temperature at some times, see `TemperatureHistory.at`."""
        history_points.side_of_jump(side)
        end = self.cycles * self.period
        turns = np.clip(real_array("times", times, "s"), 0.0, end) / self.period
        # Whole cycles are subtracted first: sin(2 π n) is not 0 in floating point.
        angle = 2 * math.pi * (turns - np.floor(turns)) + self.phase
        return np.asarray(self.mean + self.amplitude * np.sin(angle))

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest temperature [K]."""
        return self.mean - abs(self.amplitude), self.mean + abs(self.amplitude)

    @property
    def steepest(self) -> float:
        """Largest rate of change [K/s]."""
        return 2 * math.pi * abs(self.amplitude) / self.period
