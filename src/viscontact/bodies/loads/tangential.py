"""Tangential loads: forces along the surface and a torque, or shifts and a rotation, over time."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite_array

#: Forces and torque, and the motions that replace them.
FORCES = ("force_x", "force_y", "torque")
MOTIONS = ("displacement_x", "displacement_y", "rotation")
UNITS = dict(zip((*FORCES, *MOTIONS), ("N", "N", "N m", "m", "m", "rad"), strict=True))


@dataclass(frozen=True)
class TangentialPoint:
    """Tangential load at one instant: of each direction a force or torque, or else a motion."""

    #: Forces [N] and torque [N m]; None where the motion is prescribed.
    forces: tuple[float | None, float | None, float | None]
    #: Shifts [m] and rotation [rad]; None where the force is prescribed.
    motions: tuple[float | None, float | None, float | None]

    @classmethod
    def of(cls, values: Mapping[str, float | None]) -> TangentialPoint:
        """Load with values by name: a motion that is given replaces its force."""
        x, y, turn = (values[name] for name in MOTIONS)
        forces = zip((x, y, turn), FORCES, strict=True)
        kept = [values[name] if motion is None else None for motion, name in forces]
        return cls((kept[0], kept[1], kept[2]), (x, y, turn))


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

    @property
    @abstractmethod
    def whole_cycles(self) -> tuple[tuple[float, float], ...]:
        """Begin and end of each cycle of the load [s], in order; none if it does not come back."""


def given_values(owner: str, given: Mapping[str, float]) -> dict[str, float]:
    """Values by name, finite and at least one."""
    names = ", ".join(UNITS)
    for name in given:
        if name not in UNITS:
            raise ValueError(f"{owner}: unknown argument {name!r}; give one or more of {names}")
    if not given:
        raise ValueError(f"{owner}: nothing is given; give one or more of {names}")
    return {name: float(finite_array(name, value, UNITS[name])) for name, value in given.items()}


def refuse_both(values: Mapping[str, Any]) -> None:
    """Raise ValueError if a motion is prescribed together with the force that it replaces."""
    for force, motion in zip(FORCES, MOTIONS, strict=True):
        if values.get(motion) is not None and np.any(values.get(force, 0.0)):
            largest = float(np.abs(values[force]).max())
            raise ValueError(
                f"{motion} and {force} contradict each other: a prescribed {motion} replaces the "
                f"{force}, got {force} up to {format_quantity(largest, UNITS[force])}; leave one "
                "of them out"
            )
