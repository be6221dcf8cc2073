"""Designs of functions in place of runs, to test the search without a contact."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.studies.design import evaluated_trials
from viscontact.studies.design.conclusions import notes_on
from viscontact.studies.design.evaluated_trials import Searched, Trials
from viscontact.studies.design.goals import Goal, ScalarGoal, constraints_of, goals_of
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.trials import Trial
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
        names = {goal.name: goal.entries[0] for goal in self.goals if goal.entries}
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
    parameter: str | None = None,
    constraints: Sequence[str] = (),
    **options: Any,
) -> tuple[Searched, Trial | None]:
    """Search for the best `force` of a function, and return the search and the best trial."""
    goals: tuple[Goal, ...] = (ScalarGoal("force", least),)
    if parameter is not None:
        goals = goals_of(
            parameter if least else None,
            None if least else parameter,
            "worst",
            space_of(change),
            {},
        )
    trials = trials_of(function, goals, change, constraints=constraints, **options)
    trials.of_case({})
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
    on_coarse: Function | None = None,
    workers: int = 1,
) -> Trials:
    """Trials of a function in one scenario."""

    def runs_of(settings: Mapping[str, str], level: Level) -> list[FunctionInPlaceOfARun]:
        chosen = (on_coarse if level == "coarse" else None) or function
        return [FunctionInPlaceOfARun(f"{level} {settings}", chosen, goals, settings)]

    executor = Rounds() if workers > 1 else None
    evaluation = Evaluation(Budget(budget), ChosenWorkers(executor, workers))
    levels = ("coarse", "case") if is_coarse else ("case",)
    limits = constraints_of(constraints)
    return Trials(space_of(change), runs_of, goals, limits, evaluation, levels)


def notes(best: Trial, search: Searched) -> list[str]:
    """Notes on the best trial."""
    return list(notes_on(best, search.trials.in_order()[0], search))


@dataclass(frozen=True)
class KnownFunction:
    """Function of two variables from 0 to 1, with its least value."""

    values: Function
    constraints: tuple[str, ...]
    least: float


def random_function(seed: int) -> KnownFunction:
    """A parabola with waves: as it is, with a kink, without a limit behind a line, or bounded."""
    rng = np.random.default_rng(seed)
    center, curvature, waves = rng.uniform(0, 1, 2), rng.uniform(0.2, 3, 2), rng.uniform(2, 6, 2)
    height, slope, normal = rng.uniform(0, 0.3), rng.uniform(-2, 2, 2), rng.uniform(0.3, 1.5, 2)
    kind = ("smooth", "kinked", "limited", "bounded")[seed % 4]

    def force(x: NDArray[np.float64]) -> NDArray[np.float64]:
        found = 3 + (x - center) ** 2 @ curvature + height * np.sin(x @ waves)
        plane = 3.2 + (x - center) @ slope
        return np.asarray(np.maximum(found, plane) if kind == "kinked" else found)

    def behind(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(x @ normal / normal.sum() - 0.5)

    def values(v: Mapping[str, float]) -> dict[str, Value]:
        x = np.array([v["load.x"], v["load.y"]])
        error = math.inf if kind == "limited" and behind(x) > 0 else 0.0
        limit = {"contact_length <= 500 mm": Value(0.5 + float(behind(x)), 0.0)}
        return {"force": Value(float(force(x)), error)} | (limit if kind == "bounded" else {})

    line = np.linspace(0, 1, 301)
    points = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    is_open = (behind(points) <= 0) | (kind in ("smooth", "kinked"))
    bounds = ("contact_length<=0.5 m",) if kind == "bounded" else ()
    return KnownFunction(values, bounds, float(force(points[is_open]).min()))


def _number(text: str) -> float:
    try:
        return float(text.split()[0])
    except ValueError:
        return float("nan")
