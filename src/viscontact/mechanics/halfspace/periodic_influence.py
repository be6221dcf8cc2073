"""Influence coefficients of a rectangle that repeats along one axis.

A cell is loaded together with its periodic images along x, at distances of m periods l. Those of
|m| <= M are summed by Love's coefficients, and the others, of which 1/r is smooth, by the
Euler-Maclaurin formula from the middle between two images:

    Σ_{m > M} f(m) = ∫_{M+1/2}^∞ f dm + f'/24 - 7 f'''/5760 + 31 f⁽⁵⁾/967680 - ...,

with f = 1/r and the derivatives at m = M + 1/2. The integral diverges as the logarithm of its upper
limit, by the same amount at all places: there is no displacement at rest to count from. Without
that constant the sum decays as -(2/l) ln(|y|/d) far from the line of images, and d is the distance
at which displacement counts as zero.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), section 2.3: the datum of a half-plane.
M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), eqs. 23.1.30 and 25.4.2.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial import chebyshev

from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.influence import influence_coefficient

#: Gauss's rule over an edge of a cell, on [-1, 1], for what is smooth over it.
GAUSS_NODES, GAUSS_WEIGHTS = GAUSS = np.polynomial.legendre.leggauss(4)

#: The same over an edge that is short against a period, and the longest such edge over it: beyond
#: the images that are summed one by one, what is smooth is a cubic over it, to rounding.
SHORT_NODES, SHORT_WEIGHTS = np.polynomial.legendre.leggauss(2)
SHORT = 1 / 32

#: Images on either side that are summed one by one: at least these, and up to this many lengths of
#: a cell across.
IMAGES = 6

#: Images on either side that are found at all places, and Chebyshev's nodes for each distance of
#: the next ones, at which they and those beyond are found.
NEAR_IMAGES, FAR_NODES = 1, 14

#: Factors of the first, third, ... derivative in the Euler-Maclaurin formula from the middle.
MIDDLE_FACTORS = ((1, 1 / 24), (3, -7 / 5760), (5, 31 / 967680), (7, -127 / 154828800))


def periodic_influence_coefficient(
    x: Floats,
    y: Floats,
    cell_size: tuple[float, float],
    period: float,
    datum: float,
) -> Floats:
    """Influence coefficients [m] of a cell with its images along x at offsets x, y [m].

    `x` is at most half a period. Displacement is zero at the distance `datum` [m] of a line load.
    """
    images = max(IMAGES, math.ceil(IMAGES * cell_size[1] / period))
    table = _far_images(x, y, cell_size, period, images, datum)
    for image in range(-images, images + 1):
        table += influence_coefficient(x + image * period, y, cell_size)
    return table


def smooth_periodic_table(
    shape: tuple[int, int], cell_size: tuple[float, float], datum: float
) -> Floats:
    """Influence coefficients [m] of a period along x at offsets of i and j cells, shape (nx, ny).

    What is far is interpolated between Chebyshev's nodes, to rounding.
    """
    (nx, ny), (dx, dy) = shape, cell_size
    period, images = nx * dx, max(IMAGES, math.ceil(IMAGES * dy / (nx * dx)))
    x = np.arange(nx // 2 + 1, dtype=np.float64) * dx
    y = np.arange(ny, dtype=np.float64) * dy
    along, across = (_nodes_among(each, period) for each in (x, y))
    rule = (SHORT_NODES, SHORT_WEIGHTS) if max(dx, dy) < SHORT * period else GAUSS
    far = _far_images(along[:, None], across[None, :], cell_size, period, images, datum, rule)
    near = np.zeros((len(x), ny))
    for image in range(-images, images + 1):
        is_near = abs(image) <= NEAR_IMAGES
        places, others, into = (x, y, near) if is_near else (along, across, far)
        into += influence_coefficient(places[:, None] + image * period, others, cell_size)
    half = near + _between(x, along) @ far @ _between(y, across).T
    offsets = np.arange(nx)
    return np.asarray(half[np.minimum(offsets, nx - offsets)])


def _nodes_among(places: Floats, period: float) -> Floats:
    """Chebyshev's nodes over places for what varies over some periods, or all places [m]."""
    length = float(places[-1])
    count = FAR_NODES + FAR_NODES * math.ceil(length / ((NEAR_IMAGES + 0.5) * period))
    if 2 * count > len(places):
        return places
    angles = np.pi * (np.arange(count) + 0.5) / count
    return np.asarray(length / 2 * (1 - np.cos(angles)))


def _between(places: Floats, nodes: Floats) -> Floats:
    """Weights of values at Chebyshev's nodes in those at places, shape (places, nodes)."""
    if nodes is places:
        return np.eye(len(places))
    half = (nodes[-1] - nodes[0]) / (2 * math.cos(math.pi / (2 * len(nodes))))
    both = (chebyshev.chebvander(each / half - 1, len(nodes) - 1) for each in (nodes, places))
    known, wanted = both
    return np.asarray(wanted @ np.linalg.inv(known))


def _far_images(
    x: Floats,
    y: Floats,
    cell_size: tuple[float, float],
    period: float,
    images: int,
    datum: float,
    rule: tuple[Floats, Floats] = GAUSS,
) -> Floats:
    """Mean over the cell of the sums beyond the images on both sides, times its area over π."""
    dx, dy = cell_size
    total = np.zeros(np.broadcast_shapes(x.shape, y.shape))
    begin = (images + 0.5) * period
    for node_x, weight_x in zip(*rule, strict=True):
        for node_y, weight_y in zip(*rule, strict=True):
            east, north = x - node_x * dx / 2, y - node_y * dy / 2
            for along in (begin + east, begin - east):
                total += weight_x * weight_y / 4 * _tail(along, north, period, datum)
    return np.asarray(total * dx * dy / np.pi)


def _tail(along: Floats, across: Floats, period: float, datum: float) -> Floats:
    """Sum of 1/r from half a period after a place on, less its logarithm's upper limit [1/m]."""
    r = np.hypot(along, across)
    found = -np.log((along + r) / datum) / period
    for order, factor in MIDDLE_FACTORS:
        # d^n/dx^n (1/r) = (-1)^n n! P_n(x/r) / r^(n+1)
        derivative = -math.factorial(order) * _legendre(order, along / r) / r ** (order + 1)
        found += factor * period**order * derivative
    return np.asarray(found)


def _legendre(order: int, x: Floats) -> Floats:
    """P_n of an order >= 1, by differences of polynomials that follow each other."""
    # Without the special functions of SciPy, which take a tenth of a second to load.
    below = x - 1
    step, found = below, x
    for k in range(1, order):
        step = (2 * k + 1) / (k + 1) * below * found + k / (k + 1) * step
        found = step + found
    return np.asarray(found)
