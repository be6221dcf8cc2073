"""Influence coefficients between pressure and displacement along the surface, and reversed.

A traction q along the surface displaces it into the half-space by

    u_z = (c J/π) ∫∫ (r·q)/r² dx' dy',    c = (1 - 2ν)/(2 (1 - ν)) = (1 - κ)/2,

and a pressure p displaces it along itself, towards the load, by -(c J/π) ∫∫ r p/r² dx' dy'. For a
unit load on a rectangle around the origin and c J = 1, the coefficients are

    X(x, y) = (1/π) ∫∫ x/r² dx' dy',   Y(x, y) = (1/π) ∫∫ y/r² dx' dy'.

The primitive of x/r² in x and y is y ln r + x atan(y/x). Repeated along x with the period l, the
kernels have closed sums, of sines and hyperbolic sines of 2π x/l and 2π y/l; the images next to a
cell are integrated exactly, the others, which are smooth, by Gauss's rule.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), eqs. 3.75c and 3.18b.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.periodic_influence import GAUSS_NODES, GAUSS_WEIGHTS
from viscontact.mechanics.halfspace.shear_influence import over_cell

#: Images of a cell on either side that are integrated exactly.
EXACT_IMAGES = 1


@dataclass(frozen=True, eq=False)
class CouplingTables:
    """Influence coefficients [m] at i, j >= 0 cells from a loaded cell, each of shape (nx, ny)."""

    along_x: Floats  # X: odd along x, even along y
    along_y: Floats  # Y: even along x, odd along y

    def within(self, shape: tuple[int, int]) -> CouplingTables:
        """The part for a smaller block of cells."""
        nx, ny = shape
        return CouplingTables(self.along_x[:nx, :ny], self.along_y[:nx, :ny])


def coupling_tables(grid: Grid) -> CouplingTables:
    """Coefficients between all cells of a grid that is not periodic along both axes."""
    (nx, ny), (cell_x, cell_y) = grid.shape, grid.cell_size
    x: Floats = np.arange(nx, dtype=np.float64)[:, None] * cell_x
    y: Floats = np.arange(ny, dtype=np.float64)[None, :] * cell_y
    if grid.periodic[0]:
        return CouplingTables(*periodic_coupling(nx, y, grid.cell_size))
    if grid.periodic[1]:
        across, along = periodic_coupling(ny, x.T, grid.cell_size[::-1])
        return CouplingTables(along.T, across.T)
    turned = coupling_coefficient(y.T, x.T, (cell_y, cell_x)).T
    return CouplingTables(coupling_coefficient(x, y, grid.cell_size), turned)


def coupling_coefficient(x: Floats, y: Floats, cell_size: tuple[float, float]) -> Floats:
    """X [m] at x, y [m] from the middle of a cell."""
    return over_cell(x, y, cell_size, _corner, lambda x, y, r: x / (r * r))


def _corner(x: Floats, y: Floats) -> Floats:
    """Primitive y ln r + x atan(y/x) of x/r²; no cell has the corner r = 0 at its middle."""
    angle = np.arctan(np.divide(y, x, out=np.zeros_like(y), where=x != 0))
    return np.asarray(y * np.log(np.hypot(x, y)) + x * angle)


def periodic_coupling(nx: int, y: Floats, cell_size: tuple[float, float]) -> tuple[Floats, Floats]:
    """X and Y [m] at offsets y [m] from cells that repeat along x after nx of them."""
    (dx, dy), ny = cell_size, y.size
    if nx == 1:  # strips: the mean over x of the closed sum is π sign(y)/l
        return np.zeros((1, ny)), np.clip(2 * y, -dy, dy)
    offsets = (np.arange(nx) + nx // 2) % nx - nx // 2
    x: Floats = offsets.astype(np.float64)[:, None] * dx
    along, across = np.zeros((nx, ny)), np.zeros((nx, ny))
    for node_x, weight_x in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
        for node_y, weight_y in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
            here = x + dx / 2 * node_x, y + dy / 2 * node_y
            smooth_x, smooth_y = _smooth_kernels(*here, nx * dx)
            along += weight_x * weight_y * smooth_x
            across += weight_x * weight_y * smooth_y
    along *= dx * dy / 4 / np.pi
    across *= dx * dy / 4 / np.pi
    for image in range(-EXACT_IMAGES, EXACT_IMAGES + 1):
        there = x + image * nx * dx
        along += coupling_coefficient(there, y, (dx, dy))
        across += coupling_coefficient(y.T, there.T, (dy, dx)).T
    along[(offsets == 0) | (2 * offsets == -nx)] = 0.0  # odd, and of both neighbours
    across[:, y[0] == 0] = 0.0
    return along, across


def _smooth_kernels(x: Floats, y: Floats, period: float) -> tuple[Floats, Floats]:
    """Sums of x/r² and y/r² over all images but those integrated exactly [1/m]."""
    wave = 2 * np.pi / period
    decay, turn = np.exp(-wave * np.abs(y)), wave * x
    # cosh - cos and sinh without overflow, times 2 exp(-wave |y|).
    below = 1 + decay**2 - 2 * decay * np.cos(turn)
    along = wave / 2 * 2 * decay * np.sin(turn) / below
    across = wave / 2 * np.sign(y) * (1 - decay**2) / below
    for image in range(-EXACT_IMAGES, EXACT_IMAGES + 1):
        there = x + image * period
        squared = there**2 + y**2
        along = along - there / squared
        across = across - y / squared
    return np.asarray(along), np.asarray(across)
