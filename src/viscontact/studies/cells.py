"""Cells of the runs of a study: settings of coarser ones, and a grid for several runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.case import Case
from viscontact.simulation.meshing.refinement import good_shape

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
    """Setting of a case for a grid."""
    (shape,) = shape_setting(grid.shape).values()
    lengths, centre = (
        ", ".join(f"{each!r} m" for each in map(float, pair)) for pair in (grid.size, grid.centre)
    )
    periodic = ", ".join(str(each).lower() for each in map(bool, grid.periodic))
    own = f"shape: {shape}, size: [{lengths}], centre: [{centre}], periodic: [{periodic}]"
    return {"grid": f"{{{own}}}"}


#: Cells that may be longer than those that another run would choose by this factor.
TOLERATED = 1.5


def covering(nominal: Grid, others: Sequence[Grid]) -> Grid:
    """Return a grid over the extents of all grids, whose cells lie on those of the nominal one.

    Along an axis that is periodic it is the nominal one: another period would be another contact.
    """
    cell = np.array(nominal.cell_size)
    finest = np.min([each.cell_size for each in (nominal, *others)], axis=0)
    # Parts of whole cells still end where a straight part of the body ends.
    cell = cell / np.maximum(1, np.ceil(cell / (TOLERATED * finest) - 1e-9))
    centre = np.array(nominal.centre)
    reach = [
        np.abs(np.array(each.centre) - centre) + np.array(each.size) / 2
        for each in (nominal, *others)
    ]
    counts = good_shape(2 * np.max(reach, axis=0) / cell - 1e-6, np.inf)
    size = (float(counts[0] * cell[0]), float(counts[1] * cell[1]))
    repeats_x, repeats_y = nominal.periodic
    shape = (
        nominal.shape[0] if repeats_x else counts[0],
        nominal.shape[1] if repeats_y else counts[1],
    )
    lengths = (nominal.size[0] if repeats_x else size[0], nominal.size[1] if repeats_y else size[1])
    return Grid(shape, lengths, nominal.periodic, centre=nominal.centre)
