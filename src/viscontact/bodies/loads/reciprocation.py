"""Motion of the body back and forth over the surface."""

from __future__ import annotations

import itertools
import math
from dataclasses import field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Cycle
from viscontact.bodies.loads.motion import (
    Motion,
    checked_creepage,
    checked_lateral_creepage,
    checked_rolling,
    refuse_long_path,
)
from viscontact.units.numbers import finite, positive, real_array, whole

#: Steps of a cycle; the work of a cycle then has an error of about 6e-4.
STEPS_PER_CYCLE = 128

#: Upper limit on the cycles; each takes dozens of steps.
MOST_CYCLES = 100_000


@dataclass(frozen=True, kw_only=True)
class Reciprocation(Motion):
    """Motion back and forth, amplitude sin(2 π t/period), at rest after the last cycle.

    Made by `reciprocating`.

    Attributes
    ----------
    amplitude : float
        Largest distance from the middle [m].
    period : float
        Time of a cycle [s].
    count : int
        Number of cycles.
    along : {"x", "y"}
        Axis of the motion.
    rolling : bool or None
        As in `Travel`.
    creepage, lateral_creepage : float or None
        As in `Travel` [-].
    """

    amplitude: float = field(metadata={"unit": "m"})
    period: float = field(metadata={"unit": "s"})
    count: int = field(metadata={"unit": "1", "name": "cycles"})
    along: Literal["x", "y"] = "y"
    rolling: bool | None = None
    creepage: float | None = field(default=None, metadata={"unit": "1"})
    lateral_creepage: float | None = field(
        default=None, metadata={"unit": "1", "recorded": "if given"}
    )

    def position_at(self, times: ArrayLike) -> Floats:
        """Return the positions (x, y) of the body's axis, shape (..., 2) [m]."""
        turns = np.clip(real_array("times", times, "s") / self.period, 0.0, self.count)
        # Whole cycles are subtracted first: sin(2 π n) is not 0 in floating point.
        position = self.amplitude * np.sin(2 * math.pi * (turns - np.floor(turns)))
        return _on_axis(self.along, position)

    def velocity_at(self, time: float) -> tuple[float, float]:
        """Return the velocity along x and y with which the body arrives at an instant [m/s]."""
        time, speed = finite("time", time, "s"), 0.0
        if 0 < time <= self.end:
            rate = 2 * math.pi / self.period
            speed = self.amplitude * rate * math.cos(rate * (time % self.period))
        along_x, along_y = _on_axis(self.along, np.asarray(speed)).tolist()
        return along_x, along_y

    @property
    def top_speed(self) -> float:
        """Largest speed [m/s]."""
        return 2 * math.pi * self.amplitude / self.period

    @property
    def kinks(self) -> Floats:
        """Begin and end of the cycles [s]."""
        return np.array([0.0, self.count * self.period])

    @property
    def reach(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and largest positions along x, and along y [m]."""
        low, high = _on_axis(self.along, np.array([-self.amplitude, self.amplitude]))
        return (float(low[0]), float(high[0])), (float(low[1]), float(high[1]))

    def times_at_cells(self, cell_size: tuple[float, float]) -> Floats:
        """Return times at which the body has moved by whole cells (dx, dy) [s]."""
        reach = self.amplitude / cell_size["xy".index(self.along)]
        refuse_long_path(4 * self.count * reach)
        parts = np.arange(-math.floor(reach), math.floor(reach) + 1) / reach
        phases = np.arcsin(parts) / (2 * math.pi)
        half_turns = np.arange(2 * self.count + 1)[:, None]
        turns = half_turns / 2 + phases  # of both signs, forth and back
        return np.unique(np.clip(turns * self.period, 0.0, self.end))

    @property
    def longest_step(self) -> float:
        """A 128th of a period [s]."""
        return self.period / STEPS_PER_CYCLE

    @property
    def cycles(self) -> tuple[Cycle, ...]:
        """Whole periods."""
        ends = [(k * self.period, "right") for k in range(self.count + 1)]
        return tuple(itertools.pairwise(ends))


def reciprocating(
    amplitude: float,
    period: float,
    cycles: int,
    along: Literal["x", "y"] = "y",
    *,
    rolling: bool | None = None,
    creepage: float | None = None,
    lateral_creepage: float | None = None,
) -> Reciprocation:
    """Return a motion back and forth, amplitude sin(2 π t/period), from time 0.

    Parameters
    ----------
    amplitude : float
        Largest distance from the middle, positive [m].
    period : float
        Time of a cycle, positive [s].
    cycles : int
        Number of cycles, at least 1; then the body is at rest.
    along : {"x", "y"}, optional
        Axis of the motion.
    rolling : bool, optional
        True if the material of both bodies flows through the contact, False if the body slides.
        Required where the indenter's material is not elastic.
    creepage : float, optional
        Surface speed of a body that rolls over its travel, less 1, forth and back [-].
    lateral_creepage : float, optional
        As in `Travel`; the body's surface moves to the one side forth and to the other one back,
        as that of a wheel that is askew does [-].

    Returns
    -------
    Reciprocation
        To be given as `motion`.

    Raises
    ------
    ValueError
        If amplitude or period is not positive and finite, cycles is not a whole number of at
        least 1, along is neither "x" nor "y", or a creepage is out of range or given of a body
        that slides, or lateral without the other one.

    Examples
    --------
    >>> reciprocating(2e-3, 1.0, cycles=3).position_at(0.25).tolist()
    [0.0, 0.002]
    """
    if along not in ("x", "y"):
        raise ValueError(f"reciprocating: along must be 'x' or 'y', got {along!r}")
    rolls = checked_rolling(rolling)
    share = checked_creepage(creepage, rolling=rolls)
    return Reciprocation(
        amplitude=positive("reciprocating: amplitude", amplitude, "m"),
        period=positive("reciprocating: period", period, "s"),
        count=whole("reciprocating: cycles", cycles, 1, MOST_CYCLES),
        along=along,
        rolling=rolls if share is None else True,
        creepage=share,
        lateral_creepage=checked_lateral_creepage(lateral_creepage, creepage=share),
    )


def _on_axis(along: str, values: Floats) -> Floats:
    """Positions or velocities along one axis, shape (..., 2)."""
    still = np.zeros_like(values)
    return np.stack([values, still] if along == "x" else [still, values], axis=-1)
