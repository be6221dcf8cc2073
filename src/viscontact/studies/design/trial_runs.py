"""Runs of the trials of a design, on coarse cells or on those of the case."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from viscontact.studies.case_values import case_with, result_of
from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.scenarios import Scenario
from viscontact.studies.design.sharp_ends import reaches_sharp_end
from viscontact.studies.design.trials import REACH, goal_name
from viscontact.studies.evaluation import Level
from viscontact.studies.journal import Entry
from viscontact.studies.scalars import magnitude

#: Scalar without a limit at a sharp end, also where the cells do not resolve that.
PEAK = "peak_pressure"


@dataclass(frozen=True)
class CaseTrials:
    """Case of a design: makes the runs of the trials, one for each scenario."""

    case: Path
    settings: Mapping[str, str]  # of all runs
    scenarios: Sequence[Scenario]
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    coarse: Mapping[str, str]  # settings of the coarse cells

    def __call__(self, settings: Mapping[str, str], level: Level) -> list[TrialRun]:
        """Runs of a trial with some values, in the order of the scenarios."""
        cells = self.coarse if level == "coarse" else {}
        fixed = {**self.settings, **cells, "output.fields": "none"}
        values = ", ".join(f"{key}={value}" for key, value in sorted(settings.items()))
        return [
            TrialRun(
                f"{level} {number} {values}",
                self.case,
                {**fixed, **each.settings(settings)},
                self.goals,
                self.constraints,
            )
            for number, each in enumerate(self.scenarios)
        ]


@dataclass(frozen=True)
class TrialRun:
    """Run of a trial in a scenario: the goals, the constraints, and the reach of the contact."""

    key: str
    case: Path
    settings: Mapping[str, str]
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]

    def __call__(self) -> Entry:
        """Simulate the run; values with their errors, by name."""
        case = case_with(self.case, self.settings)
        found = result_of(case)
        values = {goal_name(goal): goal.value(found) for goal in self.goals}
        values |= {str(each): each.value(found) for each in self.constraints}
        values[REACH] = magnitude(found, REACH, "worst")
        warned = str(found.attrs.get("warnings", ""))
        outcome = {name: [each.value, each.error] for name, each in values.items()}
        if reaches_sharp_end(case.indenter, warned):
            peaks = [goal_name(goal) for goal in self.goals if goal.scalar == PEAK]
            peaks += [str(each) for each in self.constraints if each.scalar == PEAK]
            outcome |= {name: [outcome[name][0], math.inf] for name in peaks}
        return Entry(outcome, warnings=warned)
