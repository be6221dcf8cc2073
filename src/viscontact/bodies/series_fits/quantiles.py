"""Quantiles of Student's distribution, and exceedances of the chi-square one.

SciPy has both; to import its special functions takes as long as a fit.
"""

from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np

from viscontact.backend.arrays import Floats

#: Abscissae and weights of Gauss's rule between -1 and 1.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(96)
_STEPS = 200  # of Newton, and of a continued fraction: far more than needed
_MANY = 1e4  # degrees of freedom from which on the series in their reciprocal is exact to 1e-10
_EXACT = 1e-14  # relative change of a tail, or of a quantile, that is rounding


def student_quantile(freedom: float, probability: float) -> float:
    """Quantile of Student's distribution of `freedom` > 0 at a probability from 1/2 to 1.

    Its error is below 1e-10 of it, or 1e-15.

    >>> round(student_quantile(10.0, 0.975), 6)
    2.228139
    """
    above = 1.0 - probability  # without rounding
    if above in (0.0, 0.5):
        return 0.0 if above else math.inf
    normal = NormalDist().inv_cdf(probability)
    if freedom >= _MANY:
        return _of_many(freedom, normal)
    # The logarithm of the tail is concave in that of t, and the normal quantile a lower one.
    t = normal
    for _ in range(_STEPS):
        tail, density = _student_tail(freedom, t)
        step = tail / (t * density) * math.log(tail / above)
        t *= math.exp(step)
        if abs(step) <= _EXACT:
            break
    return t


def _of_many(freedom: float, normal: float) -> float:
    """Student's quantile from the normal one (Abramowitz and Stegun 1964, 26.7.5)."""
    z = normal * normal
    terms = (
        (z + 1) / 4,
        ((5 * z + 16) * z + 3) / 96,
        (((3 * z + 19) * z + 17) * z - 15) / 384,
        ((((79 * z + 776) * z + 1482) * z - 1920) * z - 945) / 92160,
    )
    return normal * (1 + sum(term / freedom**power for power, term in enumerate(terms, 1)))


def _student_tail(freedom: float, t: float) -> tuple[float, float]:
    """Probability of Student's distribution beyond t > 0, and its density there."""
    # With t = sqrt(n) tan(u) the density is c cos(u)^(n - 1) du.
    log_scale = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - math.log(math.pi) / 2
    log_cosine = -math.log1p(t * t / freedom) / 2
    density = math.exp(log_scale + (freedom + 1) * log_cosine) / math.sqrt(freedom)
    a, x = freedom / 2, math.exp(2 * log_cosine)
    if x < (a + 1) / (a + 2.5):
        return density * t / freedom * _beta_fraction(a, 0.5, x), density
    end = math.atan(t / math.sqrt(freedom))
    places = end / 2 * (1 + _NODES)
    part = end / 2 * float(_WEIGHTS @ np.cos(places) ** (freedom - 1))
    return 0.5 - math.exp(log_scale) * part, density


def _beta_fraction(a: float, b: float, x: float) -> float:
    """Continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method."""
    upper, lower, value = 1.0, 0.0, 1.0
    for count in range(1, 2 * _STEPS):
        m, is_odd = divmod(count, 2)
        if is_odd:
            term = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        else:
            term = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        lower = 1 / (1 + term * lower)
        upper = 1 + term / upper
        value *= upper * lower
        if abs(upper * lower - 1) <= _EXACT:
            break
    return 1 / value


def chi_square_exceedance(value: float, degrees: int) -> float:
    """Probability that a chi-square of an even number of degrees of freedom exceeds a value.

    >>> round(chi_square_exceedance(18.307038, 10), 6)
    0.05
    """
    if value <= 0:
        return 1.0
    # A sum of Poisson's probabilities (Abramowitz and Stegun 1964, 26.4.21).
    counts = np.arange(degrees // 2)
    factorials: Floats = np.append(0.0, np.cumsum(np.log(counts[1:])))
    logarithms = counts * math.log(value / 2) - factorials - value / 2
    return float(np.minimum(np.exp(logarithms).sum(), 1.0))
