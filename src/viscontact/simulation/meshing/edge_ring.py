"""Cells that resolve the ring of fresh material at the edge of a growing contact."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.simulation.meshing.creeping_peak import ContactGrowth

#: Ratio of the cells of neighbouring meshes along an axis, and of the finest and the coarsest.
STEP, LARGEST_FACTOR = 2**0.25, 4.0

#: Relative difference of cells across below which both axes of a round contact have one error.
ALIKE = 1e-3

#: Part of the error that must remain at most for cells that miss the tolerance to be worthwhile.
WORTHWHILE = 0.5


@dataclass(frozen=True, eq=False)
class RingResolution:
    """Factors of the cells along x and y, at least 1, and the error of the peak pressure left."""

    factors: Floats
    error: float  # relative to the largest peak pressure of the history [-]


def resolve_ring(
    growth: ContactGrowth, across: Floats, tolerance: float, most: Floats
) -> RingResolution:
    """Fewest additional cells for which the peak pressure of a history meets a tolerance."""
    # `across` are the cells across the largest contact, `most` the largest factors of the cells
    # along x and y. These are the result if the tolerance is out of reach, and 1 where they would
    # hardly reduce the error.
    errors = _errors(growth, across, np.minimum(most[:2], most[2]))
    steps = [_fewest(each, tolerance) for each in errors]
    while any(steps) and STEP ** sum(steps) > most[2]:
        steps = [min(each, max(steps) - 1) for each in steps]
    at_first = max(float(each[0]) for each in errors)
    error = max(float(each[step]) for each, step in zip(errors, steps, strict=True))
    if error > max(tolerance, WORTHWHILE * at_first):
        return RingResolution(np.ones(2), at_first)
    return RingResolution(STEP ** np.array(steps, dtype=np.float64), error)


def _errors(growth: ContactGrowth, across: Floats, most: Floats) -> list[Floats]:
    """Errors of the peak pressure on ever more cells along x, and along y, up to these factors."""
    # As cells come into contact one after the other, the error scatters from mesh to mesh: that of
    # the next mesh counts, too.
    finest = np.log(np.clip(most, 1.0, LARGEST_FACTOR)) / math.log(STEP)
    factors = [STEP ** np.arange(math.floor(each + 1e-9) + 2) for each in finest]
    along = _with_next(growth.peak_errors(0, across[0] * factors[0]))
    is_square = np.ptp(across) < ALIKE * across.max() and most[0] == most[1]
    if is_square and growth.is_round:
        return [along, along]
    return [along, _with_next(growth.peak_errors(1, across[1] * factors[1]))]


def _with_next(errors: Floats) -> Floats:
    return np.maximum(errors[:-1], errors[1:])


def _fewest(errors: Floats, tolerance: float) -> int:
    """First mesh that meets the tolerance, else the best."""
    enough = errors <= tolerance
    return int((enough if enough.any() else -errors).argmax())
