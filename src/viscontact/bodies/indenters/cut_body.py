"""An indenter pressed on a body that ends: what lies beyond the ends meets nothing."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import positions


@dataclass(frozen=True)
class CutBody(Indenter):
    """An indenter between planes across x, beyond which there is no body to be pressed."""

    body: Indenter
    before: float = -math.inf  # [m]
    after: float = math.inf  # [m]

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the gap of the body, +inf beyond the planes; see `Indenter.gap`."""
        along, across = positions(x, y)
        inside = (along > self.before) & (along < self.after)
        return np.asarray(np.where(inside, self.body.gap(along, across), np.inf))

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures of the body [1/m]."""
        return self.body.curvatures

    @property
    def endless(self) -> tuple[bool, bool]:
        """Axes along which it continues without end: y, where the body does."""
        return False, self.body.endless[1]

    @property
    def period(self) -> float:
        """Shortest length over which the body repeats itself [m]."""
        return self.body.period

    @property
    def periods(self) -> tuple[float, float]:
        """Lengths along x and y over which the body repeats itself [m]."""
        return self.body.periods

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """Spacing of the samples of the body [m]."""
        return self.body.sample_spacing

    @property
    def sample_points(self) -> tuple[Floats, Floats]:
        """Points of the body [m]."""
        return self.body.sample_points


def cut_at(indenter: Indenter, planes: list[tuple[float | None, float | None]]) -> Indenter:
    """An indenter cut by the ends of bodies at -x and +x [m]; as it is without ends."""
    before = max((low for low, _ in planes if low is not None), default=-math.inf)
    after = min((high for _, high in planes if high is not None), default=math.inf)
    if math.isinf(before) and math.isinf(after):
        return indenter
    return CutBody(indenter, before, after)
