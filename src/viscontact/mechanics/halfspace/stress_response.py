"""Stresses inside an elastic body under a pressure on its surface: of one cell, and of a wave."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.stack_waves import WaveStresses
from viscontact.mechanics.halfspace.stress_influence import stress_coefficients


class StressResponse(ABC):
    """Stresses per unit pressure in a body that is homogeneous along its surface."""

    @abstractmethod
    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Stresses at a point per unit pressure on cells, as in `stress_coefficients` [-]."""

    @abstractmethod
    def waves(self, wave_number: Floats) -> Callable[[float], WaveStresses]:
        """Stresses over the depth [m] under a wave of pressure, of wave numbers > 0 [1/m]."""

    @abstractmethod
    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio at a depth [m]; ValueError where there are no stresses."""


@dataclass(frozen=True)
class HalfSpaceStress(StressResponse):
    """Stresses in a half-space: they depend on its Poisson's ratio only."""

    poisson_ratio: float

    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Love's closed form [-]."""
        return stress_coefficients(x_edges, y_edges, depth, self.poisson_ratio)

    def waves(self, wave_number: Floats) -> Callable[[float], WaveStresses]:
        """Johnson 1985, section 13.2: each wave decays as exp(-q z)."""

        def at(depth: float) -> WaveStresses:
            qz = wave_number * depth
            return WaveStresses(-(1 - qz), -2 * self.poisson_ratio, -(1 + qz), -qz, np.exp(-qz))

        return at

    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio of the half-space."""
        return self.poisson_ratio
