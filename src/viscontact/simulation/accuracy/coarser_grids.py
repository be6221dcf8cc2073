"""Grids of the coarser runs."""

from __future__ import annotations

from dataclasses import replace
from weakref import WeakKeyDictionary

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.body_edge import trace_outline
from viscontact.simulation.transient.setup import RunSetup

#: Largest relative change of a coarser grid's cells that lets the body end alike within a cell.
ALIGNMENT_REACH = 0.15

#: Largest difference along a straight end of a body, in cells.
STRAIGHT_WITHIN = 1e-6


def coarser_grid(grid: Grid, spacing: tuple[float, float], parity: bool) -> Grid:
    """Grid of cells larger by factors along x and y over the same region; a period stays."""
    # With `parity` even numbers of cells stay even; otherwise they become odd. The grid extends at
    # least one cell further, so that the contact does not touch its rim.
    shape, size = [], []
    for axis, (count, by) in enumerate(zip(grid.shape, spacing, strict=True)):
        if grid.periodic[axis]:
            shape.append(max(min(4, count), round(count / by)))
            size.append(grid.size[axis])
            continue
        coarse = max(4, int(np.ceil(count / by - 1e-9)) + 1)
        shape.append(coarse + ((coarse - count) % 2 == parity))
        size.append(shape[axis] * by * grid.cell_size[axis])
    return replace(grid, shape=(shape[0], shape[1]), size=(size[0], size[1]))


def aligned_spacing(run: RunSetup, spacing: float, parity: bool) -> tuple[float, float]:
    """Ratios of cells along x and y near a given one at which the body ends alike within a cell."""
    # Cells approximate an end by whole cells: the error is of first order in their size, with a
    # factor that depends on where within a cell the body ends.
    # Where numbers of cells change their parity, edges change places with centres.
    shift = 0.0 if parity else 0.5
    ratios = []
    for end in straight_ends(run):
        nearest = round(end / spacing - end - shift) + end + shift if end < np.inf else np.inf
        ratio = end / nearest if 0 < nearest < np.inf else spacing
        near = abs(ratio / spacing - 1) < ALIGNMENT_REACH
        ratios.append(ratio if near else spacing)
    return ratios[0], ratios[1]


def straight_ends(run: RunSetup) -> tuple[float, float]:
    """Distances from the grid's centre to the body's straight ends along x and y, in cells."""
    if run not in _KNOWN_ENDS:
        _KNOWN_ENDS[run] = _straight_ends(run)
    return _KNOWN_ENDS[run]


#: Straight ends of runs, which several error bars ask for.
_KNOWN_ENDS: WeakKeyDictionary[RunSetup, tuple[float, float]] = WeakKeyDictionary()


def _straight_ends(run: RunSetup) -> tuple[float, float]:
    # Those on +x and +y, or else on -x and -y; inf where there is none: the end of a round body has
    # no single place in a cell, nor has the end of a body within a period.
    inside = np.isfinite(run.open_gap)
    if all(run.grid.periodic) or inside.all():
        return np.inf, np.inf
    outline = trace_outline(run.indenter_at(0.0), run.grid)
    along_x = _straight_end(inside, outline.along_x)
    along_y = _straight_end(inside.T, outline.along_y.T)
    return (
        np.inf if run.grid.periodic[0] else along_x,
        np.inf if run.grid.periodic[1] else along_y,
    )


def _straight_end(inside: Bools, crossings: Floats) -> float:
    """Distance from the grid's centre to a straight end along the first axis, in cells; or inf."""
    positive = _positive_end(inside, crossings)
    return positive if positive < np.inf else _positive_end(inside[::-1], crossings[::-1])


def _positive_end(inside: Bools, crossings: Floats) -> float:
    """End on the positive side."""
    last = int(np.flatnonzero(inside.any(axis=1))[-1])
    if last == len(inside) - 1:
        return np.inf
    ends = crossings[last][inside[last]]
    if len(ends) < 2 or np.ptp(ends) > STRAIGHT_WITHIN:
        return np.inf
    return last + 0.5 + float(ends[0]) - len(inside) / 2
