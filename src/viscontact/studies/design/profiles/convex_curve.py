"""Convex drop curves of a roller with piecewise linear curvature."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Steepness of the knots towards the end: the last interval is this part of the first one.
LAST_INTERVAL = 0.15
#: Points of a table from the middle to the end.
POINTS = 100


@dataclass(frozen=True)
class ConvexCurves:
    """Curves drop(x) on |x| <= half_length, whose curvature is linear between knots.

    Each coefficient is the drop at the ends [m] that the curvature at a knot adds: from the middle
    to the end; else to the left end, then to the right end. With `has_slope`, the last one is the
    drop of a straight taper [m], of either sign: it counts where the roller's tilt is prescribed.
    """

    # The curvature is not negative, so that a curve is convex.

    half_length: float
    knots: int  # from the middle to the end
    symmetric: bool
    has_slope: bool = False

    @property
    def size(self) -> int:
        """Number of coefficients."""
        return self.knots * (1 if self.symmetric else 2) + self.has_slope

    @property
    def lowest(self) -> Floats:
        """Least values of the coefficients [m]."""
        least = np.zeros(self.size)
        if self.has_slope:
            least[-1] = -np.inf
        return least

    @cached_property
    def places(self) -> Floats:
        """Knots from the middle, 0, to the end, 1; they become denser towards the end."""
        intervals = np.geomspace(1.0, LAST_INTERVAL, self.knots - 1)
        return np.append(0.0, np.cumsum(intervals) / intervals.sum())

    def shapes(self, x: ArrayLike) -> Floats:
        """Drop per coefficient at positions, shape (positions, coefficients) [-]."""
        u = np.asarray(x, dtype=np.float64) / self.half_length
        both = _double_integrals(self.places, np.abs(u))
        if self.symmetric:
            parts = [both]
        else:
            parts = [np.where((u < 0)[:, None], both, 0.0), np.where((u > 0)[:, None], both, 0.0)]
        return np.hstack([*parts, u[:, None]] if self.has_slope else parts)

    def drop(self, coefficients: ArrayLike, x: ArrayLike) -> Floats:
        """Drop at positions [m], zero at the highest point of a table."""
        found = self.shapes(x) @ np.asarray(coefficients, dtype=np.float64)
        return np.asarray(found - found.min())

    def table(self) -> Floats:
        """Positions of a table from the left end to the right end [m]."""
        right = self.half_length * np.arange(1, POINTS + 1) / POINTS
        return np.concatenate([-right[::-1], [0.0], right])

    def fitted(self, drop: ArrayLike) -> Floats:
        """Coefficients of the curve closest to drops at the positions of the table [m]."""
        # Relative deviations count near the end, where the drop is steep, absolute ones elsewhere.
        wanted, x = np.asarray(drop, dtype=np.float64), self.table()
        weight = 1 / (np.abs(wanted) + 0.05 * np.abs(wanted).max())
        shapes = self.shapes(x) * weight[:, None]
        found = scipy.optimize.lsq_linear(
            shapes, wanted * weight, bounds=(self.lowest, np.full(self.size, np.inf))
        )
        return np.asarray(found.x)


def _double_integrals(places: Floats, u: Floats) -> Floats:
    """Curves with the curvature of one knot, zero with their slope at 0, and one at the end."""
    columns = []
    for knot in range(len(places)):
        hat = np.zeros(len(places))
        hat[knot] = 1.0
        curve = scipy.interpolate.make_interp_spline(places, hat, k=1).antiderivative(2)
        columns.append(curve(u) / curve(1.0))
    return np.stack(columns, axis=-1)
