"""Rows of cells whose influence is analytic, so that a few of them give all, by polynomials."""

from __future__ import annotations

import math

import numpy as np
import scipy

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass

#: Points of a polynomial. Over a length that is as long as the distance of its middle from a
#: singularity beside it, or twice as long as that from its end to one ahead of it, the error falls
#: by 2 + sqrt(5) or 2 + sqrt(3) with each point.
POINTS = 27


@dataclass(frozen=True, eq=False)
class SampledCells:
    """Cells that stand for all of a row."""

    edges: Floats  # [m]
    cells: Integers  # which of the intervals between the edges are cells
    weights: Floats | None = None  # of their values, for all, shape (all, samples); None for all

    @property
    def centres(self) -> Floats:
        """Middles of the cells [m]."""
        return np.asarray(self.edges[self.cells] + self.edges[self.cells + 1]) / 2

    def at_all(self, values: Floats, *, axis: int) -> Floats:
        """Values at all cells along an axis, the second or the third of three, from these."""
        if self.weights is None:
            return values
        return np.asarray(values @ self.weights.T if axis == 2 else self.weights @ values)


def sampled_cells(edges: Floats, length: float) -> SampledCells:
    """Chebyshev's points of parts of a length [m] as cells, or all cells if these are few."""
    # J.-P. Berrut, L. N. Trefethen, SIAM Rev. 46 (2004) 501, eqs. 4.2 and 5.4.
    count = edges.size - 1
    parts = math.ceil(abs(float(edges[-1] - edges[0])) / length) if length > 0 else count
    if count <= 2 * parts * POINTS:  # a cell beside others has one edge more, one alone has two
        return SampledCells(edges, np.arange(count))
    centres, half = (edges[:-1] + edges[1:]) / 2, (edges[1] - edges[0]) / 2
    points, blocks = [], []
    for part in np.array_split(centres, parts):
        middle, reach = (part[0] + part[-1]) / 2, (part[-1] - part[0]) / 2
        points.append(middle + reach * np.cos(np.pi * np.arange(POINTS) / (POINTS - 1)))
        blocks.append(_barycentric(part, points[-1]))
    pairs = np.add.outer(np.concatenate(points), [-half, half]).ravel()
    weights = scipy.linalg.block_diag(*blocks)
    return SampledCells(pairs, 2 * np.arange(weights.shape[1]), weights)


def _barycentric(places: Floats, points: Floats) -> Floats:
    """Weights of values at Chebyshev's points, for the polynomial at some places."""
    signs = (-1.0) ** np.arange(points.size)
    signs[[0, -1]] /= 2
    distances = np.subtract.outer(places, points)
    exact = distances == 0
    terms = signs / np.where(exact, 1.0, distances)
    weights = terms / terms.sum(axis=1, keepdims=True)
    at_points = exact.any(axis=1)
    weights[at_points] = exact[at_points]
    return np.asarray(weights)
