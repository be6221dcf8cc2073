"""Progress of several runs in one display: bars on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress

from rich.console import Console
from rich.progress import (
    BarColumn,
    Progress,
    TaskID,
    TaskProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)

from viscontact.cli.terminal.messages import say
from viscontact.runs.processes.child import Child, Ended
from viscontact.runs.processes.job import Job
from viscontact.units.formatting import format_quantity

#: Plain lines come at this part of all the work, or after so many seconds.
_LINE_PART, _LINE_SECONDS = 0.1, 30.0


class RunsDisplay:
    """Runs, shown as they go on; this one shows nothing."""

    def __init__(self, jobs: Sequence[Job]) -> None:
        self._work = {job.directory: job.work for job in jobs}
        self._parts = dict.fromkeys(self._work, 0.0)
        self._count = len(jobs)
        self._ended = 0

    def goes_on(self, active: Sequence[Child]) -> None:
        """Show how far the runs have come."""
        for child in active:
            self._parts[child.job.directory] = child.course.part

    def ends(self, ended: Ended) -> None:
        """Show that a run has ended."""
        self._ended += 1
        self._parts[ended.job.directory] = 1.0

    @property
    def _part(self) -> float:
        """How much of all the work is done."""
        done = sum(self._parts[place] * work for place, work in self._work.items())
        return done / sum(self._work.values())

    @property
    def _runs(self) -> str:
        return f"{self._ended} of {self._count} runs ended"


class _Lines(RunsDisplay):
    """A line for each run that ends, and one now and then."""

    def __init__(self, jobs: Sequence[Job]) -> None:
        super().__init__(jobs)
        self._started = self._said_at = clock.perf_counter()
        self._before: float | None = None
        self._next = 0.0

    def goes_on(self, active: Sequence[Child]) -> None:
        super().goes_on(active)
        part, now = self._part, clock.perf_counter()
        if self._before is None:  # what earlier processes did says nothing about the time left
            self._before, self._next = part, part + _LINE_PART
        is_due = part >= self._next or now - self._said_at >= _LINE_SECONDS
        if not is_due or part >= 1 or part <= self._before:
            return
        self._next, self._said_at = part + _LINE_PART, now
        left = (now - self._started) / (part - self._before) * (1 - part)
        say(f"{part:.0%} done, {self._runs}, about {left:.0f} s left")

    def ends(self, ended: Ended) -> None:
        super().ends(ended)
        say(f"{ended.job.name}: {ended.outcome}; {self._runs}")


class _Bars(RunsDisplay):
    """A bar for all, and one for each that is at work."""

    def __init__(self, jobs: Sequence[Job], bars: Progress) -> None:
        super().__init__(jobs)
        self._bars = bars
        self._all = bars.add_task("all", total=1.0, details=self._runs)
        self._tasks: dict[str, TaskID] = {}

    def goes_on(self, active: Sequence[Child]) -> None:
        super().goes_on(active)
        for child in active:
            name = child.job.name
            if name not in self._tasks:
                self._tasks[name] = self._bars.add_task(name, total=1.0, details="")
            self._bars.update(
                self._tasks[name], completed=child.course.part, details=_details(child)
            )
        self._bars.update(self._all, completed=self._part, details=self._runs)

    def ends(self, ended: Ended) -> None:
        super().ends(ended)
        if ended.job.name in self._tasks:
            self._bars.remove_task(self._tasks.pop(ended.job.name))
        self._bars.update(self._all, completed=self._part, details=self._runs)


@contextmanager
def shown_runs(jobs: Sequence[Job], *, quiet: bool) -> Iterator[RunsDisplay]:
    """Show how several runs go on."""
    if quiet or not jobs:
        yield RunsDisplay(jobs)
    elif sys.stderr.isatty():
        bars = _bars()
        bars.start()
        try:
            yield _Bars(jobs, bars)
        finally:
            # A terminal that is gone is no reason for runs to fail.
            with suppress(OSError):
                bars.stop()
    else:
        yield _Lines(jobs)


def _bars() -> Progress:
    return Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(bar_width=16),  # fixed, so that the rest does not jump
        TaskProgressColumn(),
        TimeRemainingColumn(),
        TextColumn("left, {task.fields[details]}", markup=False),
        console=Console(stderr=True),
    )


def _details(child: Child) -> str:
    course, job = child.course, child.job
    of = "" if job.instants is None else f" of {job.instants}"
    return f"{course.instants}{of} instants, t = {format_quantity(course.time, 's')}"
