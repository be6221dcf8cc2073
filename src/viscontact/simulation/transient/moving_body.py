"""Part of a moving body that a grid comes to see."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion


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
