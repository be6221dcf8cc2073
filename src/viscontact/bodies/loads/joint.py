"""Normal and tangential load together, of whose steps a run is made."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Cycle, LoadHistory
from viscontact.bodies.loads.tangential import TangentialLoad


@dataclass(frozen=True, eq=False)
class JointLoad(LoadHistory):
    """Normal load with the kinks and jumps of a tangential one."""

    load: LoadHistory
    tangential: TangentialLoad

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the normal force [N] or approach [m] at many instants [s], any shape."""
        return self.load.level_at(times, side=side)

    @property
    def largest_level(self) -> float:
        """Largest force [N] or approach [m] of the normal load."""
        return self.load.largest_level

    @cached_property
    def kinks(self) -> Floats:
        """Kinks of both loads, increasing [s]."""
        return np.union1d(self.load.kinks, self.tangential.kinks)

    @cached_property
    def jumps(self) -> Floats:
        """Jumps of both loads, increasing [s]."""
        return np.union1d(self.load.jumps, self.tangential.jumps)

    @property
    def longest_step(self) -> float:
        """Longest step on which both are nearly linear [s]."""
        return min(self.load.longest_step, self.tangential.longest_step)

    @property
    def curved_until(self) -> float:
        """Time up to which one of them is curved [s]."""
        curved = (each for each in (self.load, self.tangential) if math.isfinite(each.longest_step))
        return max((float(each.kinks[-1]) for each in curved), default=0.0)

    @property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """Cycles of the normal load."""
        return self.load.load_cycles

    @property
    def touches(self) -> Floats:
        """Instants between kinks at which undeformed bodies come to touch, increasing [s]."""
        return self.load.touches

    @property
    def stops(self) -> Floats:
        """Instants at which every run has a step: those of the normal load, and of both [s]."""
        ends = [time for cycle in self.tangential.whole_cycles for time in cycle]
        return np.unique(np.concatenate([super().stops, ends]))
