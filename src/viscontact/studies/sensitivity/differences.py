"""Differences: derivatives from values at some points, with the error of their step."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class Slopes:
    """Two differences for a derivative, and Richardson's extrapolation (1911) of both."""

    near: Floats
    far: Floats

    @property
    def extrapolated(self) -> Floats:
        """Derivative without the error of second order."""
        return (4 * self.near - self.far) / 3

    @property
    def error(self) -> Floats:
        """Error of the step: the distance of both differences."""
        return np.abs(self.near - self.far)

    def distance(self, other: Slopes) -> Floats:
        """Largest difference from the slopes on other cells; NaN if one is not known."""
        # Errors of cells vary with the place of the rim within a cell, and may be equal by chance
        # in one of the differences, but not in all.
        names = ("near", "far", "extrapolated")
        apart = [np.abs(getattr(self, name) - getattr(other, name)) for name in names]
        return np.asarray(np.max(apart, axis=0))


@dataclass(frozen=True)
class Stencil:
    """Weights of the points, in steps, of second-order differences with a step and twice this."""

    near: Mapping[int, float]
    far: Mapping[int, float]

    @property
    def points(self) -> tuple[int, ...]:
        """Points other than the nominal one."""
        return tuple(sorted({*self.near, *self.far} - {0}))

    def slopes(self, values: Mapping[int, Floats], step: float) -> Slopes:
        """Derivative from values at all points and at the nominal one."""
        near, far = (
            sum((weight * values[point] for point, weight in each.items()), start=np.array(0.0))
            for each in (self.near, self.far)
        )
        return Slopes(near / step, far / step)


CENTRAL = Stencil({-1: -0.5, 1: 0.5}, {-2: -0.25, 2: 0.25})
#: One-sided differences, for a value close to a limit.
ABOVE = Stencil({0: -1.5, 1: 2.0, 2: -0.5}, {0: -0.75, 2: 1.0, 4: -0.25})
BELOW = Stencil({0: 1.5, -1: -2.0, -2: 0.5}, {0: 0.75, -2: -1.0, -4: 0.25})
