"""Exploration of a whole space by DIRECT, which ends when it gains less than the error."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable
from dataclasses import field
from typing import Any

import numpy as np
from scipy.optimize import direct

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.local_search import LEAST_GAIN
from viscontact.studies.design.scores import Foreseen, Point, Score

#: Times the patience of an exploration that has found no feasible trial, and the part of the runs,
#: as its inverse, after which it ends without one.
NOTHING_FEASIBLE, UNFEASIBLE_PART = 3, 2
#: Trials in which an exploration must gain something, for each parameter and for itself.
PATIENCE = 6
#: Cost of a point.
_Cost = Callable[[Any], float]


class EnoughError(Exception):
    """The last trials have gained less than the error, or enough points are known."""


@dataclass
class Exploration:
    """Costs of points that DIRECT tries."""

    score_at: Callable[[Point, Foreseen], Score]
    parameters: int
    most: int  # runs
    is_hopeless: Callable[[int], bool]  # after some trials, if none is feasible
    has_feasible: Callable[[], bool]
    #: Least cost of a point that cannot be better than a feasible one; None if it is to be run.
    least_cost: Callable[[Point], float | None] = lambda point: None
    _known: dict[Point, float] = field(default_factory=dict)  # costs so far
    _keys: set[Any] = field(default_factory=set)
    _mark: float = math.inf  # best cost when something was gained last
    _last: int = 0

    def run(self) -> None:
        """Explore until nothing is gained."""
        with contextlib.suppress(EnoughError):
            self._minimise(self._cost)

    def _minimise(self, cost: _Cost) -> None:
        direct(
            cost, [(0.0, 1.0)] * self.parameters, maxfun=100 * self.most, vol_tol=0, len_tol=1e-4
        )

    def _cost(self, given: Any) -> float:
        point = tuple(map(float, np.ravel(given)))
        least = self.least_cost(point)
        if least is not None:
            self._known[point] = least
            return least
        score = self.score_at(point, self._next_points)
        self._known[point] = score.cost
        self._keys.add(score.key)
        self._watch(score)
        return score.cost

    def _next_points(self, count: int) -> list[Point]:
        """Next points of DIRECT, if each of them costs as much as the nearest known one."""
        # The first one is the present point. DIRECT asks for several points before it decides on
        # their costs, and repeated with the known costs it takes the same way.
        found: dict[Point, None] = {}
        points, costs = list(self._known), list(self._known.values())

        def repeated(given: Any) -> float:
            point = tuple(map(float, np.ravel(given)))
            if point in self._known:
                return self._known[point]
            if len(found) > count:
                raise EnoughError
            found[point] = None
            distances = [math.dist(point, each) for each in points]
            return costs[int(np.argmin(distances))] if costs else 0.0

        with contextlib.suppress(EnoughError):
            self._minimise(repeated)
        return list(found)

    def _watch(self, score: Score) -> None:
        tried = len(self._keys)
        if score.cost < self._mark - max(LEAST_GAIN, score.cost_error):
            self._mark, self._last = score.cost, tried
        patience = PATIENCE * (1 + self.parameters)
        if not self.has_feasible():
            if self.is_hopeless(tried):
                raise EnoughError
            patience *= NOTHING_FEASIBLE
        if tried - self._last >= patience:
            raise EnoughError
