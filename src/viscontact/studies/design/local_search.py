"""Local search: points where a surrogate predicts a gain, and around the best one."""

# A trust-region method with polls. The surrogate proposes the point with the least predicted cost
# in a box around the best one; where it predicts no gain, the points at the faces of the box are
# polled, as in a pattern search (Torczon 1997), and then the box is halved. In the end, points of
# the whole space are proposed.

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.stats.qmc import Sobol

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.scores import (
    KNOWN_PENALTY,
    PENALTY,
    Point,
    Score,
    best_or_closest,
    ranked,
)
from viscontact.studies.design.surrogate import Surrogate, interpolant

#: Least gain that counts, relative to the objective, where the error is smaller or not known; the
#: part of the error that counts where it is larger, and the most of that.
LEAST_GAIN, ERROR_PART, MOST_ERROR = 1e-3, 0.25, 2.5e-3
#: Half edges of the box around the best point, in parts of the ranges: the least and the largest.
LEAST_RADIUS, LARGEST_RADIUS = 1e-3, 0.25
#: Least distance from the points that are known, in parts of the radius, and at least.
APART, LEAST_APART = 0.02, 2e-4
#: Least half edge of the box in which the gain of a known objective is predicted.
KNOWN_RADIUS = 0.03
#: Points in the box at which the surrogate is evaluated, by the number of ranges.
GRIDS, SOBOL = {1: 161, 2: 41}, 11
#: Last predictions that give the error of the surrogate.
REMEMBERED = 3
#: Last points, whose gain is expected of as many further ones, for each parameter and the search.
RECENT = 1
#: Half edge of the box that is the whole space, and the looks there without a gain that end a
#: search, for each parameter and for the search itself.
WHOLE, LOOKS = 1.0, 2


@dataclass(frozen=True)
class Prediction:
    """Point that is proposed, and what the surrogate predicts there."""

    point: Point
    responses: tuple[float, ...]  # the cost alone, if no known point has a limit
    cost: float  # [-]
    objective: float  # [-]
    excess: float


