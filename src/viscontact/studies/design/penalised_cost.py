"""Cost of trials in parts of the objective, with penalties where they are not feasible."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.trials import Trial

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

    def __call__(self, trial: Trial) -> float:
        """Cost of a trial [-]."""
        value = self.objective.cost(trial)
        if not math.isfinite(value.value):
            return FAILED
        self.scale = self.scale or abs(value.value) or 1.0
        self.reach = self.reach or trial.reach() or 1.0
        if value.depends_on_mesh:
            return PENALTY + min(trial.reach() / self.reach, MOST_REACH)
        excess = trial.violation(self.constraints)
        # Less than two, and never flat, so that a search knows the way to the bound.
        bounded = excess if excess < 1 else 2 - 1 / excess
        return value.value / self.scale + PENALTY * bounded

    def is_feasible(self, trial: Trial) -> bool:
        """True if all runs of a trial have a result with a limit, and all constraints are kept."""
        return trial.is_feasible(self.goals, self.constraints)

    def error(self, trial: Trial) -> float:
        """Error of the cost of a trial [-]; zero if it is not known."""
        error = self.objective.cost(trial).error
        return error / self.scale if math.isfinite(error) else 0.0
