"""Indenters that touch at a point: sphere, paraboloid, cone."""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.arc import arc_drop
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import acute_angle, positions
from viscontact.units.numbers import as_real, check_fields, positive


@dataclass(frozen=True)
class Sphere(Indenter):
    """A sphere, with its true circular section.

    Hertz's theory takes the paraboloid of the same radius, which is flatter by r⁴ / (8 R³) to
    the leading order; `Paraboloid` with two equal radii is that one.

    Parameters
    ----------
    radius : float
        Radius [m].

    Raises
    ------
    ValueError
        If the radius is not a positive, finite number.

    Examples
    --------
    >>> float(Sphere(5.0).gap(3.0, 0.0))
    1.0
    """

    radius: float = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "radius")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return R - sqrt(R² - r²), +inf for r > R; see `Indenter.gap`."""
        return arc_drop(np.hypot(*positions(x, y)), self.radius)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Equal curvatures 1/R along x and y [1/m]."""
        return 1 / self.radius, 1 / self.radius


@dataclass(frozen=True)
class Paraboloid(Indenter):
    """An elliptic paraboloid, the shape of Hertz's theory; it has no outline.

    Parameters
    ----------
    radius_x, radius_y : float
        Radii of curvature at the apex, in the planes y = 0 and x = 0 [m]. One of them may be
        infinite: a parabolic cylinder, for grids that are periodic along it.

    Raises
    ------
    ValueError
        If a radius is not a positive number, or both are infinite.

    Examples
    --------
    >>> float(Paraboloid(radius_x=0.5, radius_y=2.0).gap(1.0, 2.0))
    2.0
    >>> float(Paraboloid(radius_x=math.inf, radius_y=2.0).gap(1.0, 2.0))
    1.0
    """

    radius_x: float = field(metadata={"unit": "m"})
    radius_y: float = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "radius_x", "radius_y", check=_radius)
        if math.isinf(self.radius_x) and math.isinf(self.radius_y):
            raise ValueError("Paraboloid: one of radius_x and radius_y must be finite")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return x²/(2 R_x) + y²/(2 R_y); see `Indenter.gap`."""
        x, y = positions(x, y)
        return np.asarray(x * x / (2 * self.radius_x) + y * y / (2 * self.radius_y))

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures 1/R_x and 1/R_y [1/m]."""
        return 1 / self.radius_x, 1 / self.radius_y

    @property
    def endless(self) -> tuple[bool, bool]:
        """Axes of infinite radius."""
        return math.isinf(self.radius_x), math.isinf(self.radius_y)


def _radius(name: str, value: object, unit: str) -> float:
    """Positive radius, which may be infinite."""
    return math.inf if as_real(value, unit) == math.inf else positive(name, value, unit)


@dataclass(frozen=True)
class Cone(Indenter):
    """A cone, apex down; it has no outline, and at its apex no curvature.

    Parameters
    ----------
    half_angle : float
        Angle from the axis to the flank, between 0 (a needle) and π/2 (a plane), both
        excluded [rad].

    Raises
    ------
    ValueError
        If the angle is not a number strictly between 0 and π/2.

    Examples
    --------
    >>> round(float(Cone(half_angle=math.pi / 4).gap(3.0, 4.0)), 12)
    5.0
    """

    half_angle: float = field(metadata={"unit": "rad"})

    def __post_init__(self) -> None:
        check_fields(self, "half_angle", check=acute_angle)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return r / tan(half_angle); see `Indenter.gap`."""
        return np.asarray(np.hypot(*positions(x, y)) / math.tan(self.half_angle))
