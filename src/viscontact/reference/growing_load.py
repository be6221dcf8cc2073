"""Monotonically increasing load histories of the Lee-Radok solution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from viscontact.reference.hereditary import TimeFunction, accumulated, averaged, evaluate


class GrowingLoad(Protocol):
    """Load history that never decreases."""

    @property
    def corners(self) -> tuple[float, ...]:
        """Instants where the load, or its rate, jumps; the first is 0 [s]."""

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Load at each time [N]."""

    def crept(
        self, creep_compliance: TimeFunction, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Integral of J(t - t') dW(t') at each time [m²]."""


@dataclass(frozen=True)
class SuddenLoad:
    """Force applied at time 0 and held."""

    force: float  # [N]
    corners = (0.0,)

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Load at each time, the value just after the jump at 0 [N]."""
        return np.full_like(times, self.force)

    def crept(
        self, creep_compliance: TimeFunction, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
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

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Load at each time [N]."""
        load: NDArray[np.float64] = self.force * np.minimum(times / self.duration, 1.0)
        return load

    def crept(
        self, creep_compliance: TimeFunction, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Integral of J(t - t') dW(t') at each time: F/T times that of J over [t - T, t] [m²]."""
        mean = np.empty_like(times)
        long_held = times > 2 * self.duration
        # Long after the ramp the difference of two integrals from 0 would lose its digits.
        early = times[~long_held]
        if early.size:
            since_held = np.maximum(early - self.duration, 0.0)
            both = accumulated(creep_compliance, np.stack([early, since_held]))
            mean[~long_held] = (both[0] - both[1]) / self.duration
        mean[long_held] = averaged(
            creep_compliance, times[long_held] - self.duration, self.duration
        )
        return self.force * mean
