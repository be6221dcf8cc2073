"""How one exponential term shows in each kind of test: the columns of a linear fit.

A term of strength 1 and time τ answers a creep test with 1 - exp(-t/τ), a relaxation test with
exp(-t/τ), and an oscillation with a²/(1 + a²) in phase and a/(1 + a²) out of phase, a = ωτ.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Response(Protocol):
    """One kind of test at the instants or frequencies where it was measured."""

    @property
    def constants(self) -> Array:
        """Columns, shape (rows, m), of what has no time of its own."""

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest time of a term that would show in the test [s]."""

    def terms(self, times: Array) -> Array:
        """Columns, shape (rows, n), of terms of strength 1 with these times [s]."""

    def slopes(self, times: Array) -> Array:
        """Change of each of these columns per change of ln τ."""


@dataclass(frozen=True, eq=False)
class CreepResponse:
    """Creep under a held stress: J_0 + sum J_i (1 - exp(-t/τ_i)) + φ t.

    Parameters
    ----------
    times : ndarray, shape (rows,)
        Instants [s].
    fluid : bool
        Whether there is a term of steady flow.
    """

    times: Array
    fluid: bool

    @property
    def constants(self) -> Array:
        """Columns of the instant compliance and of the flow."""
        ones = np.ones_like(self.times)
        return np.stack([ones, self.times] if self.fluid else [ones], axis=1)

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest time of a term that would show [s]."""
        first, last = _span(self.times)
        return first / 3, 3 * last

    def terms(self, times: Array) -> Array:
        """Columns 1 - exp(-t/τ)."""
        return -np.expm1(-self.times[:, None] / times)

    def slopes(self, times: Array) -> Array:
        """Columns -(t/τ) exp(-t/τ)."""
        ratio = self.times[:, None] / times
        return -ratio * np.exp(-ratio)


@dataclass(frozen=True, eq=False)
class RelaxationResponse:
    """Relaxation under a held strain: G_inf + sum G_i exp(-t/τ_i).

    Parameters
    ----------
    times : ndarray, shape (rows,)
        Instants [s].
    fluid : bool
        Whether everything relaxes: no G_inf.
    """

    times: Array
    fluid: bool

    @property
    def constants(self) -> Array:
        """Column of the modulus that stays; none for a fluid."""
        return np.ones((self.times.size, 0 if self.fluid else 1))

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest time of a term that would show [s]."""
        first, last = _span(self.times)
        # What relaxes far later is told from what stays only where nothing can stay.
        return first / 3, (30 if self.fluid else 3) * last

    def terms(self, times: Array) -> Array:
        """Columns exp(-t/τ)."""
        return np.exp(-self.times[:, None] / times)

    def slopes(self, times: Array) -> Array:
        """Columns (t/τ) exp(-t/τ)."""
        ratio = self.times[:, None] / times
        return ratio * np.exp(-ratio)


@dataclass(frozen=True, eq=False)
class DynamicResponse:
    """Steady oscillation: first the rows of G', then those of G''.

    Parameters
    ----------
    angular_frequency : ndarray, shape (rows/2,)
        Angular frequencies [rad/s].
    fluid : bool
        Whether everything relaxes: no G_inf.
    """

    angular_frequency: Array
    fluid: bool

    @property
    def constants(self) -> Array:
        """Column of the modulus that stays, in phase only; none for a fluid."""
        count = 0 if self.fluid else 1
        rows = self.angular_frequency.size
        return np.concatenate([np.ones((rows, count)), np.zeros((rows, count))])

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest time of a term that would show [s]."""
        lowest, highest = _span(self.angular_frequency)
        # A term beyond either end still shows in the losses, which fall off as ωτ or 1/ωτ only.
        return 0.1 / highest, 10 / lowest

    def terms(self, times: Array) -> Array:
        """Columns a²/(1 + a²) above a/(1 + a²), a = ωτ."""
        a = self.angular_frequency[:, None] * times
        return np.concatenate([a * a, a]) / np.tile(1 + a * a, (2, 1))

    def slopes(self, times: Array) -> Array:
        """Columns 2a²/(1 + a²)² above a(1 - a²)/(1 + a²)²."""
        a = self.angular_frequency[:, None] * times
        return np.concatenate([2 * a * a, a * (1 - a * a)]) / np.tile((1 + a * a) ** 2, (2, 1))


def _span(points: Array) -> tuple[float, float]:
    positive = points[points > 0]
    return float(positive.min()), float(positive.max())
