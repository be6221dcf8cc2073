"""Body that moves over the grid: its next periods, and the part of it that the grid sees."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads.motion import Motion


@dataclass(frozen=True)
class PeriodicBody(Indenter):
    """A body that repeats itself along the periodic axes of a grid.

    >>> from viscontact.bodies.indenters import Paraboloid
    >>> period = Grid((4, 4), (2.0, 2.0), periodic=True)
    >>> PeriodicBody(Paraboloid(0.5, 0.5), period).gap([-0.5, 1.5], 0.0).tolist()
    [0.25, 0.25]
    """

    body: Indenter
    grid: Grid

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the gap of the body in the period of each position; see `Indenter.gap`."""
        along_x, along_y = (
            _wrapped(positions, middle, period) if repeats else positions
            for positions, middle, period, repeats in zip(
                (x, y), self.grid.centre, self.grid.size, self.grid.periodic, strict=True
            )
        )
        return self.body.gap(along_x, along_y)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Those of the body [1/m]."""
        return self.body.curvatures

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """That of the body [m]."""
        return self.body.sample_spacing


def _wrapped(positions: ArrayLike, middle: float, period: float) -> Floats:
    """Positions moved by whole periods to within half a period of the middle [m]."""
    offset = np.asarray(positions, dtype=np.float64) - middle
    return np.asarray(middle + offset - period * np.round(offset / period))


def cells_seen(grid: Grid, motion: Motion) -> tuple[Floats, Floats]:
    """Positions in the body's frame that cells of the grid have during a motion, along x and y [m].

    >>> from viscontact.bodies.loads import Travel
    >>> path = Travel([0.0, 1.0], y=[0.0, 0.5])
    >>> cells_seen(Grid((4, 4), (1.0, 1.0)), path)[1].tolist()
    [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375]
    """
    along_x, along_y = (
        centres - low
        if low == high
        else centres[0]
        + cell * np.arange(-math.ceil(high / cell), centres.size + math.ceil(-low / cell))
        for centres, cell, (low, high) in zip(
            (grid.x, grid.y), grid.cell_size, motion.reach, strict=True
        )
    )
    return along_x, along_y
