"""Legendre's series of a pressure over each cell, and cells that act as it does from a distance.

In a cell p = Σ c_ab P_a(ξ) P_b(η), with ξ and η from -1 to 1. From a distance the sum to the third
order acts as multipoles do; these are made of cells of uniform pressure, the cell itself and two
on each side, by differences of fourth order: one convolution with the coefficients of the surface
takes them all.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats

#: Orders of the terms P_a P_b, those of the multipoles first: along x and along y.
MULTIPOLES = tuple((a, b) for a in range(4) for b in range(4 - a))
ORDERS = (
    *MULTIPOLES,
    *((a, b) for a in range(7) for b in range(7 - a) if a + b > 3),
)

#: Cells on each side of one which carry its multipoles.
CARRIERS = 2


def legendre_to(order: int, place: Floats) -> Floats:
    """Legendre's polynomials P_0 to P_n at places from -1 to 1, in a first dimension."""
    return np.array(np.moveaxis(np.polynomial.legendre.legvander(place, order), -1, 0))


def _differences() -> Floats:
    """Pressures in a row of cells with one moment ∫ p ξ^k dξ/2 of 1, and none of the others.

    For k = 0 it is the cell itself, which has others, too. Shape (4, 5).
    """
    count = 2 * CARRIERS + 1
    borders = 2 * np.arange(-CARRIERS, CARRIERS + 2) - 1.0
    moments = [
        (borders[1:] ** (k + 1) - borders[:-1] ** (k + 1)) / (2 * (k + 1)) for k in range(count)
    ]
    found = np.linalg.solve(np.array(moments), np.eye(count)).T[:4].copy()
    found[0] = np.eye(count)[CARRIERS]
    return np.asarray(found)


def stencils() -> Floats:
    """Pressures of cells around one that act as P_a P_b in it does, shape (10, 5, 5).

    >>> print(stencils()[0].sum(), np.abs(stencils()[1:].sum(axis=(1, 2))).max() < 1e-12)
    1.0 True
    """
    rows = _differences()
    by_moments = {(a, b): np.outer(rows[a], rows[b]) for a, b in MULTIPOLES}
    nodes, weights = np.polynomial.legendre.leggauss(4)
    powers = nodes ** np.arange(4)[:, None] * weights / 2
    #: Moments of P_a along one axis, and those that the cell itself has as the carrier of order 0.
    own = legendre_to(3, nodes) @ powers.T
    found = []
    for a, b in MULTIPOLES:
        left = {(k, m): own[a, k] * own[b, m] for k, m in MULTIPOLES}
        total = np.zeros((2 * CARRIERS + 1, 2 * CARRIERS + 1))
        for k, m in sorted(left, key=sum):
            share = left[k, m]
            total += share * by_moments[k, m]
            for more, n in MULTIPOLES:  # moments of the cell itself along the other axis
                along = own[0, more] if k == 0 else float(more == k)
                across = own[0, n] if m == 0 else float(n == m)
                left[more, n] -= share * along * across
        found.append(total)
    return np.array(found)
