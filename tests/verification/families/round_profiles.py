"""Bodies of revolution, and the transform g(s) of their gap for the solution by rods.

g(s) = s times the integral of f'(r)/sqrt(s² - r²) over r < s is the approach at which an elastic
contact reaches s (Sneddon 1965, Int. J. Eng. Sci. 3, 47).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.special import gamma

import viscontact as vc

Array = np.ndarray
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_FINE, _FINE_WEIGHTS = np.polynomial.legendre.leggauss(300)


@dataclass(frozen=True)
class PowerBody(vc.Indenter):
    """Gap r^n/(n c^(n-1)), without an end."""

    exponent: float
    length: float  # c: where the slope is 1 [m]

    def gap(self, x: ArrayLike, y: ArrayLike) -> Array:
        r = np.hypot(*np.broadcast_arrays(x, y))
        return r / self.exponent * (r / self.length) ** (self.exponent - 1)

    @property
    def curvatures(self) -> tuple[float, float]:
        return (1 / self.length, 1 / self.length) if self.exponent == 2 else (0.0, 0.0)


@dataclass(frozen=True)
class RoundedCone(vc.Indenter):
    """A cone whose tip is a paraboloid, tangent at a radius."""

    half_angle: float  # of the cone, from its axis [rad]
    radius: float  # of the tip's contact with the cone [m]

    @property
    def slope(self) -> float:
        return 1 / math.tan(self.half_angle)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Array:
        r = np.hypot(*np.broadcast_arrays(x, y))
        inside = np.minimum(r, self.radius)
        return self.slope * (inside**2 / (2 * self.radius) + np.maximum(r - self.radius, 0.0))

    @property
    def curvatures(self) -> tuple[float, float]:
        return self.slope / self.radius, self.slope / self.radius


@dataclass(frozen=True, eq=False)
class RoundProfile:
    """Transform of a gap, as the solution by rods needs it; made from the slope f'(r)."""

    slope: Callable[[Array], Array]  # f'(r)
    depth_at: Callable[[Array], Array]  # g(s) [m]
    largest: float  # radius up to which it is used [m]

    edge = math.inf

    @classmethod
    def of_slope(cls, slope: Callable[[Array], Array], largest: float) -> "RoundProfile":
        """By quadrature: g(s) = s times the mean of f'(s sin θ) over a quarter turn, times π/2."""
        sines = np.sin(math.pi / 4 * (1 + _FINE))
        s = largest * np.linspace(0.0, 1.0, 2001)
        g = s * (slope(s[:, None] * sines) @ _FINE_WEIGHTS) * math.pi / 4
        return cls(slope, CubicSpline(s, g), largest)

    @cached_property
    def _spline(self) -> CubicSpline:
        s = self.largest * np.linspace(0.0, 1.0, 2001)
        return CubicSpline(s, self.depth_at(s))

    @cached_property
    def _swept(self) -> CubicSpline:
        return self._spline.antiderivative()

    @cached_property
    def _logarithms(self) -> tuple[Array, Array]:
        """ln g and ln s at 6000 radii, between which the one is nearly linear in the other."""
        s = np.geomspace(1e-5 * self.largest, self.largest, 6000)
        return np.log(self.depth(s)), np.log(s)

    @cached_property
    def _tip(self) -> tuple[float, float, float, float]:
        """Radius below which g is a power of s, g there, its exponent, and its integral."""
        s = 2e-3 * self.largest
        g, half = (float(self.depth_at(np.array(each))) for each in (s, s / 2))
        exponent = math.log2(g / half)
        return s, g, exponent, s * g / (exponent + 1)

    def depth(self, s: Array) -> Array:
        """g(s), a power of s near the axis and beyond the largest radius."""
        s = np.asarray(s, dtype=float)
        tip, start, exponent, _ = self._tip
        body = self.depth_at(np.clip(s, tip, self.largest))
        outside = (np.maximum(s, self.largest) / self.largest) ** 2
        inside = start * (np.minimum(s, tip) / tip) ** exponent
        return np.asarray(np.where(s < tip, inside, body * outside))

    def reach(self, depth: Array) -> Array:
        with np.errstate(divide="ignore"):
            return np.exp(np.interp(np.log(depth), *self._logarithms))

    def depth_integral(self, s: Array) -> Array:
        s = np.asarray(s, dtype=float)
        tip, _, exponent, start = self._tip
        inside = np.clip(s, tip, self.largest)
        body = start + self._swept(inside) - self._swept(tip)
        ratio = np.maximum(s, self.largest) / self.largest
        outside = self.largest * float(self.depth(self.largest)) * (ratio**3 - 1) / 3
        near = start * (np.minimum(s, tip) / tip) ** (exponent + 1)
        return np.asarray(np.where(s < tip, near, body + outside))

    def pressure_weights(self, places: Array, r: float) -> Array:
        """Integral of g'(s)/sqrt(s² - r²) over each element between places, from r on [-]."""
        ends = np.sqrt(np.maximum(places**2 - r**2, 0.0))
        half = np.diff(ends)[:, None] / 2
        u = ends[:-1, None] + half * (1 + _NODES)
        s = np.hypot(u, r)
        return np.asarray((half * self._spline(s, 1) / s) @ _WEIGHTS)


