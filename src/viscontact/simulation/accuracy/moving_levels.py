"""Grids and times of the coarser runs of a moving contact: steps of whole cells stay so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion
from viscontact.simulation.accuracy.coarser_steps import fewer_times

#: Least number of cells across the largest contact, and ratios of cells and of steps to the run's:
#: the steps are whole cells on each of these grids.
WHOLE_RATIOS = ((13.5, ((2.0, 2), (3.0, 3))), (9.0, ((1.5, 3), (2.0, 2))))

#: Part of a cell within which positions are at whole cells.
WHOLE_WITHIN = 1e-6

#: Part of the times of a path that are at whole cells, or ends of its parts.
MOSTLY = 0.8


def whole_cell_ratios(across: float) -> tuple[tuple[float, int], ...]:
    """Ratios of cells and steps of the coarser runs, finer first; empty with too few cells."""
    return next((ratios for least, ratios in WHOLE_RATIOS if across >= least), ())


def aligned_along(grid: Grid, fine: Grid, motion: Motion) -> Grid:
    """Coarser grid, moved by up to half a cell along the motion, so that the body starts alike."""
    # Its error then differs by the cells' size only, and not by the place of the body within them.
    centre = list(grid.centre)
    start = motion.position_at(0.0)
    for axis, moves in enumerate(motion.moves):
        if moves:
            own, theirs = (
                (start[axis] - (each.x, each.y)[axis][0]) / each.cell_size[axis]
                for each in (fine, grid)
            )
            part = theirs - own
            centre[axis] += float(part - np.round(part)) * grid.cell_size[axis]
    return replace(grid, centre=(centre[0], centre[1]))


def fewer_moving_times(
    times: Floats, stops: Floats, motion: Motion, grid: Grid, step_ratio: int
) -> Floats:
    """Times of steps of `step_ratio` as many cells of the grid; at rest about every second one."""
    # Of times that are not at whole cells every `step_ratio`-th, without those behind stops.
    way = (motion.position_at(times) - motion.position_at(0.0)) / grid.cell_size
    whole = np.round(way)
    at_stop = np.isin(times, stops) | np.isin(times, times[[0, -1]])
    at_cells = (np.abs(way - whole) < WHOLE_WITHIN).all(axis=1)
    moves = np.append(False, (np.abs(np.diff(way, axis=0)) > WHOLE_WITHIN).any(axis=1))
    resting = np.isin(times, fewer_times(times, stops, 2)) & ~moves
    if np.mean((at_cells | at_stop)[moves]) < MOSTLY:
        counted = np.arange(len(times)) - np.maximum.accumulate(
            np.where(at_stop, np.arange(len(times)), 0)
        )
        return np.asarray(times[at_stop | resting | (moves & (counted % step_ratio == 0))])
    cells = np.abs(whole).max(axis=1).astype(int)
    a_step = int(np.gcd.reduce(cells[at_cells & moves])) or 1
    kept = moves & at_cells & (cells % (step_ratio * a_step) == 0)
    return np.asarray(times[at_stop | resting | kept])
