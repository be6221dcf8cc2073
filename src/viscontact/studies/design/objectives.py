"""Objective of a search, one goal or a compromise between several, and its penalised cost."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.goals import Constraint, Goal, ParameterGoal
from viscontact.studies.design.scores import KNOWN_PENALTY, PENALTY, Point, Score, penalty
from viscontact.studies.design.trials import Trial
from viscontact.studies.scalars import Value

#: Part of the sum of all goals in a compromise: of two trials that are equal in the goal that is
#: farthest off, the one that is better in the others has the smaller cost.
AUGMENTATION = 1e-3


@dataclass(frozen=True)
class Objective:
    """Number that is least for the best trial: the cost of one goal, or a distance of several."""

    # Of several it is the augmented weighted Chebyshev distance from their best values (Steuer and
    # Choo 1983), plus one: its least values for all weights are the trials that are not dominated,
    # also where their curve is not convex.

    goals: tuple[Goal, ...]
    weights: tuple[float, ...] = (1.0,)
    best: tuple[float, ...] = ()  # least costs of all goals
    spans: tuple[float, ...] = ()  # of the costs along the curve

    @property
    def is_known(self) -> bool:
        """True if the objective is known without a run, as that of a parameter is."""
        return len(self.goals) == 1 and isinstance(self.goals[0], ParameterGoal)

    def known(self, settings: Mapping[str, str]) -> float:
        """Objective of values of the parameters, where it is known without a run."""
        (goal,) = self.goals
        assert isinstance(goal, ParameterGoal)
        return goal.cost(goal.number(settings))

    def cost(self, trial: Trial) -> Value:
        """Cost of a trial and its error: NaN if a run failed, inf as error without a limit."""
        values = [trial.worst(goal) for goal in self.goals]
        if len(self.goals) == 1:
            return Value(self.goals[0].cost(values[0].value), values[0].error)
        costs = np.array(
            [goal.cost(each.value) for goal, each in zip(self.goals, values, strict=True)]
        )
        spans, weights = np.array(self.spans), np.array(self.weights)
        apart = (costs - self.best) / spans
        if np.isnan(apart).any():
            return Value(math.nan, math.nan)
        farthest = int((weights * apart).argmax())
        error = weights[farthest] * values[farthest].error / spans[farthest]
        if any(each.depends_on_mesh for each in values):
            error = math.inf
        return Value(float(1 + (weights * apart)[farthest] + AUGMENTATION * apart.sum()), error)

    def parts(self, trial: Trial) -> tuple[float, ...]:
        """Cost in each scenario, of which the largest one counts: smooth functions of a point."""
        each_goal = [
            [goal.cost(value.value) for value in trial.values_of(goal)] for goal in self.goals
        ]
        if len(self.goals) == 1:
            return tuple(each_goal[0])
        apart = (np.array(each_goal).T - self.best) / np.array(self.spans)
        sums = AUGMENTATION * apart.max(axis=0).sum()
        return tuple((1 + np.array(self.weights) * apart + sums).ravel().tolist())


#: Most that the reach of a contact adds to the cost of a value without a limit. A contact that
#: reaches the sharp end of a body has a smaller cost the less it reaches.
MOST_REACH = 5.0


@dataclass
class PenalisedCost:
    """Cost of trials over the size of the objective in the first one."""

    objective: Objective
    goals: tuple[Goal, ...]  # of the design, the values of which must have a limit
    constraints: tuple[Constraint, ...]
    scale: float = 0.0  # size of the first objective
    reach: float = 0.0  # first reach of a contact [m]

    @property
    def weight(self) -> float:
        """Cost of a relative excess over a bound [-]."""
        return KNOWN_PENALTY if self.objective.is_known else PENALTY

    def score(self, trial: Trial, point: Point) -> Score:
        """Score of a trial at a point; the first one with a value gives the scale."""
        objective = self.objective.cost(trial)
        if not trial.has_limits(self.goals, self.constraints):
            objective = replace(objective, error=math.inf)
        cost, error = self._cost(trial, objective), objective.error
        return Score(
            trial.key,
            point,
            trial.level,
            objective.value,
            error,
            cost,
            error / self.scale if self.scale and math.isfinite(error) else 0.0,
            trial.is_feasible(self.goals, self.constraints),
            bool(trial.failure),
            self.objective.parts(trial),
            trial.excesses(self.constraints),
        )

    def _cost(self, trial: Trial, objective: Value) -> float:
        """Cost of a trial [-]."""
        if not math.isfinite(objective.value):
            return 2 * self.weight  # above any penalty
        self.scale = self.scale or abs(objective.value) or 1.0
        self.reach = self.reach or trial.reach() or 1.0
        if objective.depends_on_mesh:
            return self.weight + min(trial.reach() / self.reach, MOST_REACH)
        return objective.value / self.scale + penalty(
            trial.violation(self.constraints), self.weight
        )