@dataclass(frozen=True)
class LocalSearch:
    """State of a local search; a step of it makes another one."""

    ranges: tuple[int, ...]  # coordinates that change
    scores: tuple[Score, ...]  # on one level of cells
    coarse: tuple[Score, ...] = ()  # on a cheaper one, with limits
    radius: float = 0.1
    misses: tuple[float, ...] = ()  # last errors of the predicted objective [-]
    margin: float = 0.0  # last error of a predicted excess where a bound was not kept
    looks: int = 0  # into the whole space, since the last gain
    is_known: bool = False  # the objective, without a run

    @property
    def best(self) -> Score:
        """Best feasible point, or the closest one."""
        found = best_or_closest(self.scores)
        return self.scores[0] if found is None else found

    @property
    def weight(self) -> float:
        """Cost of a relative excess over a bound [-]."""
        return KNOWN_PENALTY if self.is_known else PENALTY

    @property
    def tolerance(self) -> float:
        """Gain that does not count [-]."""
        return max(LEAST_GAIN, min(ERROR_PART * self.best.cost_error, MOST_ERROR))

    @property
    def scale(self) -> float:
        """Size of the objective, also where the best one is about zero."""
        sizes = [abs(each.value) for each in self.with_limits]
        own = abs(self.best.value) if self.best.has_limit else 0.0
        return max(own, 1e-3 * max(sizes, default=0.0)) or 1.0

    @property
    def with_limits(self) -> list[Score]:
        """Points whose responses the surrogate interpolates."""
        return [each for each in self.scores if each.has_limit]

    @property
    def miss(self) -> float:
        """Error of the predicted objective [-]; NaN if it is not known."""
        if self.is_known:
            return 0.0
        if self.misses:
            return max(self.misses[-REMEMBERED:])
        others = [each for each in self.scores if each is not self.best]
        if not self.best.has_limit or not any(each.has_limit for each in others):
            return math.nan
        made, _ = self._predicted(others, np.array([self.best.point])[:, list(self.ranges)])
        return abs(float(made[0]) - self.best.value / self.scale)

    @property
    def parts(self) -> int:
        """Number of the responses that are parts of the objective."""
        return len(self.scores[0].parts) or 1

    def responses(self, points: Floats, scores: Sequence[Score] | None = None) -> Floats:
        """Responses at some points, of shape (points, responses): the costs without limits."""
        known, own = self.scores if scores is None else scores, list(self.ranges)
        fine = [each for each in known if each.has_limit]
        if not fine:
            done = [each for each in known if not each.has_failed]
            return Surrogate.through([(_part(each, own), (each.cost,)) for each in done])(points)
        # Many points on the cells of the case know more about a small box than the coarse ones.
        is_coarse = len(fine) <= 2 * len(own) + 1 or self.radius == WHOLE
        coarse = self.coarse if is_coarse and len(self.coarse) > len(own) else ()
        samples = (
            [(_part(each, own), each.responses) for each in group] for group in (fine, coarse)
        )
        return Surrogate.through(*samples)(points)

    def _predicted(self, scores: Sequence[Score], points: Floats) -> tuple[Floats, Floats]:
        return self.objective_and_excess(self.responses(points, scores))

    def objective_and_excess(self, responses: Floats) -> tuple[Floats, Floats]:
        """Objective over its size, and largest excess, of some responses."""
        if not self.with_limits:
            return responses[:, 0], np.zeros(len(responses))
        excess = responses[:, self.parts :].max(axis=1, initial=-1.0)
        return responses[:, : self.parts].max(axis=1) / self.scale, excess

    def own_cost(self, score: Score) -> float:
        """Cost of a point in the sense of the predictions [-]."""
        if not self.with_limits:
            return score.cost
        if not score.has_limit:
            return math.inf
        return score.value / self.scale + self.weight * score.excess

    def proposal(self) -> tuple[LocalSearch, Prediction] | None:
        """Next point, and the search with its present box; None if nothing is to be gained."""
        if all(each.has_failed for each in self.scores):
            return None
        state = self
        while state.radius >= LEAST_RADIUS:
            found = state._model_step() or state._poll()
            if found is not None:
                return state, found
            is_certain = len(state.misses) >= REMEMBERED and not self.is_known
            if is_certain and state.remaining_gain() <= state.tolerance:
                break
            state = replace(state, radius=state.radius / 2)
        if state.looks >= LOOKS * (1 + len(self.ranges)) or not self.with_limits:
            return None
        made = replace(state, radius=WHOLE)._model_step()
        return None if made is None else (replace(state, looks=state.looks + 1), made)

    def after(self, made: Prediction, score: Score) -> LocalSearch:
        """The search with the score of a point that it has proposed."""
        if any(each.key == score.key for each in self.scores):
            # The values of a narrow range are equal to all their digits.
            return replace(self, radius=self.radius / 2)
        before, found = self.best, replace(self, scores=(*self.scores, score))
        misses, margin, radius, looks = self.misses, self.margin, self.radius, self.looks
        if score.has_limit:
            if len(self.with_limits) > len(self.ranges):
                missed = score.value / self.scale - made.objective
                if self.is_known:
                    missed = max(score.excesses, default=0.0) - made.excess
                misses = (*misses, abs(missed))
            over = score.excess - made.excess if score.excess > 0 else 0.0
            # Next to a bound that is not kept lies the optimum of a known objective.
            margin = 0.0 if self.is_known else min(max(over, margin / 2), 10 * LEAST_GAIN)
        if found.best is score and self._gain(before, score) > self.tolerance:
            moved = self._distance(score.point, before.point)
            looks, radius = 0, min(max(2 * moved, radius / 2), LARGEST_RADIUS)
        elif score.has_limit and made.cost < self.own_cost(before) - self.tolerance:
            radius /= 2  # the surrogate has promised a gain
        return replace(found, misses=misses, margin=margin, radius=radius, looks=looks)

    def remaining_gain(self) -> float:
        """Gain that the surrogate leaves in the box, with the error of its predictions [-]."""
        if self.is_known:
            # Its predictions err in the excess, and a small box would hide that.
            points = replace(self, radius=max(self.radius, KNOWN_RADIUS))._box()
            objective, excess = self._predicted(self.scores, points)
            is_open = excess <= max(self.misses[-REMEMBERED:], default=math.inf)
            return max(
                0.0, self.best.value / self.scale - float(objective[is_open].min(initial=math.inf))
            )
        points = self._box()
        objective, excess = self._predicted(self.scores, points)
        is_open = (excess <= self.margin) & ~self._behind_barriers(points)
        is_open &= self._limits(points) > -1.0
        least = float(objective[is_open].min(initial=math.inf))
        return max(0.0, self.best.value / self.scale - least) + self.miss

    def recent_gain(self) -> float:
        """Gain of the last points, a few for each parameter; zero if there was none."""
        before = ranked(self.scores[: -RECENT * (1 + len(self.ranges))])
        return (before[0].value - self.best.value) / self.scale if before else 0.0

    def _gain(self, before: Score, after: Score) -> float:
        if before.is_feasible != after.is_feasible:
            return math.inf
        return self.own_cost(before) - self.own_cost(after)

    def _model_step(self) -> Prediction | None:
        """Point of the box with the least predicted cost, if that is a gain."""
        points = self._box()
        made = self._best_of(points[self._is_open(points)])
        return made if made and made.cost < self.own_cost(self.best) - self.tolerance else None

    def _poll(self) -> Prediction | None:
        """Point at a face of the box where a gain is possible, the most likely one first."""
        center, own = np.array(self.best.point)[list(self.ranges)], len(self.ranges)
        points = np.clip(center + self.radius * np.vstack([np.eye(own), -np.eye(own)]), 0, 1)
        distances = np.linalg.norm(points[:, None] - self._coordinates(self.scores), axis=2)
        is_apart = distances.min(axis=1) > self.radius / 2
        made = self._best_of(points[is_apart & ~self._behind_barriers(points)])
        miss = self.miss if len(self.misses) >= REMEMBERED else math.inf
        hoped = made.cost - miss if made else math.inf
        return made if hoped < self.own_cost(self.best) - self.tolerance else None

    def _best_of(self, points: Floats) -> Prediction | None:
        """Prediction with the least cost; None without points."""
        if not len(points):
            return None
        responses = self.responses(points)
        objective, excess = self.objective_and_excess(responses)
        # A surrogate that has missed a bound keeps this distance from it.
        costs = objective + self.weight * np.maximum(excess + self.margin, 0.0)
        row = int(costs.argmin())
        point = np.array(self.best.point)
        point[list(self.ranges)] = points[row]
        found = (float(each[row]) for each in (costs, objective, excess))
        return Prediction(tuple(point.tolist()), tuple(responses[row].tolist()), *found)

    def believed(self, made: Prediction) -> Score:
        """Score of a point if the prediction is right."""
        return replace(
            self.best,
            key=made.point,
            point=made.point,
            value=made.objective * self.scale,
            cost=made.cost,
            is_feasible=bool(self.with_limits) and made.excess <= 0,
            parts=made.responses[: self.parts],
            excesses=made.responses[self.parts :],
        )

    def _box(self) -> Floats:
        center = np.array(self.best.point)[list(self.ranges)]
        return np.clip(center + self.radius * _offsets(len(self.ranges)), 0.0, 1.0)

    def _is_open(self, points: Floats) -> Bools:
        """True where a point is apart from all known ones, and more likely than not has a limit."""
        known = self._coordinates(self.scores)
        distances = np.linalg.norm(points[:, None] - known, axis=2)
        is_apart = distances.min(axis=1) > max(LEAST_APART, APART * self.radius)
        return np.asarray(is_apart & (self._limits(points) >= 0.0))

    def _limits(self, points: Floats) -> Floats:
        """Interpolant that is 1 at the points with a limit and -1 at those without."""
        limits = np.array([each.has_limit for each in self.scores])
        if limits.all() or not limits.any():
            return np.ones(len(points))
        known = self._coordinates(self.scores)
        return interpolant(known, np.where(limits, 1.0, -1.0)[:, None])(points)[:, 0]

    def _behind_barriers(self, points: Floats) -> Bools:
        """True where a point without a limit lies between a point and the best one."""
        barriers = [each for each in self.scores if not each.has_limit]
        if not barriers or not self.best.has_limit:
            return np.zeros(len(points), dtype=bool)
        center = np.array(self.best.point)[list(self.ranges)]
        ways, walls = points - center, self._coordinates(barriers) - center
        lengths, far = np.linalg.norm(ways, axis=1), np.linalg.norm(walls, axis=1)
        along = ways @ walls.T >= 0.7 * np.outer(lengths, far)
        return np.asarray((along & (lengths[:, None] >= far)).any(axis=1))

    def _coordinates(self, scores: Sequence[Score]) -> Floats:
        return np.array([each.point for each in scores])[:, list(self.ranges)]

    def _distance(self, one: Point, other: Point) -> float:
        return float(np.abs(np.subtract(one, other)).max())


def _part(score: Score, numbers: Sequence[int]) -> Point:
    return tuple(score.point[number] for number in numbers)


def _offsets(count: int) -> Floats:
    """Points of a box, from -1 to 1, of shape (points, `count`)."""
    if count in GRIDS:
        line = np.linspace(-1, 1, GRIDS[count])
        return np.stack(np.meshgrid(*[line] * count), axis=-1).reshape(-1, count)
    inside = 2 * Sobol(count, scramble=False).random_base2(SOBOL) - 1
    return np.vstack([inside, 0.3 * inside, np.eye(count), -np.eye(count)])
