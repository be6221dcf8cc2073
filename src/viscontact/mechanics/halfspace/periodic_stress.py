"""Stress influence coefficients of a rectangle that repeats along one axis.

The images of a cell at up to `IMAGES` periods are summed one by one. Those beyond, where the stress
f(m) of the image m is smooth, are replaced by the midpoint rule with two corrections,

    Σ_{m > M} f(m) = F + (1 - h²) δf/24 - (17 - 10 h² - 7 h⁴) δ³f/5760 + ...,

with the central differences δf, δ³f at m = M + 1/2. F is the stress of a strip that begins there
and has no end, with the cell's pressure spread over its period; h is the cell's part of the period.
The terms in h allow for the end of the strip, which is sharp instead of blurred over a cell, and
for differences in place of derivatives in the Euler-Maclaurin formula.
All terms are finite, unlike the displacement of such a row (`periodic_influence`).

Over a period, the sum of all images but the cell itself is an analytic function of the place, which
polynomials interpolate to rounding: it is evaluated at few points.

References
----------
M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), eq. 25.4.2.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.sampled_cells import SampledCells, sampled_cells
from viscontact.mechanics.halfspace.stress_response import StressResponse

#: Images on either side that are summed one by one.
IMAGES = 4

#: Length of a strip without end, in the largest of the other lengths.
ENDLESS = 1e10


def periodic_stress_coefficients(
    first: float,
    cells: int,
    edge: float,
    y_edges: Floats,
    depth: float,
    response: StressResponse,
    places: int | None = None,
) -> Floats:
    """Stress per unit load on cells repeated along x by `cells` edges [-], (6, places, ny).

    At points at x = first, first + edge, ... from a cell's centre [m], a period if `places` is
    None. Components xx, yy, zz, yz, xz, xy; the edges along y are equally spaced.
    """
    count = cells if places is None else places

    def at(x_edges: Floats, across: Floats) -> Floats:
        # The edges rise along x, so that the first difference has the other sign.
        return -response.coefficients(x_edges, across, depth)

    # 1. The cell itself.
    x_edges = first + (np.arange(count + 1, dtype=np.float64) - 0.5) * edge
    found = at(x_edges, y_edges)
    # 2. The others, whose sum is smooth: at some points, and between them by polynomials.
    clearance = cells * edge - float(np.abs(x_edges).max())
    x, y = sampled_cells(x_edges, 2 * clearance), sampled_cells(y_edges, clearance)
    beyond = _image_stresses(at, x, y, edge, cells, depth)
    return found + x.at_all(y.at_all(beyond, axis=2), axis=1)


def _image_stresses(
    at: Callable[[Floats, Floats], Floats],
    x: SampledCells,
    y: SampledCells,
    edge: float,
    cells: int,
    depth: float,
) -> Floats:
    """Stresses of all images but the cell itself, shape (6, samples along x, along y)."""
    period = cells * edge
    images = np.arange(-IMAGES - 2, IMAGES + 3, dtype=np.float64)
    weights, others = _weights(1 / cells), images != 0
    # 1. The images nearby, and those that the correction takes.
    shifted = np.add.outer(images[others] * period, x.edges)
    places = np.add.outer(np.arange(len(shifted)) * x.edges.size, x.cells)
    near = at(shifted.ravel(), y.edges)[:, :, y.cells][:, places]
    found = np.einsum("cmxy,m->cxy", near, weights[others])
    # 2. The strips beyond, from each place on.
    begin = (IMAGES + 0.5) * period
    endless = ENDLESS * max(period, depth, float(np.abs(y.edges).max()))
    far = np.full(x.cells.size, endless)
    for lower, upper in ((x.centres + begin, far), (-far, x.centres - begin)):
        strips = at(np.stack([lower, upper], axis=1).ravel(), y.edges)
        found += strips[:, ::2, y.cells] / cells
    return np.asarray(found)


def _weights(part: float) -> Floats:
    """Weights of the images from one side to the other, the corrections of both ends included."""
    slope, third = (1 - part**2) / 24, -(17 - 10 * part**2 - 7 * part**4) / 5760
    end = np.array([-third, -slope + 3 * third, slope - 3 * third, third])
    weights = np.ones(2 * IMAGES + 5)
    weights[:2] = weights[-2:] = 0.0
    weights[-4:] += end
    weights[:4] += end[::-1]
    return weights
