"""Responses of one exponential term to each kind of test: columns of a linear fit.

A term of strength 1 and time τ responds to a creep test with 1 - exp(-t/τ), to a relaxation test
with exp(-t/τ), and to an oscillation with a²/(1 + a²) in phase and a/(1 + a²) out of phase, a = ωτ.

"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class CreepResponse:
    """Creep at times [s] under constant stress: J_0 + sum J_i (1 - exp(-t/τ_i)) + φ t (fluid)."""

    times: Floats
    fluid: bool

    @property
    def constants(self) -> Floats:
        """Columns of the instant compliance and of the flow."""
        ones = np.ones_like(self.times)
        return np.stack([ones, self.times] if self.fluid else [ones], axis=1)

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest detectable time of a term [s]."""
        first, last = _span(self.times)
        return first / 3, 3 * last

    def terms(self, times: Floats) -> Floats:
        """Columns 1 - exp(-t/τ)."""
        return -np.expm1(-self.times[:, None] / times)

    def slopes(self, times: Floats) -> Floats:
        """Columns -(t/τ) exp(-t/τ)."""
        ratio = self.times[:, None] / times
        return -ratio * np.exp(-ratio)


@dataclass(frozen=True, eq=False)
class ExpandingCreepResponse(CreepResponse):
    """Creep with a strain proportional to the change of temperature, of either sign."""

    warmer: Floats  # temperature above that of no such strain [K]

    @property
    def constants(self) -> Floats:
        """Columns of creep, and those of thermal expansion and contraction."""
        thermal = np.stack([self.warmer, -self.warmer], axis=1)
        return np.concatenate([super().constants, thermal], axis=1)


@dataclass(frozen=True, eq=False)
class RelaxationResponse:
    """Relaxation at times [s] under constant strain: G_inf (0: fluid) + sum G_i exp(-t/τ_i)."""

    times: Floats
    fluid: bool

    @property
    def constants(self) -> Floats:
        """Column of the equilibrium modulus; none for a fluid."""
        return np.ones((self.times.size, 0 if self.fluid else 1))

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest detectable time of a term [s]."""
        first, last = _span(self.times)
        # Late relaxation differs from an equilibrium modulus only where there is none.
        return first / 3, (30 if self.fluid else 3) * last

    def terms(self, times: Floats) -> Floats:
        """Columns exp(-t/τ)."""
        return np.exp(-self.times[:, None] / times)

    def slopes(self, times: Floats) -> Floats:
        """Columns (t/τ) exp(-t/τ)."""
        ratio = self.times[:, None] / times
        return ratio * np.exp(-ratio)


@dataclass(frozen=True, eq=False)
class DynamicResponse:
    """Oscillation at angular frequencies [rad/s]: rows of G', then of G''; fluid: no G_inf."""

    angular_frequency: Floats
    fluid: bool

    @property
    def constants(self) -> Floats:
        """Column of the equilibrium modulus, in phase only; none for a fluid."""
        count = 0 if self.fluid else 1
        rows = self.angular_frequency.size
        return np.concatenate([np.ones((rows, count)), np.zeros((rows, count))])

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest detectable time of a term [s]."""
        lowest, highest = _span(self.angular_frequency)
        # A term beyond either end still contributes to the losses, which decay as ωτ or 1/ωτ only.
        return 0.1 / highest, 10 / lowest

    def terms(self, times: Floats) -> Floats:
        """Columns a²/(1 + a²) above a/(1 + a²), a = ωτ."""
        a = self.angular_frequency[:, None] * times
        return np.concatenate([a * a, a]) / np.tile(1 + a * a, (2, 1))

    def slopes(self, times: Floats) -> Floats:
        """Columns 2a²/(1 + a²)² above a(1 - a²)/(1 + a²)²."""
        a = self.angular_frequency[:, None] * times
        return np.concatenate([2 * a * a, a * (1 - a * a)]) / np.tile((1 + a * a) ** 2, (2, 1))


@dataclass(frozen=True, eq=False)
class StorageResponse:
    """Oscillation at angular frequencies [rad/s]: rows of G' alone; fluid: no G_inf."""

    angular_frequency: Floats
    fluid: bool

    @property
    def constants(self) -> Floats:
        """Column of the equilibrium modulus; none for a fluid."""
        return np.ones((self.angular_frequency.size, 0 if self.fluid else 1))

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest detectable time of a term [s]."""
        lowest, highest = _span(self.angular_frequency)
        # Slow terms differ from an equilibrium modulus only where there is none.
        return 1 / (3 * highest), (30 if self.fluid else 3) / lowest

    def terms(self, times: Floats) -> Floats:
        """Columns a²/(1 + a²), a = ωτ."""
        a = self.angular_frequency[:, None] * times
        return a * a / (1 + a * a)

    def slopes(self, times: Floats) -> Floats:
        """Columns 2a²/(1 + a²)²."""
        a = self.angular_frequency[:, None] * times
        return 2 * a * a / (1 + a * a) ** 2


#: One kind of test at its measured times or frequencies, on a solid or a fluid.
Response = CreepResponse | RelaxationResponse | DynamicResponse | StorageResponse


def _span(points: Floats) -> tuple[float, float]:
    positive = points[points > 0]
    return float(positive.min()), float(positive.max())
