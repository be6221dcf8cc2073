"""Jumps of a body's curvature at the rim of its contact, as from a rounded tip to a cone."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.simulation.accuracy.coarser_results import History
from viscontact.simulation.accuracy.rim_cells import EXTENTS
from viscontact.simulation.transient.setup import RunSetup

#: Cells between the rim and the places that are compared, and to one farther inside.
BESIDE, INSIDE = 1.5, 2.5

#: Exponents of the distance that a curvature may follow.
LEAST_POWER, LARGEST_POWER = -2.0, 8.0

#: Fewest cells of a line, and of half a contact, for which it is known.
LEAST_LINE, LEAST_HALF = 8, 2.0


def curvature_jumps(run: RunSetup, history: History) -> Floats:
    """Relative jump of the curvature across the rim over times, the largest of four sides.

    It is the difference between the curvature of the open gap just outside and the one expected
    from a power of the distance inside, over the larger of both: 0 of bodies r^n. Lines through
    the lowest point of the body are looked at.
    """
    largest = np.zeros(len(history["time"]))
    for name, line, cell in zip(EXTENTS, *_lines(run), strict=True):
        if line.size < LEAST_LINE:
            continue
        with np.errstate(invalid="ignore"):  # beyond the end of a body
            curvature = np.diff(line, 2)
        lowest = int(np.argmin(line)) - 1
        half = np.nan_to_num(history[name]) / (2 * cell)
        for side in (-1, 1):
            largest = np.fmax(largest, _jumps(curvature, lowest, side, half))
    return largest


def _lines(run: RunSetup) -> tuple[tuple[Floats, Floats], tuple[float, float]]:
    """Open gap along x and y through the lowest point [m], and the edges of a cell [m]."""
    gap = run.open_gap
    i, j = np.unravel_index(int(np.argmin(gap)), gap.shape)
    return (gap[:, j], gap[i]), run.grid.cell_size


def _jumps(curvature: Floats, lowest: int, side: int, half: Floats) -> Floats:
    """Relative jumps on one side of a body, for half widths of the contact in cells."""
    cells = np.arange(curvature.size)

    def at(distance: Floats) -> Floats:
        place = lowest + side * distance
        return np.asarray(np.interp(place, cells, curvature, left=np.nan, right=np.nan))

    known = half > LEAST_HALF
    half = np.where(known, half, LEAST_HALF + 1)
    near, far = half - BESIDE, np.maximum(half - INSIDE, 0.5)
    inside, deeper, outside = at(near), at(half - INSIDE), at(half + BESIDE)
    with np.errstate(invalid="ignore", divide="ignore"):
        power = np.log(inside / deeper) / np.log(near / far)
        power = np.clip(np.nan_to_num(power), LEAST_POWER, LARGEST_POWER)
        expected = inside * ((half + BESIDE) / near) ** power
        jump = np.abs(outside - expected) / np.maximum(np.abs(outside), expected)
    return np.where(known & (inside > 0), jump, np.nan)
