"""Evaluation of trials: the runs of their scenarios on coarse cells or on those of the case."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import xarray as xr

from viscontact.case import Case, read_case
from viscontact.checks.half_space_theory import AT_THE_END
from viscontact.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.indenters import (
    Chamfer,
    CylindricalProfile,
    FullCrown,
    Indenter,
    PartialCrown,
    Roller,
    TwoRadiiCrown,
)
from viscontact.studies.design.goals import Constraint, Goal, magnitude
from viscontact.studies.design.scenarios import Scenario
from viscontact.studies.design.trials import REACH, Level, ScenarioResult, Trial, goal_name
from viscontact.studies.sweep.many import simulate_many
from viscontact.studies.sweep.varied_runs import VariedRun

#: Relative error of an automatic grid in the search, unless the case allows more.
COARSE_TOLERANCE = 0.05
#: Least number of cells along an edge, and cells from which a given grid is made coarser.
LEAST_CELLS, MOST_CELLS = 32, 2**12

#: Scalar without a limit at a sharp end, also where the cells do not resolve that.
PEAK = "peak_pressure"
_SHARP = (CylindricalProfile, PartialCrown, FullCrown, TwoRadiiCrown, Chamfer)

#: Values of the trials that are likely to follow, at most the given number.
Ahead = Callable[[int], Iterable[Mapping[str, str]]]


def _nothing_ahead(count: int) -> Iterable[Mapping[str, str]]:
    return ()


class BudgetSpentError(Exception):
    """The next trial would need more runs than are allowed."""


@dataclass
class Evaluation:
    """Runs of a design, each made once; `recorded` has those of an interrupted design."""

    case: Path
    settings: Mapping[str, str]
    scenarios: Sequence[Scenario]
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    coarse: Mapping[str, str]  # settings of the coarse cells
    budget: int  # most runs
    executor: Executor | None
    workers: int  # of the executor
    keep: Callable[[Trial], None]  # called after each new trial
    progress: Callable[[int, int], None]  # called with the numbers of runs, done and allowed
    recorded: dict[tuple[Any, ...], Trial] = field(default_factory=dict)
    trials: list[Trial] = field(default_factory=list)
    reserved: int = 0  # runs that the present search leaves to others
    computed: dict[tuple[Any, ...], tuple[ScenarioResult, ...]] = field(default_factory=dict)

    @property
    def runs(self) -> int:
        """Number of runs that the trials have taken."""
        return len(self.trials) * len(self.scenarios)

    @property
    def levels(self) -> tuple[Level, ...]:
        """Levels of the search, the cheap one first."""
        return ("coarse", "case") if self.coarse else ("case",)

    def evaluate(
        self, settings: Mapping[str, str], level: Level, ahead: Ahead = _nothing_ahead
    ) -> Trial:
        """Return the trial of some values; BudgetSpentError if it would need too many runs.

        Workers that are free compute the trials that are likely to follow. Those that are never
        asked for do not count, so the number of workers changes neither trials nor budget.
        """
        key = _key(settings, level)
        known = next((t for t in self.trials if identity(t) == key), None)
        if known is not None:
            return known
        if self.runs + len(self.scenarios) > self.budget - self.reserved:
            raise BudgetSpentError
        recorded = self.recorded.get(key)
        if recorded is None and key not in self.computed:
            self._compute([settings, *self._likely(key, ahead)], level)
        trial = recorded or Trial(dict(settings), level, self.computed.pop(key))
        self.trials.append(trial)
        if recorded is None:
            self.keep(trial)
        self.progress(self.runs, self.budget)
        return trial

    def _likely(self, key: tuple[Any, ...], ahead: Ahead) -> list[Mapping[str, str]]:
        """Values of further trials, so that all workers are in use with those of `key`."""
        wanted = self.workers // math.gcd(self.workers, len(self.scenarios)) - 1
        left = (self.budget - self.reserved - self.runs) // len(self.scenarios) - 1
        count = min(wanted, left)
        done = {key, *map(identity, self.trials), *self.recorded, *self.computed}
        likely = {_key(each, key[0]): each for each in ahead(count)} if count > 0 else {}
        return [each for other, each in likely.items() if other not in done][:count]

    def _compute(self, trials: Sequence[Mapping[str, str]], level: Level) -> None:
        """Compute the results of some trials at the same time."""
        runs = [self._run(each, scenario, level) for each in trials for scenario in self.scenarios]
        results = iter(self._results(runs))
        for each in trials:
            self.computed[_key(each, level)] = tuple(next(results) for _ in self.scenarios)

    def _results(self, runs: Sequence[VariedRun]) -> list[ScenarioResult]:
        with warnings.catch_warnings():
            # They are kept with the trial.
            warnings.simplefilter("ignore", AccuracyWarning)
            if self.executor is None:
                found = [_attempt(run) for run in runs]
            else:
                found = simulate_many(runs, executor=self.executor, return_exceptions=True)
        return [self._measured(run, each) for run, each in zip(runs, found, strict=True)]

    def _run(self, settings: Mapping[str, str], scenario: Scenario, level: Level) -> VariedRun:
        cells = self.coarse if level == "coarse" else {}
        whole = {**self.settings, **cells, "output.fields": "none", **scenario.settings(settings)}
        return VariedRun(self.case, whole, tuple(settings), "", "", "cases")

    def _measured(self, run: VariedRun, found: xr.Dataset | Exception) -> ScenarioResult:
        if isinstance(found, ValueError | ConvergenceError | DomainError):
            return ScenarioResult({}, str(found).splitlines()[0])
        if isinstance(found, Exception):
            raise found
        values = {goal_name(goal): goal.value(found) for goal in self.goals}
        values |= {str(each): each.value(found) for each in self.constraints}
        values[REACH] = magnitude(found, REACH, "worst", largest=True)
        warned = str(found.attrs.get("warnings", ""))
        if AT_THE_END in warned and ends_sharply(read_case(run.case, run.assignments).indenter):
            peaks = [goal_name(goal) for goal in self.goals if goal.scalar == PEAK]
            peaks += [str(each) for each in self.constraints if each.scalar == PEAK]
            values |= {name: replace(values[name], error=math.inf) for name in peaks}
        return ScenarioResult(values, "", warned)


def ends_sharply(indenter: Indenter) -> bool:
    """True for a roller with an edge at its end, where a contact has a pressure without a limit.

    The end of a logarithmic profile has a finite pressure, which the error bars cover.
    """
    return isinstance(indenter, Roller) and isinstance(indenter.line, _SHARP)


def identity(trial: Trial) -> tuple[Any, ...]:
    """Values and cells of a trial, which are the same in an equal one."""
    return _key(trial.settings, trial.level)


def coarse_cells(case: Case) -> dict[str, str]:
    """Settings of the coarse cells of a case; none if its own cells are coarse."""
    if isinstance(case.grid, Grid):
        shape, least = case.grid.shape, LEAST_CELLS
        while math.prod(shape) > MOST_CELLS and min(shape) >= 2 * least:
            shape = (shape[0] // 2, shape[1] // 2)
        return {} if shape == case.grid.shape else {"grid.shape": f"[{shape[0]}, {shape[1]}]"}
    asked = case.automatic_grid
    if asked is None or asked.largest_cell is not None or asked.tolerance >= COARSE_TOLERANCE:
        return {}
    return {"grid.tolerance": f"{100 * COARSE_TOLERANCE:g} %"}


def _key(settings: Mapping[str, str], level: Level) -> tuple[Any, ...]:
    return (level, *sorted(settings.items()))


def _attempt(run: VariedRun) -> xr.Dataset | Exception:
    try:
        return run()
    except (ValueError, ConvergenceError, DomainError) as error:
        return error
