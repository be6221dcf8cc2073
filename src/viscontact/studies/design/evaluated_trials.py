"""Trials of a design, whose runs an evaluation makes, and the search among them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import Any

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.objectives import Objective, PenalisedCost
from viscontact.studies.design.scores import Foreseen, Point, Score
from viscontact.studies.design.search import search
from viscontact.studies.design.threshold_search import threshold
from viscontact.studies.design.trials import ScenarioResult, Trial
from viscontact.studies.evaluation import Budget, Evaluation, Level, StudyRun
from viscontact.studies.journal import Entry
from viscontact.studies.scalars import Value
from viscontact.studies.space import Space

#: Runs of a trial with some values, on cells of a level, one for each scenario.
RunsOf = Callable[[Mapping[str, str], Level], Sequence[StudyRun]]


@dataclass
class Trials:
    """Trials at points of a space, each made once, in their order."""

    space: Space
    runs_of: RunsOf
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    evaluation: Evaluation
    levels: tuple[Level, ...] = ("case",)  # of the search, the cheap one first
    size: int = 1  # runs of a trial
    made: dict[Hashable, Trial] = field(default_factory=dict)
    points: dict[Hashable, Point] = field(default_factory=dict)  # all but the case's own

    @property
    def budget(self) -> Budget:
        """Runs that are allowed and made."""
        return self.evaluation.budget

    def in_order(self) -> list[Trial]:
        """Trials, the case itself first."""
        return list(self.made.values())

    def __call__(
        self, points: Sequence[Point], level: Level, ahead: Foreseen | None = None
    ) -> list[Trial]:
        """Trials at some points; `ahead` gives points that are likely to follow."""

        def likely(count: int) -> Iterator[Sequence[StudyRun]]:
            for point in ahead(count) if ahead else ():
                yield self.runs_of(self.space.settings(point), level)

        found = [self._trial(self.space.settings(point), level, likely) for point in points]
        for trial, point in zip(found, points, strict=True):
            self.points.setdefault(trial.key, tuple(np.clip(point, 0.0, 1.0).tolist()))
        return found

    def tried(self, level: Level | None = None) -> list[Trial]:
        """Trials at points of the space, of one level or of all."""
        found = (self.made[key] for key in self.points)
        return [trial for trial in found if level in (None, trial.level)]

    def of_case(self, own: Mapping[str, str]) -> Trial:
        """Trial of the case with its `own` values, which counts as any other within the ranges."""
        trial, point = self._trial({}, "case", None), self.space.point(own)
        if point is not None:
            del self.made[trial.key]
            trial = replace(trial, settings={key: own[key] for key in self.space.keys})
            self.made[trial.key], self.points[trial.key] = trial, point
        return trial

    def _trial(
        self,
        settings: Mapping[str, str],
        level: Level,
        likely: Callable[[int], Iterator[Sequence[StudyRun]]] | None,
    ) -> Trial:
        known = self.made.get(Trial(settings, level, ()).key)
        if known is not None:
            return known
        outcomes = self.evaluation.outcomes(self.runs_of(settings, level), likely)
        trial = Trial(dict(settings), level, tuple(map(_result, outcomes)))
        self.made[trial.key] = trial
        return trial


@dataclass(frozen=True, eq=False)
class Searched:
    """Search of a design for one objective, among all trials so far."""

    trials: Trials
    objective: Objective
    best: Trial | None  # None if none is feasible on the cells of the case
    is_cut_short: bool  # the runs were used up before the gain was within the error
    remaining_gain: float  # of the objective, as the runs around the best trial predict it


def searched(trials: Trials, objective: Objective, *, held: int = 0) -> Searched:
    """Search for the trial with the least objective; `held` runs are left to later searches."""
    cost = PenalisedCost(objective, trials.goals, trials.constraints)

    def evaluate(points: Sequence[Point], level: Level, ahead: Foreseen | None) -> list[Score]:
        return [score(trial) for trial in trials(points, level, ahead)]

    def score(trial: Trial) -> Score:
        return cost.score(trial, trials.points[trial.key])

    def known(point: Point) -> float:
        return objective.known(trials.space.settings(point))

    shared: dict[str, Any] = {"held": held, "known": list(map(score, trials.tried()))}
    budget, levels = trials.budget, trials.levels
    if objective.is_known and len(trials.space.keys) == len(trials.space.ranges) == 1:
        found = threshold(evaluate, known, budget, levels, **shared)
    else:
        shared["objective"] = known if objective.is_known else None
        found = search(evaluate, trials.space, budget, levels, size=trials.size, **shared)
    best = None if found.best is None else trials.made[found.best.key]
    return Searched(trials, objective, best, found.is_cut_short, found.remaining_gain)


def _result(outcome: Entry) -> ScenarioResult:
    values = {name: Value(*each) for name, each in outcome.values.items()}
    return ScenarioResult(values, outcome.failure, outcome.warnings)
