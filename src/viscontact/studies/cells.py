"""Cells of the runs of a study, as settings of its case."""

from __future__ import annotations

import math
from dataclasses import replace

from viscontact.bodies.grid import Grid
from viscontact.case import Case

#: Relative error of an automatic grid in a search, unless the case allows more.
COARSE_TOLERANCE = 0.05
#: Least number of cells along an edge, and cells from which a given grid is made coarser.
LEAST_CELLS, MOST_CELLS = 32, 2**12


def coarse_cells(case: Case) -> dict[str, str]:
    """Settings of the coarse cells of a case; none if its own cells are coarse."""
    if isinstance(case.grid, Grid):
        shape = case.grid.shape
        while math.prod(shape) > MOST_CELLS and min(shape) >= 2 * LEAST_CELLS:
            shape = (shape[0] // 2, shape[1] // 2)
        return {} if shape == case.grid.shape else shape_setting(shape)
    automatic = case.automatic_grid
    if automatic is None or automatic.largest_cell is not None:
        return {}
    if automatic.tolerance >= COARSE_TOLERANCE:
        return {}
    return {"grid.tolerance": f"{100 * COARSE_TOLERANCE:g} %"}


def coarser(grid: Grid) -> Grid:
    """Return the grid with cells of twice the length, where there are several along an axis."""
    nx, ny = grid.shape
    return replace(grid, shape=(-(-nx // 2), -(-ny // 2)))


def shape_setting(shape: tuple[int, int]) -> dict[str, str]:
    """Setting of a case for the numbers of cells of its grid."""
    return {"grid.shape": f"[{shape[0]}, {shape[1]}]"}


def grid_setting(grid: Grid) -> dict[str, str]:
    """Setting of a case for a grid that is not periodic."""
    (shape,) = shape_setting(grid.shape).values()
    lengths, centre = (
        ", ".join(f"{each!r} m" for each in map(float, pair)) for pair in (grid.size, grid.centre)
    )
    return {"grid": f"{{shape: {shape}, size: [{lengths}], centre: [{centre}]}}"}
