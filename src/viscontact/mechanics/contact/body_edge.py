"""Outline of a body between the cell centres of a grid, and cells near it."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter

#: Cells from the end of a body in which a pressure peak is not resolved: pressure rises towards a
#: sharp end, and falls to zero before a logarithmic one.
END_DEPTH = 2

#: Parts into which a cell is divided again and again, enough to locate the outline to rounding.
PARTS = (16,) * 11 + (2,)


@dataclass(frozen=True, eq=False)
class Outline:
    """Distances from inner cell centres to the indenter's outline, in cells, or NaN."""

    along_x: Floats  # shape (nx - 1, ny)
    along_y: Floats  # shape (nx, ny - 1)


def trace_outline(indenter: Indenter, grid: Grid, open_gap: Floats | None = None) -> Outline:
    """Find by division where an indenter's gap becomes +inf between cell centres.

    `open_gap` is that gap on the cells [m], if it is known.
    """
    x, y = grid.x[:, None], grid.y[None, :]
    inside = np.isfinite(indenter.gap(x, y) if open_gap is None else open_gap)
    x, y = np.broadcast_arrays(x, y)
    return Outline(
        _outline_crossings(indenter, inside, x, y),
        _outline_crossings(indenter, inside.T, x.T, y.T).T,
    )


def end_cells(open_gap: Floats, depth: int) -> Bools:
    """Cells of a body within `depth` cells of its end along x, and along y, shape (2, nx, ny)."""
    outside = np.isinf(open_gap)
    near = np.zeros((2, *outside.shape), dtype=bool)
    for axis in (0, 1):
        beyond, close = np.moveaxis(outside, axis, 0), np.moveaxis(near[axis], axis, 0)
        for steps in range(1, depth + 1):
            close[steps:] |= beyond[:-steps]
            close[:-steps] |= beyond[steps:]
    return near & ~outside


def _outline_crossings(
    indenter: Indenter,
    inside: Bools,
    x: Floats,
    y: Floats,
) -> Floats:
    """Crossings along the first axis, in cells from the centre inside the body."""
    shape = inside.shape[0] - 1, inside.shape[1]
    i, j = np.nonzero(inside[:-1] != inside[1:])
    if not len(i):
        return np.broadcast_to(np.nan, shape)
    crossings = np.full(shape, np.nan)
    # From the centre inside the body towards the one outside.
    inner, outer = np.where(inside[i, j], i, i + 1), np.where(inside[i, j], i + 1, i)
    begin, width = np.zeros(len(i)), 1.0
    for parts in PARTS:
        width /= parts
        places = begin + width * np.arange(1.0, parts)[:, None]
        is_inside = np.isfinite(
            indenter.gap(
                x[inner, j] + places * (x[outer, j] - x[inner, j]),
                y[inner, j] + places * (y[outer, j] - y[inner, j]),
            )
        )
        begin = begin + width * np.logical_and.accumulate(is_inside, axis=0).sum(axis=0)
    crossings[i, j] = begin + width / 2
    return crossings
