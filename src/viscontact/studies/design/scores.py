"""Scores of the points of a search: their responses, their cost, and which is the best."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.evaluation import Level

Point = tuple[float, ...]

#: Cost of a relative excess over a bound, in parts of the objective: an exact penalty, as long as
#: the objective changes less than this for a given relative change of the bound.
PENALTY = 10.0
#: The same where the objective is known without a run, as that of a parameter is, which may change
#: much for a small change of what is bounded: first the bounds are kept, then the objective counts.
KNOWN_PENALTY = 1e3


@dataclass(frozen=True)
class Score:
    """Score of a point: the objective, and the cost, which has penalties where it is infeasible."""

    key: Hashable  # the same for points with the same values on the same cells
    point: Point
    level: Level
    value: float  # objective: NaN if a run failed
    error: float  # of the objective; NaN if unknown, inf if it depends on the mesh
    cost: float  # [-]
    cost_error: float  # [-], 0 if unknown
    is_feasible: bool
    has_failed: bool
    parts: tuple[float, ...] = ()  # objective in each scenario, the value is the largest one
    excesses: tuple[float, ...] = ()  # over the bounds in each scenario, relative to them

    @property
    def responses(self) -> tuple[float, ...]:
        """Smooth functions of the point: the parts of the objective, then the excesses."""
        return (*(self.parts or (self.value,)), *self.excesses)

    @property
    def has_limit(self) -> bool:
        """True if all responses are numbers that do not depend on the mesh."""
        return not math.isinf(self.error) and all(map(math.isfinite, self.responses))

    @property
    def excess(self) -> float:
        """Largest relative excess over a bound; zero if all are kept."""
        return max(0.0, *self.excesses, 0.0)


@dataclass(frozen=True)
class Found:
    """Best point that a search has found."""

    best: Score | None  # feasible, on the cells of the case
    is_cut_short: bool  # the runs were used up before the gain was within the error
    remaining_gain: float = math.nan  # of the objective, predicted around the best point


#: Points that are likely to follow, a given number of them.
Foreseen = Callable[[int], Sequence[Point]]
#: Scores of some points; workers that are free compute those that are likely to follow.
#: BudgetSpentError if they would take more runs than are left.
Evaluate = Callable[[Sequence[Point], Level, Foreseen | None], Sequence[Score]]


def penalty(excess: float, weight: float = PENALTY) -> float:
    """Cost of a relative excess over a bound [-]."""
    # Less than twice the factor, and never flat, so that a search knows the way to the bound.
    return weight * (excess if excess < 1 else 2 - 1 / excess)


def ranked(scores: Iterable[Score]) -> list[Score]:
    """Feasible points, the best first."""
    return sorted((each for each in scores if each.is_feasible), key=lambda each: each.value)


def closest(scores: Iterable[Score]) -> Score | None:
    """Point with the least cost, feasible or not; None if all of them failed."""
    done = (each for each in scores if not each.has_failed)
    return min(done, key=lambda each: each.cost, default=None)


def best_or_closest(scores: Sequence[Score]) -> Score | None:
    """Best feasible point, or that with the least cost where none is feasible."""
    return next(iter(ranked(scores)), None) or closest(scores)
