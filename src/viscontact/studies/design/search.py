"""Search for the best point of a space: DIRECT on coarse cells, then a local search."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import field
from functools import partial
from itertools import product

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.exploration import UNFEASIBLE_PART, Exploration
from viscontact.studies.design.local_search import LocalSearch
from viscontact.studies.design.scores import (
    Evaluate,
    Foreseen,
    Found,
    Point,
    Score,
    best_or_closest,
    closest,
    ranked,
)
from viscontact.studies.evaluation import Budget, BudgetSpentError, Level
from viscontact.studies.space import Choice, Space

#: Most points that are certified on the cells of the case, before the local search.
CANDIDATES = 3
#: Runs that are kept for the cells of the case: their part of all, as its inverse, and the most of
#: them for each parameter and for the search itself.
RESERVED, MOST_RESERVED = 2, 6
#: Half edge of the first box of a local search, in parts of the ranges: around the best trial, and
#: around the one that is closest to a feasible one.
BOX, WIDE_BOX = 0.08, 0.15
#: Parts of a range from its end in which the end itself is tried: for the best trial, and, where
#: none is feasible, for the one that is closest to being so.
NEAR_END, NEAR_UNFEASIBLE_END = 0.1, 0.25


def search(  # noqa: PLR0913
    evaluate: Evaluate,
    space: Space,
    budget: Budget,
    levels: Sequence[Level],
    *,
    size: int = 1,
    held: int = 0,
    known: Iterable[Score] = (),
    objective: Callable[[Point], float] | None = None,
) -> Found:
    """Search for the best feasible point on the last of some levels of cells, the cheapest first.

    A point takes `size` runs; `held` runs of the budget are left to later searches, `known` points
    are those of earlier ones. Where the `objective` is known without a run, points that cannot be
    better than a feasible one are not run.
    """
    made = _Search(evaluate, space, budget, levels, size, objective)
    made.tried.update({each.key: each for each in known})
    # The optimum is that of the finest cells. What its surroundings do not need is left to the rest
    # of the space.
    most = MOST_RESERVED * (1 + len(space.parameters)) * size
    budget.reserved = held
    for kept in (min(most, budget.left // RESERVED), 0):
        budget.reserved = held + kept
        made.is_cut_short = False
        made.within_budget(made.explore)
        budget.reserved, is_unexplored = held, made.is_cut_short
        made.within_budget(made.certify)
        made.within_budget(made.refine)
        if not is_unexplored:
            break
    best = next(iter(ranked(made.at(levels[-1]))), None)
    return Found(best, made.is_cut_short, made.remaining_gain)


@dataclass
class _Search:
    """Points that a search has tried."""

    evaluate: Evaluate
    space: Space
    budget: Budget
    levels: Sequence[Level]
    size: int
    objective: Callable[[Point], float] | None = None
    tried: dict[Hashable, Score] = field(default_factory=dict)
    is_cut_short: bool = False
    remaining_gain: float = math.nan

    def within_budget(self, part: Callable[[], None]) -> None:
        """Search until the runs are used up."""
        try:
            part()
        except BudgetSpentError:
            self.is_cut_short = True

    def at(self, level: Level) -> list[Score]:
        """Points of a level."""
        return [each for each in self.tried.values() if each.level == level]

    def explore(self) -> None:
        """Search the whole space on the cheapest cells, until there are feasible points."""
        self._explore(self.levels[0])
        if not ranked(self.at(self.levels[0])):
            self._approach(self.levels[0])

    def _explore(self, level: Level) -> None:
        """Search the whole space: all combinations of choices, or DIRECT over the ranges."""
        choices = [each for each in self.space.parameters if isinstance(each, Choice)]
        if len(choices) == len(self.space.parameters):
            counts = [len(each.values) for each in choices]
            middles = ([(n + 0.5) / count for n in range(count)] for count in counts)
            self._try_all(sorted(product(*middles), key=self.objective or _in_order), level)
            return
        left = (self.budget.most - self.budget.reserved) // self.size
        Exploration(
            lambda point, ahead: self.score_at(point, level, ahead),
            len(self.space.parameters),
            self.budget.most,
            lambda tried: tried >= left // UNFEASIBLE_PART and closest(self.at(level)) is not None,
            lambda: bool(ranked(self.at(level))),
            lambda point: self._least_cost(point, level),
        ).run()
        self._try_ends(level)

    def _least_cost(self, point: Point, level: Level) -> float | None:
        """Cost of a point that cannot be better than a feasible one; None if it is to be run."""
        best = next(iter(ranked(self.at(level))), None)
        if self.objective is None or best is None or not best.value:
            return None
        value = self.objective(point)
        return None if value < best.value else best.cost * value / best.value

    def _approach(self, level: Level) -> None:
        """Search around the point that is closest to a feasible one, where none is feasible."""
        if closest(self.at(level)) is not None and self.space.ranges:
            self._search_around(level, WIDE_BOX, lambda: bool(ranked(self.at(level))))

    def _try_ends(self, level: Level) -> None:
        """Try the end of a range that the best or least infeasible point is close to."""
        # DIRECT never reaches it.
        best = best_or_closest(self.at(level))
        if best is None:
            return
        near_end = NEAR_END if best.is_feasible else NEAR_UNFEASIBLE_END
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
        found = ranked(self.at(coarse))
        if not found and (nearest := closest(self.at(coarse))) is not None:
            # It may be feasible on smaller cells.
            self.score_at(nearest.point, fine, _first_of([]))
        for rank, each in enumerate(found):
            best = next(iter(ranked(self.at(fine))), None)
            if best is not None:
                # The others are worse by more than the cells can explain.
                known = each.error if math.isfinite(each.error) else 0.0
                if rank >= CANDIDATES or each.value - known > best.value:
                    return
            others = [other.point for other in found[rank + 1 : CANDIDATES]]
            self.score_at(each.point, fine, _first_of(others))

    def refine(self) -> None:
        """Search around the best point on the finest cells, or the closest one if none is."""
        if best_or_closest(self.at(self.levels[-1])) is None:
            return
        if not self.space.ranges:
            self.remaining_gain = 0.0  # all combinations have been tried
            return
        self._search_around(self.levels[-1], BOX, lambda: False)
        self._try_ends(self.levels[-1])

    def _search_around(self, level: Level, radius: float, is_enough: Callable[[], bool]) -> None:
        """Search around the best or the closest point of a level."""
        state, is_over = self._local(level, radius), False
        try:
            while not is_enough() and (step := state.proposal()) is not None:
                state, made = step
                score = self.score_at(made.point, level, partial(_followers, state))
                state = state.after(made, score)
            is_over = True
        finally:
            if state.best.is_feasible:
                # Smaller gains than the tolerance have not been followed.
                left = max(state.remaining_gain(), state.tolerance)
                left = left if is_over else max(left, state.recent_gain())
                self.remaining_gain = state.scale * left

    def _local(self, level: Level, radius: float) -> LocalSearch:
        """Local search among the points with the choices of the best one."""
        best = best_or_closest(self.at(level))
        assert best is not None
        ranges = self.space.ranges

        keys = [key for number, key in enumerate(self.space.keys) if number not in ranges]

        def choices(score: Score) -> list[str]:
            settings = self.space.settings(score.point)
            return [settings[key] for key in keys]

        own = choices(best)
        alike = [each for each in self.tried.values() if choices(each) == own]
        coarse = [each for each in alike if each.level != level and each.has_limit]
        scores = tuple(each for each in alike if each.level == level)
        is_known = self.objective is not None
        return LocalSearch(ranges, scores, tuple(coarse), radius, is_known=is_known)

    def _try_all(self, points: Sequence[Point], level: Level) -> None:
        for number, point in enumerate(points, 1):
            if self._least_cost(point, level) is None:
                self.score_at(point, level, _first_of(points[number:]))

    def score_at(self, point: Point, level: Level, ahead: Foreseen) -> Score:
        """Return the score of a point; `ahead` are the points that are likely to follow."""
        (score,) = self.evaluate([point], level, ahead)
        return self.tried.setdefault(score.key, score)


def _followers(state: LocalSearch, count: int) -> list[Point]:
    """Points of a local search, if the surrogate is right at each of them."""
    found: list[Point] = []
    while len(found) <= count and (step := state.proposal()) is not None:
        state, made = step
        found.append(made.point)
        state = state.after(made, state.believed(made))
    return found


def _in_order(point: Point) -> float:
    """Sort key that leaves points in their order."""
    return 0.0


def _first_of(points: Sequence[Point]) -> Foreseen:
    return lambda count: points[:count]
