"""Checks of positions and angles that indenters share."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.units.numbers import real, real_array, shown


def positions(x: ArrayLike, y: ArrayLike) -> tuple[Floats, Floats]:
    """Return coordinates [m] as arrays of floats, or raise ValueError."""
    return real_array("x", x, "m"), real_array("y", y, "m")


def acute_angle(name: str, value: object, unit: str = "rad") -> float:
    """Return an angle between 0 and π/2, both excluded, as a float, or raise ValueError [rad]."""
    angle = real(name, value, unit)
    if not 0 < angle < math.pi / 2:
        raise ValueError(
            f"{name} must lie between 0 and π/2 rad, got {shown(value, unit)}; for degrees use "
            "math.radians(...)"
        )
    return angle
