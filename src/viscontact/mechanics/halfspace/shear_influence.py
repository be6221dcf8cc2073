"""Influence coefficients of a rectangle under uniform shear (Boussinesq and Cerruti).

A shear traction q (of the body on the half-space) displaces the surface of a half-space of contact
compliance J and Poisson's ratio ν along itself by

    u = (J/π) ∫∫ [1/r + κ (r r^T)/r³] q dx' dy',    κ = ν/(1 - ν),

so each component is that of a pressure, and a part by κ. For a unit traction on a rectangle around
the origin and J = 1, the second part has the coefficients

    X(x, y) = (1/π) ∫∫ x²/r³ dx' dy',   Y = (1/π) ∫∫ y²/r³ dx' dy' = K - X,
    Z(x, y) = (1/π) ∫∫ x y/r³ dx' dy',

with Love's K of 1/r. Their primitives in x and y are y asinh(x/|y|) and -r. Of a rectangle that
repeats along an axis, the images near by are summed one by one, the others as in
`periodic_influence`.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), section 3.6, eqs. 3.91a and 3.91b.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import scipy  # its special functions are imported at their first use

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.periodic_influence import (
    GAUSS_NODES,
    GAUSS_WEIGHTS,
    IMAGES,
    MIDDLE_FACTORS,
    periodic_influence_coefficient,
)

#: Beyond this many cell edges Gauss's rule over the cell is exact to 1e-12, while the difference of
#: four corner terms cancels.
FAR = 20.0


@dataclass(frozen=True, eq=False)
class PairTables:
    """Coefficients [m] at i, j >= 0 cells from a cell under tractions, each of shape (nx, ny)."""

    along_x: Floats  # of x to x
    cross: Floats  # of x to y and reversed: odd along both axes
    along_y: Floats  # of y to y

    def within(self, shape: tuple[int, int]) -> PairTables:
        """The part for a smaller block of cells."""
        nx, ny = shape
        return PairTables(self.along_x[:nx, :ny], self.cross[:nx, :ny], self.along_y[:nx, :ny])


@dataclass(frozen=True, eq=False)
class ShearTables:
    """Influence coefficients [m] at i, j >= 0 cells from a loaded cell, each of shape (nx, ny)."""

    direct: Floats  # K, of 1/r
    along_x: Floats  # X, of x²/r³
    cross: Floats  # Z, of x y/r³: odd along both axes
    corrections: tuple[PairTables, ...] = ()  # of layers, beyond those of a half-space

    @property
    def along_y(self) -> Floats:
        """Y, of y²/r³."""
        return self.direct - self.along_x

    def within(self, shape: tuple[int, int]) -> ShearTables:
        """The part for a smaller block of cells."""
        nx, ny = shape
        return ShearTables(
            self.direct[:nx, :ny],
            self.along_x[:nx, :ny],
            self.cross[:nx, :ny],
            tuple(each.within(shape) for each in self.corrections),
        )


def shear_tables(grid: Grid) -> ShearTables:
    """Coefficients between all cells of a grid that is not periodic along both axes."""
    # Along one axis displacement counts from that of a line load at the distance of the grid's
    # size, as that of a pressure does.
    if grid.periodic[0]:
        return _periodic_tables(grid.shape, grid.cell_size, grid.size[1])
    if grid.periodic[1]:
        turned = _periodic_tables(grid.shape[::-1], grid.cell_size[::-1], grid.size[0])
        return ShearTables(turned.direct.T, turned.along_y.T, turned.cross.T)
    cell_x, cell_y = grid.cell_size
    x: Floats = np.arange(grid.shape[0], dtype=np.float64)[:, None] * cell_x
    y: Floats = np.arange(grid.shape[1], dtype=np.float64)[None, :] * cell_y
    return ShearTables(
        influence_table(grid.shape, grid.cell_size),
        along_coefficient(x, y, grid.cell_size),
        cross_coefficient(x, y, grid.cell_size),
    )


def along_coefficient(x: Floats, y: Floats, cell_size: tuple[float, float]) -> Floats:
    """X: displacement along x [m] at x, y [m] per unit κ, J and traction along x."""
    return over_cell(x, y, cell_size, _along_corner, lambda x, y, r: x * x / (r * r * r))


def cross_coefficient(x: Floats, y: Floats, cell_size: tuple[float, float]) -> Floats:
    """Z: displacement along y [m] at x, y [m] per unit κ, J and traction along x, and reversed."""
    return over_cell(
        x, y, cell_size, lambda x, y: -np.hypot(x, y), lambda x, y, r: x * y / (r * r * r)
    )


def _along_corner(x: Floats, y: Floats) -> Floats:
    """Primitive y asinh(x/|y|) of x²/r³; its limit on the axis y = 0 is 0."""
    ratio = np.divide(x, np.abs(y), out=np.zeros_like(x), where=y != 0)
    return np.asarray(y * np.arcsinh(ratio))


def over_cell(
    x: Floats,
    y: Floats,
    cell_size: tuple[float, float],
    primitive: Callable[[Floats, Floats], Floats],
    kernel: Callable[[Floats, Floats, Floats], Floats],
) -> Floats:
    """Integral of a kernel over a cell over π: by its primitive near the cell, else by a rule."""
    x, y = np.broadcast_arrays(x, y)
    a, b = cell_size[0] / 2, cell_size[1] / 2
    near = np.hypot(x, y) <= FAR * max(cell_size)
    found = np.zeros(x.shape)
    here_x, here_y = x[near], y[near]
    for along, across, sign in ((a, b, 1), (a, -b, -1), (-a, b, -1), (-a, -b, 1)):
        found[near] += sign * primitive(here_x + along, here_y + across)
    far_x, far_y = x[~near], y[~near]
    total = np.zeros(far_x.shape)
    for node_x, weight_x in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
        for node_y, weight_y in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
            there = far_x + a * node_x, far_y + b * node_y
            distance = np.sqrt(there[0] ** 2 + there[1] ** 2)
            total += weight_x * weight_y * kernel(*there, distance)
    found[~near] = total * (a * b)
    return found / np.pi


def _periodic_tables(
    shape: tuple[int, int], cell_size: tuple[float, float], datum: float
) -> ShearTables:
    """Coefficients of cells that repeat along x after the whole grid."""
    (nx, ny), (dx, dy) = shape, cell_size
    y: Floats = np.arange(ny, dtype=np.float64)[None, :] * dy
    return periodic_coefficients(nx, y, (dx, dy), datum)


def periodic_coefficients(
    count: int, y: Floats, cell_size: tuple[float, float], datum: float
) -> ShearTables:
    """Coefficients of cells that repeat along x after some number of them, at offsets y [m].

    Rows are the offsets 0, 1, 2, ... along x; y is a row, and not negative.
    """
    nx, (dx, dy) = count, cell_size
    period = nx * dx
    if nx == 1:
        dx = dy  # pieces of any length make the strip
        period = dx
    offsets = np.arange(nx)
    # Of the nearer image; the coefficients are even along x, but Z, which is odd.
    x: Floats = np.minimum(offsets, nx - offsets).astype(np.float64)[:, None] * dx
    direct = periodic_influence_coefficient(x, y, (dx, dy), period, datum)
    images = max(IMAGES, math.ceil(IMAGES * dy / period))
    along_y, cross = _far_images(x, y, (dx, dy), period, images)
    for image in range(-images, images + 1):
        there = x + image * period
        along_y += along_coefficient(y, there, (dy, dx))
        cross += cross_coefficient(there, y, (dx, dy))
    cross *= np.where(offsets * 2 == nx, 0, np.where(offsets * 2 < nx, 1, -1))[:, None]
    return ShearTables(direct, direct - along_y, cross)


def _far_images(
    x: Floats, y: Floats, cell_size: tuple[float, float], period: float, images: int
) -> tuple[Floats, Floats]:
    """Parts of Y and Z by the images beyond those summed one by one."""
    dx, dy = cell_size
    shape = np.broadcast_shapes(x.shape, y.shape)
    along_y, cross = np.zeros(shape), np.zeros(shape)
    begin = (images + 0.5) * period
    for node_x, weight_x in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
        for node_y, weight_y in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
            east, north = x + node_x * dx / 2, y + node_y * dy / 2
            weight = weight_x * weight_y / 4 * dx * dy / np.pi
            for side in (1, -1):
                own_y, own_cross = _tails(begin + side * east, north, period)
                along_y += weight * own_y
                cross += side * weight * own_cross
    return along_y, cross


def _tails(along: Floats, across: Floats, period: float) -> tuple[Floats, Floats]:
    """Sums of y²/r³ and x y/r³ from half a period after a place on [1/m]."""
    # With f = 1/r these are -y ∂f/∂y and -y ∂f/∂x, where d^n f/dx^n = (-1)^n n! P_n(c)/r^(n+1) with
    # c = x/r, and c P_n' + (n + 1) P_n = P_{n+1}'.
    r = np.hypot(along, across)
    c = along / r
    # 1 - c without cancellation.
    total_y = across**2 / (r * (r + along)) / period
    total_cross = across / r / period
    for order, factor in MIDDLE_FACTORS:
        scale = factor * period**order * math.factorial(order)
        slope = np.polynomial.Legendre.basis(order + 1).deriv()(c)
        total_y += -scale * across**2 / r ** (order + 3) * slope
        following = scipy.special.eval_legendre(order + 1, c)
        total_cross += -scale * (order + 1) * across / r ** (order + 2) * following
    return np.asarray(total_y), np.asarray(total_cross)
