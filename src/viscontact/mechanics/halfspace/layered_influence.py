"""Influence coefficients of a uniformly loaded rectangle on layers.

K = L(∞) times Love's coefficients of a half-space, plus the mean of the smooth correction Δ(r) over
the cell times its area (`smooth_kernel`). Near the cell, Δ may vary within it as fast as the layers
are thin. There the double integral is the double difference of F(X, Y) = T(X, Y) + T(Y, X) over the
corners, where the right triangle of legs X and Y with its tip at the origin contributes

    T(X, Y) = ∫_0^{asinh(Y/X)} M(X cosh t)/cosh t dt,   M(R) = ∫_0^R Δ(r) r dr:

with M = R/π, that of 1/(π r), this is Love's X asinh(Y/X)/π. The integrand is analytic in a strip
of half width π/2, whatever the thickness of the layers. Farther away, a Gauss rule over the cell.

Far away a surface is a half-space of L(0) times the compliance. Along a period the coefficients are
those of this half-space (`periodic_influence`), and the sum over the images of the rest f, which
decays exponentially on a rigid base and as c/r³ on an elastic one. The images of a period l beyond
a distance R, on both sides, add per unit area, by Euler's and Maclaurin's formula at midpoints,

    (2/l) ∫_R^∞ f dx - l B_2(1/2 + x/l) f'(R) - (l³/12) B_4(1/2 + x/l) f'''(R)

for an offset x along the period, with Bernoulli's polynomials (Abramowitz & Stegun 1964, 23.1.30).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.influence import FAR, influence_coefficient
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse

if TYPE_CHECKING:
    from viscontact.mechanics.halfspace.smooth_kernel import SmoothKernel

#: Gauss nodes over each piece of a triangle, and along each edge of a cell far away.
CORNER_RULE = np.polynomial.legendre.leggauss(24)
SHORT_RULE, CELL_RULE = (np.polynomial.legendre.leggauss(count) for count in (8, 3))

#: Longest piece of a triangle, over asinh(Y/X), and one for which fewer nodes do; distance of an
#: edge that counts as zero, in cells.
LONGEST_PIECE, SHORT_PIECE, ON_EDGE = 3.0, 0.6, 1e-12

#: Ratio of the distances up to which tables of the kernel reach, and its largest power.
REACHES, MOST_REACHES = 16.0, 7

#: Gauss nodes over each piece of the sum over far images, and relative step of a derivative there.
TAIL_RULE, SLOPE_STEP = np.polynomial.legendre.leggauss(6), 0.02

#: Rest of π r k(r) below which images are left out, and its part of L(0) below which they decay as
#: 1/r³; the farthest and the least distance of that in thicknesses.
REST_VANISHED, REST_DECAYED, FARTHEST, LEAST_REACH = 1e-12, 1e-4, 1e5, 1e3

#: Distance in thicknesses up to which images are summed one by one, and the fewest of them.
NEAR, LEAST_IMAGES = 40.0, 6


def layered_influence_table(
    shape: tuple[int, int], cell_size: tuple[float, float], response: SurfaceResponse
) -> Floats:
    """Influence coefficients [m] at i, j cells, per unit J of the response's half-space."""
    x = np.arange(shape[0], dtype=np.float64) * cell_size[0]
    return layered_influence_coefficient(x, shape[1], cell_size, response)


def layered_influence_coefficient(
    x: Floats, ny: int, cell_size: tuple[float, float], response: SurfaceResponse
) -> Floats:
    """Influence coefficients [m] at offsets x [m] and of j < ny cells along y, (nx, ny)."""
    y = np.arange(ny, dtype=np.float64) * cell_size[1]
    table = response.short_waves * influence_coefficient(x[:, None], y[None, :], cell_size)
    if math.isinf(response.length):
        return table
    return table + correction_coefficient(x, ny, cell_size, response)


def periodic_layered_table(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    response: SurfaceResponse,
    datum: float,
) -> Floats:
    """Influence coefficients [m] of a period along x at offsets of i and j cells, shape (nx, ny).

    On a rigid base they need no datum; on a half-space displacement is zero at the distance `datum`
    [m] of a line load. One cell along x is a strip without end.
    """
    y = np.arange(shape[1], dtype=np.float64) * cell_size[1]
    half = periodic_layered_coefficient(shape[0], y, cell_size, response, datum)
    offsets = np.arange(shape[0])
    return half[np.minimum(offsets, shape[0] - offsets)]


