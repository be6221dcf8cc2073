"""Grid whose cells are no larger than a limit."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.simulation.meshing.contact_extent import MAX_CELLS
from viscontact.simulation.meshing.refinement import good_shape

#: Relative excess over the limit that is rounding.
ROUNDING = 1e-6


def with_small_cells(
    grid: Grid, largest_cell: tuple[float, float], ends: tuple[float, float]
) -> Grid:
    """Cover a grid with cells up to `largest_cell` that end at the body's `ends` [m]."""
    # Along an axis with smaller cells the grid remains. ValueError if there would be too many
    # cells.
    cells = [
        _cell(*each) for each in zip(grid.cell_size, largest_cell, grid.size, ends, strict=True)
    ]
    counts = np.divide(grid.size, cells)
    if not float(counts.prod()) <= MAX_CELLS:
        raise ValueError(
            f"grid.largest_cell: cells this small would be about {float(counts.prod()):.2g}, more "
            "than an automatic grid has; allow larger cells, or give a grid"
        )
    wanted = good_shape(counts * (1 - ROUNDING), math.inf)
    axes = zip(grid.shape, wanted, cells, grid.cell_size, grid.size, strict=True)
    shape, size = zip(
        *(
            (count, extent) if cell == own else (more, more * cell)
            for count, more, cell, own, extent in axes
        ),
        strict=True,
    )
    return replace(grid, shape=shape, size=size)


def _cell(own: float, largest: float, extent: float, end: float) -> float:
    """Length of a cell along an axis; pairs of cells end where the body ends."""
    if own <= largest * (1 + ROUNDING):
        return own
    if not end < extent / 2:
        return largest
    return end / (2 * math.ceil(end / (2 * largest) * (1 - ROUNDING)))