@dataclass(frozen=True, eq=False)
class RoundBody:
    """A body of revolution, its transform, and whether its peak pressure has a limit."""

    name: str
    indenter: vc.Indenter
    profile: RoundProfile
    sharp: bool = False


def paraboloid(rng: np.random.Generator, a: float) -> RoundBody:
    """Contact of radius a on a ball of 10 to 300 times this radius."""
    radius = a * 10 ** rng.uniform(1, 2.5)
    profile = RoundProfile(lambda r: r / radius, lambda s: s**2 / radius, 4 * a)
    return RoundBody("paraboloid", vc.Paraboloid(radius, radius), profile)


def sphere(rng: np.random.Generator, a: float) -> RoundBody:
    radius = a * 10 ** rng.uniform(0.8, 2)
    profile = RoundProfile(
        lambda r: r / np.sqrt((radius - r) * (radius + r)),
        lambda s: s * np.arctanh(s / radius),
        min(4 * a, 0.999 * radius),
    )
    return RoundBody("sphere", vc.Sphere(radius), profile)


def power_body(rng: np.random.Generator, a: float) -> RoundBody:
    """Exponents 3 to 10: g(s) = f(s) sqrt(π) Γ(n/2 + 1)/Γ((n + 1)/2)."""
    exponent = float(rng.integers(3, 11)) if rng.random() < 0.7 else rng.uniform(2.0, 10.0)
    length = a * 10 ** rng.uniform(0.8, 2) ** (1 / (exponent - 1))
    body = PowerBody(exponent, length)
    factor = math.sqrt(math.pi) * gamma(exponent / 2 + 1) / gamma((exponent + 1) / 2)
    profile = RoundProfile(
        lambda r: (r / length) ** (exponent - 1),
        lambda s: factor * s / exponent * (s / length) ** (exponent - 1),
        4 * a,
    )
    return RoundBody(f"r^{exponent:.2g}", body, profile)


def cone(rng: np.random.Generator, a: float) -> RoundBody:
    angle = math.radians(rng.uniform(75, 88))
    profile = RoundProfile(
        lambda r: np.full_like(r, 1 / math.tan(angle)),
        lambda s: math.pi / 2 / math.tan(angle) * s,
        4 * a,
    )
    return RoundBody("cone", vc.Cone(angle), profile, sharp=True)


def rounded_cone(rng: np.random.Generator, a: float) -> RoundBody:
    """The tip takes 0.3 to 0.9 of the contact; the closed form of Ciavarella's rounded cone.

    M. Ciavarella, J. Strain Anal. 34 (1999) 263-275.
    """
    angle, b = math.radians(rng.uniform(75, 88)), a * rng.uniform(0.3, 0.9)
    slope = 1 / math.tan(angle)

    def depth(s: Array) -> Array:
        beyond = np.maximum(s, b)
        root = np.sqrt((beyond - b) * (beyond + b))
        return slope * s * ((s - root) / b + math.pi / 2 - np.arcsin(b / beyond))

    profile = RoundProfile(lambda r: slope * np.minimum(r / b, 1.0), depth, 4 * a)
    return RoundBody("rounded cone", RoundedCone(angle, b), profile)


def quartic_ball(rng: np.random.Generator, a: float) -> RoundBody:
    """A paraboloid with a part of r^4: g(s) = s²/R + (8/3) c s^4."""
    radius = a * 10 ** rng.uniform(1, 2)
    more = rng.uniform(0.2, 3.0) / (2 * radius * a**2)
    cubic = PowerBody(4.0, (1 / (4 * more)) ** (1 / 3))
    profile = RoundProfile(
        lambda r: r / radius + 4 * more * r**3,
        lambda s: s**2 / radius + 8 / 3 * more * s**4,
        4 * a,
    )
    return RoundBody("r^2 + r^4", vc.Paraboloid(radius, radius) + cubic, profile)


def tabulated(rng: np.random.Generator, a: float) -> RoundBody:
    """A ball by 25 to 60 points of its section, with monotone cubics between them."""
    radius = a * 10 ** rng.uniform(1, 2)
    exponent = rng.uniform(1.8, 3.0)
    count = int(rng.integers(25, 61))
    r = np.linspace(0.0, 4 * a, count)
    drops = a**2 / (2 * radius) * (r / a) ** exponent
    # Through the mirrored points too, as the body is drawn.
    line = PchipInterpolator(np.append(-r[:0:-1], r), np.append(drops[:0:-1], drops))
    profile = RoundProfile.of_slope(line.derivative(), 3.5 * a)
    return RoundBody("tabulated", vc.Revolved(r, drops), profile)


BODIES = (
    paraboloid,
    sphere,
    power_body,
    power_body,
    cone,
    rounded_cone,
    quartic_ball,
    tabulated,
)


def random_body(rng: np.random.Generator, a: float) -> RoundBody:
    """A body whose contacts have about the radius a [m]."""
    return BODIES[rng.integers(len(BODIES))](rng, a)
