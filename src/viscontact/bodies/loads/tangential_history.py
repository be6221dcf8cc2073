"""Piecewise linear tangential loads: histories by points, steps and ramps."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.level import positive_duration
from viscontact.bodies.loads.tangential import (
    FORCES,
    MOTIONS,
    UNITS,
    TangentialLoad,
    TangentialPoint,
    given_values,
    refuse_both,
)
from viscontact.units.numbers import finite, store

#: Difference of two levels, over the largest, that is rounding.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False, init=False)
class TangentialHistory(TangentialLoad):
    """Forces along the surface and a torque, piecewise linear in time, with jumps.

    Of the body on the half-space, positive along +x and +y and from x to y. Between its points the
    history is linear; a time given twice is a jump, from the first value to the second. Before the
    first point forces and shifts are zero, after the last one all is held.

    Parameters
    ----------
    times : array_like
        Instants of the points, not decreasing, none before 0, shape (n,) [s].
    force_x, force_y : float or array_like, optional
        Forces along x and y, scalars or one value a point [N].
    torque : float or array_like, optional
        Torque about the axis of the body [N m].
    displacement_x, displacement_y : float or array_like, optional
        Rigid shift of the body along x or y against the half-space far below, in place of the
        force [m].
    rotation : float or array_like, optional
        Rotation of the body, in place of the torque [rad].

    Raises
    ------
    ValueError
        If the arrays do not fit together, the times decrease or come three times or before 0, a
        value is not finite, or a force and the motion that replaces it are both given.

    Examples
    --------
    >>> history = TangentialHistory([0, 1, 3], force_x=[0, 5, -5])
    >>> history.at(2.0).forces, history.kinks.tolist()
    ((0.0, 0.0, 0.0), [0.0, 1.0, 3.0])
    """

    times: Floats = field(metadata={"unit": "s"})
    force_x: float | Floats = field(metadata={"unit": "N"})
    force_y: float | Floats = field(metadata={"unit": "N"})
    torque: float | Floats = field(metadata={"unit": "N m"})
    displacement_x: float | Floats | None = field(metadata={"unit": "m"})
    displacement_y: float | Floats | None = field(metadata={"unit": "m"})
    rotation: float | Floats | None = field(metadata={"unit": "rad"})

    def __init__(
        self,
        times: ArrayLike,
        force_x: ArrayLike = 0.0,
        force_y: ArrayLike = 0.0,
        torque: ArrayLike = 0.0,
        *,
        displacement_x: ArrayLike | None = None,
        displacement_y: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
    ) -> None:
        instants = history_points.instants(times)
        given: dict[str, Any] = {"force_x": force_x, "force_y": force_y, "torque": torque}
        given |= {"displacement_x": displacement_x, "displacement_y": displacement_y}
        given |= {"rotation": rotation}
        values: dict[str, Any] = {
            name: None
            if value is None
            else history_points.values(TangentialHistory, name, value, instants.size)
            for name, value in given.items()
        }
        refuse_both(values)
        store(self, times=instants, **values)

    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the load at an instant [s], after a jump or before it ("left")."""
        return TangentialPoint.of({name: self._value(name, time, side) for name in UNITS})

    def _value(self, name: str, time: float, side: str) -> float | None:
        """Value of a name at an instant; None if not given."""
        values = getattr(self, name)
        if values is None:
            return None
        instant = finite("time", time, "s")
        reached = int(np.searchsorted(self.times, instant, history_points.side_of_jump(side)))
        if reached == 0:
            return 0.0
        points = np.broadcast_to(values, self.times.shape)
        if reached == self.times.size:
            return float(points[-1])
        begin, end = self.times[reached - 1], self.times[reached]
        part = (instant - begin) / (end - begin) if end > begin else 1.0
        return float(points[reached - 1] * (1 - part) + points[reached] * part)

    @cached_property
    def kinks(self) -> Floats:
        """All instants of points [s]."""
        return np.unique(self.times)

    @cached_property
    def jumps(self) -> Floats:
        """Instants where a force or a motion jumps, the first too if it starts there [s]."""
        changes = [
            any(
                self._value(name, time, "left") != self._value(name, time, "right")
                for name in UNITS
            )
            for time in self.kinks.tolist()
        ]
        return np.asarray(self.kinks[np.array(changes)])

    @cached_property
    def whole_cycles(self) -> tuple[tuple[float, float], ...]:
        """Begin and end of each cycle, from a reversal to the next one at the same level [s]."""
        # Of the first direction that comes back at all.
        for acts, *names in zip(self.acts, FORCES, MOTIONS, strict=True):
            if acts and (found := self._cycles_of(next(filter(self._varies, names)))):
                return found
        return ()

    def _varies(self, name: str) -> bool:
        return getattr(self, name) is not None and bool(np.any(getattr(self, name)))

    def _cycles_of(self, name: str) -> tuple[tuple[float, float], ...]:
        values = np.append(0.0, np.broadcast_to(getattr(self, name), self.times.shape))
        times = np.append(min(0.0, self.times[0]), self.times)
        # The end of each level, and the reversals among these, the last one included.
        ends = np.append(np.flatnonzero(np.diff(values)), values.size - 1)
        levels, steps = values[ends], np.diff(values[ends])
        turns = ends[1:][np.append(steps[:-1] * steps[1:] < 0, bool(steps.size))]
        same = ROUNDING * np.abs(levels).max()
        pairs = zip(turns[:-2:2], turns[2::2], strict=False)
        return tuple(
            (float(times[begin]), float(times[end]))
            for begin, end in pairs
            if abs(values[end] - values[begin]) <= same
        )


def tangential_step(**given: float) -> TangentialHistory:
    """Return a tangential load that comes at time 0 and is held.

    Parameters
    ----------
    **given : float
        ``force_x``, ``force_y`` [N], ``torque`` [N m], ``displacement_x``, ``displacement_y`` [m],
        ``rotation`` [rad], as in `TangentialHistory`.

    Returns
    -------
    TangentialHistory
        The history, with one point.

    Raises
    ------
    ValueError
        If nothing is given, a name is unknown, or a value is no finite number.

    Examples
    --------
    >>> tangential_step(force_x=2.0).at(1.0).forces
    (2.0, 0.0, 0.0)
    """
    return TangentialHistory([0.0], **given_values("tangential_step", given))


def tangential_ramp(*, duration: float, **given: float) -> TangentialHistory:
    """Return a tangential load that grows from zero in a time, and is held.

    Parameters
    ----------
    duration : float
        Time of the growth, positive [s].
    **given : float
        Values at its end, as in `tangential_step`.

    Returns
    -------
    TangentialHistory
        The history, with two points.

    Raises
    ------
    ValueError
        If nothing is given, a name is unknown, or a value is no finite number.

    Examples
    --------
    >>> tangential_ramp(displacement_x=1e-6, duration=2.0).at(1.0).motions
    (5e-07, None, None)
    """
    end = positive_duration("duration", duration)
    values = {name: [0.0, value] for name, value in given_values("tangential_ramp", given).items()}
    return TangentialHistory([0.0, end], **values)
