"""Designs of functions in place of runs, to test the search without a contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any

from viscontact.studies.design import evaluated_trials
from viscontact.studies.design.conclusions import notes_on
from viscontact.studies.design.evaluated_trials import Searched, Trials
from viscontact.studies.design.goals import Goal, constraints_of
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.trials import Trial, goal_name
from viscontact.studies.evaluation import Budget, Evaluation, Level
from viscontact.studies.executors.executor_choice import ChosenWorkers
from viscontact.studies.journal import Entry
from viscontact.studies.scalars import Value

#: Values of the parameters to the objective and, by name of the constraint, the other scalars.
Function = Callable[[Mapping[str, float]], Mapping[str, Value]]


@dataclass(frozen=True)
class FunctionInPlaceOfARun:
    """Value of a function."""

    key: str
    function: Function
    goals: tuple[Goal, ...]
    settings: Mapping[str, str]

    def __call__(self) -> Entry:
        """Evaluate the function."""
        if not self.settings:
            return Entry(failure="the case itself is not tried")
        found = self.function({key: _number(text) for key, text in self.settings.items()})
        names = {goal.scalar: goal_name(goal) for goal in self.goals}
        values = {names.get(name, name): [v.value, v.error] for name, v in found.items()}
        return Entry(values)


class Rounds(Executor):
    """Executor that makes all calls so far when one of them is awaited, and counts that."""

    def __init__(self) -> None:
        self.rounds = 0
        self._waiting: list[tuple[Future[Any], Any, Any]] = []

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Note the call."""
        rounds = self

        class Awaited(Future[Any]):
            def result(self, timeout: float | None = None) -> Any:
                if not self.done():
                    rounds.make()
                return super().result(timeout)

        future: Future[Any] = Awaited()
        self._waiting.append((future, fn, args))
        return future

    def make(self) -> None:
        """Make the calls."""
        self.rounds += 1
        for future, call, args in self._waiting:
            future.set_result(call(*args))
        self._waiting.clear()


def searched(
    function: Function,
    change: Mapping[str, object],
    *,
    least: bool = True,
    constraints: Sequence[str] = (),
    **options: Any,
) -> tuple[Searched, Trial | None]:
    """Search for the best `force` of a function, and return the search and the best trial."""
    goals = (Goal("force", least),)
    trials = trials_of(function, goals, change, constraints=constraints, **options)
    trials.of_case()
    search = evaluated_trials.searched(trials, Objective(goals))
    return search, search.best


def trials_of(
    function: Function,
    goals: tuple[Goal, ...],
    change: Mapping[str, object],
    *,
    constraints: Sequence[str] = (),
    budget: int = 60,
    is_coarse: bool = False,
    workers: int = 1,
) -> Trials:
    """Trials of a function in one scenario."""

    def runs_of(settings: Mapping[str, str], level: Level) -> list[FunctionInPlaceOfARun]:
        return [FunctionInPlaceOfARun(f"{level} {settings}", function, goals, settings)]

    executor = Rounds() if workers > 1 else None
    evaluation = Evaluation(Budget(budget), ChosenWorkers(executor, workers))
    levels = ("coarse", "case") if is_coarse else ("case",)
    limits = constraints_of(constraints)
    return Trials(space_of(change), runs_of, goals, limits, evaluation, levels)


def notes(best: Trial, search: Searched) -> list[str]:
    """Notes on the best trial."""
    return list(notes_on(best, search.trials.in_order()[0], search))


def _number(text: str) -> float:
    try:
        return float(text.split()[0])
    except ValueError:
        return float("nan")
