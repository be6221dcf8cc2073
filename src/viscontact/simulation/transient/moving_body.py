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
    """A body that repeats itself along the periodic axes of a grid."""

    body: Indenter
    grid: Grid

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the gap of the body in the period of each position; see `Indenter.gap`."""
        along_x, along_y = (
            _wrap(positions, middle, period) if repeats else positions
            for positions, middle, period, repeats in zip(
                (x, y), self.grid.centre, self.grid.size, self.grid.periodic, strict=True
            )
        )
        return self.body.gap(along_x, along_y)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures of the body [1/m]."""
        return self.body.curvatures

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """Spacing of the samples of the body [m]."""
        return self.body.sample_spacing


def _wrap(positions: ArrayLike, middle: float, period: float) -> Floats:
    """Positions moved by whole periods to within half a period of the middle [m]."""
    offset = np.asarray(positions, dtype=np.float64) - middle
    return np.asarray(middle + offset - period * np.round(offset / period))


def cells_seen(grid: Grid, motion: Motion) -> tuple[Floats, Floats]:
    """Positions of cells of the grid in the body's frame during a motion, along x and y [m]."""
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
