"""Axisymmetric indenter profiles as the Abel transform of their gap.

A gap f(r) enters the axisymmetric contact problem through g(s) = s times the integral of
f'(r)/sqrt(s² - r²) over 0 < r < s alone: a rigid indenter pressed in by w displaces the
elastic surface so that, in the transform of `AxisymmetricContact`, it moves by w - g(s).
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import require_positive


class Profile(Protocol):
    """Axisymmetric indenter that touches at its axis first."""

    @property
    def edge(self) -> float:
        """Radius of the indenter, inf if unlimited [m]."""

    def depth(self, s: Floats) -> Floats:
        """Transform g(s) of the gap: the approach at which an elastic contact reaches s [m]."""

    def reach(self, depth: Floats) -> Floats:
        """Radius s at which g(s) is the depth [m]."""

    def depth_integral(self, s: Floats) -> Floats:
        """Integral of g from 0 to s [m²]."""

    def outer_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g'(x)/sqrt(x² - r²) over r < x < s; 0 for s <= r [-]."""

    def inner_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g(x)/sqrt(r² - x²) over 0 < x < min(s, r) [m]."""


@dataclass(frozen=True)
class SphereProfile:
    """A sphere, or paraboloid of revolution: gap r²/(2R), g(s) = s²/R.

    Parameters
    ----------
    radius : float
        Radius R of the sphere, or relative radius of two [m].

    Raises
    ------
    ValueError
        If the radius is not positive and finite.

    Examples
    --------
    >>> print(f"{SphereProfile(0.01).depth(np.array(1e-3)) * 1e3:.3f} mm")
    0.100 mm
    """

    radius: float

    def __post_init__(self) -> None:
        require_positive("m", radius=self.radius)

    @property
    def edge(self) -> float:
        """Radius of the indenter: unlimited [m]."""
        return math.inf

    def depth(self, s: Floats) -> Floats:
        """Transform g(s) = s²/R of the gap [m]."""
        return s**2 / self.radius

    def reach(self, depth: Floats) -> Floats:
        """Radius s at which g(s) is the depth [m]."""
        radius: Floats = np.sqrt(self.radius * depth)
        return radius

    def depth_integral(self, s: Floats) -> Floats:
        """Integral of g from 0 to s [m²]."""
        return s**3 / (3 * self.radius)

    def outer_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g'(x)/sqrt(x² - r²) over r < x < s: (2/R) sqrt(s² - r²) [-]."""
        height: Floats = np.sqrt(np.maximum((s - r) * (s + r), 0.0))
        return 2 / self.radius * height

    def inner_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g(x)/sqrt(r² - x²) over 0 < x < min(s, r) [m]."""
        x = np.minimum(s, r)
        angle = arcsine(x, r)
        whole: Floats = r**2 * angle - x * np.sqrt((r - x) * (r + x))
        return whole / (2 * self.radius)


@dataclass(frozen=True)
class ConeProfile:
    """A cone, point down: gap r cot(half_angle), g(s) = (π/2) s cot(half_angle).

    Parameters
    ----------
    half_angle : float
        Angle from the axis to the flank, between 0 and π/2 [rad].

    Raises
    ------
    ValueError
        If the angle is not between 0 and π/2.

    Examples
    --------
    >>> print(f"{ConeProfile(math.radians(70)).depth(np.array(1e-3)) * 1e3:.6f} mm")
    0.571723 mm
    """

    half_angle: float

    def __post_init__(self) -> None:
        if not 0 < self.half_angle < math.pi / 2:
            raise ValueError(
                "half_angle: wanted an angle from the axis between 0 and pi/2 rad, "
                f"got {self.half_angle!r}"
            )

    @property
    def edge(self) -> float:
        """Radius of the indenter: unlimited [m]."""
        return math.inf

    @property
    def _slope(self) -> float:
        return math.pi / 2 / math.tan(self.half_angle)

    def depth(self, s: Floats) -> Floats:
        """Transform g(s) = (π/2) s cot(half_angle) of the gap [m]."""
        return self._slope * s

    def reach(self, depth: Floats) -> Floats:
        """Radius s at which g(s) is the depth [m]."""
        return depth / self._slope

    def depth_integral(self, s: Floats) -> Floats:
        """Integral of g from 0 to s [m²]."""
        return self._slope * s**2 / 2

    def outer_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g'(x)/sqrt(x² - r²) over r < x < s, infinite on the axis [-]."""
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(s > r, s / r, 1.0)
        return self._slope * np.arccosh(ratio)

    def inner_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g(x)/sqrt(r² - x²) over 0 < x < min(s, r) [m]."""
        x = np.minimum(s, r)
        height: Floats = np.sqrt((r - x) * (r + x))
        return self._slope * (r - height)


@dataclass(frozen=True)
class PunchProfile:
    """A round punch with a flat end: no gap, g(s) = 0, up to its radius.

    Parameters
    ----------
    radius : float
        Radius of the punch [m].

    Raises
    ------
    ValueError
        If the radius is not positive and finite.

    Examples
    --------
    >>> PunchProfile(0.01).edge
    0.01
    """

    radius: float

    def __post_init__(self) -> None:
        require_positive("m", radius=self.radius)

    @property
    def edge(self) -> float:
        """Radius of the punch [m]."""
        return self.radius

    def depth(self, s: Floats) -> Floats:
        """Transform of the gap: none under the punch [m]."""
        return np.zeros_like(s)

    def reach(self, depth: Floats) -> Floats:
        """Radius in contact at any depth: that of the punch [m]."""
        return np.full_like(depth, self.radius)

    def depth_integral(self, s: Floats) -> Floats:
        """Integral of g from 0 to s: none [m²]."""
        return np.zeros_like(s)

    def outer_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g'(x)/sqrt(x² - r²): none [-]."""
        return np.zeros(np.broadcast_shapes(s.shape, r.shape))

    def inner_integral(self, s: Floats, r: Floats) -> Floats:
        """Integral of g(x)/sqrt(r² - x²): none [m]."""
        return np.zeros(np.broadcast_shapes(s.shape, r.shape))


def arcsine(x: Floats, r: Floats) -> Floats:
    """Angle arcsin(x/r), the integral of 1/sqrt(r² - x²) from 0; π/2 where r = 0 [rad]."""
    with np.errstate(divide="ignore", invalid="ignore"):
        sine = np.where(r > 0, x / r, 1.0)
    angle: Floats = np.arcsin(np.minimum(sine, 1.0))
    return angle
