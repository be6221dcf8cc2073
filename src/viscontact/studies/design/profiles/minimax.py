"""Least largest value of several functions, by sequential linear programs with a trust region."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.evaluation import BudgetSpentError

#: Cost of a forbidden value over that of a value: an exact penalty.
PENALTY = 10.0
#: Half edge of the trust region at first, the least and the largest one, in sizes of the variables.
FIRST_RADIUS, LEAST_RADIUS, LARGEST_RADIUS = 0.5, 0.01, 1.0
#: Step of the differences, in parts of the sizes.
STEP = 0.02
#: Parts of the predicted gain below which the region shrinks, and above which it grows.
POOR, GOOD = 0.25, 0.75
#: Least gain that counts, in parts of the largest value. With 1e-3 a search may end on a plateau,
#: 1 % above the minimum; with 5e-4 it may follow the mesh.
LEAST_GAIN = 7e-4


class PointValues(Protocol):
    """Values at a point."""

    @property
    def values(self) -> Floats:
        """Values whose largest is to be least."""

    @property
    def forbidden(self) -> Floats:
        """Values that are not to be positive."""


@dataclass(frozen=True, eq=False)
class Minimum:
    """Point with the least largest value that was found."""

    point: Floats
    cost: float
    is_cut_short: bool  # the calls were used up before the gain was small


#: Responses at several points; None where there is none. BudgetSpentError if they are too many.
Responses = Callable[[Sequence[Floats]], Sequence[PointValues | None]]


def cost(response: PointValues | None) -> float:
    """Largest value, and the penalty of the forbidden ones; inf without values."""
    if response is None:
        return np.inf
    return float(response.values.max() + PENALTY * response.forbidden.max(initial=0.0))


def least_largest(responses: Responses, start: Floats, sizes: Floats, lowest: Floats) -> Minimum:
    """Find the point, not below `lowest`, with the least largest value near a start."""
    # Madsen (1975), An algorithm for minimax solution of overdetermined systems of non-linear
    # equations, J. Inst. Maths Applics 16, 321-328: all values are linearised, and the linear
    # program of the least largest value is solved in a region that shrinks where the linear values
    # mislead. It converges quadratically where as many values are largest as there are variables,
    # plus one. The derivatives are forward differences.
    point, radius = start, FIRST_RADIUS
    here, jacobian = None, None
    try:
        (here,) = responses([point])
        while here is not None and radius >= LEAST_RADIUS:
            if jacobian is None:
                jacobian = _jacobian(responses, point, here, sizes)
            step, predicted = _linear_step(here, jacobian, sizes, radius, lowest - point)
            if predicted > cost(here) - LEAST_GAIN * abs(cost(here)):
                break
            (there,) = responses([point + step])
            gained = (cost(here) - cost(there)) / (cost(here) - predicted)
            if gained > GOOD:
                radius = min(2 * radius, LARGEST_RADIUS)
            elif gained < POOR:
                radius /= 4 if gained < 0 else 2
            if gained > 0:
                point, here, jacobian = point + step, there, None
    except BudgetSpentError:
        return Minimum(point, cost(here), True)
    return Minimum(point, cost(here), False)


def _jacobian(
    responses: Responses, point: Floats, here: PointValues, sizes: Floats
) -> tuple[Floats, Floats]:
    """Derivatives of the values and of the forbidden ones, shape (values, variables)."""
    moved = [point + STEP * sizes * axis for axis in np.eye(len(point))]
    columns: tuple[list[Floats], list[Floats]] = ([], [])
    for size, there in zip(sizes, responses(moved), strict=True):
        # Without values there, the program does not go there.
        columns[0].append(
            np.zeros_like(here.values)
            if there is None
            else (there.values - here.values) / (STEP * size)
        )
        columns[1].append(
            np.zeros_like(here.forbidden)
            if there is None
            else (there.forbidden - here.forbidden) / (STEP * size)
        )
    return np.stack(columns[0], axis=-1), np.stack(columns[1], axis=-1)


def _linear_step(
    here: PointValues, jacobian: tuple[Floats, Floats], sizes: Floats, radius: float, lowest: Floats
) -> tuple[Floats, float]:
    """Step to the least largest linear value within a region, and the cost there."""
    count, scale = len(sizes), float(np.abs(here.values).max()) or 1.0
    # Variables: the step in sizes, the largest value, and the largest forbidden one, in scales.
    slopes = [part * sizes / scale for part in jacobian]
    ones = [-np.ones((len(part), 1)) for part in slopes]
    none = [np.zeros((len(part), 1)) for part in slopes]
    rows = np.vstack(
        [np.hstack([slopes[0], ones[0], none[0]]), np.hstack([slopes[1], none[1], ones[1]])]
    )
    bounds = [(max(-radius, low), radius) for low in np.minimum(lowest / sizes, 0.0)]
    found = scipy.optimize.linprog(
        [*np.zeros(count), 1.0, PENALTY],
        A_ub=rows,
        b_ub=-np.concatenate([here.values, here.forbidden]) / scale,
        bounds=[*bounds, (None, None), (0.0, None)],
    )
    if found.x is None:
        return np.zeros(count), cost(here)
    return np.asarray(found.x[:count]) * sizes, float(found.fun) * scale
