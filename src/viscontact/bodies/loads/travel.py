"""Motion of the body over the surface along given points."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.motion import (
    Motion,
    checked_creepage,
    checked_lateral_creepage,
    checked_rolling,
    refuse_long_path,
)
from viscontact.units.numbers import finite, real_array, store

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
    creepage : float, optional
        Surface speed of a body that rolls over its travel, less 1, for rolling with traction under
        friction: positive where the body drives. Towards +y it then pushes the half-space to -y.
        Between -1 and 1; the body then rolls [-].
    lateral_creepage : float, optional
        Beside a creepage, which may be 0, the speed of the body's surface across its travel over
        that, as of a wheel that is askew: positive to the right of the travel, which is +x for one
        towards +y, and the half-space is pushed there. Between -1 and 1 [-].

    Raises
    ------
    ValueError
        If the arrays do not fit together, a value is not finite, the times do not increase (a
        repeated time would be a jump of the position), the body does not move, or a creepage is
        out of range or given of a body that slides, or lateral without the other one.

    Notes
    -----
    gap = h(x - X, y - Y) + displacement - approach - tilt_x (x - X) - tilt_y (y - Y), with the
    position (X, Y) of the body's axis. Eccentricities are measured from the axis. With a creepage
    the surface of the body moves by -creepage times the way against the half-space, and by the
    lateral creepage times the way to the right of it.

    Examples
    --------
    From rest to 1 m/s along y, for 20 mm:

    >>> path = Travel(times=[0.0, 0.02], y=[0.0, 0.02])
    >>> path.position_at(0.01).tolist(), path.velocity_at(0.01)
    ([0.0, 0.01], (0.0, 1.0))
    """

    times: Floats = field(metadata={"unit": "s", "name": "at times"})
    x: float | Floats = field(metadata={"unit": "m"})
    y: float | Floats = field(metadata={"unit": "m"})
    rolling: bool | None
    creepage: float | None = field(metadata={"unit": "1"})
    lateral_creepage: float | None = field(
        default=None, metadata={"unit": "1", "recorded": "if given"}
    )

    def __init__(
        self,
        times: ArrayLike,
        x: ArrayLike = 0.0,
        y: ArrayLike = 0.0,
        *,
        rolling: bool | None = None,
        creepage: float | None = None,
        lateral_creepage: float | None = None,
    ) -> None:
        instants = history_points.instants(times)
        for i in np.flatnonzero(np.diff(instants) == 0)[:1]:
            raise ValueError(
                f"times must increase, got {instants[i]} s twice: the position cannot jump; give "
                "the time that the body takes for the distance"
            )
        along_x, along_y = (
            history_points.values(Travel, name, given, instants.size)
            for name, given in (("x", x), ("y", y))
        )
        rolls = checked_rolling(rolling)
        share = checked_creepage(creepage, rolling=rolls)
        askew = checked_lateral_creepage(lateral_creepage, creepage=share)
        rolls = rolls if share is None else True
        store(self, times=instants, x=along_x, y=along_y, rolling=rolls)
        store(self, creepage=share, lateral_creepage=askew)
        if not any(self.moves):
            raise ValueError(
                "x and y: the body does not move; give two different positions, or leave out the "
                "motion"
            )

    def position_at(self, times: ArrayLike) -> Floats:
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
        instants = real_array("times", times, "s")
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
        index = int(np.searchsorted(self.times, finite("time", time, "s"))) - 1
        if not 0 <= index < self.times.size - 1:
            return 0.0, 0.0
        span = self.times[index + 1] - self.times[index]
        along_x, along_y = ((each[index + 1] - each[index]) / span for each in self._points)
        return float(along_x), float(along_y)

    @property
    def top_speed(self) -> float:
        """Largest speed [m/s]."""
        distances = np.hypot(*(np.diff(each) for each in self._points))
        return float((distances / np.diff(self.times)).max())

    @property
    def kinks(self) -> Floats:
        """Times of the points [s]."""
        return self.times

    @property
    def reach(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and largest positions along x, and along y [m]."""
        along_x, along_y = ((float(each.min()), float(each.max())) for each in self._points)
        return along_x, along_y

    def times_at_cells(self, cell_size: tuple[float, float]) -> Floats:
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
        refuse_long_path(float(np.abs(np.diff(cells, axis=0)).max(axis=1).sum()))
        found = [
            begin + (end - begin) * part
            for (begin, end), (first, last) in zip(
                itertools.pairwise(self.times.tolist()), itertools.pairwise(cells), strict=True
            )
            for part in _parts_at_cells(first, last)
        ]
        return np.unique(np.asarray(found, dtype=np.float64))

    @property
    def _points(self) -> tuple[Floats, Floats]:
        along_x, along_y = (np.broadcast_to(each, self.times.shape) for each in (self.x, self.y))
        return along_x, along_y


def _parts_at_cells(first: Floats, last: Floats) -> Iterator[float]:
    """Parts of a straight path between two positions, in cells, at which whole cells are passed."""
    distance = last - first
    axis = int(np.abs(distance).argmax())
    if distance[axis] == 0:
        return
    low, high = sorted((first[axis], last[axis]))
    for cell in range(math.ceil(low - ROUNDING), math.floor(high + ROUNDING) + 1):
        yield min(max(float((cell - first[axis]) / distance[axis]), 0.0), 1.0)
