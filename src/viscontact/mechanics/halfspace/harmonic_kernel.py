"""Kernels cos(m φ) Δ_m(r), sin(m φ) Δ_m(r) of layers under shear, and their integrals over cells.

With the rest beyond short waves of a ratio L(q) of `layered_shear`,

    Δ_m(r) = (1/π) ∫_0^∞ [L(q) - L(∞)] J_m(q r) dq.

As J_2(z) = 2 J_1(z)/z - J_0(z), and r J_1(q r)/q is the integral of J_0(q r) r over r, both follow
from tables of `smooth_kernel`, with the moment M(r) = ∫_0^r Δ_0 r' dr':

    Δ_2 = 2 M/r² - Δ_0,   Δ_1 = M_1/r,

where M_1 is the moment of the kernel of q L. Over a rectangle that begins at the origin the
integral is that over two triangles, as in `layered_influence`: at t on the edge the direction from
the origin has the cosine 1/cosh t with the leg, and the sine tanh t.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.influence import FAR
from viscontact.mechanics.halfspace.layered_influence import (
    CELL_RULE,
    ON_EDGE,
    table_reach,
    triangles,
)
from viscontact.mechanics.halfspace.layered_shear import CouplingSlope, LayeredShear, ShearComponent
from viscontact.mechanics.halfspace.smooth_kernel import (
    SmoothKernel,
    kernel_of,
    smooth_kernel,
    table_places,
)


@dataclass(frozen=True)
class Harmonic:
    """Factor of a kernel by the direction."""

    along_x: Callable[[Floats], Floats]  # over t, in the triangle whose leg lies along x
    along_y: Callable[[Floats], Floats]
    odd: tuple[bool, bool]  # in x and in y
    at: Callable[[Floats, Floats], Floats]  # in the direction of unit vectors x, y


COS_2 = Harmonic(
    lambda t: 2 / np.cosh(t) ** 2 - 1,
    lambda t: 1 - 2 / np.cosh(t) ** 2,
    (False, False),
    lambda x, y: x * x - y * y,
)
SIN_2 = Harmonic(
    lambda t: 2 * np.tanh(t) / np.cosh(t),
    lambda t: 2 * np.tanh(t) / np.cosh(t),
    (True, True),
    lambda x, y: 2 * x * y,
)
COS_1 = Harmonic(lambda t: 1 / np.cosh(t), np.tanh, (True, False), lambda x, y: x)


@lru_cache(maxsize=32)
def split_kernel(response: LayeredShear, reach: float) -> SmoothKernel:
    """Δ_2 of (B - A)/2, for distances up to `reach` [m]."""
    zero = smooth_kernel(ShearComponent(response, -0.5, 0.5), reach)
    r = response.length * np.sinh(table_places(response.length, reach))
    values = 2 * zero.moment(r) / r**2 - zero.value(r)
    return kernel_of(response.length, reach, values * response.length)


@lru_cache(maxsize=32)
def coupling_kernel(response: LayeredShear, reach: float) -> SmoothKernel:
    """Δ_1 of D, for distances up to `reach` [m]."""
    slope = smooth_kernel(CouplingSlope(response), reach)
    r = response.length * np.sinh(table_places(response.length, reach))
    return kernel_of(response.length, reach, slope.moment(r) / r, sign=-1)


def harmonic_coefficient(
    kernel: Callable[[float], SmoothKernel],
    harmonic: Harmonic,
    x: Floats,
    ny: int,
    cell_size: tuple[float, float],
    length: float,
) -> Floats:
    """Integrals over cells at offsets x >= 0 [m] and of j < ny cells along y, shape (nx, ny).

    `kernel` makes a table up to a reach.
    """
    y = np.arange(ny, dtype=np.float64) * cell_size[1]
    table = kernel(table_reach(x, ny, cell_size, length))
    is_near = x <= FAR * max(cell_size)
    near_y = min(ny, int(FAR * max(cell_size) / cell_size[1]) + 1)
    found = np.empty((x.size, ny))
    found[~is_near] = _gauss(table, harmonic, x[~is_near], y, cell_size)
    found[is_near, near_y:] = _gauss(table, harmonic, x[is_near], y[near_y:], cell_size)
    if is_near.any():
        found[is_near, :near_y] = _by_corners(table, harmonic, x[is_near], near_y, cell_size)
    return found


def _gauss(
    kernel: SmoothKernel, harmonic: Harmonic, x: Floats, y: Floats, cell_size: tuple[float, float]
) -> Floats:
    """Gauss rule over cells around x, y."""
    (dx, dy), total = cell_size, np.zeros((x.size, y.size))
    for node_x, weight_x in zip(*CELL_RULE, strict=True):
        for node_y, weight_y in zip(*CELL_RULE, strict=True):
            here, there = (x + node_x * dx / 2)[:, None], (y + node_y * dy / 2)[None, :]
            r = np.hypot(here, there)
            total += weight_x * weight_y * harmonic.at(here / r, there / r) * kernel.value(r)
    return np.asarray(total * (dx * dy / 4))


def _by_corners(
    kernel: SmoothKernel,
    harmonic: Harmonic,
    x: Floats,
    ny: int,
    cell_size: tuple[float, float],
) -> Floats:
    """Double differences over the corners of cells of the integral from the origin."""
    dx, dy = cell_size
    edges = np.concatenate([x + dx / 2, x - dx / 2])
    distances, places = np.unique(np.maximum(np.abs(edges), ON_EDGE * dx), return_inverse=True)
    sides = np.arange(0.5, ny) * dy
    corners = triangles(kernel, distances, sides, harmonic.along_x)
    corners = corners + triangles(kernel, sides, distances, harmonic.along_y).T
    # The integral from the origin to a corner is odd of an even kernel, and reversed.
    odd_x, odd_y = harmonic.odd
    signs = np.ones(edges.shape) if odd_x else np.sign(edges)
    corners = signs[:, None] * corners[places]
    over_x = corners[: x.size] - corners[x.size :]
    first = over_x[:, :1]
    return np.diff(over_x, axis=1, prepend=first if odd_y else -first)
