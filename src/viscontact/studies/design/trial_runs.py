"""Runs of the trials of a design, on coarse cells or on those of the case."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.case_values import case_with, result_with
from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.scenarios import Scenario
from viscontact.studies.design.sharp_ends import reaches_sharp_end
from viscontact.studies.design.trials import AT_END, REACH
from viscontact.studies.evaluation import Level, SimulatedRun
from viscontact.studies.scalars import Value, magnitude


@dataclass(frozen=True)
class CaseTrials:
    """Case of a design: makes the runs of the trials, one for each scenario."""

    case: Path
    settings: Mapping[str, str]  # of all runs
    scenarios: Sequence[Scenario]
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    coarse: Mapping[str, str]  # settings of the coarse cells
    fields: Mapping[str, str]  # setting of the fields that are kept
    clear_of_ends: bool = False  # a contact that reaches a sharp end is as one without a limit

    def __call__(self, settings: Mapping[str, str], level: Level) -> list[SimulatedRun]:
        """Runs of a trial with some values, in the order of the scenarios."""
        cells = self.coarse if level == "coarse" else {}
        fixed = {**self.settings, **cells, **self.fields}
        values = ", ".join(f"{key}={value}" for key, value in sorted(settings.items()))
        runs = []
        for number, each in enumerate(self.scenarios):
            whole = {**fixed, **each.settings(settings)}
            result = partial(result_with, self.case, whole)
            key = f"{level} {number} {values}"
            runs.append(SimulatedRun(key, result, partial(self.numbers, whole)))
        return runs

    def numbers(self, settings: Mapping[str, str], found: xr.Dataset) -> dict[str, Any]:
        """Goals, constraints and reach of the contact in a run, with their errors, by name."""
        values = {name: each for goal in self.goals for name, each in goal.taken(found).items()}
        values |= {str(each): each.value(found) for each in self.constraints}
        values[REACH] = magnitude(found, REACH, "worst")
        if found.attrs.get("warnings"):
            is_sharp = reaches_sharp_end(case_with(self.case, settings).indenter, found)
            has_limit = not (is_sharp and self.clear_of_ends)
            values[AT_END] = Value(float(is_sharp), 0.0 if has_limit else math.inf)
        return {name: [each.value, each.error] for name, each in values.items()}
