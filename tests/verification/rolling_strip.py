"""Cylinder in steady motion over a layered half-plane, by Chebyshev polynomials in wave space.

With the contact from x0 - c to x0 + c and s = (x - x0)/c, the pressure Σ c_n sqrt(1 - s²) U_n(s)
has the transform Σ c_n c π (n+1) (-i)^n J_{n+1}(kc)/(kc). A wave of the pressure e^(ikx) displaces
the surface by (2/|k|) C(|k|, kV) with the complex compliance C of the layers at the frequency k V.
So the slope of the surface at s is

    u' = -2 C(inf) Σ c_n T_{n+1}(s) + (2/π) Re ∫_0^∞ i [C - C(inf)] p^ e^(ik c s) dk,

as the half-plane's own part is the finite Hilbert transform of sqrt(1 - s²) U_n (Muskhelishvili
1953). It equals -(x0 + c s)/R at the N + 1 zeros of T_{N+1}: linear equations for N coefficients
and x0, the offset of the contact from the axis. There is no grid, no set of cells, no separation,
and the layers enter by closed forms with complex moduli.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import eval_chebyt, eval_chebyu, jv

#: Polynomials, largest k c of the integral, and Gauss nodes on each piece of it, of unit k c.
COUNT, LARGEST, NODES = 32, 1000, 4

#: Pieces of k c < 1 that are graded towards zero, each half as long as the one before.
GRADED = 45


@dataclass(frozen=True)
class RollingStrip:
    """Contact of a rigid cylinder, per unit length."""

    force: float
    half_width: float
    offset: float  # of the middle of the contact from the axis, ahead positive
    friction_coefficient: float
    peak_pressure: float
    approach: float  # on a rigid base


def rolling_strip(
    half_width: float,
    radius: float,
    complex_compliance: Callable[[np.ndarray], np.ndarray],
    instant: float,
) -> RollingStrip:
    """Contact of a half width, with C at wave numbers k (complex) and its limit C(inf)."""
    c = half_width
    node, weight = np.polynomial.legendre.leggauss(NODES)
    edges = np.concatenate([[0.0], 0.5 ** np.arange(GRADED, 0, -1.0), np.arange(1.0, LARGEST)])
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    kc = (middle[:, None] + half[:, None] * node).ravel()
    strength = (half[:, None] * weight).ravel() / c
    k = kc / c
    order = np.arange(COUNT)
    transforms = c * np.pi * (order + 1) * (-1j) ** order * jv(order + 1, kc[:, None]) / kc[:, None]
    s = np.cos(np.pi * (np.arange(COUNT + 1) + 0.5) / (COUNT + 1))
    waves = np.exp(1j * np.multiply.outer(s, kc))
    compliance = complex_compliance(k)
    rest = waves @ ((1j * (compliance - instant) * strength)[:, None] * transforms)
    slopes = -2 * instant * eval_chebyt(order + 1, s[:, None]) + 2 / np.pi * rest.real
    system = np.hstack([slopes, np.full((s.size, 1), 1 / radius)])
    solution = np.linalg.solve(system, -c * s / radius)
    found, offset = solution[:-1], float(solution[-1])
    force = np.pi / 2 * c * found[0]  # ∫ sqrt(1 - s²) U_0 ds = π/2, ∫ s sqrt(1 - s²) U_1 ds = π/4
    moment = offset * force + np.pi / 4 * c**2 * found[1]
    fine = np.cos(np.linspace(0, np.pi, 4001))
    pressure = np.sqrt(1 - fine**2) * (eval_chebyu(order, fine[:, None]) @ found)
    assert pressure.min() > -1e-3 * pressure.max()
    # At the axis, or the nearest place in contact.
    at = float(np.clip(-offset / c, -1, 1))
    level = (compliance / k * strength * np.exp(1j * at * kc)) @ transforms
    displacement = 2 / np.pi * float((level @ found).real)
    return RollingStrip(
        float(force),
        c,
        offset,
        float(moment / (radius * force)),
        float(pressure.max()),
        displacement + (offset + c * at) ** 2 / (2 * radius),
    )


def bonded(w: np.ndarray, nu: complex | np.ndarray) -> np.ndarray:
    """L of a layer bonded to a rigid base, at w = q h (Johnson 1985, section 5.8), scaled."""
    k, t = 3 - 4 * nu, np.exp(-2 * w)
    upper = k * (1 - t**2) - 4 * w * t
    return upper / (k * (1 + t**2) + (1 + k**2 + 4 * w**2) * t)


def on_core(w: np.ndarray, nu: float, core_nu: float, ratio: np.ndarray) -> np.ndarray:
    """L of a layer bonded to a core, by the ratio of shear moduli (O'Sullivan & King 1988)."""
    t = np.exp(-2 * w)
    lam = 1 - 4 * (1 - nu) / (1 + ratio * (3 - 4 * core_nu))
    kap = (ratio - 1) / (ratio + 3 - 4 * nu)
    return (1 + 4 * w * kap * t - lam * kap * t**2) / (
        1 - (lam + kap + 4 * kap * w**2) * t + lam * kap * t**2
    )
