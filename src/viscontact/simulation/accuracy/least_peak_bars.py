"""Lower limits of the error bars of the peak pressure."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import (
    CombinedIndenter,
    Indenter,
    PlacedIndenter,
    Revolved,
    Swept,
)
from viscontact.simulation.accuracy.coarser_results import History
from viscontact.simulation.accuracy.least_bars import SMOOTH_DROP, TINY, ContactKinds
from viscontact.simulation.accuracy.refinement_levels import moving_maximum
from viscontact.simulation.accuracy.rim_cells import cells_across
from viscontact.simulation.transient.setup import RunSetup

#: Least error of a peak near the rim, in its drop to a neighbouring cell of a coarser grid.
LEAST_PEAK_ERROR = 0.16

#: Part of that at the instants before and after that counts, times the ratio of the squares of the
#: cells across: a ridge of pressure beside the rim may lie in the middle of a cell at an instant.
PEAK_NEARBY = 0.45

#: Least relative error of a peak under a body of points, times the square of the cells across: its
#: curvature jumps from point to point, and the pressure with it. Balls of 25 to 60 points err by
#: 0.9 in the median, by 5 in one of ten.
POINTS_PEAK_ERROR = 4.0

#: Least error of a peak at an apex r^n, in its drop to a neighbouring cell of a coarser grid, by
#: the exponents that `apex_exponent` finds. It holds where the apex is midway between four cells of
#: the run, and in the centre of one of the coarser grid; 24 to 161 cells. The pressure has a cusp.
APEX_EXPONENTS = (1.0, 1.14, 1.19, 1.29, 1.44, 1.57, 1.7, 1.83, 1.92, 2.0)
APEX_ERRORS = (6.0, 5.6, 5.0, 4.0, 2.0, 1.1, 0.62, 0.4, 0.29, 0.0)

#: Where a body is rounded within a cell of the rim, the cells take the rounding for a sharp end:
#: pressure grows as the inverse square root of the distance to it, down to the width of the
#: rounding that is in contact. This is, in cells, so much times (sqrt(a/h)/b)^(2/3) with the half
#: width a of the contact, cells of length h and the growth b that the bend can cause; 0.3 to 0.35
#: on faces of 1 mm rounded by 1 to 8 mm. Peaks are too small by 1 - sqrt(w/1.1) for w cells.
ROUNDING_WIDTH, RESOLVED_ROUNDING = 0.33, 1.1

#: Most by which a crest between cells, a parabola, is higher than the largest cell, in the drop
#: from there to the cells next to it. Without a rim, nothing else may show on coarser grids.
CREST_BETWEEN_CELLS = 1 / 8


def least_peak_bar(run: RunSetup, kinds: ContactKinds, history: History) -> Floats:
    """Lower limit of the bar of the peak pressure, from its drop to the cells next to it [Pa]."""
    drops = kinds.drops
    relative = LEAST_PEAK_ERROR * drops**2 / (drops + SMOOTH_DROP)
    relative = np.fmax(relative, np.where(kinds.steep, entry_rise(run, history["time"]), 0.0))
    apex = np.interp(np.nan_to_num(kinds.exponents, nan=2.0), APEX_EXPONENTS, APEX_ERRORS)
    relative = np.fmax(relative, apex * drops)
    relative = np.fmax(relative, np.where(kinds.steep, _coarse_rounding(kinds, history), 0.0))
    if _is_of_points(run.problem.indenter):
        by_points = POINTS_PEAK_ERROR / np.maximum(cells_across(run, history), 1.0) ** 2
        relative = np.fmax(relative, by_points)
    has_no_rim = np.isinf(cells_across(run, history))
    relative = np.fmax(relative, np.where(has_no_rim, CREST_BETWEEN_CELLS * drops, 0.0))
    count = np.maximum(history["cells_across"], 1.0) ** 2
    relative = np.fmax(relative, PEAK_NEARBY * moving_maximum(count * relative, 1) / count)
    return np.asarray(relative * history["peak_pressure"])


def _is_of_points(indenter: Indenter) -> bool:
    """True if a body is given by points, or has such a part."""
    if isinstance(indenter, PlacedIndenter):
        return _is_of_points(indenter.body)
    if isinstance(indenter, CombinedIndenter):
        return any(_is_of_points(part) for part in indenter.parts)
    return isinstance(indenter, Revolved | Swept)


def _coarse_rounding(kinds: ContactKinds, history: History) -> Floats:
    """Relative error of a peak at a rounding that takes less than a cell of the contact [-]."""
    across, bends = history["cells_across"], np.nan_to_num(kinds.bends)
    narrow = bends > 0
    quotient = np.sqrt(across / 2) / np.where(narrow, bends, 1.0)
    width = np.where(narrow, ROUNDING_WIDTH * quotient ** (2 / 3), np.inf)
    return np.asarray(1 - np.sqrt(np.minimum(width / RESOLVED_ROUNDING, 1.0)))


def entry_rise(run: RunSetup, times: Floats) -> Floats:
    """Possible relative rise of a peak at the leading edge of a contact on finer cells [-]."""
    # The material in the first cell has been in contact for the time in which the body passes a
    # cell, and is as compliant as then; it is stiffer on finer cells, up to its instant modulus.
    # The largest pressure of such a layer grows with the root of its stiffness.
    motion, compliance = run.problem.motion, run.problem.compliance
    if motion.stands or not compliance.instant > 0:
        return np.zeros(len(times))
    speeds = np.array([np.hypot(*motion.velocity_at(float(time))) for time in times])
    passing = min(run.grid.cell_size) / np.maximum(speeds, TINY)
    passing = np.minimum(passing, times[-1])
    rises = np.sqrt(np.asarray(compliance(passing)) / compliance.instant) - 1
    return np.where(speeds > 0, rises, 0.0)
