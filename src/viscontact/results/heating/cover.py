"""Conduction of heat through the cover of a roll: a slab with a uniform source."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.polynomial.legendre import legder, leggauss, legval, legvander

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Polynomials over the thickness: a steady profile is a parabola, and is met exactly; that of a
#: heating is smooth once its start has spread over a tenth of the thickness.
_MODES = 16
#: Places at which the hottest one is looked for.
_PLACES = 1001


@dataclass(frozen=True)
class Cover:
    """Slab with a uniform heat source: its surface is cooled, its core insulated or held.

    Without a conductivity its temperature is uniform. The temperature is expanded in polynomials
    over the thickness (Galerkin), to which the cooling is a natural boundary condition.
    """

    cooling: float  # heat transfer coefficient of the surface [W/(m² K)]
    ambient: float  # [K]
    thickness: float = 1.0  # [m]; without effect on the balance of a uniform temperature
    conductivity: float | None = None  # [W/(m K)]
    core_temperature: float | None = None  # [K]; None: no heat flows into the core
    capacity: float = 1.0  # heat capacity of a volume [J/(m³ K)], for heating over time

    @property
    def base(self) -> float:
        """Temperature to which the polynomials add [K]."""
        return self.ambient if self.core_temperature is None else self.core_temperature

    def _shapes(self, x: Floats, derivative: bool = False) -> Floats:
        """Polynomials, or derivatives by z, at places x from -1 (core) to 1: (places, modes)."""
        if self.conductivity is None:
            return np.full((x.size, 1), 0.0 if derivative else 1.0)
        numbers = np.eye(_MODES)
        if self.core_temperature is not None:  # P_n - P_n(-1) vanishes at the core
            numbers = np.eye(_MODES, _MODES + 1, k=1)
            numbers[:, 0] = [(-1.0) ** n for n in range(_MODES)]
        if derivative:
            slopes = np.asarray(legval(x, legder(numbers.T)).T, dtype=np.float64)
            return 2.0 / self.thickness * slopes
        return np.asarray(legvander(x, numbers.shape[1] - 1) @ numbers.T)

    @cached_property
    def matrices(self) -> tuple[Floats, Floats]:
        """Heat capacities and conductances of the modes, per area [J/(m² K)], [W/(m² K)]."""
        x, weights = leggauss(_MODES + 2)
        weights = weights * self.thickness / 2
        shapes, slopes = self._shapes(x), self._shapes(x, derivative=True)
        at_surface = self._shapes(np.array([1.0]))[0]
        stored = self.capacity * np.asarray((shapes.T * weights) @ shapes, dtype=np.float64)
        conducted = (self.conductivity or 0.0) * (slopes.T * weights) @ slopes
        return stored, conducted + self.cooling * np.outer(at_surface, at_surface)

    @cached_property
    def averages(self) -> Floats:
        """Means of the modes over the thickness."""
        x, weights = leggauss(_MODES + 2)
        return np.asarray(weights @ self._shapes(x) / 2, dtype=np.float64)

    @property
    def inflow(self) -> Floats:
        """Heat that the modes receive from outside at the temperature `base` [W/m²]."""
        received = self.cooling * (self.ambient - self.base)
        return np.asarray(received * self._shapes(np.array([1.0]))[0], dtype=np.float64)

    def steady(self, flux: float) -> Floats:
        """Modes of the steady state with a heat source [W per m² of the surface]."""
        sources = flux * self.averages + self.inflow
        return np.asarray(np.linalg.solve(self.matrices[1], sources), dtype=np.float64)

    def mean(self, modes: Floats) -> Floats:
        """Mean temperature over the thickness [K]."""
        return np.asarray(self.base + modes @ self.averages, dtype=np.float64)

    def hottest(self, modes: Floats) -> Floats:
        """Highest temperature over the thickness [K]."""
        return np.asarray(self.profile(modes)[1].max(axis=-1))

    def surface(self, modes: Floats) -> Floats:
        """Temperature of the surface [K]."""
        return np.asarray(self.base + modes @ self._shapes(np.array([1.0]))[0])

    def profile(self, modes: Floats) -> tuple[Floats, Floats]:
        """Distances from the core [m], and the temperatures there [K]."""
        x = np.linspace(-1.0, 1.0, _PLACES)
        return self.thickness / 2 * (1 + x), self.base + modes @ self._shapes(x).T

    @cached_property
    def idle(self) -> float:
        """Mean temperature without a source [K]."""
        return float(self.mean(self.steady(0.0)))

    @cached_property
    def resistance(self) -> float:
        """Rise of the mean temperature per heat source [K m²/W]."""
        return float(self.averages @ np.linalg.solve(self.matrices[1], self.averages))
