"""Surrogate of the responses of a case: radial basis functions through those of its trials."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import RBFInterpolator

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Values at some points, of shape (points, columns).
Interpolant = Callable[[Floats], Floats]
#: Point and its responses.
Sample = tuple[Sequence[float], Sequence[float]]


def interpolant(points: Floats, values: Floats) -> Interpolant:
    """Interpolant of values, of shape (points, columns): cubic, with a linear part, if possible."""
    count, size = points.shape
    if count == 1:
        return lambda wanted: np.repeat(values, len(wanted), axis=0)
    # Points of a line in a plane do not fix a linear part.
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if count > size and spread[-1] > 1e-6 * spread[0]:
        found: Interpolant = RBFInterpolator(points, values, kernel="cubic", degree=1)
    else:
        found = RBFInterpolator(points, values, kernel="linear", degree=0)
    return found


@dataclass(frozen=True)
class Surrogate:
    """Interpolant of the responses on the cells of the case, which may build on coarser ones."""

    correction: Interpolant
    coarse: Interpolant | None = None

    @classmethod
    def through(cls, fine: Sequence[Sample], coarse: Sequence[Sample] = ()) -> Surrogate:
        """Surrogate of samples on fine cells: with coarse ones, of the difference from these."""
        points, values = _columns(fine)
        if not coarse:
            return cls(interpolant(points, values))
        base = interpolant(*_columns(coarse))
        return cls(interpolant(points, values - base(points)), base)

    def __call__(self, points: Floats) -> Floats:
        """Responses at some points, of shape (points, responses)."""
        found = self.correction(points)
        return found if self.coarse is None else found + self.coarse(points)


def _columns(samples: Sequence[Sample]) -> tuple[Floats, Floats]:
    return np.array([point for point, _ in samples]), np.array([values for _, values in samples])
