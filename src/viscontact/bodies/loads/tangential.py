"""Tangential loads: forces along the surface and a torque, or shifts and a rotation, over time."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.harmonic import STEPS_PER_CYCLE
from viscontact.bodies.loads.history import Cycle, LoadHistory
from viscontact.bodies.loads.level import positive_duration
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, finite_array, positive, store, whole

#: Forces and torque, and the motions that replace them.
FORCES = ("force_x", "force_y", "torque")
MOTIONS = ("displacement_x", "displacement_y", "rotation")
UNITS = dict(zip((*FORCES, *MOTIONS), ("N", "N", "N m", "m", "m", "rad"), strict=True))

#: Most cycles of a harmonic tangential load, each of which has two reversals.
MOST_CYCLES = 10_000


@dataclass(frozen=True)
class TangentialPoint:
    """Tangential load at one instant: of each direction a force or torque, or else a motion."""

    #: Forces [N] and torque [N m]; None where the motion is prescribed.
    forces: tuple[float | None, float | None, float | None]
    #: Shifts [m] and rotation [rad]; None where the force is prescribed.
    motions: tuple[float | None, float | None, float | None]


class TangentialLoad(ABC):
    """Load along the surface over time, of the body on the half-space."""

    @abstractmethod
    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the load at an instant [s], after a jump or before it ("left")."""

    @property
    @abstractmethod
    def kinks(self) -> Floats:
        """Times of kinks, jumps and reversals, with begin and end, increasing [s]."""

    @property
    @abstractmethod
    def jumps(self) -> Floats:
        """Times at which the load jumps, increasing [s]."""

    @property
    def acts(self) -> tuple[bool, bool, bool]:
        """True for x, y and the rotation if there is a force, torque or motion at any time."""
        along_x, along_y, turning = (
            any(getattr(self, name) is not None and np.any(getattr(self, name)) for name in pair)
            for pair in zip(FORCES, MOTIONS, strict=True)
        )
        return along_x, along_y, turning

    @property
    def longest_step(self) -> float:
        """Longest step on which the load is nearly linear [s]; inf if it is linear."""
        return math.inf

    def history_under(self, load: LoadHistory) -> LoadHistory:
        """Return a normal load with the kinks and jumps of this one, for the steps of a run."""
        return JointLoad(load, self)


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
        _refuse_both(values)
        store(self, times=instants, **values)

    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the load at an instant [s], after a jump or before it ("left")."""
        forces, motions = (
            [self._value(name, time, side) for name in of] for of in (FORCES, MOTIONS)
        )
        replaced = [motion is not None for motion in motions]
        kept = [None if gone else force for force, gone in zip(forces, replaced, strict=True)]
        return TangentialPoint((kept[0], kept[1], kept[2]), (motions[0], motions[1], motions[2]))

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


@dataclass(frozen=True, kw_only=True)
class TangentialHarmonic(TangentialLoad):
    """Harmonic tangential load, amplitude sin(2 π t/period + phase), held after the last cycle.

    Made by `tangential_harmonic`.
    """

    force_x: float = field(default=0.0, metadata={"unit": "N"})
    force_y: float = field(default=0.0, metadata={"unit": "N"})
    torque: float = field(default=0.0, metadata={"unit": "N m"})
    displacement_x: float | None = field(default=None, metadata={"unit": "m"})
    displacement_y: float | None = field(default=None, metadata={"unit": "m"})
    rotation: float | None = field(default=None, metadata={"unit": "rad"})
    period: float = field(metadata={"unit": "s"})
    cycles: int = field(metadata={"unit": "1"})
    phase: float = field(default=0.0, metadata={"unit": "rad"})

    @property
    def end(self) -> float:
        """Instant at which the last cycle ends [s]."""
        return self.cycles * self.period

    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the load at an instant [s], after the jump at the start or before it ("left")."""
        instant = finite("time", time, "s")
        right = history_points.side_of_jump(side) == "right"
        started = instant > 0 or (right and instant == 0)
        turns = min(instant, self.end) / self.period
        # Whole cycles are subtracted first: sin(2 π n) is not 0 in floating point.
        wave = math.sin(2 * math.pi * (turns - math.floor(turns)) + self.phase) if started else 0.0
        forces, motions = ([getattr(self, name) for name in names] for names in (FORCES, MOTIONS))
        scaled = [None if motion is None else motion * wave for motion in motions]
        pairs = zip(forces, motions, strict=True)
        kept = [force * wave if motion is None else None for force, motion in pairs]
        return TangentialPoint((kept[0], kept[1], kept[2]), (scaled[0], scaled[1], scaled[2]))

    @cached_property
    def kinks(self) -> Floats:
        """Begin, reversals and end of the cycles [s]."""
        first = 0.25 - self.phase / (2 * math.pi)
        turns = np.arange(2 * self.cycles + 2) / 2 + (first % 0.5)
        turns = turns[(turns > 1e-9) & (turns < self.cycles - 1e-9)]
        return np.array([0.0, *(turns * self.period), self.end])

    @property
    def jumps(self) -> Floats:
        """Time 0, unless the load starts at zero [s]."""
        return np.zeros(1) if math.sin(self.phase) else np.zeros(0)

    @property
    def longest_step(self) -> float:
        """A 128th of a period [s]."""
        return self.period / STEPS_PER_CYCLE


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
    return TangentialHistory([0.0], **_checked("tangential_step", given))


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
    values = {name: [0.0, value] for name, value in _checked("tangential_ramp", given).items()}
    return TangentialHistory([0.0, end], **values)


