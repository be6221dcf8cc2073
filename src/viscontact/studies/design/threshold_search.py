"""Search for the best value of one parameter that keeps the constraints: a root of their excess."""

# The objective is the parameter itself, which costs no run and has no error, so that the best point
# lies at an end of the range or where the largest excess over a bound passes through zero. The
# range is looked at from its better end on, on coarse cells. The first change of sign is then
# enclosed, on the coarse cells and on those of the case, by the root of radial basis functions
# through all points, or by bisection where that is slower.

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import field

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.local_search import LEAST_GAIN
from viscontact.studies.design.scores import Evaluate, Found, Point, Score, closest, ranked
from viscontact.studies.design.surrogate import Surrogate
from viscontact.studies.evaluation import Budget, BudgetSpentError, Level

#: Parts of the range between the first points that are tried, and further points where none of them
#: keeps the constraints, with the least distance between them in parts of the range.
FIRST_PARTS, FURTHER, APART = 4, 12, 0.01
#: Relative gain in the bracket at which it is narrow enough, on coarse cells.
COARSE_GAIN = 2e-2
#: Points in a bracket at which the surrogate is evaluated.
GRID = 400
#: Steps after which a bracket must have half its width.
PATIENCE = 3


def threshold(
    evaluate: Evaluate,
    objective: Callable[[Point], float],
    budget: Budget,
    levels: Sequence[Level],
    *,
    held: int = 0,
    known: Iterable[Score] = (),
) -> Found:
    """Best feasible point of a range along which the objective is known, and monotone.

    `held` runs of the budget are left to later searches, `known` points are those of earlier ones.
    """
    made = _Bracketing(evaluate, objective, levels, objective((0.0,)) < objective((1.0,)))
    made.tried.update({each.key: each for each in known})
    budget.reserved, is_cut_short = held, False
    try:
        made.scan()
        for level in dict.fromkeys(levels):
            made.enclose(level)
    except BudgetSpentError:
        is_cut_short = True
    best = next(iter(ranked(made.at(levels[-1]).values())), None)
    if best is None:
        return Found(None, is_cut_short)
    low, high = made.bracket(levels[-1])
    return Found(best, is_cut_short, abs(made.value(high) - made.value(low)))


