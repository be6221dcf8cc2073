"""Roller profile with chamfered ends."""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.arc import arc_drop
from viscontact.bodies.indenters.position_checks import acute_angle
from viscontact.bodies.indenters.profile import Profile
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import check_fields, non_negative, real_array


@dataclass(frozen=True)
class Chamfer(Profile):
    """A straight line cut off by a chamfer, with a sharp or a rounded corner between them.

    The roller's half length is half of the whole, chamfers included.

    Parameters
    ----------
    angle : float
        Angle of the chamfer to the straight part, between 0 and π/2, both excluded [rad].
    length : float
        Length of the chamfer along x, from the sharp corner to the end [m].
    corner_radius : float, optional
        Radius that rounds the corner, tangent to the straight part and to the chamfer [m];
        a sharp corner when zero.

    Raises
    ------
    ValueError
        If a length or the angle is invalid, or there is no room for the chamfer or the
        rounding.

    Notes
    -----
    The rounding takes r tan(angle/2) off the straight part, and as much, measured along it, off
    the chamfer. The contact's pressure is singular at a sharp corner, as it is at a sharp end.

    Examples
    --------
    >>> Chamfer(angle=math.pi / 4, length=1.0).drop([4.0, 4.5, 5.1], half_length=5.0).round(12)
    array([0. , 0.5, inf])
    """

    angle: float = field(metadata={"unit": "rad"})
    length: float = field(metadata={"unit": "m"})
    corner_radius: float = field(default=0.0, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "length")
        check_fields(self, "corner_radius", check=non_negative)
        check_fields(self, "angle", check=acute_angle)
        if self._tangent * math.cos(self.angle) > self.length:
            largest = self.length / math.cos(self.angle) / math.tan(self.angle / 2)
            raise ValueError(
                f"Chamfer: corner_radius of {format_quantity(self.corner_radius, 'm', 9)} leaves "
                f"nothing of a chamfer of length {format_quantity(self.length, 'm', 9)}; make it "
                "smaller than "
                f"{format_quantity(largest, 'm', 3)}"
            )

    @property
    def _tangent(self) -> float:
        """Length that the rounding takes off either line [m]."""
        return self.corner_radius * math.tan(self.angle / 2)

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the drop of the rounding and of the chamfer; see `Profile.drop`."""
        distance = np.abs(real_array("x", x, "m"))
        beyond = np.maximum(distance - (half_length - self.length - self._tangent), 0.0)
        on_arc = beyond <= self.corner_radius * math.sin(self.angle)
        # A sharp corner has no arc, and R = 0 would end at s = 0.
        arc = arc_drop(np.where(on_arc, beyond, 0.0), self.corner_radius)
        drop = np.where(on_arc, arc, (beyond - self._tangent) * math.tan(self.angle))
        return np.where(distance <= half_length, drop, np.inf)

    def end(self, half_length: float) -> float:
        """Return the half length [m]."""
        return half_length

    def require_fit(self, half_length: float) -> None:
        """Raise ValueError if the chamfers leave no straight part."""
        if self.length + self._tangent >= half_length:
            raise ValueError(
                f"Chamfer: length of {format_quantity(self.length, 'm', 9)}, with the rounding, "
                "leaves no straight part of a half length of "
                f"{format_quantity(half_length, 'm', 9)}; make the chamfer shorter"
            )
