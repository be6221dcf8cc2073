"""Motions of the body over the surface: along points, and back and forth."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.loads import arguments
from viscontact.loads.history import Cycle
from viscontact.loads.motion import Motion
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive, store, whole

#: Steps of a cycle; the work of a cycle then has an error of about 6e-4.
STEPS_PER_CYCLE = 128

#: Upper limit on the cycles; each takes dozens of steps.
MOST_CYCLES = 100_000

#: Upper limit on the cells that the body passes.
MOST_CELLS = 1_000_000

#: Part of a cell that is rounding.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False, init=False)
class Travel(Motion):
    """Path of the body over the surface, through given points at given times.

    Parameters
    ----------
    times : array_like
        Times of the points, increasing, none before 0, shape (n,) [s]. Before the first and after
        the last one the body is at rest.
    x, y : float or array_like, optional
        Positions of the body's axis at the points, a scalar or one value a point [m]. Between
        points the velocity is constant.
    rolling : bool, optional
        True if the material of both bodies flows through the contact, False if the body slides
        and its own material moves with it. Required where the indenter's material is not elastic.

    Raises
    ------
    ValueError
        If the arrays do not fit together, a value is not finite, the times do not increase (a
        repeated time would be a jump of the position), or the body does not move.

    Notes
    -----
    gap = h(x - X, y - Y) + displacement - approach - tilt_x (x - X) - tilt_y (y - Y), with the
    position (X, Y) of the body's axis. There is no friction. Eccentricities are measured from the
    axis.

    Examples
    --------
    From rest to 1 m/s along y, for 20 mm:

    >>> path = Travel(times=[0.0, 0.02], y=[0.0, 0.02])
    >>> path.position_at(0.01).tolist(), path.velocity_at(0.01)
    ([0.0, 0.01], (0.0, 1.0))
    """

    times: NDArray[np.float64] = field(metadata={"unit": "s", "name": "at times"})
    x: float | NDArray[np.float64] = field(metadata={"unit": "m"})
    y: float | NDArray[np.float64] = field(metadata={"unit": "m"})
    rolling: bool | None

    def __init__(
        self,
        times: ArrayLike,
        x: ArrayLike = 0.0,
        y: ArrayLike = 0.0,
        *,
        rolling: bool | None = None,
    ) -> None:
        instants = arguments.instants(times)
        for i in np.flatnonzero(np.diff(instants) == 0)[:1]:
            raise ValueError(
                f"times must increase, got {instants[i]} s twice: the position cannot jump; give "
                "the time that the body needs for its way"
            )
        along_x, along_y = (
            arguments.values(Travel, name, given, instants.size)
            for name, given in (("x", x), ("y", y))
        )
        store(self, times=instants, x=along_x, y=along_y, rolling=_checked_rolling(rolling))
        if not any(self.moves):
            raise ValueError(
                "x and y: the body does not move; give two different positions, or leave out the "
                "motion"
            )

    def position_at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the positions of the body's axis.

        Parameters
        ----------
        times : array_like
            The instants, any shape [s].

        Returns
        -------
        ndarray
            Positions (x, y), shape (..., 2) [m].
        """
        instants = np.asarray(times, dtype=np.float64)
        return np.stack([np.interp(instants, self.times, each) for each in self._points], axis=-1)

    def velocity_at(self, time: float) -> tuple[float, float]:
        """Return the velocity with which the body arrives at an instant.

        Parameters
        ----------
        time : float
            The instant [s].

        Returns
        -------
        tuple of float
            Along x and y [m/s].
        """
        index = int(np.searchsorted(self.times, time)) - 1
        if not 0 <= index < self.times.size - 1:
            return 0.0, 0.0
        span = self.times[index + 1] - self.times[index]
        along_x, along_y = ((each[index + 1] - each[index]) / span for each in self._points)
        return float(along_x), float(along_y)

    @property
    def top_speed(self) -> float:
        """Largest speed [m/s]."""
        ways = np.hypot(*(np.diff(each) for each in self._points))
        return float((ways / np.diff(self.times)).max())

    @property
    def kinks(self) -> NDArray[np.float64]:
        """Times of the points [s]."""
        return self.times

    @property
    def reach(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and largest positions along x, and along y [m]."""
        along_x, along_y = ((float(each.min()), float(each.max())) for each in self._points)
        return along_x, along_y

    def times_at_cells(self, cell_size: tuple[float, float]) -> NDArray[np.float64]:
        """Return the times at which the body has moved by whole cells since its start.

        Parameters
        ----------
        cell_size : tuple of float
            Edge lengths (dx, dy) of a cell [m].

        Returns
        -------
        ndarray
            Increasing times [s]. On an oblique part of the path those of the axis along which
            the body passes more cells.
        """
        cells = np.stack(self._points, axis=-1)
        cells = (cells - cells[0]) / np.asarray(cell_size)
        _refuse_long_path(float(np.abs(np.diff(cells, axis=0)).max(axis=1).sum()))
        found = [
            begin + (end - begin) * part
            for (begin, end), (first, last) in zip(
                itertools.pairwise(self.times.tolist()), itertools.pairwise(cells), strict=True
            )
            for part in _parts_at_cells(first, last)
        ]
        return np.unique(np.asarray(found, dtype=np.float64))

    @property
    def _points(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        along_x, along_y = (np.broadcast_to(each, self.times.shape) for each in (self.x, self.y))
        return along_x, along_y


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
    """

    amplitude: float = field(metadata={"unit": "m"})
    period: float = field(metadata={"unit": "s"})
    count: int = field(metadata={"unit": "1", "name": "cycles"})
    along: Literal["x", "y"] = "y"
    rolling: bool | None = None

    def position_at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the positions (x, y) of the body's axis, shape (..., 2) [m]."""
        turns = np.clip(np.asarray(times, dtype=np.float64) / self.period, 0.0, self.count)
        # Whole cycles are subtracted first: sin(2 π n) is not 0 in floating point.
        position = self.amplitude * np.sin(2 * math.pi * (turns - np.floor(turns)))
        return _on_axis(self.along, position)

    def velocity_at(self, time: float) -> tuple[float, float]:
        """Return the velocity along x and y with which the body arrives at an instant [m/s]."""
        speed = 0.0
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
    def kinks(self) -> NDArray[np.float64]:
        """Begin and end of the cycles [s]."""
        return np.array([0.0, self.count * self.period])

    @property
    def reach(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and largest positions along x, and along y [m]."""
        low, high = _on_axis(self.along, np.array([-self.amplitude, self.amplitude]))
        return (float(low[0]), float(high[0])), (float(low[1]), float(high[1]))

    def times_at_cells(self, cell_size: tuple[float, float]) -> NDArray[np.float64]:
        """Return times at which the body has moved by whole cells (dx, dy) [s]."""
        reach = self.amplitude / cell_size["xy".index(self.along)]
        _refuse_long_path(4 * self.count * reach)
        parts = np.arange(-math.floor(reach), math.floor(reach) + 1) / reach
        phases = np.arcsin(parts) / (2 * math.pi)
        half_turns = np.arange(2 * self.count + 1)[:, None]
        turns = half_turns / 2 + np.where(half_turns % 2, -1.0, 1.0) * phases
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

    Returns
    -------
    Reciprocation
        To be given as `motion`.

    Raises
    ------
    ValueError
        If amplitude or period is not positive and finite, cycles is not a whole number of at
        least 1, or along is neither "x" nor "y".

    Examples
    --------
    >>> reciprocating(2e-3, 1.0, cycles=3).position_at(0.25).tolist()
    [0.0, 0.002]
    """
    if along not in ("x", "y"):
        raise ValueError(f"reciprocating: along must be 'x' or 'y', got {along!r}")
    return Reciprocation(
        amplitude=positive("reciprocating: amplitude", amplitude, "m"),
        period=positive("reciprocating: period", period, "s"),
        count=whole("reciprocating: cycles", cycles, 1, MOST_CYCLES),
        along=along,
        rolling=_checked_rolling(rolling),
    )


def _checked_rolling(rolling: bool | None) -> bool | None:
    if rolling is None or isinstance(rolling, bool | np.bool_):
        return None if rolling is None else bool(rolling)
    raise ValueError(f"rolling must be true or false, got {rolling!r}")


def _on_axis(along: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Positions or velocities along one axis, shape (..., 2)."""
    still = np.zeros_like(values)
    return np.stack([values, still] if along == "x" else [still, values], axis=-1)


def _parts_at_cells(first: NDArray[np.float64], last: NDArray[np.float64]) -> Iterator[float]:
    """Parts of a straight way between two positions, in cells, at which whole cells are passed."""
    way = last - first
    axis = int(np.abs(way).argmax())
    if way[axis] == 0:
        return
    low, high = sorted((first[axis], last[axis]))
    for cell in range(math.ceil(low - ROUNDING), math.floor(high + ROUNDING) + 1):
        yield min(max(float((cell - first[axis]) / way[axis]), 0.0), 1.0)


def _refuse_long_path(cells: float) -> None:
    if cells > MOST_CELLS:
        raise ValueError(
            f"times: the path crosses {cells:.3g} cells, and at most {MOST_CELLS} are stepped "
            "over one by one; give times, or a shorter path"
        )


def format_path(motion: Motion) -> str:
    """Describe the largest displacements of a motion in words.

    >>> format_path(reciprocating(2e-3, 1.0, cycles=3))
    '4 mm along y'
    """
    ways = zip("xy", motion.reach, strict=True)
    return " and ".join(
        f"{format_quantity(high - low, 'm', 4)} along {name}"
        for name, (low, high) in ways
        if high > low
    )
