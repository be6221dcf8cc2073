"""Monotonically increasing load histories of the Lee-Radok solution."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.hereditary import TimeFunction, evaluate
from viscontact.reference.lag_means import lag_mean


class GrowingLoad(Protocol):
    """Load history that never decreases."""

    @property
    def corners(self) -> tuple[float, ...]:
        """Instants where the load, or its rate, jumps; the first is 0 [s]."""

    def at(self, times: Floats) -> Floats:
        """Load at each time [N]."""

    def crept(self, creep_compliance: TimeFunction, times: Floats) -> Floats:
        """Integral of J(t - t') dW(t') at each time [m²]."""


@dataclass(frozen=True)
class SuddenLoad:
    """Force applied at time 0 and held."""

    force: float  # [N]
    corners = (0.0,)

    def at(self, times: Floats) -> Floats:
        """Load at each time, the value just after the jump at 0 [N]."""
        return np.full_like(times, self.force)

    def crept(self, creep_compliance: TimeFunction, times: Floats) -> Floats:
        """Integral of J(t - t') dW(t') at each time, here F J(t) [m²]."""
        return self.force * evaluate(creep_compliance, times)


@dataclass(frozen=True)
class RampedLoad:
    """Force that increases linearly with time, then is held."""

    force: float  # force that is held [N]
    duration: float  # time of its rise [s]

    @property
    def corners(self) -> tuple[float, ...]:
        """Instants where the rate of loading jumps [s]."""
        return (0.0, self.duration)

    def at(self, times: Floats) -> Floats:
        """Load at each time [N]."""
        load: Floats = self.force * np.minimum(times / self.duration, 1.0)
        return load

    def crept(self, creep_compliance: TimeFunction, times: Floats) -> Floats:
        """Integral of J(t - t') dW(t') at each time: F/T times that of J over [t - T, t] [m²]."""
        since_held = np.maximum(times - self.duration, 0.0)
        mean = lag_mean(creep_compliance)(since_held.ravel(), times.ravel()).reshape(times.shape)
        return self.force * mean * (times - since_held) / self.duration
