"""Result of a design: the best trial, all trials as a table, and notes on them."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import Case, read_case
from viscontact.results.formatting import format_with_error
from viscontact.results.variables import error_name
from viscontact.studies.case_values import case_with, fields_setting
from viscontact.studies.design.goals import Constraint, Goal, ParameterGoal, ScalarGoal
from viscontact.studies.design.scenarios import Scenario
from viscontact.studies.design.trade_off import costs_of, not_dominated
from viscontact.studies.design.trials import Trial
from viscontact.studies.design.year_of_creep import creeps_on, year_of_creep
from viscontact.studies.scalars import places_of, value_columns
from viscontact.studies.space import DIGITS
from viscontact.studies.sweep.axes import coordinate
from viscontact.studies.sweep.varied_runs import VariedRun
from viscontact.units.display import StudyResult
from viscontact.units.formatting import format_quantity

#: Least remaining gain that a sentence states, relative to the best value.
LEAST_STATED = 5e-4


@dataclass(frozen=True)
class DesignResult(StudyResult):
    """Best values of the parameters of a case, and the trials that lead to them.

    Attributes
    ----------
    table : xarray.Dataset
        All trials along the dimension ``trial``, in their order, in SI units: the varied keys as
        coordinates, scalars that are goals or constraints by their names, in the worst scenario,
        with their errors; a scalar that is a goal over (trial, scenario) as
        ``<name>_of_scenarios``; ``level`` ("coarse", or "case" for the cells of the case),
        ``feasible`` and ``message``, the reason of a failed run. A trade-off has ``on_front``, the
        trials that are not dominated. Trial 0 is the case as it is.
    settings : mapping of str to str
        Best values by key, as ``--set`` takes them.
    notes : tuple of str
        Notes on the optimum: that it lies at a bound, that a constraint is kept only
        within the error, that the runs were used up, and the warnings of its runs.
    runs : int
        Number of runs of the trials.

    Examples
    --------
    >>> import tempfile
    >>> from viscontact.studies.design.design import design
    >>> file = Path(tempfile.mkdtemp(), "ball.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: sphere, radius: 5 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}, "
    ...     "load: {kind: step, force: 0.1 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [32, 32], size: [2.4 mm, 2.4 mm]}}"
    ... )
    >>> radii = {"indenter.radius": ["2 mm", "8 mm"]}
    >>> found = design(file, radii, minimise="peak_pressure", workers=1)
    >>> found.settings, found.runs
    ({'indenter.radius': '8 mm'}, 3)
    >>> before = found.table.isel(trial=0)
    >>> round(float(found.best.peak_pressure / before.peak_pressure), 2)  # Hertz: (5/8)**(2/3)
    0.73
    """

    table: xr.Dataset
    settings: Mapping[str, str]
    notes: tuple[str, ...]
    runs: int
    case: Path
    fixed: Mapping[str, str]
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    number: int  # of the best trial
    scenarios: tuple[Scenario, ...]
    deciding: int = 0  # number of the scenario in which the best trial is farthest off

    @property
    def best(self) -> xr.Dataset:
        """Best trial: its row of the table."""
        return self.table.isel(trial=self.number)

    @property
    def remaining_gain(self) -> float:
        """Gain that further runs may have, as those around the best trial predict it [SI unit].

        NaN for a trade-off, or if it is not known. It is a prediction for the surroundings of the
        best trial, to be added to the error of its value.
        """
        return float(self.table.attrs["remaining_gain"])

    @property
    def goal(self) -> Goal:
        """What is to be least or largest; of several the first one."""
        return self.goals[0]

    @property
    def front(self) -> xr.Dataset:
        """Trials of which no other one is better in one scalar and as good in all others.

        They are on the cells of the case, and sorted by the first scalar; of a design with one
        scalar it is the best trial.
        """
        if len(self.goals) == 1:
            return self.table.isel(trial=[self.number])
        return self.table.isel(trial=self.table["on_front"].values).sortby(self.goal.name)

    @property
    def best_case(self) -> Case:
        """Best case, without the values of a scenario."""
        settings = {**self.fixed, **self.settings}
        return read_case(self.case, [f"{key}={value}" for key, value in settings.items()])

    @property
    def case_text(self) -> str:
        """Best case as YAML."""
        return self.best_case.text

    def _page(self) -> tuple[Any, ...]:
        title = f"Design of {self.case.stem}: {_list_texts(map(str, self.goals))}"
        years = self.over_a_year()
        words = {"title": title, "headline": str(self), "years": years}
        return "design", self.table, self.before_and_after(), words

    def before_and_after(self) -> dict[str, xr.Dataset]:
        """Results of the case and of the best one, in the scenario that decides.

        Fields are kept at the first and at the last instant. The case is left out if it fails.
        """
        runs = {"case": self._run({})} if not self.table["message"].values[0] else {}
        return runs | {"best": self._run(self.settings)}

    def over_a_year(self) -> dict[str, xr.Dataset | str]:
        """Results of the case and of the best one up to a year, in the scenario that decides.

        The reason in place of one that fails. There is none if the load is not held at the end of
        the case, or the bodies do not creep after it. The instants of the case are followed by
        others, a day, a week and a year among them.
        """
        runs = {"case": self._deciding_run({}), "best": self._deciding_run(self.settings)}
        if not creeps_on(read_case(self.case, runs["best"].assignments)):
            return {}
        found: dict[str, xr.Dataset | str] = {}
        for name, run in runs.items():
            try:
                case = read_case(self.case, run.assignments)
            except ValueError as error:
                found[name] = str(error).splitlines()[0]
            else:
                found[name] = year_of_creep(case, run.arguments)
        return found

    def _run(self, settings: Mapping[str, str]) -> xr.Dataset:
        run = self._deciding_run(settings)
        axis, places = places_of(read_case(self.case, run.assignments))
        ends = dict.fromkeys((float(places[0]), float(places[-1])))
        fields = f"[{', '.join(f'{place!r} {axis.unit}' for place in ends)}]"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AccuracyWarning)  # they are among the notes
            return replace(run, settings={**run.settings, "output.fields": fields})()

    def _deciding_run(self, settings: Mapping[str, str]) -> VariedRun:
        """Run of some values in the scenario that decides."""
        scenario = self.scenarios[self.deciding]
        whole = {**self.fixed, **scenario.settings(settings)}
        whole |= fields_setting(case_with(self.case, self.fixed))
        return VariedRun(self.case, whole, tuple(settings), "", "", "cases")

    def __str__(self) -> str:
        values = ", ".join(f"{key} = {value}" for key, value in self.settings.items())
        if len(self.goals) == 1:
            goal = self.goal
            own, further = self._format(goal, self.number), self._further(goal)
            where = f"at {values}" if isinstance(goal, ScalarGoal) else self._kept(values)
            return f"{goal}: {own} {where}{self._prior(goal)}{further}"
        each = (f"{g.name} {self._format(g, self.number)}{self._prior(g)}" for g in self.goals)
        return (
            f"{_list_texts(map(str, self.goals))}: {self.front.sizes['trial']} trials are not "
            f"dominated; the compromise has {_list_texts(each)}, at {values}"
        )

    def _prior(self, goal: Goal) -> str:
        value = self.table[goal.name].values[0]
        if not (np.isreal(value) and np.isfinite(value)):
            return ""
        return f", where the case has {self._format(goal, 0)}"

    def _further(self, goal: Goal) -> str:
        """Gain that further runs may have, unless that is hardly more than nothing."""
        left, value = self.remaining_gain, abs(float(self.best[goal.name]))
        if math.isnan(left):
            return "; what further runs may gain is not known"
        if left <= LEAST_STATED * value:
            return ""
        return f"; further runs may gain up to {format_quantity(left, goal.units, 2)}"

    def _format(self, goal: Goal, trial: int) -> str:
        if isinstance(goal, ParameterGoal):
            return format_quantity(float(self.table[goal.name].values[trial]), goal.units, DIGITS)
        value, error = (
            float(self.table[n].values[trial]) for n in (goal.name, error_name(goal.name))
        )
        return format_with_error(value, error, goal.units)

    def _kept(self, values: str) -> str:
        """The constraints at the best trial, and other parameters than the goal."""
        kept = []
        for each in self.constraints:
            own, error = (float(self.best[n]) for n in (each.scalar, error_name(each.scalar)))
            kept.append(f"{each.scalar} {format_with_error(own, error, each.units)}")
        others = f" at {values}" if len(self.settings) > 1 else ""
        return f"with {_list_texts(kept)}{others}"


def table_of(
    trials: Sequence[Trial],
    keys: Sequence[str],
    own: Mapping[str, str],
    scenarios: Sequence[str],
    goals: tuple[Goal, ...],
    constraints: tuple[Constraint, ...],
) -> xr.Dataset:
    """Table of the trials; `own` are the values of the case, of trials without others."""
    columns = {key: [t.settings.get(key, own.get(key, "")) for t in trials] for key in keys}
    coords = {key: coordinate(key, "trial", texts) for key, texts in columns.items()}
    names = xr.Variable("scenario", np.array(scenarios, dtype=np.str_))
    data: dict[str, xr.Variable] = {}
    for each in constraints:
        values = [trial.extreme(each) for trial in trials]
        data |= value_columns(each.scalar, "trial", values)
    for goal in goals:
        if isinstance(goal, ScalarGoal):
            data |= value_columns(goal.name, "trial", [trial.worst(goal) for trial in trials])
            data |= _of_scenarios(trials, goal)
    feasible = [trial.is_feasible(goals, constraints) for trial in trials]
    if len(goals) > 1:
        data["on_front"] = _on_front(trials, goals, feasible)
    data["feasible"] = xr.Variable("trial", feasible, {"long_name": "all constraints are kept"})
    data["level"] = _texts([trial.level for trial in trials], "cells of the runs")
    data["message"] = _texts([trial.failure for trial in trials], "reason of a failed run")
    return xr.Dataset(data, {"trial": np.arange(len(trials)), "scenario": names, **coords})


def _of_scenarios(trials: Sequence[Trial], goal: Goal) -> dict[str, xr.Variable]:
    found = [trial.values_of(goal) for trial in trials]
    return value_columns(goal.name, ("trial", "scenario"), found, "_of_scenarios")


def _on_front(
    trials: Sequence[Trial], goals: tuple[Goal, ...], feasible: Sequence[bool]
) -> xr.Variable:
    compared = np.array([each.level == "case" for each in trials]) & feasible
    costs = np.where(compared[:, None], costs_of(trials, goals), np.nan)
    about = {"long_name": "no trial is better in one scalar and as good in all others"}
    return xr.Variable("trial", not_dominated(costs), about)


def _list_texts(texts: Iterable[str]) -> str:
    return " and ".join(texts)


def _texts(texts: Sequence[str], long_name: str) -> xr.Variable:
    return xr.Variable("trial", np.array(texts, dtype=np.str_), {"long_name": long_name})
