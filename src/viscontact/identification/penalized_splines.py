"""Uniform cubic B-splines with a penalty on curvature, as dense as the rows of measured sets."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import BSpline

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

_MOST_KNOTS = 200
_MARGIN = np.log(10.0)  # that places may move beyond the knots before these are set again


@dataclass(frozen=True, eq=False)
class PenalizedSplines:
    """Basis of smooth curves over the reduced ln(time)."""

    first: float
    spacing: float
    count: int

    @classmethod
    def over(cls, places: Floats, spacing: float) -> PenalizedSplines:
        """Splines over the places and a margin."""
        first, last = float(places.min() - _MARGIN), float(places.max() + _MARGIN)
        spacing = max(spacing, (last - first) / _MOST_KNOTS)
        return cls(first, spacing, int(np.ceil((last - first) / spacing)) + 3)

    @property
    def knots(self) -> Floats:
        """All knots, three of them before the first place."""
        return np.asarray(self.first + self.spacing * (np.arange(self.count + 4) - 3.0))

    @property
    def penalty(self) -> Floats:
        """Matrix of the integral of the squared second derivative."""
        second = np.diff(np.eye(self.count), n=2, axis=0)
        return np.asarray(second.T @ second / self.spacing**3)

    @property
    def log_penalty(self) -> float:
        """Logarithm of the product of the eigenvalues of the penalty that are not 0."""
        second = np.diff(np.eye(self.count), n=2, axis=0)
        log = np.linalg.slogdet(second @ second.T)[1]
        return float(log - 3 * (self.count - 2) * np.log(self.spacing))

    def values(self, places: Floats) -> Floats:
        """Values of all splines, shape (places, count)."""
        return np.asarray(BSpline.design_matrix(self._inside(places), self.knots, 3).toarray())

    def slopes(self, places: Floats) -> Floats:
        """Derivatives of all splines, shape (places, count)."""
        lower = BSpline.design_matrix(self._inside(places), self.knots[1:-1], 2).toarray()
        return np.asarray(lower @ np.diff(np.eye(self.count), axis=0) / self.spacing)

    def _inside(self, places: Floats) -> Floats:
        last = self.first + self.spacing * (self.count - 3)
        return np.clip(places, self.first, last - 1e-9 * self.spacing)
