"""Evaluation of formulas in place of runs: budget, failures, journal, and runs ahead."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from viscontact.studies.evaluation import Budget, BudgetSpentError, Evaluation
from viscontact.studies.executors.executor_choice import ChosenWorkers
from viscontact.studies.journal import Entry, journal_of


@dataclass(frozen=True)
class Root:
    """Square root of a number."""

    number: float

    @property
    def key(self) -> str:
        """The number."""
        return repr(self.number)

    def __call__(self) -> Entry:
        """Compute it."""
        if self.number < 0:
            raise ValueError(f"no root of {self.number}\nand a second line")
        return Entry({"root": self.number**0.5})


class AtOnce(Executor):
    """Executor that computes at once, and counts."""

    def __init__(self) -> None:
        self.numbers: list[float] = []

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Compute."""
        self.numbers.append(args[0].number)
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def roots(evaluation: Evaluation, *numbers: float, **options: Any) -> list[float]:
    """Roots of some numbers."""
    return [
        each.values["root"] for each in evaluation.outcomes([Root(n) for n in numbers], **options)
    ]


def test_a_run_is_computed_and_counted_once() -> None:
    executor, said = AtOnce(), []
    evaluation = Evaluation(
        Budget(3), ChosenWorkers(executor, 2), None, lambda *given: said.append(given)
    )
    assert roots(evaluation, 4.0, 9.0, 4.0) == [2.0, 3.0, 2.0]
    assert roots(evaluation, 9.0) == [3.0]
    assert executor.numbers == [4.0, 9.0]
    assert said == [(1, 3), (2, 3)]


def test_runs_beyond_the_budget_are_refused_before_they_begin() -> None:
    evaluation = Evaluation(Budget(2))
    with pytest.raises(BudgetSpentError):
        roots(evaluation, 1.0, 4.0, 9.0)
    assert evaluation.budget.runs == 0
    assert roots(evaluation, 1.0, 4.0, 1.0) == [1.0, 2.0, 1.0]
    with pytest.raises(BudgetSpentError):
        roots(evaluation, 9.0)
    assert roots(evaluation, 9.0, is_limited=False) == [3.0]
    assert (evaluation.budget.runs, evaluation.budget.most) == (3, 3)


def test_a_failed_run_has_the_first_line_of_its_reason() -> None:
    found = Evaluation(Budget(2)).outcomes([Root(-1.0), Root(1.0)])
    assert found == [Entry(failure="no root of -1.0"), Entry({"root": 1.0})]


def test_outcomes_of_a_journal_count_but_are_not_computed(tmp_path: Path) -> None:
    with journal_of("roots", {}, directory=tmp_path) as journal:
        assert roots(Evaluation(Budget(2), journal=journal), 4.0, 2.0)[1] == 2.0**0.5
    executor = AtOnce()
    with journal_of("roots", {}, directory=tmp_path) as journal:
        evaluation = Evaluation(Budget(3), ChosenWorkers(executor, 2), journal)
        assert roots(evaluation, 2.0, 4.0, 9.0) == [2.0**0.5, 2.0, 3.0]
    assert executor.numbers == [9.0]
    assert evaluation.budget.runs == 3


@pytest.mark.parametrize(("workers", "ahead"), [(1, 0), (2, 1), (4, 3)])
def test_free_workers_compute_ahead_what_does_not_count(workers: int, ahead: int) -> None:
    executor = AtOnce()
    evaluation = Evaluation(Budget(6), ChosenWorkers(executor, workers))

    def likely(count: int) -> Iterable[Sequence[Root]]:
        return [[Root(float(n))] for n in range(2, 3 + count)]

    assert roots(evaluation, 1.0, ahead=likely) == [1.0]
    assert executor.numbers == [1.0, 2.0, 3.0, 4.0][: 1 + ahead]
    assert evaluation.budget.runs == 1
    assert roots(evaluation, 2.0) == [2.0**0.5]
    assert executor.numbers.count(2.0) == 1
    assert evaluation.budget.runs == 2


def test_runs_ahead_stay_within_the_budget() -> None:
    executor = AtOnce()
    evaluation = Evaluation(Budget(4, reserved=1), ChosenWorkers(executor, 8))
    roots(evaluation, 1.0, ahead=lambda count: [[Root(float(n))] for n in range(2, 12)])
    assert executor.numbers == [1.0, 2.0, 3.0]
