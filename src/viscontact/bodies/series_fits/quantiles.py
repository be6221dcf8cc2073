"""Quantiles of Student's distribution, and exceedances of the chi-square one.

SciPy has both; to import its special functions takes as long as a fit.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats

#: Abscissae and weights of Gauss's rule between -1 and 1.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(96)
_NEWTON_STEPS = 200  # far more than needed: the distribution is concave above 0
_NORMAL = 1e6  # degrees of freedom from which on the distribution is the normal one to rounding


def student_quantile(freedom: float, probability: float) -> float:
    """Quantile of Student's distribution of `freedom` > 0 at a probability from 1/2 to below 1.

    >>> round(student_quantile(10.0, 0.975), 6)
    2.228139
    """
    freedom = min(freedom, _NORMAL)
    # With t = sqrt(n) tan(u) the density is c cos(u)^(n - 1) du.
    log_scale = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - math.log(math.pi) / 2
    scale, t = math.exp(log_scale), 0.0
    for _ in range(_NEWTON_STEPS):
        end = math.atan(t / math.sqrt(freedom))
        places = end / 2 * (1 + _NODES)
        part = scale * end / 2 * float(_WEIGHTS @ np.cos(places) ** (freedom - 1))
        density = scale / math.sqrt(freedom) * math.cos(end) ** (freedom + 1)
        step = (probability - 0.5 - part) / density
        t += step
        if abs(step) <= 1e-13 * t:
            break
    return t


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
