"""Mesh refinement: cells along x and y are added until an elastic contact meets the tolerance.

1. Solve the contact on a mesh and on cells twice as long along x, and along y (`trial_mesh`). The
   changes estimate the errors of both directions.
2. Stop at the first mesh whose estimated errors meet the tolerance, and which agrees with the last
   one, so that the estimate is not small by chance. Where the contact reaches the body's end, that
   is a finer one.
3. Else multiply the cells along each axis by (2 change/tolerance)^(1/USUAL_ORDER), between
   MIN_AT_ONCE and MAX_AT_ONCE, and repeat.
4. Leave out the peak pressure if it grows, and its changes do not fall with the cells: it is
   singular. So is the width of the contact at such an end. Rounded edges and logarithmic ends seem
   so on large cells, so that the refinement continues for a while, unless the peak grows like the
   inverse square root at a sharp end.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import fast_length
from viscontact.bodies.grid import MESH_QUANTITIES
from viscontact.simulation.meshing.trial_mesh import PEAK, ElasticContact, MeshTrial, try_mesh

_LOG = logging.getLogger("viscontact")

#: Tolerance of a trial solve: this part of the tolerance, at most the second value.
TRIAL_TOLERANCE_SHARE, MAX_TRIAL_TOLERANCE = 0.01, 1e-4

#: Smallest mean chord of strips, rings and spots in cells, whatever the error estimate is.
MIN_CONSECUTIVE_CELLS = 6.0

#: Order of convergence that predicts the next trial, and order below which the values have no
#: limit.
USUAL_ORDER, LOWEST_ORDER = 1.7, 0.5

#: Smallest and largest factor of the cells along an axis from one trial to the next.
MIN_AT_ONCE, MAX_AT_ONCE = 1.1, 2.0

#: Cells, over those of the first trial, up to which a peak without a limit is refined further: a
#: rounded edge seems sharp until it is resolved.
MAX_CELL_RATIO_WITHOUT_LIMIT = 16

#: Cells up to which such a peak is refined further in any case at the body's end: a logarithmic one
#: seems sharp until the contact ends some cells before it.
CELLS_AT_END = 100_000

#: Exponent of the growth with the cells, twice in succession, that makes a peak at an end singular:
#: it is 1/2 at a sharp end (Johnson 1985, Contact Mechanics, eq. 2.64), approached from below.
SINGULAR_EXPONENT = 1 / 3


@dataclass(frozen=True, eq=False)
class Resolution:
    """Result of a refinement: the mesh that is fine enough, or the finest that was tried."""

    trial: MeshTrial
    quantities: tuple[str, ...]  # refined for; without the peak pressure where that has no limit
    cells_needed: float  # estimated number of cells that meet the tolerance
    is_enough: bool = True  # the tolerance is met
    at_finest: bool = False  # no finer mesh is of use


def refine_mesh(
    pressing: ElasticContact,
    quantities: Sequence[str],
    tolerance: float,
    *,
    fewest: ArrayLike,
    finest: ArrayLike = math.inf,
    most_cells: float = math.inf,
) -> Resolution:
    """Refine a mesh, from `fewest` cells along x and y, until quantities meet a tolerance [-]."""
    exact = min(MAX_TRIAL_TOLERANCE, TRIAL_TOLERANCE_SHARE * tolerance)
    names, shape = tuple(quantities), good_shape(fewest, finest)
    trials: list[MeshTrial] = []
    while True:
        # Step 1: errors on this mesh.
        trial = try_mesh(pressing, shape, exact)
        _LOG.debug("trial grid: %d x %d cells", *trial.shape)
        trials.append(trial)
        is_last = _is_last(trial, _next_shape(trial, names, tolerance, finest), most_cells)
        doubtful = tuple(name for name in trial.unlimited if name in names)
        is_exact = (_factors(trial, doubtful, tolerance) == 1).all()
        # Step 4: a singular peak is not refined for, nor the width of the contact below it.
        if doubtful and not is_exact and _has_no_limit(trials, patient=not is_last):
            names = tuple(name for name in names if name not in doubtful)
        # Step 2: the first mesh that is fine enough for the remaining quantities, not by chance.
        following = _next_shape(trial, names, tolerance, finest)
        is_last = _is_last(trial, following, most_cells)
        enough = [
            each
            for each in trials
            if (_factors(each, names, tolerance) == 1).all()
            and _do_agree(each, trial, names, tolerance)
        ]
        if _needs_confirmation(trial, names) and not is_last:
            enough = enough[:-1] if enough and enough[-1] is trial else []
        if enough:
            return Resolution(enough[0], names, enough[0].cells)
        # Step 3: the next mesh, or the end of what is allowed.
        if is_last:
            needed = trial.cells * float(_factors(trial, names, tolerance).prod())
            return Resolution(trial, names, needed, is_enough=False, at_finest=following == shape)
        shape = following


def _do_agree(trial: MeshTrial, finer: MeshTrial, names: Sequence[str], tolerance: float) -> bool:
    """True if two meshes agree in these quantities to the tolerance."""
    which = [MESH_QUANTITIES.index(name) for name in names]
    # Relative to the value, or to what an eccentricity or a tilt near zero counts against.
    allowed = tolerance * np.maximum(np.abs(finer.values), finer.least_scales)
    return bool((np.abs(trial.values - finer.values) <= allowed)[which].all())


def _needs_confirmation(trial: MeshTrial, names: Sequence[str]) -> bool:
    """True if the peak pressure may change on cells that resolve the body's end."""
    return PEAK in names and bool(trial.at_end.any())


