"""A load as it is, but for the steps that it asks for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.loads import LoadHistory, LoadPoint
from viscontact.loads.history import Cycle


@dataclass(frozen=True, eq=False)
class LongerStepsLoad(LoadHistory):
    """A load that asks for fewer steps of its own.

    Attributes
    ----------
    load : LoadHistory
        The load.
    step_ratio : float
        Its longest step, in longest steps of the load.
    """

    load: LoadHistory
    step_ratio: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "control", self.load.control)

    def at(self, time: float, *, side: str = "right") -> LoadPoint:
        """Return what is prescribed at an instant [s]."""
        return self.load.at(time, side=side)

    def level_at(self, times: ArrayLike, *, side: str = "right") -> NDArray[np.float64]:
        """Return the force [N] or the approach [m] at many instants [s]."""
        return self.load.level_at(times, side=side)

    @property
    def largest_level(self) -> float:
        """Largest force [N] or approach [m] of the whole history."""
        return self.load.largest_level

    @property
    def kinks(self) -> NDArray[np.float64]:
        """The load's kinks [s]."""
        return self.load.kinks

    @property
    def jumps(self) -> NDArray[np.float64]:
        """The load's jumps [s]."""
        return self.load.jumps

    @property
    def longest_step(self) -> float:
        """Longest step, so many times the load's [s]."""
        return self.step_ratio * self.load.longest_step

    @property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """The load's cycles."""
        return self.load.load_cycles

    def is_even(self, axis: int) -> bool:
        """Whether the load is even along an axis."""
        return self.load.is_even(axis)
