"""Frictionless contact of parabolic bodies with layers, by integral equations.

The surface's response is given as the deviation L - 1 from a half-space at wave numbers times the
thickness of the layer. Lengths are in thicknesses, pressures times the contact compliance.

References
----------
I. N. Sneddon, Mixed Boundary Value Problems in Potential Theory (1966); K. L. Johnson, Contact
Mechanics (1985), section 5.8.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

Array = np.ndarray
Deviation = Callable[[Array], Array]

#: Wave number beyond which L - 1 is below rounding, and the longest wave.
SHORTEST, LONGEST = 22.0, 1e-5

PANEL = np.polynomial.legendre.leggauss(12)


def bonded_on_rigid(nu: float) -> Deviation:
    """A layer bonded to a rigid base (Johnson 1985, section 5.8)."""
    k = 3 - 4 * nu

    def deviation(w: Array) -> Array:
        t = np.exp(-2 * w)
        lower = k * (1 + t * t) + (1 + k * k + 4 * w * w) * t
        return -t * (4 * w + 1 + k * k + 4 * w * w + 2 * k * t) / lower

    return deviation


def sliding_on_rigid() -> Deviation:
    """A layer on a rigid base without friction (Johnson 1985, section 5.8)."""

    def deviation(w: Array) -> Array:
        t = np.exp(-2 * w)
        return -2 * t * (1 + 2 * w - t) / (1 + 4 * w * t - t * t)

    return deviation


def bonded_on(ratio: float, nu: float, nu_base: float) -> Deviation:
    """A layer bonded to a half-space of 1/ratio of its shear modulus (Nogi and Kato 1997)."""
    lam = 1 - 4 * (1 - nu) / (1 + ratio * (3 - 4 * nu_base))
    kap = (ratio - 1) / (ratio + 3 - 4 * nu)

    def deviation(w: Array) -> Array:
        t = np.exp(-2 * w)
        lower = 1 - (lam + kap + 4 * kap * w * w) * t + lam * kap * t * t
        return t * (4 * w * kap + lam + kap + 4 * kap * w * w - 2 * lam * kap * t) / lower

    return deviation


@dataclass(frozen=True)
class Contact:
    """Force times compliance (per length for a line), approach and largest pressure; a = 1 / h."""

    radius: float
    force: float
    approach: float
    peak: float


def _waves(reach: float) -> tuple[Array, Array]:
    """Gauss nodes and weights of the wave number, for cosines over a distance."""
    panels = np.arange(0.0, SHORTEST, min(1.0, 2.0 / reach))
    edges = np.union1d(np.geomspace(LONGEST, SHORTEST, 60), panels)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    nodes = middle[:, None] + half[:, None] * PANEL[0]
    return nodes.ravel(), (half[:, None] * PANEL[1]).ravel()


def ball(a: float, radius: float, deviation: Deviation) -> Contact:
    """Paraboloid of a radius in contact over the radius a, by a Fredholm equation.

    As in `viscontact.reference.layer`, on any layers.
    """
    count = 48 + int(8 * a)
    nodes, weights = np.polynomial.legendre.leggauss(count)
    t, weights = (1 + nodes) * a / 2, weights * a / 2
    q, strength = _waves(a)
    cosines = np.cos(np.multiply.outer(np.append(t, a), q))
    kernel = 2 / np.pi * (cosines * (strength * deviation(q))) @ cosines[:-1].T * weights
    matrix = np.eye(count) + kernel[:-1]
    level, curved = np.linalg.solve(matrix, np.stack([np.ones(count), t**2 / radius], 1)).T / np.pi
    ends = [1 / np.pi - kernel[-1] @ level, a**2 / radius / np.pi - kernel[-1] @ curved]
    approach = ends[1] / ends[0]
    density = approach * level - curved
    # The density is even in t and zero at the rim: a polynomial in (t/a)².
    square = (t / a) ** 2
    fitted = np.polynomial.Chebyshev.fit(
        np.append(square, 1.0), np.append(density, 0.0), count // 2, domain=(0.0, 1.0)
    ).deriv()
    places = a * np.sin(np.linspace(0.0, 0.5, 600) * np.pi)
    half = np.sqrt(a**2 - places**2)[:, None] / 2
    s = half * (1 + nodes)
    pressure = -2 / a**2 * (fitted((places[:, None] ** 2 + s**2) / a**2) * half) @ (2 * weights / a)
    force = 2 * np.pi * float(weights @ density)
    return Contact(a, force, float(approach), float(pressure.max()))


def cylinder(a: float, radius: float, deviation: Deviation) -> Contact:
    """Parabolic cylinder in contact over the half width a; on a rigid base, else no approach.

    p = Σ c_n T_2n/sqrt(1 - ξ²) with Σ c_n = 0, by collocation: the logarithm's part is exact,
    ∫ -ln|x - s| T_n/sqrt(1 - s²) ds = π T_n/n, the rest is smooth.
    """
    count = 40 + int(8 * a)
    order = 2 * np.arange(count)
    xi = np.cos((np.arange(count) + 0.5) * np.pi / (2 * count))  # of both halves
    chebyshev = np.cos(np.multiply.outer(np.arccos(xi), order))
    singular = np.divide(np.pi, order, out=np.full(count, np.pi * np.log(2)), where=order > 0)
    matrix = a * chebyshev * (singular + np.where(order == 0, -np.pi * np.log(a), 0.0))
    x = a * xi
    q, strength = _waves(2 * a)
    wave = np.cos(np.multiply.outer(x, q))
    smooth = (wave * (strength * (deviation(q) + np.exp(-q)) / q)) @ wave.T
    apart = np.log1p(np.subtract.outer(x, x) ** 2) + np.log1p(np.add.outer(x, x) ** 2)
    matrix += (smooth + apart / 4) @ chebyshev * (a * np.pi / count)
    system = np.zeros((count + 1, count + 1))
    system[:-1, :-1], system[:-1, -1], system[-1, :-1] = 2 / np.pi * matrix, -1.0, 1.0
    found = np.linalg.solve(system, np.append(-(x**2) / (2 * radius), 0.0))
    angles = np.linspace(0.0, 0.5, 402)[1:] * np.pi
    pressure = np.cos(np.multiply.outer(angles, order)) @ found[:-1] / np.sin(angles)
    return Contact(a, a * np.pi * float(found[0]), float(found[-1]), float(pressure.max()))


def under(
    level: float, quantity: str, solve: Callable[[float], Contact], bounds: tuple[float, float]
) -> Contact:
    """Contact of a force or an approach."""

    def excess(log_a: float) -> float:
        return float(np.log(getattr(solve(np.exp(log_a)), quantity) / level))

    return solve(float(np.exp(brentq(excess, *np.log(bounds), xtol=1e-9))))