def tangential_harmonic(
    *, period: float, cycles: int, phase: float = 0.0, **given: float
) -> TangentialHarmonic:
    """Return a tangential load amplitude · sin(2 π t/period + phase), held after the last cycle.

    Parameters
    ----------
    period : float
        Time of a cycle, positive [s].
    cycles : int
        Number of cycles, at least 1.
    phase : float, optional
        Phase at time 0 [rad].
    **given : float
        Amplitudes, as in `tangential_step`.

    Returns
    -------
    TangentialHarmonic
        The load; its reversals are kinks, from which slip starts anew.

    Raises
    ------
    ValueError
        If nothing is given, a name is unknown, or a value is out of range.

    Examples
    --------
    >>> load = tangential_harmonic(force_x=2.0, period=4.0, cycles=1)
    >>> load.at(1.0).forces, load.kinks.tolist()
    ((2.0, 0.0, 0.0), [0.0, 1.0, 3.0, 4.0])
    """
    count = whole("cycles", cycles, 1, MOST_CYCLES)
    values: dict[str, Any] = _checked("tangential_harmonic", given)
    _refuse_both(values)
    return TangentialHarmonic(
        period=positive("period", period, "s"),
        cycles=count,
        phase=finite("phase", phase, "rad"),
        **values,
    )


def _checked(owner: str, given: Mapping[str, float]) -> dict[str, float]:
    """Values by name, finite and at least one."""
    names = ", ".join(UNITS)
    for name in given:
        if name not in UNITS:
            raise ValueError(f"{owner}: unknown argument {name!r}; give one or more of {names}")
    if not given:
        raise ValueError(f"{owner}: nothing is given; give one or more of {names}")
    return {name: float(finite_array(name, value, UNITS[name])) for name, value in given.items()}


def _refuse_both(values: Mapping[str, Any]) -> None:
    """Raise ValueError if a motion is prescribed together with the force that it replaces."""
    for force, motion in zip(FORCES, MOTIONS, strict=True):
        if values.get(motion) is not None and np.any(values.get(force, 0.0)):
            largest = float(np.abs(values[force]).max())
            raise ValueError(
                f"{motion} and {force} contradict each other: a prescribed {motion} replaces the "
                f"{force}, got {force} up to {format_quantity(largest, UNITS[force])}; leave one "
                "of them out"
            )
