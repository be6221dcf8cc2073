"""Harmonic tangential loads."""

from __future__ import annotations

import math
from dataclasses import field
from functools import cached_property
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.harmonic_history import STEPS_PER_CYCLE
from viscontact.bodies.loads.tangential import (
    UNITS,
    TangentialLoad,
    TangentialPoint,
    given_values,
    refuse_both,
)
from viscontact.units.numbers import finite, positive, whole

#: Most cycles of a harmonic tangential load, each of which has two reversals.
MOST_CYCLES = 10_000


@dataclass(frozen=True, kw_only=True)
class TangentialHarmonic(TangentialLoad):
    """Harmonic tangential load, amplitude sin(2 π t/period + phase), held after the last cycle.

    Made by `tangential_harmonic`.
    """

    force_x: float = field(default=0.0, metadata={"unit": "N"})
    force_y: float = field(default=0.0, metadata={"unit": "N"})
    torque: float = field(default=0.0, metadata={"unit": "N m"})
    displacement_x: float | None = field(default=None, metadata={"unit": "m"})
    displacement_y: float | None = field(default=None, metadata={"unit": "m"})
    rotation: float | None = field(default=None, metadata={"unit": "rad"})
    period: float = field(metadata={"unit": "s"})
    cycles: int = field(metadata={"unit": "1"})
    phase: float = field(default=0.0, metadata={"unit": "rad"})

    @property
    def end(self) -> float:
        """Instant at which the last cycle ends [s]."""
        return self.cycles * self.period

    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the load at an instant [s], after the jump at the start or before it ("left")."""
        instant = finite("time", time, "s")
        right = history_points.side_of_jump(side) == "right"
        started = instant > 0 or (right and instant == 0)
        turns = min(instant, self.end) / self.period
        # Whole cycles are subtracted first: sin(2 π n) is not 0 in floating point.
        wave = math.sin(2 * math.pi * (turns - math.floor(turns)) + self.phase) if started else 0.0
        amplitudes = {name: getattr(self, name) for name in UNITS}
        return TangentialPoint.of(
            {name: None if size is None else size * wave for name, size in amplitudes.items()}
        )

    @cached_property
    def kinks(self) -> Floats:
        """Begin, reversals and end of the cycles [s]."""
        first = 0.25 - self.phase / (2 * math.pi)
        turns = np.arange(2 * self.cycles + 2) / 2 + (first % 0.5)
        turns = turns[(turns > 1e-9) & (turns < self.cycles - 1e-9)]
        return np.array([0.0, *(turns * self.period), self.end])

    @property
    def whole_cycles(self) -> tuple[tuple[float, float], ...]:
        """Its periods [s]."""
        return tuple((n * self.period, (n + 1) * self.period) for n in range(self.cycles))

    @property
    def jumps(self) -> Floats:
        """Time 0, unless the load starts at zero [s]."""
        return np.zeros(1) if math.sin(self.phase) else np.zeros(0)

    @property
    def longest_step(self) -> float:
        """A 128th of a period [s]."""
        return self.period / STEPS_PER_CYCLE


def tangential_harmonic(
    *, period: float, cycles: int, phase: float = 0.0, **given: float
) -> TangentialHarmonic:
    """Return a tangential load amplitude · sin(2 π t/period + phase), held after the last cycle.

    Parameters
    ----------
    period : float
        Time of a cycle, positive [s].
    cycles : int
        Number of cycles, at least 1.
    phase : float, optional
        Phase at time 0 [rad].
    **given : float
        Amplitudes, as in `tangential_step`.

    Returns
    -------
    TangentialHarmonic
        The load; its reversals are kinks, from which slip starts anew.

    Raises
    ------
    ValueError
        If nothing is given, a name is unknown, or a value is out of range.

    Examples
    --------
    >>> load = tangential_harmonic(force_x=2.0, period=4.0, cycles=1)
    >>> load.at(1.0).forces, load.kinks.tolist()
    ((2.0, 0.0, 0.0), [0.0, 1.0, 3.0, 4.0])
    """
    count = whole("cycles", cycles, 1, MOST_CYCLES)
    values: dict[str, Any] = given_values("tangential_harmonic", given)
    refuse_both(values)
    return TangentialHarmonic(
        period=positive("period", period, "s"),
        cycles=count,
        phase=finite("phase", phase, "rad"),
        **values,
    )
