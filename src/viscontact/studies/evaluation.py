"""Evaluation of a study: outcomes of its runs, each computed once, within a budget."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Future
from contextlib import AbstractContextManager, contextmanager
from dataclasses import field
from functools import partial
from typing import Any, Protocol

import xarray as xr

from viscontact.backend.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.executors.executor_choice import IN_THIS_PROCESS, ChosenWorkers
from viscontact.studies.executors.local import BEHIND_MAIN
from viscontact.studies.journal import Entry, Journal

#: Called with the numbers of runs, done and allowed, after each run.
Progress = Callable[[int, int], None]


#: Name of the cells of a run, as "coarse" for those of a search and "case" for those of the case.
Level = str


class BudgetSpentError(Exception):
    """The next runs would be more than are allowed."""


class StudyRun(Protocol):
    """Run of a study, which can be sent to another process."""

    @property
    def key(self) -> str:
        """Values that the outcome depends on, as text."""

    def __call__(self) -> Entry:
        """Compute the outcome; ValueError, ConvergenceError or DomainError if the run fails."""


@dataclass(frozen=True, eq=False)
class SimulatedRun:
    """Run of a study: the call that gives its result, and the numbers that are kept of that."""

    key: str
    result: Callable[[], xr.Dataset]
    numbers: Callable[[xr.Dataset], Mapping[str, Any]]  # as JSON has them

    def __call__(self) -> Entry:
        """Simulate the run."""
        found = self.result()
        return Entry(self.numbers(found), warnings=str(found.attrs.get("warnings", "")))


#: Groups of runs that are likely to follow, at most the given number.
Ahead = Callable[[int], Iterable[Sequence[StudyRun]]]


@dataclass
class Budget:
    """Runs that a study may take, and those that it has taken."""

    most: int
    runs: int = 0
    reserved: int = 0  # left to later searches

    @property
    def left(self) -> int:
        """Runs that the present search may still take."""
        return self.most - self.reserved - self.runs

    def require(self, runs: int) -> None:
        """Raise BudgetSpentError if some runs are too many."""
        if runs > self.left:
            raise BudgetSpentError


@dataclass
class Evaluation:
    """Outcomes of runs by their keys."""

    budget: Budget
    workers: ChosenWorkers = IN_THIS_PROCESS
    journal: Journal | None = None
    progress: Progress | None = None
    known: dict[str, Entry] = field(default_factory=dict)
    _begun: dict[str, Callable[[], Entry]] = field(default_factory=dict)

    def outcomes(
        self, runs: Sequence[StudyRun], ahead: Ahead | None = None, *, is_limited: bool = True
    ) -> list[Entry]:
        """Outcomes of some runs; BudgetSpentError if there are more than the limit."""
        # Workers that are free compute groups of runs that are likely to follow. Those that are
        # never requested do not count, so the number of workers changes neither outcomes nor
        # budget.
        wanted = {each.key: each for each in runs if each.key not in self.known}
        if is_limited:
            self.budget.require(len(wanted))
        else:
            self.budget.most = max(self.budget.most, self.budget.runs + len(wanted))
        if missing := self._new_runs(wanted.values()):
            likely = self._likely(len(runs), {*wanted}, ahead) if ahead else []
            for each in (*missing, *likely):
                self._begin(each)
        for key in wanted:
            self.known[key] = self._outcome(key)
            self.budget.runs += 1
            if self.progress:
                self.progress(self.budget.runs, self.budget.most)
        return [self.known[each.key] for each in runs]

    def _new_runs(self, runs: Iterable[StudyRun]) -> list[StudyRun]:
        """Runs without an outcome that have not begun."""
        recorded = self.journal.recorded if self.journal else {}
        done = (self.known, recorded, self._begun)
        return [run for run in runs if not any(run.key in each for each in done)]

    def _likely(self, size: int, wanted: set[str], ahead: Ahead) -> Iterator[StudyRun]:
        """Yield further runs, so that all workers are in use with the `wanted` ones of a group."""
        workers = self.workers.count
        count = min(workers // math.gcd(workers, size) - 1, self.budget.left // size - 1)
        for group in ahead(count) if count > 0 else ():
            found = [each for each in self._new_runs(group) if each.key not in wanted]
            if found and count > 0:
                count -= 1
                yield from found

    def _begin(self, run: StudyRun) -> None:
        executor = self.workers.executor
        if executor is None:
            self._begun[run.key] = partial(_attempt, run)
        else:
            self._begun[run.key] = partial(_await_entry, executor.submit(_attempt, run))

    def _outcome(self, key: str) -> Entry:
        if self.journal is None:
            return self._begun.pop(key)()
        if key not in self.journal.recorded:
            self.journal.keep(key, self._begun.pop(key)())
        return self.journal.recorded[key]


@contextmanager
def evaluating(
    budget: Budget,
    journal: AbstractContextManager[Journal | None],
    workers: AbstractContextManager[ChosenWorkers],
    progress: Progress | None,
) -> Iterator[Evaluation]:
    """Evaluation of a study, with its journal open and its workers started during a block."""
    with workers as chosen, journal as kept:
        yield Evaluation(budget, chosen, kept, progress)


def _attempt(run: StudyRun) -> Entry:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # they are kept with the outcome
        try:
            return run()
        except (ValueError, ConvergenceError, DomainError) as error:
            return Entry(failure=str(error).splitlines()[0])


def _await_entry(future: Future[Entry]) -> Entry:
    try:
        return future.result()
    except BrokenExecutor as error:
        raise RuntimeError(
            f"the process of a run ended without an answer: {BEHIND_MAIN}; else it was killed, as "
            "happens when memory runs out: then use fewer workers"
        ) from error
