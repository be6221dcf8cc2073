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

from viscontact.backend.arrays import Floats

#: Arguments up to which K_0 and K_1 are power series, with terms of these; terms of the Chebyshev
#: series in 1/x beyond.
NEAR, BEYOND = ((0.05, 4), (2.0, 10)), 18

#: Step and end of the integral that gives the latter, by the trapezium rule.
STEP, END = 0.05, 5.0

#: Orders beyond those asked for from which spherical Bessel functions are recurred down.
ORDERS_ABOVE = 16


def modified_bessel(x: Floats) -> tuple[Floats, Floats]:
    """K_0 and K_1 at places x > 0.

    >>> print([f"{float(each):.9f}" for each in modified_bessel(np.array(1.0))])
    ['0.421024438', '0.601907230']
    """
    order_0, order_1 = _of_orders(x, (0, 1))
    return order_0, order_1


def modified_bessel_0(x: Floats) -> Floats:
    """K_0 at places x > 0."""
    return _of_orders(x, (0,))[0]


def _of_orders(x: Floats, orders: tuple[int, ...]) -> list[Floats]:
    """K_n at places x > 0, for some of the orders 0 and 1."""
    found = [np.full(x.shape, np.nan) for _ in orders]
    least = 0.0
    for most, terms in NEAR:
        near = (x > least) & (x <= most)
        for values, order in zip(found, orders, strict=True):
            values[near] = _near(x[near], terms, order)
        least = most
    beyond = x > least
    far = x[beyond]
    place = 2 * least / far - 1
    decay, series = np.exp(-far) / np.sqrt(far), _beyond()
    for values, order in zip(found, orders, strict=True):
        values[beyond] = decay * chebyshev.chebval(place, series[:, order])
    return found


def _near(x: Floats, terms: int, order: int) -> Floats:
    """K_0 or K_1 by their power series (eq. 9.6.13 and 9.6.11)."""
    k = np.arange(terms)
    factorials = np.array([math.factorial(each) for each in range(terms + 1)], dtype=np.float64)
    harmonic = np.append(0.0, np.cumsum(1 / np.arange(1.0, terms + 1)))
    squared, logarithm = x**2 / 4, np.log(x / 2) + np.euler_gamma
    if order == 0:
        powers = 1 / factorials[:-1] ** 2
        regular = polynomial.polyval(squared, powers * harmonic[:-1])
        return np.asarray(regular - logarithm * polynomial.polyval(squared, powers))
    powers = 1 / (factorials[:-1] * factorials[1:])
    regular = polynomial.polyval(squared, powers * (harmonic[k] + harmonic[k + 1]) / 2)
    return np.asarray(1 / x + x / 2 * (logarithm * polynomial.polyval(squared, powers) - regular))


@lru_cache(maxsize=1)
def _beyond() -> Floats:
    """Chebyshev series of sqrt(x) e^x K_0 and K_1 in 4/x - 1; shape (terms, 2)."""
    # ∫ exp(-x (cosh t - 1)) cosh(n t) dt from 0 on (eq. 9.6.24).
    angles = np.pi * (np.arange(BEYOND) + 0.5) / BEYOND
    x = 2 * NEAR[-1][0] / (1 + np.cos(angles))[:, None]
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
    near = flat < count
    found[near], found[~near] = _downward(count, flat[near]), _upward(count, flat[~near])
    return found.reshape(*x.shape, count)


def _downward(count: int, x: Floats) -> Floats:
    """The same by recurrence from orders far above the place, where they vanish."""
    # Of j_n (2n + 1)!!/x^n, which neither overflows nor vanishes near 0 (eq. 10.1.19), up to a
    # factor that follows from the sum of (2n + 1) j_n² = 1 (eq. 10.1.50).
    last, squared = count + ORDERS_ABOVE, x**2
    found = np.empty((last + 2, x.size))
    found[last:] = 1.0
    for order in range(last, 0, -1):
        share = squared / ((2 * order + 1) * (2 * order + 3))
        found[order - 1] = found[order] - share * found[order + 1]
    power = np.ones(x.shape)
    for order in range(1, last + 1):
        power *= x / (2 * order + 1)
        found[order] *= power
    weights = 2 * np.arange(last + 1) + 1.0
    size = np.sqrt(np.einsum("n,nx,nx->x", weights, found[:-1], found[:-1]))
    return np.asarray((found[:count] / size).T)


def _upward(count: int, x: Floats) -> Floats:
    """The same by recurrence, which is stable where no order exceeds the place (eq. 10.1.19)."""
    found = np.empty((count + 1, x.size))
    found[0] = np.sin(x) / x
    found[1] = (found[0] - np.cos(x)) / x
    for order in range(1, count - 1):
        found[order + 1] = (2 * order + 1) / x * found[order] - found[order - 1]
    return found[:count].T
