"""Search for the best point of a space: DIRECT on coarse cells, then a local search."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from scipy.optimize import direct, minimize

from viscontact.studies.design.penalised_cost import PenalisedCost
from viscontact.studies.design.trials import Trial
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
#: Most trials that are certified on the cells of the case, before the local search.
CANDIDATES = 3
#: Part of all runs that is kept for them at most, as its inverse.
RESERVED = 3
#: Edge of the first simplex of the local search, in parts of the ranges: around the best trial, and
#: around the one that is closest to a feasible one.
SIMPLEX, WIDE_SIMPLEX = 0.04, 0.1
#: Parts of a range from its end in which the end itself is tried: for the best trial, and, where
#: none is feasible, for the one that is closest to being so.
NEAR_END, NEAR_UNFEASIBLE_END = 0.1, 0.25

#: Points that are likely to follow, a given number of them.
Foreseen = Callable[[int], Sequence[Point]]
#: Trials at some points; workers that are free compute those that are likely to follow.
#: BudgetSpentError if they would take more runs than are left.
Evaluate = Callable[[Sequence[Point], Level, Foreseen | None], Sequence[Trial]]
#: Cost of a point.
_Cost = Callable[[Any], float]


class _NothingGainedError(Exception):
    """The last trials of a search have gained less than the error."""


class _ForeseenError(Exception):
    """Enough of the next points of a search are known."""


@dataclass
class Search:
    """Search over a space by trials at its points."""

    space: Space
    evaluate: Evaluate
    cost: PenalisedCost
    budget: Budget
    levels: tuple[Level, ...] = ("case",)  # the cheap one first
    size: int = 1  # runs of a trial
    tried: dict[tuple[str, ...], tuple[Point, Trial]] = field(default_factory=dict)
    held: int = 0  # runs that are left to other searches
    is_cut_short: bool = False  # the runs were used up before the gain was within the error

    def run(self) -> Trial | None:
        """Return the best feasible trial on the cells of the case; None without one."""
        budget = self.budget
        budget.reserved = self.held
        if len(self.levels) > 1:
            # The best trials are to be computed on the cells of the case in any event.
            most = budget.left // RESERVED
            budget.reserved += min(CANDIDATES * self.size, most)
        first = self.levels[0]
        self._within_budget(partial(self._explore, first))
        if self.best(first) is None:
            self._within_budget(partial(self._approach, first))
        budget.reserved = self.held
        self._within_budget(self._certify)
        self._within_budget(self._refine)
        return self.best("case")

    def _within_budget(self, search: Callable[[], None]) -> None:
        """Search until the runs are used up."""
        try:
            search()
        except BudgetSpentError:
            self.is_cut_short = True

    def best(self, level: Level) -> Trial | None:
        """Best feasible trial of a level."""
        return next(iter(self._ranked(level)), None)

    def closest(self, level: Level) -> Trial | None:
        """Trial of a level with the least cost, feasible or not; None if all of them failed."""
        done = (each for each in self.trials(level) if not each.failure)
        return min(done, key=self.cost, default=None)

    def trials(self, level: Level) -> list[Trial]:
        """Trials of a level, in their order."""
        return [trial for _, trial in self.tried.values() if trial.level == level]

    def _ranked(self, level: Level) -> list[Trial]:
        """Feasible trials of a level, the best first."""
        found = [each for each in self.trials(level) if self.cost.is_feasible(each)]
        return sorted(found, key=lambda each: self.cost.objective.cost(each).value)

    def _explore(self, level: Level) -> None:
        """Search the whole space: all combinations of choices, or DIRECT over the ranges."""
        choices = [each for each in self.space.parameters if isinstance(each, Choice)]
        if len(choices) == len(self.space.parameters):
            self._try_all(list(product(*(_middles(len(each.values)) for each in choices))), level)
            return
        bounds = [(0.0, 1.0)] * len(self.space.parameters)
        most = 100 * self.budget.most

        def minimise(cost: _Cost) -> None:
            direct(cost, bounds, maxfun=most, vol_tol=0, len_tol=1e-4)

        left = (self.budget.most - self.budget.reserved) // self.size
        patience = PATIENCE * (1 + len(self.space.parameters))
        _Watched(self, level, patience, minimise, left // UNFEASIBLE_PART).run()
        self._try_ends(level)

    def _approach(self, level: Level) -> None:
        """Search around the trial that is closest to a feasible one, where none is feasible."""
        closest = self.closest(level)
        if closest is not None and self.space.ranges:
            self._around(closest, level, WIDE_SIMPLEX)

    def _try_ends(self, level: Level) -> None:
        """Try the end of a range that the best or least infeasible trial is close to."""
        # DIRECT never reaches it.
        best, near_end = self.best(level), NEAR_END
        if best is None:
            best, near_end = self.closest(level), NEAR_UNFEASIBLE_END
        if best is None:
            return
        point = list(self.point(best))
        ends = [round(point[n]) for n in self.space.ranges]
        near = [
            (n, end)
            for n, end in zip(self.space.ranges, ends, strict=True)
            if abs(point[n] - end) < near_end
        ]
        tried = [(*point[:n], float(end), *point[n + 1 :]) for n, end in near]
        if len(near) > 1:
            for n, end in near:
                point[n] = float(end)
            # A corner comes first: it may be the only feasible one of them.
            tried.insert(0, tuple(point))
        self._try_all(tried, level)

    def _certify(self) -> None:
        """Compute the best coarse trials on the cells of the case."""
        if self.levels[0] == "case":
            return
        certified: list[Trial] = []
        ranked = self._ranked("coarse")
        if not ranked and (closest := self.closest("coarse")) is not None:
            # It may be feasible on smaller cells.
            self.trial_at(self.point(closest), "case", _first_of([]))
        for rank, coarse in enumerate(ranked, 1):
            value = self.cost.objective.cost(coarse)
            best = self.best("case")
            if best is not None:
                # The others are worse by more than the cells can explain.
                known = value.error if math.isfinite(value.error) else 0.0
                if value.value - known > self.cost.objective.cost(best).value:
                    return
                if len(certified) >= CANDIDATES:
                    return
            others = [self.point(each) for each in ranked[rank:CANDIDATES]]
            certified.append(self.trial_at(self.point(coarse), "case", _first_of(others)))

    def _refine(self) -> None:
        """Search around the best certified trial on the cells of the case, by Nelder and Mead."""
        best = self.best("case")
        if best is None or not self.space.ranges:
            return
        self._around(best, "case", SIMPLEX)
        self._try_ends("case")

    def _around(self, trial: Trial, level: Level, edge: float) -> None:
        """Search around a trial by Nelder and Mead, from a simplex with some edge."""
        start, ranges = np.array(self.point(trial)), self.space.ranges
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

    def point(self, trial: Trial) -> Point:
        """Coordinates of a trial."""
        return self.tried[trial.key][0]

    def _try_all(self, points: Sequence[Point], level: Level) -> None:
        for number, point in enumerate(points, 1):
            self.trial_at(point, level, _first_of(points[number:]))

    def trial_at(self, point: Point, level: Level, ahead: Foreseen) -> Trial:
        """Return the trial of a point; `ahead` are the points that are likely to follow."""
        (trial,) = self.evaluate([point], level, ahead)
        clipped = tuple(float(np.clip(part, 0, 1)) for part in point)
        self.tried.setdefault(trial.key, (clipped, trial))
        return trial


class _Watched:
    """Cost of points in parts of the objective; it ends a search that gains less than the error."""

    def __init__(
        self,
        search: Search,
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
        with contextlib.suppress(_NothingGainedError):
            self._minimise(self)

    def __call__(self, given: Any) -> float:
        before, point = len(self._search.tried), tuple(map(float, np.ravel(given)))
        trial = self._search.trial_at(point, self._level, self._foreseen)
        cost = self._known[point] = self._search.cost(trial)
        self._watch(trial, cost, is_new=len(self._search.tried) > before)
        return cost

    def _foreseen(self, count: int) -> list[Point]:
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
                raise _ForeseenError
            found[point] = None
            distances = [math.dist(point, each) for each in points]
            return costs[int(np.argmin(distances))] if costs else 0.0

        with contextlib.suppress(_ForeseenError):
            self._minimise(repeated)
        return list(found)

    def _watch(self, trial: Trial, cost: float, *, is_new: bool) -> None:
        self._tried += is_new
        if cost < self._mark - max(LEAST_GAIN, self._search.cost.error(trial)):
            self._mark, self._last = cost, self._tried
        patience = self._patience
        if self._search.best(self._level) is None:
            if self._tried >= self._most_unfeasible and self._search.closest(self._level):
                raise _NothingGainedError
            patience *= NOTHING_FEASIBLE
        if self._tried - self._last >= patience:
            raise _NothingGainedError


def _first_of(points: Sequence[Point]) -> Foreseen:
    return lambda count: points[:count]


def _middles(count: int) -> list[float]:
    """Coordinates in the middle of the parts of some choices."""
    return [(number + 0.5) / count for number in range(count)]
