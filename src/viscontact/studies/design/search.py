"""Search for the best point of a space: DIRECT on coarse cells, then a local search."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from scipy.optimize import direct, minimize

from viscontact.studies.evaluation import Budget, BudgetSpentError, Level
from viscontact.studies.space import Choice, Space

Point = tuple[float, ...]

#: Times the patience of a search that has found no feasible trial, and the part of the runs, as its
#: inverse, after which the search of the whole space ends without one.
NOTHING_FEASIBLE, UNFEASIBLE_PART = 3, 2
#: Trials in which a search must gain something, for each parameter and for the search itself: of
#: the whole space, and of the surroundings of the best trial.
PATIENCE, LOCAL_PATIENCE = 6, 3
#: Least gain that counts, relative to the objective, where the error is not known or smaller.
LEAST_GAIN = 1e-3
#: Most points that are certified on the cells of the case, before the local search, and the part of
#: all runs that is kept for them at most, as its inverse.
CANDIDATES, RESERVED = 3, 3
#: Edge of the first simplex of the local search, in parts of the ranges: around the best trial, and
#: around the one that is closest to a feasible one.
SIMPLEX, WIDE_SIMPLEX = 0.04, 0.1
#: Parts of a range from its end in which the end itself is tried: for the best trial, and, where
#: none is feasible, for the one that is closest to being so.
NEAR_END, NEAR_UNFEASIBLE_END = 0.1, 0.25


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


#: Points that are likely to follow, a given number of them.
Foreseen = Callable[[int], Sequence[Point]]
#: Scores of some points; workers that are free compute those that are likely to follow.
#: BudgetSpentError if they would take more runs than are left.
Evaluate = Callable[[Sequence[Point], Level, Foreseen | None], Sequence[Score]]
#: Cost of a point.
_Cost = Callable[[Any], float]


def search(
    evaluate: Evaluate,
    space: Space,
    budget: Budget,
    levels: Sequence[Level],
    *,
    size: int = 1,
    held: int = 0,
    known: Iterable[Score] = (),
) -> tuple[Score | None, bool]:
    """Best feasible point of a space on the last of some levels of cells, the cheapest first.

    A point takes `size` runs; `held` runs of the budget are left to later searches, `known` points
    are those of earlier ones. True if the runs were used up before the gain was within the error.
    """
    made = _Search(evaluate, space, budget, levels, size)
    made.tried.update({each.key: each for each in known})
    budget.reserved = held
    if len(levels) > 1:
        # The best points are to be computed on the finest cells in any event.
        budget.reserved += min(CANDIDATES * size, budget.left // RESERVED)
    first = levels[0]
    made.within_budget(partial(made.explore, first))
    if made.best(first) is None:
        made.within_budget(partial(made.approach, first))
    budget.reserved = held
    made.within_budget(made.certify)
    made.within_budget(made.refine)
    return made.best(levels[-1]), made.is_cut_short


class _EnoughError(Exception):
    """The last trials of a search have gained less than the error, or enough points are known."""


@dataclass
class _Search:
    """Points that a search has tried."""

    evaluate: Evaluate
    space: Space
    budget: Budget
    levels: Sequence[Level]
    size: int
    tried: dict[Hashable, Score] = field(default_factory=dict)
    is_cut_short: bool = False

    def within_budget(self, part: Callable[[], None]) -> None:
        """Search until the runs are used up."""
        try:
            part()
        except BudgetSpentError:
            self.is_cut_short = True

    def best(self, level: Level) -> Score | None:
        """Best feasible point of a level."""
        return next(iter(self._ranked(level)), None)

    def closest(self, level: Level) -> Score | None:
        """Point of a level with the least cost, feasible or not; None if all of them failed."""
        done = (each for each in self._scores_at(level) if not each.has_failed)
        return min(done, key=lambda each: each.cost, default=None)

    def _scores_at(self, level: Level) -> list[Score]:
        return [each for each in self.tried.values() if each.level == level]

    def _ranked(self, level: Level) -> list[Score]:
        """Feasible points of a level, the best first."""
        found = [each for each in self._scores_at(level) if each.is_feasible]
        return sorted(found, key=lambda each: each.value)

    def explore(self, level: Level) -> None:
        """Search the whole space: all combinations of choices, or DIRECT over the ranges."""
        choices = [each for each in self.space.parameters if isinstance(each, Choice)]
        if len(choices) == len(self.space.parameters):
            counts = [len(each.values) for each in choices]
            middles = ([(n + 0.5) / count for n in range(count)] for count in counts)
            self._try_all(list(product(*middles)), level)
            return
        bounds = [(0.0, 1.0)] * len(self.space.parameters)
        most = 100 * self.budget.most

        def minimise(cost: _Cost) -> None:
            direct(cost, bounds, maxfun=most, vol_tol=0, len_tol=1e-4)

        left = (self.budget.most - self.budget.reserved) // self.size
        patience = PATIENCE * (1 + len(self.space.parameters))
        _Watched(self, level, patience, minimise, left // UNFEASIBLE_PART).run()
        self._try_ends(level)

    def approach(self, level: Level) -> None:
        """Search around the point that is closest to a feasible one, where none is feasible."""
        closest = self.closest(level)
        if closest is not None and self.space.ranges:
            self._search_around(closest, level, WIDE_SIMPLEX)

    def _try_ends(self, level: Level) -> None:
        """Try the end of a range that the best or least infeasible point is close to."""
        # DIRECT never reaches it.
        best, near_end = self.best(level), NEAR_END
        if best is None:
            best, near_end = self.closest(level), NEAR_UNFEASIBLE_END
        if best is None:
            return
        point = list(best.point)
        ends = {n: round(point[n]) for n in self.space.ranges}
        near = [(n, end) for n, end in ends.items() if abs(point[n] - end) < near_end]
        tried = [(*point[:n], float(end), *point[n + 1 :]) for n, end in near]
        if len(near) > 1:
            for n, end in near:
                point[n] = float(end)
            # A corner comes first: it may be the only feasible one of them.
            tried.insert(0, tuple(point))
        self._try_all(tried, level)

    def certify(self) -> None:
        """Compute the best points of the coarse cells on the finest ones."""
        coarse, fine = self.levels[0], self.levels[-1]
        if coarse == fine:
            return
        ranked = self._ranked(coarse)
        if not ranked and (closest := self.closest(coarse)) is not None:
            # It may be feasible on smaller cells.
            self.score_at(closest.point, fine, _first_of([]))
        for rank, each in enumerate(ranked):
            best = self.best(fine)
            if best is not None:
                # The others are worse by more than the cells can explain.
                known = each.error if math.isfinite(each.error) else 0.0
                if rank >= CANDIDATES or each.value - known > best.value:
                    return
            others = [other.point for other in ranked[rank + 1 : CANDIDATES]]
            self.score_at(each.point, fine, _first_of(others))

    def refine(self) -> None:
        """Search around the best point on the finest cells, by Nelder and Mead."""
        best = self.best(self.levels[-1])
        if best is None or not self.space.ranges:
            return
        self._search_around(best, self.levels[-1], SIMPLEX)
        self._try_ends(self.levels[-1])

    def _search_around(self, best: Score, level: Level, edge: float) -> None:
        """Search around a point by Nelder and Mead, from a simplex with some edge."""
        start, ranges = np.array(best.point), self.space.ranges
        simplex = np.tile(start[list(ranges)], (len(ranges) + 1, 1))
        for row in range(len(ranges)):
            simplex[row + 1, row] += edge if simplex[0, row] < 0.5 else -edge
        bounds = [(0, 1)] * len(ranges)
        options = {"initial_simplex": simplex, "xatol": 1e-3, "fatol": 0.0}

        def minimise(cost: _Cost) -> None:
            def of_ranges(coordinates: Any) -> float:
                point = start.copy()
                point[list(ranges)] = coordinates
                return cost(point)

            minimize(of_ranges, simplex[0], method="Nelder-Mead", bounds=bounds, options=options)

        _Watched(self, level, LOCAL_PATIENCE * (1 + len(ranges)), minimise).run()

    def _try_all(self, points: Sequence[Point], level: Level) -> None:
        for number, point in enumerate(points, 1):
            self.score_at(point, level, _first_of(points[number:]))

    def score_at(self, point: Point, level: Level, ahead: Foreseen) -> Score:
        """Return the score of a point; `ahead` are the points that are likely to follow."""
        (score,) = self.evaluate([point], level, ahead)
        return self.tried.setdefault(score.key, score)


class _Watched:
    """Cost of points in parts of the objective; it ends a search that gains less than the error."""

    def __init__(
        self,
        search: _Search,
        level: Level,
        patience: int,
        minimise: Callable[[_Cost], None],
        most_unfeasible: float = math.inf,
    ) -> None:
        self._search, self._level, self._patience = search, level, patience
        self._minimise, self._most_unfeasible = minimise, most_unfeasible
        self._known: dict[Point, float] = {}  # costs so far
        self._mark = math.inf  # best cost when something was gained last
        self._tried, self._last = 0, 0

    def run(self) -> None:
        """Search until nothing is gained."""
        with contextlib.suppress(_EnoughError):
            self._minimise(self)

    def __call__(self, given: Any) -> float:
        before, point = len(self._search.tried), tuple(map(float, np.ravel(given)))
        score = self._search.score_at(point, self._level, self._next_points)
        self._known[point] = score.cost
        self._watch(score, is_new=len(self._search.tried) > before)
        return score.cost

    def _next_points(self, count: int) -> list[Point]:
        """Next points of the search, if each of them costs as much as the nearest known one."""
        # The first one is the present point. A method asks for several points before it decides on
        # their costs, and repeated with the known costs it takes the same way.
        found: dict[Point, None] = {}
        points, costs = list(self._known), list(self._known.values())

        def repeated(given: Any) -> float:
            point = tuple(map(float, np.ravel(given)))
            if point in self._known:
                return self._known[point]
            if len(found) > count:
                raise _EnoughError
            found[point] = None
            distances = [math.dist(point, each) for each in points]
            return costs[int(np.argmin(distances))] if costs else 0.0

        with contextlib.suppress(_EnoughError):
            self._minimise(repeated)
        return list(found)

    def _watch(self, score: Score, *, is_new: bool) -> None:
        self._tried += is_new
        if score.cost < self._mark - max(LEAST_GAIN, score.cost_error):
            self._mark, self._last = score.cost, self._tried
        patience = self._patience
        if self._search.best(self._level) is None:
            if self._tried >= self._most_unfeasible and self._search.closest(self._level):
                raise _EnoughError
            patience *= NOTHING_FEASIBLE
        if self._tried - self._last >= patience:
            raise _EnoughError


def _first_of(points: Sequence[Point]) -> Foreseen:
    return lambda count: points[:count]