@dataclass
class _Bracketing:
    """Points of the range, by their distance from its better end, as a part of it."""

    evaluate: Evaluate
    objective: Callable[[Point], float]
    levels: Sequence[Level]
    is_rising: bool
    tried: dict[Hashable, Score] = field(default_factory=dict)

    def at(self, level: Level) -> dict[float, Score]:
        """Points of a level by their places, from the better end of the range on."""
        found = ((self._turned(each.point[0]), each) for each in self.tried.values())
        return dict(sorted(pair for pair in found if pair[1].level == level))

    def value(self, place: float) -> float:
        """Objective at a place."""
        return self.objective((self._turned(place),))

    def _turned(self, part: float) -> float:
        return part if self.is_rising else 1.0 - part

    def score_at(self, places: Sequence[float], level: Level) -> Score:
        """Score of the first of some places; the others are likely to follow."""
        points: list[Point] = [(self._turned(each),) for each in places]
        (score,) = self.evaluate(points[:1], level, lambda count: points[1 : 1 + count])
        return self.tried.setdefault(score.key, score)

    def scan(self) -> None:
        """Try even distances on the coarsest cells, up to the first feasible one."""
        level, places = self.levels[0], np.linspace(0, 1, FIRST_PARTS + 1).tolist()
        while places:
            if self.score_at(places, level).is_feasible:
                return
            places.pop(0)
        for number in range(FURTHER):
            if self.score_at([self._further(level, number)], level).is_feasible:
                return

    def _further(self, level: Level, number: int) -> float:
        """Place where the least excess is predicted, and by turns the one farthest from others."""
        places = np.linspace(0, 1, GRID + 1)
        apart = np.abs(places[:, None] - np.array(list(self.at(level)))).min(axis=1)
        excess = self._predicted_excess(level, places)
        if number % 2 or np.isnan(excess).any():
            return float(places[apart.argmax()])
        return float(places[np.where(apart > APART, excess, math.inf).argmin()])

    def _closest(self, level: Level) -> float:
        """Place of a level that is closest to a feasible one; the better end if all failed."""
        best = closest(self.at(level).values())
        return 0.0 if best is None else self._turned(best.point[0])

    def enclose(self, level: Level) -> None:
        """Narrow the first change of sign of a level until the gain in it is small."""
        coarse = self.levels[0]
        if not ranked(self.at(coarse).values()):
            # It may be feasible on smaller cells.
            self.score_at([self._closest(coarse)], level)
            if not ranked(self.at(level).values()):
                return
        least = LEAST_GAIN if level == self.levels[-1] else COARSE_GAIN
        widths: list[float] = []
        while (place := self._next(level, widths, least)) is not None:
            count = len(self.tried)
            self.score_at([place], level)
            if len(self.tried) == count:
                return  # the values are equal to all their digits

    def bracket(self, level: Level) -> tuple[float, float]:
        """Ends of the first change of sign: places of a level, or ends of the range."""
        known = self.at(level)
        high = next((place for place, each in known.items() if each.is_feasible), 1.0)
        return max((place for place in known if place < high), default=0.0), high

    def _next(self, level: Level, widths: list[float], least: float) -> float | None:
        """Next place in the bracket, of which `widths` are kept; None if the gain is small."""
        known, (low, high) = self.at(level), self.bracket(level)
        widths.append(high - low)
        is_closed = high in known and known[high].is_feasible
        # Over the value, or over the range where that is less, as it is at a value of zero.
        extent = abs(self.value(1.0) - self.value(0.0))
        size = min(abs(self.value(high)) or extent, extent)
        gain = abs(self.value(high) - self.value(low)) / size
        if is_closed and (high == 0.0 or (low in known and gain <= least)):
            return None
        if len(widths) > PATIENCE and widths[-1] > widths[-1 - PATIENCE] / 2:
            return (low + high) / 2
        root = self._root(level, low, high)
        if root == 0.0:
            return 0.0 if low not in known else (low + high) / 2
        # Most of the step whose gain is small, so that two steps enclose the root.
        behind, ahead = max(root - 1e-3, 0.0), min(root + 1e-3, 1.0)
        slope = abs(self.value(ahead) - self.value(behind)) / (ahead - behind)
        if slope == 0:  # the values are equal to all their digits
            return (low + high) / 2
        step = min(0.8 * least * size / slope, (high - low) / 2)
        if is_closed and high - root <= step:
            return high - step
        return min(root + step / 2, high - step / 2 if is_closed else high)

    def _root(self, level: Level, low: float, high: float) -> float:
        """Place in a bracket where the predicted excess passes through zero, or is least."""
        places = np.linspace(low, high, GRID + 1)
        excess = self._predicted_excess(level, places)
        if np.isnan(excess).any():
            return (low + high) / 2
        row = int((excess <= 0).argmax()) if (excess <= 0).any() else int(excess.argmin())
        if row == 0 or excess[row] > 0:
            return float(places[row])
        part = excess[row - 1] / (excess[row - 1] - excess[row])
        return float(places[row - 1] + part * (places[row] - places[row - 1]))

    def _predicted_excess(self, level: Level, places: Floats) -> Floats:
        """Largest excess over the bounds, as the points of a level and coarse ones predict it."""
        # Logarithms far from zero: a power of the parameter is straight on a logarithmic range.
        samples = [
            [
                ((place,), [math.copysign(math.log1p(abs(e)), e) for e in each.excesses])
                for place, each in self.at(one).items()
                if each.has_limit
            ]
            for one in dict.fromkeys((level, self.levels[0]))
        ]
        filled = [each for each in samples if each]
        if not filled or not filled[0][0][1]:
            return np.full(len(places), math.nan)
        return np.asarray(Surrogate.through(*filled)(places[:, None]).max(axis=1))
