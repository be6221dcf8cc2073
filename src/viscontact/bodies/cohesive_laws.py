"""Cohesive laws: attraction of two surfaces over the gap between them, behind a hard wall.

A law is two functions, the traction and its slope. Both take the gap, and the change of the gap
over one cell: only a law that ends abruptly, Dugdale's, looks at that.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Least change of the gap over a cell over which Dugdale's traction falls, in ranges [-].
LEAST_FALL = 0.02

#: Strength times equilibrium distance over work of the Lennard-Jones 3-9 law: 16/(9 sqrt 3) [-].
LENNARD_JONES_STRENGTH = 16 / (9 * math.sqrt(3))

#: Traction below this part of the strength is no traction [-].
NEGLIGIBLE = 1e-12


@dataclass(frozen=True)
class CohesiveLaw(ABC):
    """Attraction over the gap: work per area [J/m²], and range [m], which is work over strength."""

    work: float
    range: float

    #: True if the traction ends abruptly, so that the change of the gap over a cell counts.
    is_abrupt: ClassVar[bool] = False

    @property
    def strength(self) -> float:
        """Largest traction [Pa]."""
        return self.work / self.range

    @property
    def decreasing(self) -> CohesiveLaw:
        """Least law that nowhere increases and is nowhere below: the law itself if it decreases."""
        return self

    @property
    def remainder(self) -> CohesiveLaw:
        """The law less its decreasing one: a repulsion that falls with the gap, or nothing."""
        return _Remainder(self.work, self.range, self)

    @property
    @abstractmethod
    def reach(self) -> float:
        """Gap beyond which the traction is below 1e-12 of the strength [m]."""

    @abstractmethod
    def traction(self, gap: Floats, across: Floats) -> Floats:
        """Attraction at a gap >= 0 [Pa], positive; gap and its change over a cell [m]."""

    @abstractmethod
    def slope(self, gap: Floats, across: Floats) -> Floats:
        """Derivative of that traction by the gap [Pa/m]."""

    def traction_and_slope(self, gap: Floats) -> tuple[Floats, Floats]:
        """Both at a gap, of a law that does not end abruptly."""
        return self.traction(gap, gap), self.slope(gap, gap)

    def slope_across(self, gap: Floats, across: Floats) -> Floats:
        """Derivative of that traction by the change of the gap over a cell [Pa/m]."""
        return np.zeros(np.broadcast_shapes(gap.shape, across.shape))

    @abstractmethod
    def energy(self, gap: Floats) -> Floats:
        """Work of separation from a gap to infinity [J/m²]."""


class Exponential(CohesiveLaw):
    """Traction (w/rho) exp(-g/rho)."""

    @property
    def reach(self) -> float:
        """See `CohesiveLaw.reach`."""
        return -math.log(NEGLIGIBLE) * self.range

    def traction(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.traction`."""
        return np.asarray(self.strength * np.exp(gap * (-1 / self.range)))

    def slope(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.slope`."""
        return -self.traction(gap, across) / self.range

    def traction_and_slope(self, gap: Floats) -> tuple[Floats, Floats]:
        """See `CohesiveLaw.traction_and_slope`."""
        traction = self.traction(gap, gap)
        return traction, traction * (-1 / self.range)

    def energy(self, gap: Floats) -> Floats:
        """See `CohesiveLaw.energy`."""
        return np.asarray(self.work * np.exp(-gap / self.range))


class Dugdale(CohesiveLaw):
    """Constant traction up to the gap w/sigma0 (Maugis 1992, J. Colloid Interface Sci. 150, 243).

    The front crosses cells: a cell whose gap varies by `across` about the range carries the part of
    the strength of that part of it that is within the range. Cell by cell the front would stick to
    the grid.
    """

    is_abrupt: ClassVar[bool] = True

    @property
    def reach(self) -> float:
        """See `CohesiveLaw.reach`."""
        return 2 * self.range

    def traction(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.traction`."""
        within = 0.5 + (self.range - gap) / self._fall(across)
        return np.asarray(self.strength * np.clip(within, 0.0, 1.0))

    def slope(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.slope`."""
        fall = self._fall(across)
        crosses = np.abs(gap - self.range) < fall / 2
        return np.where(crosses, -self.strength / fall, 0.0)

    def slope_across(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.slope_across`."""
        fall, ahead = self._fall(across), self.range - gap
        varies = (np.abs(ahead) < fall / 2) & (fall == across)
        return np.where(varies, -self.strength * ahead / fall**2, 0.0)

    def energy(self, gap: Floats) -> Floats:
        """See `CohesiveLaw.energy`."""
        return np.asarray(self.strength * np.maximum(self.range - gap, 0.0))

    def _fall(self, across: Floats) -> Floats:
        """Gap over which the traction falls [m]: at most twice the range, so that w is kept."""
        return np.asarray(np.clip(across, LEAST_FALL * self.range, 2 * self.range))


class LennardJones(CohesiveLaw):
    """Attractive branch of (8 w/3 z0) ((z0/z)³ - (z0/z)⁹) behind a hard wall at z = z0.

    The gap counts from that equilibrium distance.
    """

    @property
    def _distance(self) -> float:
        """Equilibrium distance z0 [m]."""
        return LENNARD_JONES_STRENGTH * self.range

    @property
    def reach(self) -> float:
        """See `CohesiveLaw.reach`."""
        return self._distance * float(np.cbrt(1 / NEGLIGIBLE))

    def traction(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.traction`."""
        cube = (self._distance / (self._distance + gap)) ** 3
        return np.asarray(8 * self.work / (3 * self._distance) * (cube - cube**3))

    def slope(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.slope`."""
        ratio = self._distance / (self._distance + gap)
        scale = 8 * self.work / self._distance**2
        return np.asarray(scale * (3 * ratio**10 - ratio**4))

    def energy(self, gap: Floats) -> Floats:
        """See `CohesiveLaw.energy`."""
        square = (self._distance / (self._distance + gap)) ** 2
        return np.asarray(self.work / 3 * (4 * square - square**4))

    @property
    def decreasing(self) -> CohesiveLaw:
        """See `CohesiveLaw.decreasing`."""
        return _DecreasingLennardJones(self.work, self.range)


class _DecreasingLennardJones(LennardJones):
    """Lennard-Jones law with its strength from contact up to the gap at which that is reached."""

    def traction(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.traction`."""
        return super().traction(np.maximum(gap, self._strongest), across)

    def slope(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.slope`."""
        return np.where(gap > self._strongest, super().slope(gap, across), 0.0)

    @property
    def _strongest(self) -> float:
        """Gap of the strength [m]."""
        return self._distance * (3 ** (1 / 6) - 1)


@dataclass(frozen=True)
class _Remainder(CohesiveLaw):
    """A law less its decreasing one."""

    whole: CohesiveLaw

    @property
    def reach(self) -> float:
        """See `CohesiveLaw.reach`."""
        return self.whole.reach

    def traction(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.traction`; negative or zero."""
        whole = self.whole
        return whole.traction(gap, across) - whole.decreasing.traction(gap, across)

    def slope(self, gap: Floats, across: Floats) -> Floats:
        """See `CohesiveLaw.slope`."""
        return self.whole.slope(gap, across) - self.whole.decreasing.slope(gap, across)

    def energy(self, gap: Floats) -> Floats:
        """See `CohesiveLaw.energy`."""
        return self.whole.energy(gap) - self.whole.decreasing.energy(gap)


#: Laws by their names.
LAWS: dict[str, type[CohesiveLaw]] = {
    "exponential": Exponential,
    "dugdale": Dugdale,
    "lennard-jones": LennardJones,
}
