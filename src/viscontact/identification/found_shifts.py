"""Shift factors found from sets at several temperatures, with their uncertainty and doubts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import isotonic_regression

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.isotherm import Isotherm
from viscontact.identification.measured_sets import MeasuredSets, measured_sets
from viscontact.identification.shift_doubts import (
    contradictions,
    require_warmer_is_faster,
    strange_vertical_steps,
    uncertain_factors,
)
from viscontact.identification.shift_uncertainty import ShiftUncertainty, relative_to
from viscontact.identification.superposition import Superposition
from viscontact.identification.vertical_choice import chosen_vertical
from viscontact.identification.vertical_shift import Vertical


@dataclass(frozen=True, eq=False)
class FoundShifts:
    """Shift factors relative to the reference temperature."""

    logs_a: Floats  # ln a_T, which never rises, shape (sets,)
    logs_b: Floats  # ln b_T
    uncertainty: ShiftUncertainty
    vertical: Vertical
    doubts: tuple[str, ...]


def found_shifts(
    owner: str,
    isotherms: Sequence[Isotherm],
    reference: float,
    vertical: Vertical | None,
    expansion: float,
) -> FoundShifts:
    """Shift factors of two or more sets, from cold to warm."""
    temperatures = np.array([each.temperature for each in isotherms])
    names = isotherms[0].columns
    sign = -1.0 if names == ("compliance",) else 1.0
    sets = measured_sets(temperatures, [each.curve() for each in isotherms], sign)
    choice = chosen_vertical(sets, vertical, expansion, reference)
    joined = choice.joined
    gaps = _gaps(sets, joined)
    require_warmer_is_faster(owner, temperatures, joined, gaps)
    logs, covariance = relative_to(
        reference, temperatures, np.array([joined.logs_a, joined.logs_b]), joined.covariance
    )
    for k in gaps:  # nothing connects the sets beyond it with the reference
        beyond = np.arange(sets.count) > k
        lost = np.flatnonzero(np.tile(beyond if reference <= temperatures[k] else ~beyond, 2))
        covariance[lost, lost] = np.inf
    scatter = dict(zip(names, joined.noise.tolist(), strict=True))
    uncertainty = ShiftUncertainty(covariance, float(joined.freedom.sum()), scatter)
    doubts = (
        *contradictions(joined, names),
        *strange_vertical_steps(temperatures, joined, choice.shift),
        *uncertain_factors(temperatures, uncertainty),
        *choice.doubts,
    )
    return FoundShifts(_falling(logs[0], covariance), logs[1], uncertainty, choice.name, doubts)


def _gaps(sets: MeasuredSets, joined: Superposition) -> list[int]:
    """Sets after which the reduced times of the warmer ones do not overlap with the colder ones."""
    reduced = sets.log_times - joined.logs_a[sets.owner]
    return [
        k
        for k in range(sets.count - 1)
        if np.max(reduced[sets.owner > k]) <= np.min(reduced[sets.owner <= k])
        or np.max(reduced[sets.owner <= k]) <= np.min(reduced[sets.owner > k])
    ]


def _falling(logs_a: Floats, covariance: Floats) -> Floats:
    """Nearest ln a_T that does not rise: a rise within the uncertainty is scatter."""
    if not np.any(np.diff(logs_a) > 0):
        return logs_a
    variances = np.diag(covariance)[: logs_a.size]
    weights = 1 / (variances + 1e-3 * np.max(variances[np.isfinite(variances)]) + 1e-12)
    return np.asarray(isotonic_regression(logs_a, weights=weights, increasing=False).x)
