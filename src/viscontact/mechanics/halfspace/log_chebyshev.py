"""Chebyshev series of functions of the logarithm of a wave number."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True)
class LogChebyshev:
    """Chebyshev series between two wave numbers, from values at as many places as terms.

    >>> series = LogChebyshev(0.1, 10.0, 8)
    >>> coefficients = series.coefficients(np.log(series.waves))
    >>> print(f"{(series.powers(np.array([2.0])) @ coefficients)[0]:.6f}")
    0.693147
    """

    lowest: float
    highest: float
    terms: int

    @property
    def _angles(self) -> Floats:
        return np.pi * (np.arange(self.terms) + 0.5) / self.terms

    @property
    def waves(self) -> Floats:
        """Wave numbers at which values are wanted, in the unit of the limits."""
        middle = np.log(self.lowest * self.highest) / 2
        half = np.log(self.highest / self.lowest) / 2
        return np.asarray(np.exp(middle + half * np.cos(self._angles)))

    def coefficients(self, values: Floats) -> Floats:
        """Coefficients of the series through values at `waves`, along the first axis."""
        transform = 2 / self.terms * np.cos(np.outer(np.arange(self.terms), self._angles))
        transform[0] /= 2
        return np.tensordot(transform, values, axes=1)

    def powers(self, waves: Floats) -> Floats:
        """Weights of the coefficients at wave numbers, shape (waves, terms)."""
        low, high = np.log(self.lowest), np.log(self.highest)
        places = (2 * np.log(waves) - low - high) / (high - low)
        return np.asarray(chebyshev.chebvander(places, self.terms - 1))
