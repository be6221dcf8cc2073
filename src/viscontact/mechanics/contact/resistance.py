"""Force of the half-space on a body against its motion: in two forms, equal in the limit.

F = ∫ p (∂h/∂x - tilt) dA, from the slope of the body, or F = -∫ p ∂u/∂x dA, from the displacement
of the surface, which follows the body under pressure. In the second one the elastic part cancels
out on any grid, since the convolution is symmetric; it is used where little is left of the first.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter


def resistance_by_slope(
    pressure: Floats,
    grid: Grid,
    indenter: Indenter,
    tilts: tuple[float, float],
) -> tuple[float, float]:
    """Resistance along x and y [N] from the body's slopes under the pressure, means of cells."""
    # Where the body ends in a cell, the slope is the mean from its centre to the edge inside.
    i, j = np.nonzero(pressure)
    x, y, cell = grid.x[i], grid.y[j], grid.cell_size
    force, centre = pressure[i, j] * grid.cell_area, indenter.gap(x, y)
    found = []
    for along, tilt, (half_x, half_y) in (
        (cell[0] / 2, tilts[0], (cell[0] / 2, 0.0)),
        (cell[1] / 2, tilts[1], (0.0, cell[1] / 2)),
    ):
        behind, ahead = (indenter.gap(x + way * half_x, y + way * half_y) for way in (-1, 1))
        inside = np.isfinite(behind), np.isfinite(ahead)
        rise = np.where(inside[1], ahead, centre) - np.where(inside[0], behind, centre)
        length = along * (inside[0] + inside[1].astype(float))
        slope = np.divide(rise, length, out=np.zeros_like(rise), where=length > 0)
        found.append(float(force @ (slope - tilt)))
    return found[0], found[1]


def reaches_end(pressure: Floats, grid: Grid, indenter: Indenter) -> tuple[bool, bool]:
    """Test whether the contact reaches an end of the body along x, and along y."""
    # The pressure on an edge is singular, and its force along the surface is in neither form.
    i, j = np.nonzero(pressure)
    x, y, (dx, dy) = grid.x[i], grid.y[j], grid.cell_size
    along_x, along_y = (
        any(np.isinf(indenter.gap(x + by * shift[0], y + by * shift[1])).any() for by in (-1, 1))
        for shift in ((dx, 0.0), (0.0, dy))
    )
    return along_x, along_y


def is_even(pressure: Floats) -> tuple[bool, bool]:
    """Test whether a pressure is even about the middle of the grid along x, and along y."""
    # An even contact has no force along that axis, at sharp ends either.
    along_x, along_y = (bool((np.flip(pressure, axis) == pressure).all()) for axis in (0, 1))
    return along_x, along_y


def resistance_by_displacement(
    pressure: Floats, displacement: Floats, grid: Grid
) -> tuple[float, float]:
    """Resistance along x and y [N] from the slopes of the surface under the pressure."""
    # Central differences of fourth order: antisymmetric, so that the elastic part cancels.
    found = []
    for axis, cell in enumerate(grid.cell_size):
        # <p, u moved by n cells>, n = 1 and 2 either way; there is no pressure at a free border.
        ahead, behind, far_ahead, far_behind = (
            float(np.einsum("ij,ij->", pressure, np.roll(displacement, by, axis)))
            for by in (-1, 1, -2, 2)
        )
        slope = (8 * (ahead - behind) - (far_ahead - far_behind)) / (12 * cell)
        found.append(-slope * grid.cell_area)
    return found[0], found[1]
