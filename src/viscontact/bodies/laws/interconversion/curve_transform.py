"""Fourier transform of a curve through points: its response to steady oscillation, without a fit.

i ω L[f](i ω) = f(0) + ∫ exp(-i ω t) f'(t) dt is integrated piece by piece. While the phase ω t is
small, Gauss-Legendre panels in ln t resolve it. Later the integrand oscillates about zero, so each
piece, whose f' is an analytic function of t, is integrated along paths of steepest descent from
its two ends, where exp(-i ω t) only decays (Huybrechs & Vandewalle 2006, SIAM J. Numer. Anal. 44,
1026): Gauss-Laguerre quadrature.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Complexes, Floats
from viscontact.bodies.laws.interconversion.log_curve import LogCurve

# Up to the first phase exp(-i x) = 1 - i x, to its square; beyond the second, steepest descent.
_EARLY, _LATE = 1e-8, 30.0
# On a panel of a quarter of a decade the phase turns by 13 at most, which 20 nodes resolve to
# rounding; so do 24 of the descent, over which f' changes on the scale of the late phase.
_PANELS = 4
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)
_DESCENTS, _DECAYED = np.polynomial.laguerre.laggauss(24)


def oscillating(curve: LogCurve, omega: Floats) -> Complexes:
    """Return i ω L[f](i ω) at ω > 0 [rad/s]: the complex compliance of Phi, the modulus of G."""
    values = [_transform_at(curve, float(each)) for each in omega.ravel()]
    return np.array(values, dtype=np.complex128).reshape(omega.shape)


def _transform_at(curve: LogCurve, omega: float) -> complex:
    early, late = _EARLY / omega, _LATE / omega
    start = np.array(early)
    begun = float(curve(start))
    behind = float(curve.mean(0 * start, start))
    risen = begun + 1j * _EARLY * (behind - begun)
    return risen + _early_integral(curve, omega, early, late) + _late_integral(curve, omega, late)


def _early_integral(curve: LogCurve, omega: float, start: float, end: float) -> complex:
    """Return ∫ exp(-i ω t) f' dt for small phases, on Gauss-Legendre panels between the points."""
    count = int(_PANELS * np.log10(end / start)) + 2
    points = curve.times[(curve.times > start) & (curve.times < end)]
    edges = np.log(np.unique(np.concatenate([np.geomspace(start, end, count), points])))
    halves = np.diff(edges)[:, None] / 2
    middles = edges[:-1, None] + halves
    t = np.exp(middles + halves * _NODES)
    rates = curve.rate(t, np.exp(middles) + 0 * t) * t
    return complex(((rates * np.exp(-1j * omega * t)) @ _WEIGHTS) @ halves[:, 0])


def _late_integral(curve: LogCurve, omega: float, start: float) -> complex:
    """Return ∫ exp(-i ω t) f' dt from a late phase to infinity, by steepest descent."""
    edges = np.append(start, curve.times[curve.times > start])
    middles = np.append(np.sqrt(edges[:-1]) * np.sqrt(edges[1:]), 2 * edges[-1])
    # From the start of each piece down, and from its end up again; the last one has no end.
    downs = _descent(curve, omega, edges, middles)
    return complex(downs.sum() - _descent(curve, omega, edges[1:], middles[:-1]).sum())


def _descent(curve: LogCurve, omega: float, ends: Floats, pieces: Floats) -> Complexes:
    t = ends[:, None] - 1j * _DESCENTS / omega
    rates = curve.rate(t, pieces[:, None] + 0 * t.real)
    return np.asarray((rates @ _DECAYED) * np.exp(-1j * omega * ends) / (1j * omega))
