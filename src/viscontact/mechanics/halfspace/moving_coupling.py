"""Displacements by which pressure and tractions in motion act on each other, of bodies that creep.

As under a pressure (`moving_load`), each influence coefficient at rest (`coupling_influence`)
becomes J0 X + Σ Ji Ei X, with the compliances c J of both bodies, which subtract.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.transforms import Transforms, fast_length
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_filter import CouplingFilter
from viscontact.mechanics.halfspace.coupling_influence import (
    coupling_coefficient,
    periodic_coupling,
)
from viscontact.mechanics.halfspace.moving_load import (
    Coefficient,
    MovingCompliance,
    moving_influence_table,
)
from viscontact.mechanics.halfspace.moving_shear import signed_spectrum


def moving_coupling_filter(
    grid: Grid, compliance: MovingCompliance, axis: int, transforms: Transforms | None = None
) -> CouplingFilter:
    """Maps of a compliance c J in motion along +axis on all cells of a grid [m/Pa]."""
    across = 1 - axis
    repeats = bool(grid.periodic[across])
    nx, ny = (
        count if repeats and each == across else fast_length(2 * count - 1)
        for each, count in enumerate(grid.shape)
    )

    def spectrum(own: int) -> Complexes:
        # Odd along its own axis, even along the other.
        along, aside = (-1, 1) if own == axis else (1, -1)
        coefficient = _coefficient(grid, axis, own)
        cells = grid.shape, grid.cell_size
        table = moving_influence_table(*cells, compliance, axis, coefficient, along)
        # The filter multiplies its symbols, of odd kernels at rest, by the imaginary unit.
        return signed_spectrum(table, (nx, ny), axis, aside) / 1j

    shape = grid.shape[0], grid.shape[1]
    return CouplingFilter(shape, (nx, ny), (spectrum(0), spectrum(1)), transforms)


def _coefficient(grid: Grid, axis: int, own: int) -> Coefficient:
    """Coefficients of X (own = 0) or Y at offsets along and across a motion along an axis."""

    def free(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        if own == axis:
            return coupling_coefficient(along, across, cell)
        return coupling_coefficient(across, along, cell[::-1])

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        aside, ahead = periodic_coupling(across.size, np.ravel(along)[None, :], cell[::-1])
        return (ahead if own == axis else aside).T

    return with_images if grid.periodic[1 - axis] else free
