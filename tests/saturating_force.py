"""A load of the user's own: a class with what `LoadHistory` requires, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

import viscontact as vc


@dataclass(frozen=True)
class SaturatingForce(vc.LoadHistory):
    """W(t) = W_inf (1 - exp(-t/T)), held from 12 T on."""

    force: float = field(metadata={"unit": "N"})
    time: float = field(metadata={"unit": "s"})

    def level_at(self, times: ArrayLike, *, side: str = "right") -> NDArray[np.float64]:
        del side  # nothing jumps
        reached = np.clip(times, 0.0, self.kinks[-1])
        return np.asarray(-self.force * np.expm1(-reached / self.time))

    @property
    def largest_level(self) -> float:
        return self.force

    @property
    def kinks(self) -> NDArray[np.float64]:
        return np.array([0.0, 12 * self.time])

    @property
    def jumps(self) -> NDArray[np.float64]:
        return np.zeros(0)

    @property
    def longest_step(self) -> float:
        return self.time / 50
