"""Trials of a design: the values of the parameters, and what their runs gave."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.design.goals import NONE, Constraint, Goal
from viscontact.studies.evaluation import Level
from viscontact.studies.scalars import Value

#: Scalar that shows how far a contact reaches, where it reaches a sharp end.
REACH = "contact_length"
#: Name of the value that is one where a contact reaches a sharp end, without a limit where that is
#: not allowed.
AT_END = "contact at a sharp end"


@dataclass(frozen=True)
class ScenarioResult:
    """Scalars of the run of one scenario, or the reason why it has none."""

    values: Mapping[str, Value]  # of the goal at its instant, and of the constraints, by name
    failure: str = ""
    warnings: str = ""


@dataclass(frozen=True)
class Trial:
    """Values of the parameters, and the results of all scenarios."""

    settings: Mapping[str, str]  # by key
    level: Level
    results: tuple[ScenarioResult, ...]

    @property
    def key(self) -> tuple[str, ...]:
        """Values and cells, which are the same in an equal trial."""
        return (self.level, *(f"{key}={value}" for key, value in sorted(self.settings.items())))

    @property
    def failure(self) -> str:
        """Reason of the first run that failed; empty if all have a result."""
        return next((each.failure for each in self.results if each.failure), "")

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings of all runs, each once."""
        lines = (line for each in self.results for line in each.warnings.splitlines())
        return tuple(dict.fromkeys(lines))

    def values_of(self, goal: Goal) -> list[Value]:
        """Value of the goal in each scenario; NaN if a run failed."""
        return [goal.value(self.settings, each.values) for each in self.results]

    def worst(self, goal: Goal) -> Value:
        """Value of the goal in the scenario that is farthest off; NaN if a run failed."""
        values = self.values_of(goal)
        if any(math.isnan(each.value) for each in values):
            return NONE
        # A value without a limit is worse than any number.
        return max(values, key=lambda each: (each.depends_on_mesh, goal.cost(each.value)))

    def deciding(self, goal: Goal, constraints: tuple[Constraint, ...]) -> int:
        """Number of the scenario in which the goal, or else a constraint, is farthest off."""
        costs = [(each.depends_on_mesh, goal.cost(each.value)) for each in self.values_of(goal)]
        excesses = np.reshape(self.excesses(constraints), (len(constraints), len(costs)))
        ranks = [
            (*cost, excess)
            for cost, excess in zip(costs, excesses.max(axis=0, initial=-np.inf), strict=True)
        ]
        return max(range(len(ranks)), key=ranks.__getitem__)

    def reach(self) -> float:
        """Largest extent of a contact along x [m]; zero if it is not known."""
        lengths = [each.values.get(REACH, NONE).value for each in self.results]
        return max((each for each in lengths if not math.isnan(each)), default=0.0)

    @property
    def is_at_sharp_end(self) -> bool:
        """True if the contact reaches a sharp end of the body in a scenario."""
        return any(each.values.get(AT_END, NONE).value == 1.0 for each in self.results)

    def extreme(self, constraint: Constraint) -> Value:
        """Value of a constraint in the scenario that comes closest to its bound, or exceeds it."""
        values = [each.values.get(str(constraint), NONE) for each in self.results]
        return max(values, key=lambda each: constraint.violation(each.value))

    def excesses(self, constraints: tuple[Constraint, ...]) -> tuple[float, ...]:
        """Relative excess over each bound in each scenario, below zero if it is kept."""
        return tuple(
            each.violation(result.values.get(str(each), NONE).value)
            for each in constraints
            for result in self.results
        )

    def violation(self, constraints: tuple[Constraint, ...]) -> float:
        """Largest relative excess over a bound; zero if all constraints are kept."""
        return max(0.0, *self.excesses(constraints), 0.0)

    def has_limits(self, goals: tuple[Goal, ...], constraints: tuple[Constraint, ...]) -> bool:
        """True if no goal depends on the mesh, and no scalar that has a largest allowed value."""
        names = [name for goal in goals for name in goal.entries]
        names += [str(each) for each in constraints if each.upper]
        values = (each.values.get(name, NONE) for each in self.results for name in (*names, AT_END))
        return not any(each.depends_on_mesh for each in values)

    def is_feasible(self, goals: tuple[Goal, ...], constraints: tuple[Constraint, ...]) -> bool:
        """True if all runs have a result with a limit, and all constraints are kept."""
        have_values = all(math.isfinite(self.worst(goal).value) for goal in goals)
        has_limits = self.has_limits(goals, constraints)
        return have_values and has_limits and self.violation(constraints) == 0.0
