"""Cubic splines of several functions on one axis, without the modules that SciPy's take to load."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class CubicCurves:
    """Splines through values at knots; a cubic each on the first and the last two intervals."""

    knots: Floats
    coefficients: Floats  # of powers 0 to 3 of the distance from a knot; (4, intervals, curves)

    @classmethod
    def through(cls, knots: Floats, values: Floats) -> CubicCurves:
        """Splines through values of shape (knots, curves)."""
        step = np.diff(knots)[:, None]
        rise = np.diff(values, axis=0) / step
        slopes = np.linalg.solve(*_conditions(step[:, 0], rise))
        # Of an interval from its values and slopes at both ends.
        bend = (slopes[:-1] + slopes[1:] - 2 * rise) / step
        second = (rise - slopes[:-1]) / step - bend
        return cls(knots, np.stack([values[:-1], slopes[:-1], second, bend / step]))

    @property
    def count(self) -> int:
        """Number of curves."""
        return int(self.coefficients.shape[2])

    def __call__(self, places: Floats) -> Floats:
        """Values at places, the outermost cubics beyond the knots; shape (..., curves)."""
        interval = np.clip(np.searchsorted(self.knots, places) - 1, 0, len(self.knots) - 2)
        beyond = (places - self.knots[interval])[..., None]
        constant, slope, second, third = self.coefficients
        found = third[interval]
        for lower in (second, slope, constant):
            found *= beyond
            found += lower[interval]
        return np.asarray(found)


def _conditions(step: Floats, rise: Floats) -> tuple[Floats, Floats]:
    """Equations of the slopes at knots: smooth second derivatives, and at the ends third ones."""
    count = len(step) + 1
    matrix, right = np.zeros((count, count)), np.zeros((count, rise.shape[1]))
    inner = np.arange(1, count - 1)
    matrix[inner, inner - 1] = step[1:]
    matrix[inner, inner] = 2 * (step[:-1] + step[1:])
    matrix[inner, inner + 1] = step[:-1]
    right[inner] = 3 * (step[1:, None] * rise[:-1] + step[:-1, None] * rise[1:])
    for at, (near, far), rises in (
        (0, step[:2], rise[:2]),
        (count - 1, step[:-3:-1], rise[:-3:-1]),
    ):
        side = 1 if at == 0 else -1
        both = near + far
        matrix[at, at], matrix[at, at + side] = far, both
        right[at] = ((near + 2 * both) * far * rises[0] + near**2 * rises[1]) / both
    return matrix, right
