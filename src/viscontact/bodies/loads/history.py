"""Base class of load histories: prescribed values, kinks, jumps, cycles."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.display import Displayable
from viscontact.units.numbers import finite

#: An instant [s], and which side of a jump there: "left" before it, "right" after it.
LoadInstant = tuple[float, str]

#: Begin and end of a cycle of the load.
Cycle = tuple[LoadInstant, LoadInstant]

#: Quantity that a history prescribes along z.
Control = Literal["force", "approach"]


@dataclass(frozen=True)
class LoadPoint:
    """Load prescribed at one instant.

    Parameters
    ----------
    force : float or None
        Force pressing the bodies together, exactly 0 where it is negligible [N]; None where the
        approach is prescribed instead.
    eccentricity_x, eccentricity_y : float
        Position of the force: its moments are force · eccentricity [m].
    tilt_x, tilt_y : float or None
        Prescribed slopes along x and y, positive when they press the +x or +y end deeper;
        None where the tilt is free and the moment is balanced instead [rad].
    approach : float or None
        Prescribed approach, positive when the bodies come closer [m]; None under a force.
    """

    force: float | None
    eccentricity_x: float
    eccentricity_y: float
    tilt_x: float | None
    tilt_y: float | None
    approach: float | None = None

    @property
    def level(self) -> float:
        """Prescribed force [N] or, where that is None, approach [m].

        Examples
        --------
        >>> LoadPoint(None, 0.0, 0.0, None, None, approach=1e-6).level
        1e-06
        """
        level = self.approach if self.force is None else self.force
        assert level is not None  # one of the two is given
        return level


class LoadHistory(Displayable, ABC):
    """A force or an approach over time, with where the force acts and prescribed tilts.

    A derived class defines `level_at`, `largest_level`, `kinks` and `jumps`, and `longest_step` if
    it is curved between its kinks.

    Examples
    --------
    >>> from viscontact.bodies.loads import ramp
    >>> history = ramp(10.0, duration=2.0)
    >>> history.level_at([0.0, 1.0, 5.0]).tolist(), history.kinks.tolist()
    ([0.0, 5.0, 10.0], [0.0, 2.0])
    """

    #: Quantity that the history prescribes along z; "mixed": the force at times, else the approach.
    control: Control | Literal["mixed"] = "force"
    #: Position of the force, constant or at each point of the history [m].
    eccentricity_x: float | Floats = 0.0
    eccentricity_y: float | Floats = 0.0
    #: Prescribed slopes, constant or at each point; None where the tilt is free [rad].
    tilt_x: float | Floats | None = None
    tilt_y: float | Floats | None = None
    #: Stiffness of the spring between a stage at the prescribed approach and the body [N/m]; None
    #: of a body that is held itself.
    stage_stiffness: float | None = None

    @property
    def unit(self) -> str:
        """Unit of the level: N of a force, m of an approach."""
        return "N" if self.control == "force" else "m"

    def at(self, time: float, *, side: str = "right") -> LoadPoint:
        """Return the prescribed load at an instant [s], after a jump or before it ("left")."""
        level = float(self.level_at(finite("time", time, "s"), side=side))
        return LoadPoint(
            force=level if self.control == "force" else None,
            eccentricity_x=float(self.eccentricity_x),
            eccentricity_y=float(self.eccentricity_y),
            tilt_x=None if self.tilt_x is None else float(self.tilt_x),
            tilt_y=None if self.tilt_y is None else float(self.tilt_y),
            approach=level if self.control == "approach" else None,
        )

    def level_of(self, point: LoadPoint) -> float:
        """Return the level of a prescribed load, as `level_at` gives it."""
        return point.level

    @abstractmethod
    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force [N] or the approach [m] at many instants [s], any shape."""

    @property
    @abstractmethod
    def largest_level(self) -> float:
        """Largest force [N] or approach [m] of the whole history."""

    @property
    @abstractmethod
    def kinks(self) -> Floats:
        """All distinct times of kinks and jumps of the history, increasing [s]."""

    @property
    @abstractmethod
    def jumps(self) -> Floats:
        """Kinks at which the load jumps, increasing [s]."""

    @property
    def longest_step(self) -> float:
        """Longest step up to the last kink on which the history is nearly linear [s].

        Infinite if the history is linear between its kinks.
        """
        return math.inf

    @property
    def curved_until(self) -> float:
        """Time up to which steps are at most `longest_step` [s]."""
        return float(self.kinks[-1])

    @property
    def least_force(self) -> float:
        """Least prescribed force [N]; 0 or more where none pulls."""
        return 0.0

    @property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """Cycles of the load, in order: where each begins and ends [s], before or after a jump."""
        return ()

    @property
    def touches(self) -> Floats:
        """Instants between kinks at which undeformed bodies come to touch, increasing [s]."""
        return np.zeros(0)

    @property
    def stops(self) -> Floats:
        """Instants at which every run has a step: kinks, touches and ends of cycles [s]."""
        ends = [time for cycle in self.load_cycles for time, _ in cycle]
        return np.unique(np.concatenate([self.kinks, self.touches, ends]))

    def is_even(self, axis: int) -> bool:
        """True if the load is even along an axis, 0 for across x = 0, 1 for across y = 0."""
        along = "xy"[axis]
        return not any(np.any(getattr(self, name + along)) for name in ("eccentricity_", "tilt_"))
