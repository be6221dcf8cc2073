"""How fine a mesh has to be: refined until the trials of an elastic contact tell no more."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from viscontact.grid import GRID_QUANTITIES
from viscontact.meshing.trial_mesh import ElasticContact, MeshTrial, try_mesh

#: A trial solve converges to this part of the tolerance, and at least to this.
TRIAL_TOLERANCE_SHARE, MAX_TRIAL_TOLERANCE = 0.01, 1e-4

#: A strip, a ring or a spot has so many cells in a row, whatever the error estimate says.
MIN_CONSECUTIVE_CELLS = 6.0

#: Orders that an error is taken to fall with, to foretell the next trial; below the lowest there
#: is no limit to be expected. Nor is more than so much refined at once, along an axis.
USUAL_ORDER, LOWEST_ORDER = 1.7, 0.5
MIN_AT_ONCE, MAX_AT_ONCE = 1.1, 2.0

#: A pressure that seems to have no limit is given up at so many times the cells of the first trial:
#: a rounded edge seems sharp until it is resolved.
MAX_CELL_RATIO_WITHOUT_LIMIT = 16

#: What may be singular.
PEAK = "peak_pressure"


@dataclass(frozen=True, eq=False)
class Resolution:
    """A mesh that was found fine enough, or the finest that was tried.

    Attributes
    ----------
    trial : MeshTrial
        The mesh.
    quantities : tuple of str
        What it was refined for: the peak pressure is left out where it has no limit.
    cells_needed : float
        How many cells the tolerance takes, about, where it is not met.
    is_enough : bool
        Whether it is met.
    at_finest : bool
        Whether it is the finest mesh that makes sense.
    """

    trial: MeshTrial
    quantities: tuple[str, ...]
    cells_needed: float
    is_enough: bool = True
    at_finest: bool = False


def refine_mesh(
    pressing: ElasticContact,
    quantities: Sequence[str],
    tolerance: float,
    *,
    fewest: ArrayLike,
    finest: ArrayLike = math.inf,
    most_cells: float = math.inf,
) -> Resolution:
    """Refine the mesh of an elastic contact, each way as needed, until it is as exact as asked.

    Parameters
    ----------
    pressing : ElasticContact
        The contact.
    quantities : sequence of str
        Those of `GRID_QUANTITIES` that count.
    tolerance : float
        Their relative error [-].
    fewest, finest : array_like, shape (2,)
        Cells along x and y to begin with, and of which more make no sense.
    most_cells : float
        Number of cells that is not exceeded.

    Returns
    -------
    Resolution
        Not fine enough if it would need more cells than are allowed.

    Examples
    --------
    >>> from viscontact.indenters import Sphere
    >>> from viscontact.loads import step
    >>> ball = ElasticContact(Sphere(0.01), 1e-6, step(0.1).at(0.0), (2.4e-3, 2.4e-3))
    >>> found = refine_mesh(ball, GRID_QUANTITIES, 0.01, fewest=(24, 24))
    >>> found.is_enough, found.trial.shape
    (True, (48, 48))
    """
    exact = min(MAX_TRIAL_TOLERANCE, TRIAL_TOLERANCE_SHARE * tolerance)
    names, shape = tuple(quantities), _good_shape(fewest, finest)
    trials: list[MeshTrial] = []
    while True:
        trial = try_mesh(pressing, shape, exact)
        trials.append(trial)
        following = _refined(trial, names, tolerance, finest)
        is_last = following == shape or math.prod(following) > most_cells
        is_exact = PEAK not in names or (_factors(trial, (PEAK,), tolerance) == 1).all()
        if not is_exact and _has_no_limit(trials, patient=not is_last):
            names = tuple(name for name in names if name != PEAK)
        # What is left may have been as exact before, and not by chance.
        enough = [
            each
            for each in trials
            if (_factors(each, names, tolerance) == 1).all()
            and _agree(each, trial, names, tolerance)
        ]
        if enough:
            return Resolution(enough[0], names, enough[0].cells)
        following = _refined(trial, names, tolerance, finest)
        if following == shape or math.prod(following) > most_cells:
            needed = trial.cells * float(_factors(trial, names, tolerance).prod())
            return Resolution(trial, names, needed, is_enough=False, at_finest=following == shape)
        shape = following


def _agree(trial: MeshTrial, finer: MeshTrial, names: Sequence[str], tolerance: float) -> bool:
    which = [GRID_QUANTITIES.index(name) for name in names]
    return np.allclose(trial.values[which], finer.values[which], rtol=tolerance, atol=0.0)


def _refined(
    trial: MeshTrial, names: Sequence[str], tolerance: float, finest: ArrayLike
) -> tuple[int, int]:
    """The mesh to be tried next: something of what is needed, not all at once."""
    factors = _factors(trial, names, tolerance)
    step = np.where(factors > 1, np.clip(factors, MIN_AT_ONCE, MAX_AT_ONCE), 1.0)
    return _good_shape(trial.shape * step, finest)


def _factors(trial: MeshTrial, names: Sequence[str], tolerance: float) -> NDArray[np.float64]:
    """How many times as many cells are needed along x and y; 1 if there are enough."""
    changes = trial.changes[:, [GRID_QUANTITIES.index(name) for name in names]] / tolerance
    # The error is shared by both ways; where one has little, the other may not have more.
    changes = np.where(changes.sum(axis=0) > 1, 2 * changes, 0.0)
    factors = changes.max(axis=1, initial=0.0) ** (1 / USUAL_ORDER)
    return np.asarray(
        np.maximum(1.0, np.maximum(factors, MIN_CONSECUTIVE_CELLS / trial.consecutive_cells))
    )


def _has_no_limit(trials: Sequence[MeshTrial], *, patient: bool) -> bool:
    """Whether the peak pressure changes as much on smaller cells as it did on larger ones."""
    telling = [
        trial for trial in trials if (trial.consecutive_cells >= MIN_CONSECUTIVE_CELLS).all()
    ]
    if len(telling) < 2:
        return False
    before, now = telling[-2:]
    peak = GRID_QUANTITIES.index(PEAK)
    along = int(now.changes[:, peak].argmax())
    fall = before.changes[along, peak] / now.changes[along, peak]
    refined = now.shape[along] / before.shape[along]
    is_endless = refined > 1 and fall < refined**LOWEST_ORDER
    return is_endless and not (
        patient and now.cells < MAX_CELL_RATIO_WITHOUT_LIMIT * telling[0].cells
    )


def _good_shape(fewest: ArrayLike, finest: ArrayLike) -> tuple[int, int]:
    """Numbers of cells of which half is even, too, and that are good to transform."""
    quarters = np.maximum(2, np.ceil(np.minimum(fewest, finest) / 4)).astype(int).tolist()
    counts = [4 * int(fft.next_fast_len(quarter, real=True)) for quarter in quarters]
    return counts[0], counts[1]
