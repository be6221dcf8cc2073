"""Designs of functions in place of runs, to test the search without a contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from viscontact.studies.design.evaluation import Evaluation
from viscontact.studies.design.goals import Goal, Value, constraints_of
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.scenarios import Scenario
from viscontact.studies.design.search import Search
from viscontact.studies.design.trials import ScenarioResult, Trial, goal_name
from viscontact.studies.sweep.varied_runs import VariedRun

#: Values of the parameters to the objective and, by name of the constraint, the other scalars.
Function = Callable[[Mapping[str, float]], Mapping[str, Value]]


@dataclass
class AnalyticEvaluation(Evaluation):
    """Evaluation of a function in place of runs, which counts its calls."""

    function: Function = field(default=lambda values: {})
    calls: int = 0

    rounds: int = 0  # of calls at the same time

    def _results(self, runs: Sequence[VariedRun]) -> list[ScenarioResult]:
        self.rounds += 1
        return [self._result({key: run.settings[key] for key in run.varied}) for run in runs]

    def _result(self, settings: Mapping[str, str]) -> ScenarioResult:
        self.calls += 1
        if not settings:
            return ScenarioResult({}, "the case itself is not tried")
        numbers = {key: _number(text) for key, text in settings.items()}
        try:
            found = self.function(numbers)
        except ValueError as error:
            return ScenarioResult({}, str(error))
        names = {goal.scalar: goal_name(goal) for goal in self.goals}
        return ScenarioResult({names.get(name, name): v for name, v in found.items()})


def searched(
    function: Function,
    change: Mapping[str, object],
    *,
    least: bool = True,
    constraints: Sequence[str] = (),
    budget: int = 60,
    is_coarse: bool = False,
    workers: int = 1,
) -> tuple[Search, Trial | None]:
    """Search for the best `force` of a function, and return the search and the best trial."""
    goals = (Goal("force", least),)
    evaluation = evaluation_of(
        function,
        goals,
        constraints=constraints,
        budget=budget,
        is_coarse=is_coarse,
        workers=workers,
    )
    evaluation.evaluate({}, "case")
    search = Search(space_of(change), evaluation, Objective(goals))
    return search, search.run()


def evaluation_of(
    function: Function,
    goals: tuple[Goal, ...],
    *,
    constraints: Sequence[str] = (),
    budget: int = 60,
    is_coarse: bool = False,
    workers: int = 1,
) -> AnalyticEvaluation:
    """Evaluation of a function in one scenario."""
    return AnalyticEvaluation(
        Path("case.yaml"),
        {},
        [Scenario("")],
        goals,
        constraints_of(constraints),
        {"grid.shape": "[32, 32]"} if is_coarse else {},
        budget,
        None,
        workers,
        lambda trial: None,
        lambda done, allowed: None,
        function=function,
    )


def _number(text: str) -> float:
    try:
        return float(text.split()[0])
    except ValueError:
        return float("nan")