def _is_last(trial: MeshTrial, following: tuple[int, int], most_cells: float) -> bool:
    """True if the mesh after this one would not be finer, or have too many cells."""
    return following == trial.shape or math.prod(following) > most_cells


def _next_shape(
    trial: MeshTrial, names: Sequence[str], tolerance: float, finest: ArrayLike
) -> tuple[int, int]:
    """Step 3: cells along x and y of the next mesh."""
    factors = _factors(trial, names, tolerance)
    if (factors == 1).all() and _needs_confirmation(trial, names):
        factors = np.where(trial.at_end, MAX_AT_ONCE, 1.0)
    step = np.where(factors > 1, np.clip(factors, MIN_AT_ONCE, MAX_AT_ONCE), 1.0)
    return good_shape(trial.shape * step, finest)


def _factors(trial: MeshTrial, names: Sequence[str], tolerance: float) -> Floats:
    """Factors by which the cells along x and y must increase; 1 where there are enough."""
    changes = trial.changes[:, [MESH_QUANTITIES.index(name) for name in names]] / tolerance
    # Each axis gets half of the allowed error, even where the other causes less.
    changes = np.where(changes.sum(axis=0) > 1, 2 * changes, 0.0)
    factors = changes.max(axis=1, initial=0.0) ** (1 / USUAL_ORDER)
    return np.asarray(
        np.maximum(1.0, np.maximum(factors, MIN_CONSECUTIVE_CELLS / trial.consecutive_cells))
    )


def _has_no_limit(trials: Sequence[MeshTrial], *, patient: bool) -> bool:
    """Step 4: test whether the peak pressure grows as much on small cells as on larger ones."""
    resolved = [
        trial for trial in trials if (trial.consecutive_cells >= MIN_CONSECUTIVE_CELLS).all()
    ]
    if len(resolved) < 2:
        return False
    before, now = resolved[-2:]
    peak = MESH_QUANTITIES.index(PEAK)
    along = int(now.changes[:, peak].argmax())
    fall = before.changes[along, peak] / now.changes[along, peak]
    refined = now.shape[along] / before.shape[along]
    grows = now.values[peak] > before.values[peak]
    if not (refined > 1 and grows and fall < refined**LOWEST_ORDER):
        return False
    at_end = bool((now.end_excess > 0).any())
    if at_end and all(_growth(*pair) > SINGULAR_EXPONENT for pair in pairwise(resolved[-3:])):
        return len(resolved) > 2
    most = MAX_CELL_RATIO_WITHOUT_LIMIT * resolved[0].cells
    return not (patient and now.cells < max(most, CELLS_AT_END if at_end else 0))


def _growth(before: MeshTrial, now: MeshTrial) -> float:
    """Exponent with which the peak pressure grows with the cells along the axis refined more."""
    peak = MESH_QUANTITIES.index(PEAK)
    refined = max(fine / coarse for fine, coarse in zip(now.shape, before.shape, strict=True))
    return math.log(now.values[peak] / before.values[peak]) / math.log(refined)


def good_shape(fewest: ArrayLike, finest: ArrayLike) -> tuple[int, int]:
    """Numbers of cells that are multiples of four, so halves are even, and fast to transform."""
    quarters = np.maximum(2, np.ceil(np.minimum(fewest, finest) / 4)).astype(int).tolist()
    counts = [4 * fast_length(quarter) for quarter in quarters]
    return counts[0], counts[1]
