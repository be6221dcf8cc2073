"""Objective of a search: one goal, or a compromise between several."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viscontact.studies.design.goals import Goal
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