def periodic_layered_coefficient(
    nx: int,
    y: Floats,
    cell_size: tuple[float, float],
    response: SurfaceResponse,
    datum: float,
) -> Floats:
    """Influence coefficients [m] of a period of nx cells at offsets y [m], (nx // 2 + 1, y)."""
    dx, dy = cell_size
    if nx == 1:
        dx = dy  # pieces of any length make the strip
    table = np.zeros((nx // 2 + 1, y.size))
    places = np.arange(nx // 2 + 1, dtype=np.float64)[:, None] * dx
    if response.long_waves:
        far = halfspace.periodic_influence_coefficient(places, y[None, :], (dx, dy), nx * dx, datum)
        table += response.long_waves * far
    if math.isinf(response.length):
        return table
    if nx == 1:
        return table + halfspace.strip_coefficient(y, dy, response)
    period = nx * dx
    reach, cubic = _reach_of_rest(response, period)
    images = math.ceil(max(min(reach, NEAR * response.length), LEAST_IMAGES * period) / period)
    count = nx * images + nx // 2 + 1
    rest = layered_influence_coefficient(y, count, (dy, dx), response)
    if response.long_waves:
        along = np.arange(count) * dx
        rest -= response.long_waves * influence_coefficient(y[:, None], along, (dy, dx))
    # Offsets i + m nx of all images, those of x < 0 by symmetry.
    offsets = np.abs(np.arange(-images, images + 1)[:, None] * nx + np.arange(nx // 2 + 1))
    folded = rest.T[offsets].sum(axis=0)
    last = (images + 0.5) * period
    cells = (places[:, 0], y)
    folded += dx * dy * _images_beyond(last, (reach, cubic), cells, (dx, dy), period, response)
    return np.asarray(table + folded)


def _images_beyond(
    last: float,
    far: tuple[float, float],
    offsets: tuple[Floats, Floats],
    cell_size: tuple[float, float],
    period: float,
    response: SurfaceResponse,
) -> Floats:
    """Sum of the rest over the images beyond a distance `last`, mean over cells [1/m].

    `far`: where the decay as c/r³ begins [m], and c [m²]; `offsets`: x and y of the cells [m].
    """
    (reach, cubic), (x, y), (nodes, weights) = far, offsets, CELL_RULE
    end = max(reach, last)
    kernel = halfspace.smooth_kernel.smooth_kernel(response, 2 * (end + float(np.abs(y).max())))
    excess = response.long_waves - response.short_waves
    north = y + nodes[:, None] * cell_size[1] / 2

    def rest(along: Floats | float) -> Floats:
        r = np.hypot(along, north)
        return np.asarray(weights @ (kernel.value(r) - excess / (np.pi * r)) / 2)

    # Panels that grow with the distance.
    total = np.zeros(y.shape)
    edges = np.geomspace(last, end, 2 + int(4 * math.log(end / last)))
    for begin, stop in pairwise(edges):
        for node, weight in zip(*TAIL_RULE, strict=True):
            total += (stop - begin) / 2 * weight * rest((begin + stop + node * (stop - begin)) / 2)
    total += cubic / (end * np.hypot(end, y) + end**2 + y**2)
    # Euler's and Maclaurin's corrections, with derivatives by central differences.
    step = SLOPE_STEP * last
    two_back, back, on, two_on = (rest(last + k * step) for k in (-2, -1, 1, 2))
    first = (8 * (on - back) - (two_on - two_back)) / (12 * step)
    third = ((two_on - two_back) - 2 * (on - back)) / (2 * step**3)
    place = 0.5 + (x + nodes[:, None] * cell_size[0] / 2) / period
    second_polynomial = weights @ (place**2 - place + 1 / 6) / 2
    fourth_polynomial = weights @ (place**4 - 2 * place**3 + place**2 - 1 / 30) / 2
    corrections = np.outer(period * second_polynomial, first)
    corrections += np.outer(period**3 / 12 * fourth_polynomial, third)
    return np.asarray(2 / period * total - corrections)


def _reach_of_rest(response: SurfaceResponse, period: float) -> tuple[float, float]:
    """Distance up to which images of the rest are summed [m], and c of its decay c/r³ [m²]."""
    distances = response.length * np.geomspace(1.0, FARTHEST, 200)
    kernel = halfspace.smooth_kernel.smooth_kernel(
        response, max(2 * distances[-1], LEAST_IMAGES * period)
    )
    excess = response.long_waves - response.short_waves
    rest = np.pi * distances * kernel.value(distances) - excess
    least = max(REST_VANISHED, REST_DECAYED * min(response.long_waves, np.abs(rest).max()))
    above = np.flatnonzero(np.abs(rest) > least)
    place = min(above[-1] + 1, distances.size - 1) if above.size else 0
    reach = max(float(distances[place]), LEAST_IMAGES * period)
    if not response.long_waves:
        return reach, 0.0
    reach = max(reach, LEAST_REACH * response.length)
    # c of c/r³ + d/r⁵ through the values at two distances.
    two = reach / np.array([1.0, 2.0])
    first, second = (kernel.value(two) - excess / (np.pi * two)) * two**3
    return reach, float(4 * first - second) / 3


def correction_coefficient(
    x: Floats, ny: int, cell_size: tuple[float, float], response: SurfaceResponse
) -> Floats:
    """Integrals of Δ over cells at any offsets x [m] and of j < ny cells along y [m]."""
    dy, x = cell_size[1], np.abs(x)
    kernel = halfspace.smooth_kernel.smooth_kernel(
        response, table_reach(x, ny, cell_size, response.length)
    )
    is_near = x <= FAR * max(cell_size)
    ny_near = min(ny, int(FAR * max(cell_size) / dy) + 1)
    y = np.arange(ny, dtype=np.float64) * dy
    table = np.empty((x.size, ny))
    table[~is_near] = _gauss(kernel, x[~is_near], y, cell_size)
    table[is_near, ny_near:] = _gauss(kernel, x[is_near], y[ny_near:], cell_size)
    if is_near.any():
        table[is_near, :ny_near] = _by_corners(kernel, x[is_near], ny_near, cell_size)
    return table


def table_reach(x: Floats, ny: int, cell_size: tuple[float, float], length: float) -> float:
    """Reach of a table for cells at offsets up to x and ny cells along y [m]."""
    # Tables are kept: one for all grids of similar extent.
    dx, dy = cell_size
    farthest = math.hypot(float(x.max(initial=0.0)) + dx, (ny + 1) * dy) / length
    power = math.ceil(math.log(max(farthest, 1.0)) / math.log(REACHES))
    return length * REACHES ** min(power, MOST_REACHES)


def _gauss(kernel: SmoothKernel, x: Floats, y: Floats, cell_size: tuple[float, float]) -> Floats:
    """Gauss rule over cells around x, y."""
    (dx, dy), total = cell_size, np.zeros((x.size, y.size))
    for node_x, weight_x in zip(*CELL_RULE, strict=True):
        for node_y, weight_y in zip(*CELL_RULE, strict=True):
            r = np.hypot((x + node_x * dx / 2)[:, None], (y + node_y * dy / 2)[None, :])
            total += weight_x * weight_y * kernel.value(r)
    return np.asarray(total * (dx * dy / 4))


def _by_corners(kernel: SmoothKernel, x: Floats, ny: int, cell_size: tuple[float, float]) -> Floats:
    """Double differences of F over the corners of cells around x and of j < ny cells along y."""
    dx, dy = cell_size
    edges = np.concatenate([x + dx / 2, x - dx / 2])
    distances, places = np.unique(np.maximum(np.abs(edges), ON_EDGE * dx), return_inverse=True)
    sides = np.arange(0.5, ny) * dy
    corners = triangles(kernel, distances, sides) + triangles(kernel, sides, distances).T
    # F is odd in X and in Y: that of the corner at -1/2 cells is that of the first, reversed.
    corners = np.sign(edges)[:, None] * corners[places]
    over_x = corners[: x.size] - corners[x.size :]
    return np.diff(over_x, axis=1, prepend=-over_x[:, :1])


def triangles(
    kernel: SmoothKernel,
    near: Floats,
    along: Floats,
    turn: Callable[[Floats], Floats] | None = None,
) -> Floats:
    """T(X, Y) of ascending X (`near`, rows) and Y (`along`, columns).

    `turn` is a factor of the kernel by the direction, a function of t with Y/X = sinh t.
    """
    # Pieces from zero on, each short enough for the rule.
    first = math.asinh(float(along[0]) / float(near[0]))
    before = along[0] * np.exp(-LONGEST_PIECE * np.arange(int(first / LONGEST_PIECE), 0, -1))
    ends = np.arcsinh(np.append(before, along)[None, :] / near[:, None])
    starts = np.concatenate([np.zeros((near.size, 1)), ends[:, :-1]], axis=1)
    middle, half = (ends + starts) / 2, (ends - starts) / 2
    pieces = np.zeros(ends.shape)
    short = half.max(axis=0) <= SHORT_PIECE / 2
    for columns, rule in ((~short, CORNER_RULE), (short, SHORT_RULE)):
        for node, weight in zip(*rule, strict=True):
            place = middle[:, columns] + node * half[:, columns]
            grown = np.cosh(place)
            moments = kernel.moment(near[:, None] * grown)
            turned = moments if turn is None else moments * turn(place)
            pieces[:, columns] += weight * half[:, columns] * turned / grown
    return np.asarray(np.cumsum(pieces, axis=1)[:, before.size :])
