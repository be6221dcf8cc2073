"""Bodies of revolution that are no paraboloids: blunt apexes, blunt bodies on fine cells, and flat
faces with a rounded edge.

Truth: the rods of `rod_solution`, with transforms of the gaps in closed form.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

import viscontact as vc
from verification.families.creep_curves import random_creep
from verification.families.exact_run import ExactRun
from verification.families.random_loads import (
    history_of_points,
    in_and_recover,
    random_points,
    random_times,
    reversals,
    triangle,
    two_cycles,
)
from verification.families.round_bodies import contact_size, largest_level, run_of
from verification.families.round_profiles import (
    PowerBody,
    RoundBody,
    RoundProfile,
    power_body,
    quartic_ball,
)

Array = np.ndarray
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, eq=False)
class ApexProfile(RoundProfile):
    """Transform of r^n/(n c^(n-1)), with the pressure at the apex in closed form."""

    exponent: float = 2.0
    factor: float = 1.0  # g(s)/s^n

    def pressure_weights(self, places: Array, r: float) -> Array:
        """At the apex the integral of g'(s)/s is that of n s^(n-2)."""
        if r > 0:
            return super().pressure_weights(places, r)
        n = self.exponent
        return self.factor * n / (n - 1) * np.diff(places ** (n - 1))


def apex(rng: np.random.Generator, a: float) -> RoundBody:
    """A body r^n, 1 < n < 2, whose pressure has a cusp of finite height at its apex."""
    exponent = rng.uniform(1.1, 1.95)
    length = a * 10 ** (rng.uniform(0.8, 2) / (exponent - 1))
    factor = math.sqrt(math.pi) * gamma(exponent / 2 + 1) / gamma((exponent + 1) / 2)
    factor /= exponent * length ** (exponent - 1)
    profile = ApexProfile(
        lambda r: (r / length) ** (exponent - 1),
        lambda s: factor * s**exponent,
        4 * a,
        exponent,
        factor,
    )
    return RoundBody(f"r^{exponent:.2f}", PowerBody(exponent, length), profile)


@dataclass(frozen=True)
class RoundedPunch(vc.Indenter):
    """Gap (r - b)²/(2R) beyond a flat face of radius b."""

    face: float  # b [m]
    radius: float  # R of the edge [m]

    def gap(self, x: ArrayLike, y: ArrayLike) -> Array:
        r = np.hypot(*np.broadcast_arrays(x, y))
        return np.maximum(r - self.face, 0.0) ** 2 / (2 * self.radius)

    @property
    def curvatures(self) -> tuple[float, float]:
        return 0.0, 0.0


@dataclass(frozen=True, eq=False)
class PunchProfile(RoundProfile):
    """Transform of a rounded punch; within the face it is a millionth of its largest depth.

    g(s) = s (q - b arccos(b/s))/R, q² = s² - b², beyond the face of radius b. M. Ciavarella,
    Proc. Inst. Mech. Eng. C 213 (1999) 1205, has the pressure.
    """

    face: float = 1.0
    radius: float = 1.0

    @cached_property
    def _slight(self) -> float:
        """Curvature of the transform within the face, which the rods need [1/m]."""
        return 1e-6 * float(self._beyond(np.array(self.largest))) / self.largest**2

    def _parts(self, s: Array) -> tuple[Array, Array]:
        beyond = np.maximum(s, self.face)
        root = np.sqrt((beyond - self.face) * (beyond + self.face))
        return root, np.arccos(self.face / beyond)

    def _beyond(self, s: Array) -> Array:
        root, angle = self._parts(s)
        return np.asarray(s * (root - self.face * angle) / self.radius)

    def depth(self, s: Array) -> Array:
        s = np.asarray(s, dtype=float)
        return self._beyond(s) + self._slight * s**2

    def depth_integral(self, s: Array) -> Array:
        s = np.asarray(s, dtype=float)
        root, angle = self._parts(s)
        beyond = np.maximum(s, self.face)
        swept = root**3 / 3 - self.face * (beyond**2 * angle - self.face * root) / 2
        return swept / self.radius + self._slight * s**3 / 3

    def pressure_weights(self, places: Array, r: float) -> Array:
        ends = np.sqrt(np.maximum(places**2 - r**2, 0.0))
        half = np.diff(ends)[:, None] / 2
        s = np.hypot(ends[:-1, None] + half * (1 + _NODES), r)
        root, angle = self._parts(s)
        over = (2 * root - self.face * angle) / self.radius + 2 * self._slight * s
        return np.asarray((half * over / s) @ _WEIGHTS)


def rounded(rng: np.random.Generator, a: float) -> RoundBody:
    """A face of 0.5 to 0.9 of the contact."""
    face, radius = a * rng.uniform(0.5, 0.9), a * 10 ** rng.uniform(0.5, 2)
    profile = PunchProfile(
        lambda r: np.maximum(r - face, 0.0) / radius, np.zeros_like, 4 * a, face, radius
    )
    return RoundBody("rounded punch", RoundedPunch(face, radius), profile)


def blunt_apex(rng: np.random.Generator) -> ExactRun:
    """A body r^n, 1 < n < 2, its apex anywhere in a cell, under any history."""
    creep, a = random_creep(rng), contact_size(rng)
    body = apex(rng, a)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    kind, points = random_points(rng, jumps=creep.jumps)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    load = history_of_points(points, control, largest_level(body, creep, control, a, end), end)
    times = random_times(rng, end, most=20)
    name = f"{body.name}, {kind} of {control}, {creep.name}"
    return run_of(rng, body, creep, load, times, name, most=90, shifted=0.8)


def shrinking_contact(rng: np.random.Generator) -> ExactRun:
    """A blunt body on fine cells, under a load that falls."""
    creep, a = random_creep(rng, creeping=True), contact_size(rng)
    body = (power_body, quartic_ball)[int(rng.random() < 0.2)](rng, a)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    kinds = (triangle, in_and_recover, two_cycles, reversals)
    kind = kinds[rng.integers(len(kinds))]
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    largest = largest_level(body, creep, control, a, end)
    load = history_of_points(kind(rng), control, largest, end)
    times = random_times(rng, end, most=60)
    name = f"{body.name}, {kind.__name__.replace('_', ' ')} of {control}, {creep.name}"
    return run_of(rng, body, creep, load, times, name, most=120)


def rounded_punch(rng: np.random.Generator) -> ExactRun:
    """A flat face with a rounded edge, any law and history."""
    creep, a = random_creep(rng), contact_size(rng)
    body = rounded(rng, a)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    kind, points = random_points(rng, jumps=creep.jumps)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    load = history_of_points(points, control, largest_level(body, creep, control, a, end), end)
    name = f"{body.name}, {kind} of {control}, {creep.name}"
    return run_of(rng, body, creep, load, random_times(rng, end, most=30), name, most=64)
