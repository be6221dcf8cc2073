"""Extents of a grid whose cells end where the body ends."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.cell_borders import is_border, with_borders_at
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.mechanics.contact.body_edge import trace_outline

#: Lines of the grid on which the ends of a body are searched, along each axis.
LINES = 48

#: Ends on two lines agree if they differ by less than this part of a cell.
STRAIGHT = 1e-6

#: Ends of the indenter closer to a plane than this part of a cell are at the plane.
STRAIGHT_END = 1e-3

#: Largest relative change of an extent that lets a cell end with the body.
MAX_CHANGE = 0.1


def straight_ends(
    indenter: Indenter,
    size: tuple[float, float],
    reach: tuple[float, float],
    centre: tuple[float, float] = (0.0, 0.0),
) -> tuple[float, float]:
    """Distances of a body's straight ends within `reach` of a centre, along x and y, or inf [m]."""
    grid = Grid((LINES, LINES), size, centre=centre)
    x, y = grid.x - centre[0], grid.y - centre[1]
    inside = np.isfinite(indenter.gap(grid.x[:, None], grid.y[None, :]))
    outline = trace_outline(indenter, grid)
    near_x, near_y = np.abs(x) <= reach[0], np.abs(y) <= reach[1]
    return (
        _straight_end(x, inside[:, near_y], outline.along_x[:, near_y]),
        _straight_end(y, inside[near_x].T, outline.along_y[near_x].T),
    )


def _straight_end(centres: Floats, inside: Bools, crossings: Floats) -> float:
    """Distance at which all lines along the first axis end, inf if they end at different ones."""
    cell = float(centres[1] - centres[0])
    before, line = np.nonzero(np.isfinite(crossings))
    beyond = cell * crossings[before, line]
    ends = np.where(inside[before, line], centres[before] + beyond, centres[before + 1] - beyond)
    distances = np.abs(ends)
    if distances.size == 0 or np.ptp(distances) > STRAIGHT * cell:
        return math.inf
    return float(distances.mean())


def fitted_extents(
    size: tuple[float, float], shape: tuple[int, int], ends: tuple[float, float]
) -> tuple[float, float]:
    """Extents near given ones on which cells, also joined in pairs, end with the body [m]."""
    # Cells take a body that ends within one of them as longer or shorter by up to half a cell. At a
    # logarithmic end, whose drop grows fast there, that moves the peak pressure by up to 20 %.
    x, y = (_fit_extent(*each) for each in zip(size, shape, ends, strict=True))
    return x, y


def _fit_extent(extent: float, count: int, end: float) -> float:
    pairs = round(count * end / (2 * extent)) if end < extent / 2 else 0
    fitted = count * end / (2 * pairs) if pairs else extent
    return fitted if abs(fitted / extent - 1) <= MAX_CHANGE else extent


def grid_with_ends(grid: Grid, planes: tuple[float, ...], end: float) -> Grid:
    """Grid of which pairs of cells end at planes, and if it can be at the indenter's ends [m].

    The indenter ends at a distance on one or both sides of the grid's centre, or not (inf).
    """
    sides = [grid.centre[0] + side * end for side in (-1, 1)] if math.isfinite(end) else []
    near = STRAIGHT_END * grid.cell_size[0]
    others = [each for each in sides if min(abs(each - plane) for plane in planes) > near]
    both = with_borders_at(grid, [*planes, *others], joined=2)
    if all(is_border(both, plane) for plane in planes):
        return both
    return with_borders_at(grid, planes, joined=2)
