"""Extent of an automatic grid over the path of a moving body."""

from __future__ import annotations

import math
from dataclasses import replace

from viscontact.backend.transforms import fast_length
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion
from viscontact.simulation.meshing.contact_extent import MAX_CELLS
from viscontact.units.formatting import format_quantity


def grid_over_path(grid: Grid, motion: Motion) -> Grid:
    """Grid of the same cells that holds what a grid around the body holds, on all of its path."""
    shape, size, centre = list(grid.shape), list(grid.size), list(grid.centre)
    for axis, (cell, (low, high)) in enumerate(zip(grid.cell_size, motion.reach, strict=True)):
        if low == high == 0:
            continue
        before, behind = math.ceil(-low / cell - 1e-9), math.ceil(high / cell - 1e-9)
        count = _fast_count(grid.shape[axis] + before + behind, cell)
        behind = count - grid.shape[axis] - before
        shape[axis], size[axis] = count, cell * count
        centre[axis] += cell * (behind - before) / 2
    if shape[0] * shape[1] > MAX_CELLS:
        way = max(high - low for low, high in motion.reach)
        raise ValueError(
            f"grid: an automatic grid over a path of {format_quantity(way, 'm')} would have "
            f"{shape[0]} x {shape[1]} cells, and {MAX_CELLS} at most are possible; shorten the "
            "path, set a larger grid.tolerance, or give a grid of your own"
        )
    return replace(
        grid, shape=(shape[0], shape[1]), size=(size[0], size[1]), centre=(centre[0], centre[1])
    )


def _fast_count(least: int, cell: float) -> int:
    """A number of cells that suits the transforms and keeps the cell size to the bit."""
    count = least
    while True:
        count = fast_length(count)
        if cell * count / count == cell:
            return count
        count += 1
