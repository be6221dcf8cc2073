"""Cost of trials in parts of the objective, with penalties where they are not feasible."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.search import Point, Score
from viscontact.studies.design.trials import Trial
from viscontact.studies.scalars import Value

#: Cost of a relative excess over a bound, in parts of the objective: an exact penalty, as long as
#: the objective changes less than this for a given relative change of the bound.
PENALTY = 10.0
#: Most that the reach of a contact adds to the cost of a value without a limit. A contact that
#: reaches the sharp end of a body has a smaller cost the less it reaches.
MOST_REACH = 5.0
#: Cost of a trial of which a run failed, above any penalty.
FAILED = 2 * PENALTY


@dataclass
class PenalisedCost:
    """Cost of trials over the size of the objective in the first one."""

    objective: Objective
    goals: tuple[Goal, ...]  # of the design, the values of which must have a limit
    constraints: tuple[Constraint, ...]
    scale: float = 0.0  # size of the first objective
    reach: float = 0.0  # first reach of a contact [m]

    def score(self, trial: Trial, point: Point) -> Score:
        """Score of a trial at a point; the first one with a value gives the scale."""
        objective = self.objective.cost(trial)
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
        )

    def _cost(self, trial: Trial, objective: Value) -> float:
        """Cost of a trial [-]."""
        if not math.isfinite(objective.value):
            return FAILED
        self.scale = self.scale or abs(objective.value) or 1.0
        self.reach = self.reach or trial.reach() or 1.0
        if objective.depends_on_mesh:
            return PENALTY + min(trial.reach() / self.reach, MOST_REACH)
        excess = trial.violation(self.constraints)
        # Less than two, and never flat, so that a search knows the way to the bound.
        bounded = excess if excess < 1 else 2 - 1 / excess
        return objective.value / self.scale + PENALTY * bounded
