"""Progress of several runs in one display: bars on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress

from rich.progress import Progress, TaskID

from viscontact.cli.terminal.bars import bars_of_runs
from viscontact.cli.terminal.messages import say
from viscontact.cli.terminal.progress import Pace
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job
from viscontact.studies.executors.driver import Active
from viscontact.studies.sweep.states import State, state_at_end
from viscontact.units.formatting import format_quantity
from viscontact.units.visible import visible

#: Most runs with a bar of their own.
_MOST_BARS = 16


class RunsDisplay:
    """Progress of several runs; this base class displays nothing."""

    def __init__(self, jobs: Sequence[Job]) -> None:
        self._whole = sum(job.work for job in jobs)
        self._done = 0.0  # work, in the same unit
        self._parts = {job.directory: 0.0 for job in jobs}
        self._count = len(jobs)
        self._states: Counter[State] = Counter()

    def update(self, active: Sequence[Active]) -> None:
        """Display the progress of some of the active runs."""
        for each in active:
            self._note(each.job, each.course.part)

    def end(self, ended: Ended) -> None:
        """Display that a run has ended."""
        self._states[state_at_end(ended)] += 1
        self._note(ended.job, 1.0)

    def _note(self, job: Job, part: float) -> None:
        self._done += job.work * (part - self._parts[job.directory])
        self._parts[job.directory] = part

    @property
    def _part(self) -> float:
        """Completed part of all the work, 0 to 1."""
        return min(self._done / self._whole, 1.0)

    @property
    def _runs(self) -> str:
        others = (State.FAILED, State.STOPPED)
        counts = [f"{self._states[each]} {each.value}" for each in others if self._states[each]]
        return ", ".join((f"{self._states[State.DONE]} of {self._count} runs done", *counts))


class _ProgressLines(RunsDisplay):
    """A line for each run that ends, and one at intervals."""

    def __init__(self, jobs: Sequence[Job]) -> None:
        super().__init__(jobs)
        self._pace = Pace()
        self._before: float | None = None

    def update(self, active: Sequence[Active]) -> None:
        super().update(active)
        if self._before is None:  # work of earlier processes is left out of the estimate
            self._before = min(self._part, 1 - 1e-9)
        if self._part >= 1:
            return
        left = self._pace.seconds_left((self._part - self._before) / (1 - self._before))
        if left is not None:
            say(f"{self._part:.0%} done, {self._runs}, about {left:.0f} s left")

    def end(self, ended: Ended) -> None:
        super().end(ended)
        if (state := state_at_end(ended)) is not State.WAITING:  # after a request to stop
            say(f"{ended.job.name}: {state.value}; {self._runs}")


class _Bars(RunsDisplay):
    """A bar for all runs together, and one for each active run."""

    def __init__(self, jobs: Sequence[Job], bars: Progress) -> None:
        super().__init__(jobs)
        self._bars = bars
        self._all = bars.add_task("all", total=1.0, details=self._runs)
        self._tasks: dict[str, TaskID] = {}

    def update(self, active: Sequence[Active]) -> None:
        super().update(active)
        for each in active:
            name = each.job.name
            if name not in self._tasks:
                if not each.course.instants or len(self._tasks) >= _MOST_BARS:
                    continue
                self._tasks[name] = self._bars.add_task(visible(name), total=1.0, details="")
            self._bars.update(self._tasks[name], completed=each.course.part, details=_details(each))
        self._bars.update(self._all, completed=self._part, details=self._runs)

    def end(self, ended: Ended) -> None:
        super().end(ended)
        if ended.job.name in self._tasks:
            self._bars.remove_task(self._tasks.pop(ended.job.name))
        self._bars.update(self._all, completed=self._part, details=self._runs)


@contextmanager
def shown_runs(jobs: Sequence[Job], *, quiet: bool) -> Iterator[RunsDisplay]:
    """Choose how the progress of several runs is displayed."""
    if quiet or not jobs:
        yield RunsDisplay(jobs)
    elif sys.stderr.isatty():
        bars = bars_of_runs()
        bars.start()
        try:
            yield _Bars(jobs, bars)
        finally:
            # A closed terminal is not a reason for runs to fail.
            with suppress(OSError):
                bars.stop()
    else:
        yield _ProgressLines(jobs)


def _details(run: Active) -> str:
    course, job = run.course, run.job
    of = "" if job.instants is None else f" of {job.instants}"
    return f"{course.instants}{of} instants, t = {format_quantity(course.time, 's')}"
