"""Runs of the trials of a design, on coarse cells or on those of the case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr

from viscontact.studies.case_values import result_with
from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.scenarios import Scenario
from viscontact.studies.design.trials import REACH, goal_name
from viscontact.studies.evaluation import Level, SimulatedRun
from viscontact.studies.scalars import magnitude


@dataclass(frozen=True)
class CaseTrials:
    """Case of a design: makes the runs of the trials, one for each scenario."""

    case: Path
    settings: Mapping[str, str]  # of all runs
    scenarios: Sequence[Scenario]
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    coarse: Mapping[str, str]  # settings of the coarse cells

    def __call__(self, settings: Mapping[str, str], level: Level) -> list[SimulatedRun]:
        """Runs of a trial with some values, in the order of the scenarios."""
        cells = self.coarse if level == "coarse" else {}
        fixed = {**self.settings, **cells, "output.fields": "none"}
        values = ", ".join(f"{key}={value}" for key, value in sorted(settings.items()))
        runs = []
        for number, each in enumerate(self.scenarios):
            whole = {**fixed, **each.settings(settings)}
            result = partial(result_with, self.case, whole)
            key = f"{level} {number} {values}"
            runs.append(SimulatedRun(key, result, self.numbers))
        return runs

    def numbers(self, found: xr.Dataset) -> dict[str, Any]:
        """Goals, constraints and reach of the contact in a run, with their errors, by name."""
        values = {goal_name(goal): goal.value(found) for goal in self.goals}
        values |= {str(each): each.value(found) for each in self.constraints}
        values[REACH] = magnitude(found, REACH, "worst")
        return {name: [each.value, each.error] for name, each in values.items()}
