"""Displacement around a point force on layers, less the singular part of a half-space.

A point force on the surface displaces it at the distance r, per unit force and unit contact
compliance, by

    k(r) = (1/π) ∫_0^∞ L(q) J0(q r) dq = L(∞)/(π r) + Δ(r),
    Δ(r) = (1/π) ∫_0^∞ [L(q) - L(∞)] J0(q r) dq   [1/m].

Δ is smooth on the scale of the thinnest layer, as L(q) - L(∞) decays as e^(-2 q h). The integral is
taken along the ray q = ρ e^(iπ/8), where the Hankel function H0, whose real part is J0, decays
instead of oscillating: L is analytic between the ray and the real axis, as the least argument of
its poles is about π/4, that of a thin stiff plate on springs. With ρ = e^x the trapezium rule
converges exponentially at all distances.

References
----------
M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), eq. 9.2.3.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse

#: Direction of the ray of integration, and step of the logarithm of the wave number on it.
RAY, LOG_STEP = np.exp(1j * np.pi / 8), 0.07

#: Largest wave number times the shortest length, and smallest one times the largest distance.
SHORTEST_WAVE, LONGEST_WAVE = 22.0, 1e-14

#: Step of asinh(r/length) in the table of Δ, and degree of its spline.
STEP, DEGREE = 0.05, 7

#: Entries of the table that are mirrored to r < 0.
MIRRORED = 8


@dataclass(frozen=True, eq=False)
class SmoothKernel:
    """Splines of Δ(r) [1/m] and of ∫_0^r Δ r' dr' [m] over asinh(r/length), up to `reach`."""

    # Beyond the table Δ falls as 1/r, as between two half-spaces.

    length: float
    reach: float
    value_spline: scipy.interpolate.BSpline
    moment_spline: scipy.interpolate.BSpline

    def value(self, r: Floats) -> Floats:
        """Δ at distances [1/m]."""
        near = np.minimum(r, self.reach)
        farther = np.maximum(r / self.reach, 1.0)
        return np.asarray(
            self.value_spline(np.arcsinh(near / self.length)) / (self.length * farther)
        )

    def moment(self, r: Floats) -> Floats:
        """Moment ∫_0^r Δ r' dr' [m]."""
        near = np.minimum(r, self.reach)
        found = self.moment_spline(np.arcsinh(near / self.length)) * self.length
        return np.asarray(found + self.reach * self.value(np.array(self.reach)) * (r - near))


@lru_cache(maxsize=32)
def smooth_kernel(response: SurfaceResponse, reach: float) -> SmoothKernel:
    """Table of Δ for distances up to `reach` [m]."""
    t = table_places(response.length, reach)
    return kernel_of(response.length, reach, _ray_integral(response, response.length, np.sinh(t)))


def table_places(length: float, reach: float) -> Floats:
    """Values of asinh(r/length) of a table of distances up to `reach` [m]."""
    count = int(np.ceil(np.arcsinh(reach / length) / STEP)) + MIRRORED
    return STEP * np.arange(0.5, count)  # none at r = 0, where H0 is singular


def kernel_of(length: float, reach: float, values: Floats, *, sign: int = 1) -> SmoothKernel:
    """Kernel of values times `length` at the places of a table, even (1) or odd (-1) in r."""
    t = table_places(length, reach)
    # Over r/length: if Δ is even, its moment's integrand is odd in t.
    moments = values * np.sinh(t) * np.cosh(t)
    value, moment = (
        scipy.interpolate.make_interp_spline(*extended(t, each, parity), k=DEGREE)
        for each, parity in ((values, sign), (moments, -sign))
    )
    integral = moment.antiderivative()
    integral.c -= integral(0.0)  # the basis functions add up to one
    return SmoothKernel(length, reach, value, integral)


def _ray_integral(response: SurfaceResponse, length: float, r: Floats) -> Floats:
    """Δ at distances in units of `length`, times `length`."""
    log_longest = np.log(LONGEST_WAVE / r[-1])
    count = int(np.ceil((np.log(SHORTEST_WAVE) - log_longest) / LOG_STEP))
    q = RAY * np.exp(log_longest + LOG_STEP * np.arange(count + 1))
    weights = (response.ratio(q / length) - response.short_waves) * q * (LOG_STEP / np.pi)
    return np.array(
        [float((weights * scipy.special.hankel1(0, q * each)).sum().real) for each in r]
    )


def extended(t: Floats, values: Floats, sign: int) -> tuple[Floats, Floats]:
    """Even (1) or odd (-1) function with some of its entries at negative arguments."""
    before = slice(MIRRORED - 1, None, -1)
    return np.append(-t[before], t), np.concatenate([sign * values[before], values])
