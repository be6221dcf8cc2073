"""Influence coefficients of a loaded strip without end on layers.

A line load displaces the surface, per unit force on its length and unit contact compliance, by

    g(y) = (2/π) ∫_0^∞ L(q) cos(q y)/q dq.

With a length l, L is that of long waves, the difference to short waves times 1 - e^(-q l), and a
rest that decays at both ends. So the primitive of g is that of a half-space of L(0) and

    P(y) = (2/π) { [L(∞) - L(0)] [(y/2) ln(1 + l²/y²) + l atan(y/l)] + S(y) },
    S(y) = ∫_0^∞ {L(q) - L(0) - [L(∞) - L(0)] (1 - e^(-q l))} sin(q y)/q² dq,

and the coefficient of a strip is the difference of P at its edges. S is smooth on the scale of the
thinnest layer. As in `smooth_kernel` it is taken along a ray, of the function
{...} [e^(i q y) - e^(-q l)]/q², which has the same imaginary part on the real axis.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy

from viscontact.backend.arrays import Complexes, Floats
from viscontact.mechanics.halfspace.smooth_kernel import DEGREE, LOG_STEP, LONGEST_WAVE, RAY, STEP
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse

#: Largest wave number times the shortest length, at which the rest has decayed.
SHORTEST_WAVE = 45.0

#: Distance up to which S is tabulated, over the shortest length; it is constant beyond.
REACH = 1e8


def strip_coefficient(y: Floats, width: float, response: SurfaceResponse) -> Floats:
    """Displacement [m] at offsets y [m] from a strip under unit pressure, less that of L(0).

    Per unit contact compliance. On a rigid base, where L(0) = 0, it is all of the displacement: in
    the middle of a strip far wider than a layer the uniaxial compression h (1 - 2ν)/(1 - ν)².
    """
    return _primitive(y + width / 2, response) - _primitive(y - width / 2, response)


def _primitive(y: Floats, response: SurfaceResponse) -> Floats:
    """P at offsets [m], odd [m]."""
    length, spline = response.length, _smooth_part(response)
    distance = np.abs(y)
    squared = np.divide(length, distance, out=np.zeros_like(distance), where=distance > 0) ** 2
    closed = distance / 2 * np.log1p(squared) + length * np.arctan(distance / length)
    smooth = spline(np.arcsinh(np.minimum(distance / length, REACH))) * length
    excess = response.short_waves - response.long_waves
    return np.asarray(2 / np.pi * np.sign(y) * (excess * closed + smooth))


@lru_cache(maxsize=32)
def _smooth_part(response: SurfaceResponse) -> scipy.interpolate.BSpline:
    """S over the shortest length, as a spline of asinh(y/length)."""
    length = response.length
    y, q = places_and_waves()
    excess = response.short_waves - response.long_waves
    rest = response.ratio(q / length) - response.long_waves + excess * np.expm1(-q)
    weights = rest / q * LOG_STEP
    level = np.exp(-q)
    values = np.array([float((weights * (np.exp(1j * q * at) - level)).sum().imag) for at in y])
    return odd_spline(values)


def places_and_waves() -> tuple[Floats, Complexes]:
    """Places y/length of a spline from 0 on, and the wave numbers q length on a ray to sum over."""
    y = np.sinh(_arguments())
    log_longest = np.log(LONGEST_WAVE / y[-1])
    waves = int(np.ceil((np.log(SHORTEST_WAVE) - log_longest) / LOG_STEP))
    return y, RAY * np.exp(log_longest + LOG_STEP * np.arange(waves + 1))


def odd_spline(values: Floats) -> scipy.interpolate.BSpline:
    """Odd spline of asinh(y/length) through values at its places."""
    t = _arguments()
    return scipy.interpolate.make_interp_spline(
        np.append(-t[:0:-1], t), np.append(-values[:0:-1], values), k=DEGREE
    )


def _arguments() -> Floats:
    return np.asarray(STEP * np.arange(int(np.arcsinh(REACH) / STEP) + 2), dtype=np.float64)
