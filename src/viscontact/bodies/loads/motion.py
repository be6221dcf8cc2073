"""Motion of the body over the surface: base class, and the load of a moving body."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Control, Cycle, LoadHistory
from viscontact.units.numbers import finite, real_array, store

#: Relative difference below which a kink of the path is taken at a kink of the load.
SAME_TIME = 1e-9

#: Creepage at which a body that brakes does not turn any more.
LARGEST_CREEPAGE = 1.0

#: Upper limit on the cells that the body passes.
MOST_CELLS = 1_000_000


class Motion(ABC):
    """Position of the body's axis over time, along x and y."""

    # A derived class defines `position_at`, `velocity_at`, `kinks` and `moves`, `reach` and
    # `times_at_cells`, and `longest_step` if its path is curved between its kinks.

    #: True for a body that stays where it is, which has no resistance, friction, or heat.
    stands: ClassVar[bool] = False

    #: True if the material of both bodies flows through the contact, False if the body slides.
    rolling: bool | None = None

    #: Surface speed of a body that rolls over its travel, less 1; None if it is not given [-].
    creepage: float | None = None

    #: Speed of its surface to the right of its travel, over that; None if it is not given [-].
    lateral_creepage: float | None = None

    @abstractmethod
    def position_at(self, times: ArrayLike) -> Floats:
        """Return the positions (x, y) of the body's axis, shape (..., 2) [m]."""

    @abstractmethod
    def velocity_at(self, time: float) -> tuple[float, float]:
        """Return the velocity along x and y with which the body arrives at an instant [m/s]."""

    @property
    @abstractmethod
    def kinks(self) -> Floats:
        """Times of kinks of the path, with its begin and end, increasing [s]."""

    @property
    @abstractmethod
    def reach(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and largest positions along x, and along y [m]."""

    @abstractmethod
    def times_at_cells(self, cell_size: tuple[float, float]) -> Floats:
        """Times at which the body has moved by whole cells (dx, dy) since its start [s]."""

    @property
    def moves(self) -> tuple[bool, bool]:
        """True along x and along y if the position changes there."""
        along_x, along_y = (low < high for low, high in self.reach)
        return along_x, along_y

    @property
    def end(self) -> float:
        """Time from which the body is at rest [s]."""
        return float(self.kinks[-1])

    @property
    def longest_step(self) -> float:
        """Longest step on which the path is nearly straight in time [s]; inf if it is straight."""
        return math.inf

    @property
    @abstractmethod
    def top_speed(self) -> float:
        """Largest speed [m/s]."""

    @property
    def cycles(self) -> tuple[Cycle, ...]:
        """Begins and ends of the cycles of a reciprocating motion, in order [s]."""
        return ()

    def history_under(self, load: LoadHistory) -> LoadHistory:
        """Return a load with the kinks and cycles of the path."""
        return MovingLoad(load, self)


@dataclass(frozen=True)
class AtOrigin(Motion):
    """Body that stays at the origin of its grid."""

    def position_at(self, times: ArrayLike) -> Floats:
        """Return the origin, shape (..., 2) [m]."""
        return np.zeros((*real_array("times", times, "s").shape, 2))

    def velocity_at(self, time: float) -> tuple[float, float]:
        """Return no velocity [m/s]."""
        return 0.0, 0.0

    @property
    def kinks(self) -> Floats:
        """No times [s]."""
        return np.empty(0)

    @property
    def reach(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The origin [m]."""
        return (0.0, 0.0), (0.0, 0.0)

    def times_at_cells(self, cell_size: tuple[float, float]) -> Floats:
        """Return no times, as no cells are passed [s]."""
        return np.empty(0)

    @property
    def top_speed(self) -> float:
        """No speed [m/s]."""
        return 0.0

    def history_under(self, load: LoadHistory) -> LoadHistory:
        """Return the load as it is."""
        return load


@dataclass(frozen=True)
class Standing(AtOrigin):
    """Body that does not move over the surface."""

    stands: ClassVar[bool] = True


STANDING = Standing()


@dataclass(frozen=True, eq=False)
class MovingLoad(LoadHistory):
    """Load of a moving body: its kinks and cycles are those of the load and of the path."""

    load: LoadHistory
    motion: Motion

    #: Quantity that the load prescribes.
    control: Control = field(init=False)

    def __post_init__(self) -> None:
        store(self, control=self.load.control)

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force [N] or the approach [m] at many instants [s], any shape."""
        return self.load.level_at(times, side=side)

    @property
    def largest_level(self) -> float:
        """Largest force [N] or approach [m] of the whole history."""
        return self.load.largest_level

    @property
    def kinks(self) -> Floats:
        """Kinks of load and path, increasing [s]."""
        known, others = self.load.kinks, self.motion.kinks
        after = np.searchsorted(known, others)
        around = known[np.clip([after - 1, after], 0, len(known) - 1)]
        distance = np.abs(others - around).min(axis=0)
        return np.unique([*known, *others[distance > SAME_TIME * others]])

    @property
    def jumps(self) -> Floats:
        """Jumps of the load, increasing [s]."""
        return self.load.jumps

    @property
    def longest_step(self) -> float:
        """Longest step on which load and path are nearly linear [s]."""
        return min(self.load.longest_step, self.motion.longest_step)

    @property
    def curved_until(self) -> float:
        """Time up to which load or path are curved [s]."""
        curved = (each for each in (self.load, self.motion) if math.isfinite(each.longest_step))
        return max((float(each.kinks[-1]) for each in curved), default=0.0)

    @property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """Cycles of the load, or of the path if the load has none."""
        return self.load.load_cycles or self.motion.cycles

    @property
    def touches(self) -> Floats:
        """Instants between kinks at which undeformed bodies come to touch, increasing [s]."""
        return self.load.touches


def checked_rolling(rolling: bool | None) -> bool | None:
    """Return whether the bodies roll; raise ValueError if that is not true, false or None."""
    if rolling is None or isinstance(rolling, bool | np.bool_):
        return None if rolling is None else bool(rolling)
    raise ValueError(f"rolling must be true or false, got {rolling!r}")


def checked_creepage(creepage: float | None, *, rolling: bool | None) -> float | None:
    """Return a creepage between -1 and 1 of a body that rolls, or None; else raise ValueError."""
    if creepage is None:
        return None
    about = "the surface speed of the body over its travel, less 1"
    number = _share_of_travel("creepage", creepage, about)
    if rolling is False:
        raise ValueError(
            f"creepage goes with a body that rolls, got creepage={creepage!r} and rolling=False; "
            "leave one of them out"
        )
    return number


def checked_lateral_creepage(lateral: float | None, *, creepage: float | None) -> float | None:
    """Return a lateral creepage between -1 and 1 beside a creepage, or None; else ValueError."""
    if lateral is None:
        return None
    about = "the speed of the body's surface across its travel over that travel"
    number = _share_of_travel("lateral_creepage", lateral, about)
    if creepage is None:
        raise ValueError(
            f"lateral_creepage goes with a creepage, which may be 0, got lateral_creepage="
            f"{lateral!r} without one; give the creepage, too, as in creepage=0.0"
        )
    return number


def _share_of_travel(name: str, given: float, about: str) -> float:
    """Return a share between -1 and 1; ValueError for another one, with what it is about."""
    number = finite(name, given, "1")
    if not -LARGEST_CREEPAGE < number < LARGEST_CREEPAGE:
        raise ValueError(
            f"{name} must lie between -1 and 1, got {given!r}: it is {about}; write 0.003 for 0.3 %"
        )
    return number


def refuse_long_path(cells: float) -> None:
    """Raise ValueError if a path crosses too many cells to be stepped over one by one."""
    if cells > MOST_CELLS:
        raise ValueError(
            f"times: the path crosses {cells:.3g} cells, and at most {MOST_CELLS} are stepped "
            "over one by one; give times, or a shorter path"
        )
