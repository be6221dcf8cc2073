"""Peak pressures without a limit as cells become smaller."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.accuracy.coarser_runs import MIN_ACROSS, CoarserResult, History
from viscontact.accuracy.levels import RefinementLevels, moving_mean
from viscontact.accuracy.richardson import richardson

#: Least growth of a peak without a limit as cells shrink by a factor e, over the mean pressure:
#: under a wedge it is 0.64, under a cone 1.
UNBOUNDED_GROWTH = 0.3

#: Warning of a peak without a limit.
SINGULAR = (
    "the peak pressure has no limit as cells become smaller: it depends on the mesh, at a sharp "
    "edge, a point or a ridge of the body or at roughness that the grid does not resolve, and its "
    "error is given as infinite; resultants converge"
)


def unbounded_peak(
    history: History, results: list[CoarserResult], at_end: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Times at which the peak pressure has no limit, by the body's shape or by the grids."""
    contact = np.asarray(history["peak_pressure"] > 0)
    if any(each.is_sharp for each in results):
        return contact
    levels = RefinementLevels.of("peak_pressure", history, results)
    order = np.argsort(levels.spacings)
    if len(order) < 3:
        return np.asarray(contact & at_end)
    three = order[[0, 1, -1]]
    peaks = levels.values[three]
    spacings = np.array(levels.spacings)[three]
    known = np.isfinite(peaks).all(axis=0)
    verdict = richardson(np.where(known, peaks, 1.0), spacings)
    growth = (peaks[0] - peaks[-1]) / np.log(spacings[-1])
    grows = growth > UNBOUNDED_GROWTH * history["mean_pressure"]
    # A contact of few cells does not exist on the coarsest grid.
    fine = history["cells_across"] >= MIN_ACROSS * spacings[-1]
    unbounded = np.where(known, ~verdict.converges & grows & fine, np.nan)
    return np.asarray(contact & (at_end | (moving_mean(unbounded) > 0.5)))
