"""Bessel functions of arrays, without the modules that those of SciPy take to load.

References
----------
M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), chapters 9 and 10.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev, polynomial
from numpy.polynomial.legendre import leggauss, legvander

from viscontact.backend.arrays import Floats

#: Argument up to which K_0 and K_1 are power series, and terms of these; terms of the Chebyshev
#: series in 1/x beyond.
NEAR, TERMS, BEYOND = 2.0, 10, 18

#: Step and end of the integral that gives the latter, by the trapezium rule.
STEP, END = 0.05, 5.0

#: Arguments up to which spherical Bessel functions are a power series, and terms of it; above, up
#: to their number, Gauss's rule gives them.
SMALL, SMALL_TERMS = 0.7, 8


def modified_bessel(x: Floats) -> tuple[Floats, Floats]:
    """K_0 and K_1 at places x > 0.

    >>> print([f"{float(each):.9f}" for each in modified_bessel(np.array(1.0))])
    ['0.421024438', '0.601907230']
    """
    order_0, order_1 = np.empty(x.shape), np.empty(x.shape)
    near = x <= NEAR
    order_0[near], order_1[near] = _near(x[near])
    far = x[~near]
    place = 2 * NEAR / far - 1
    decay = np.exp(-far) / np.sqrt(far)
    series = _beyond()
    order_0[~near] = decay * chebyshev.chebval(place, series[:, 0])
    order_1[~near] = decay * chebyshev.chebval(place, series[:, 1])
    return order_0, order_1


def _near(x: Floats) -> tuple[Floats, Floats]:
    """K_0 and K_1 by their power series (eq. 9.6.13 and 9.6.11)."""
    k = np.arange(TERMS)
    factorials = np.array([math.factorial(each) for each in range(TERMS + 1)], dtype=np.float64)
    harmonic = np.append(0.0, np.cumsum(1 / np.arange(1.0, TERMS + 1)))
    squared, logarithm = x**2 / 4, np.log(x / 2) + np.euler_gamma
    zeroth, first = 1 / factorials[:-1] ** 2, 1 / (factorials[:-1] * factorials[1:])
    order_0 = polynomial.polyval(squared, zeroth * harmonic[:-1])
    order_0 -= logarithm * polynomial.polyval(squared, zeroth)
    order_1 = polynomial.polyval(squared, first * (harmonic[k] + harmonic[k + 1]) / 2)
    order_1 = 1 / x + x / 2 * (logarithm * polynomial.polyval(squared, first) - order_1)
    return order_0, np.asarray(order_1)


@lru_cache(maxsize=1)
def _beyond() -> Floats:
    """Chebyshev series of sqrt(x) e^x K_0 and K_1 in 4/x - 1; shape (terms, 2)."""
    # ∫ exp(-x (cosh t - 1)) cosh(n t) dt from 0 on (eq. 9.6.24).
    angles = np.pi * (np.arange(BEYOND) + 0.5) / BEYOND
    x = 2 * NEAR / (1 + np.cos(angles))[:, None]
    t = np.arange(0.0, END, STEP)
    # Of the lengths on which the integrand decays.
    scaled = 2 * np.arcsinh(t / np.sqrt(2 * x))
    weights = STEP * 2 / np.sqrt(2 * x + t**2) * np.exp(-(t**2))
    weights[:, 0] /= 2
    values = np.sqrt(x) * np.stack([weights, weights * np.cosh(scaled)]).sum(axis=2)[..., None]
    transform = 2 / BEYOND * np.cos(np.outer(np.arange(BEYOND), angles))
    transform[0] /= 2
    return np.asarray(transform @ values[..., 0].T)


def spherical_bessel(count: int, x: Floats) -> Floats:
    """Spherical Bessel functions j_0 to j_(count - 1) at places x >= 0; shape (..., count).

    >>> print([f"{float(each):.9f}" for each in spherical_bessel(3, np.array([1.0]))[0]])
    ['0.841470985', '0.301168679', '0.062035052']
    """
    flat = x.ravel()
    found = np.empty((flat.size, count))
    small, large = flat <= SMALL, flat >= count
    found[small] = _small(count, flat[small])
    found[large] = _upward(count, flat[large])
    between = ~(small | large)
    found[between] = _by_quadrature(count, flat[between])
    return found.reshape(*x.shape, count)


def _small(count: int, x: Floats) -> Floats:
    """The same by the power series (eq. 10.1.2)."""
    squared, found = x**2 / 2, np.empty((x.size, count))
    power = np.ones(x.shape)
    for order in range(count):
        terms = np.cumprod(
            [1.0] + [-1 / (k * (2 * (order + k) + 1)) for k in range(1, SMALL_TERMS)]
        )
        found[:, order] = power * polynomial.polyval(squared, terms)
        power = power * x / (2 * order + 3)
    return found


def _upward(count: int, x: Floats) -> Floats:
    """The same by recurrence, which is stable where no order exceeds the place (eq. 10.1.19)."""
    found = np.empty((count + 1, x.size))
    found[0] = np.sin(x) / x
    found[1] = (found[0] - np.cos(x)) / x
    for order in range(1, count - 1):
        found[order + 1] = (2 * order + 1) / x * found[order] - found[order - 1]
    return found[:count].T


def _by_quadrature(count: int, x: Floats) -> Floats:
    """The same as transforms of Legendre's polynomials (eq. 10.1.14)."""
    places, weights = leggauss(count + 20 + count % 2)  # an even number: none in the middle
    positive = places > 0
    places, weights = places[positive], weights[positive]
    polynomials = legvander(places, count - 1) * weights[:, None]
    # i^-n of exp(i x t) is real for a polynomial that is even or odd.
    signs = np.array([1.0, 1.0, -1.0, -1.0])[np.arange(count) % 4]
    angles = np.multiply.outer(x, places)
    found = np.empty((x.size, count))
    found[:, ::2] = np.cos(angles) @ (polynomials * signs)[:, ::2]
    found[:, 1::2] = np.sin(angles) @ (polynomials * signs)[:, 1::2]
    return found
