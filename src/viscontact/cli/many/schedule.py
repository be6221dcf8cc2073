"""Scheduler of several runs: started, displayed and stopped together."""

from __future__ import annotations

import time as clock
from collections import deque
from collections.abc import Sequence
from contextlib import suppress

from viscontact.cli.many.jobs import ManyRequest, checked_sweep, fitting, resource_warnings
from viscontact.cli.many.progress import RunsDisplay, shown_runs
from viscontact.cli.many.table import print_table
from viscontact.cli.many.variations import as_typed
from viscontact.cli.terminal.interruption import Interruption, watched_interruption
from viscontact.cli.terminal.messages import DONE, INTERRUPTED, STOPPED, refuse, say, stop
from viscontact.cli.terminal.streams import printing, unwritten
from viscontact.runs.execution.execution import before_the_first_step, remove_leftovers
from viscontact.runs.processes.child import Child, Ended
from viscontact.runs.processes.job import Job, Standing

#: Time between two checks of the runs [s].
PAUSE = 0.05


def execute_many(request: ManyRequest) -> None:
    """Run several cases, each into its directory."""
    if request.common.overwrite and request.common.resume:
        refuse("--resume continues runs and --overwrite starts them again: give one of them")
    quiet = request.common.quiet
    with watched_interruption() as interruption:
        with before_the_first_step():
            sweep = checked_sweep(request)
            jobs = sweep.jobs
            left = [job for job in jobs if job.standing is not Standing.FINISHED]
            at_once = min(request.jobs, fitting(left), max(1, len(left)))
            if not quiet:
                for line in resource_warnings(left, request.jobs, at_once, request.common.threads):
                    say(line)
            sweep.recorded.write()
        with shown_runs(left, quiet=quiet) as shown:
            ended = _Schedule(left, at_once, interruption, shown).run()
    _end(request, jobs, ended)


class _Schedule:
    """Waiting, active and ended runs of one command."""

    def __init__(
        self, jobs: Sequence[Job], at_once: int, interruption: Interruption, shown: RunsDisplay
    ) -> None:
        self._waiting = deque(jobs)
        self._active: list[Child] = []
        self._ended: list[Ended] = []
        self._at_once, self._interruption, self._shown = at_once, interruption, shown

    def run(self) -> list[Ended]:
        """Run all jobs, or stop them as soon as it is requested."""
        try:
            with self._interruption.marching():
                while self._active or (self._waiting and not self._interruption.requested):
                    self._poll()
                    if self._interruption.requested:
                        self._stop()
        except KeyboardInterrupt:
            pass  # the second request; the processes have received it as well
        finally:
            self._stop()
            with suppress(KeyboardInterrupt), self._interruption.postponed():
                self._ended.extend(child.wait() for child in self._active)
        return self._ended

    def _poll(self) -> None:
        while self._waiting and len(self._active) < self._at_once:
            with self._interruption.postponed():
                self._start(self._waiting.popleft())
        clock.sleep(PAUSE)
        for child in list(self._active):
            child.course.look()
            with self._interruption.postponed():
                if (ended := child.ended()) is not None:
                    self._active.remove(child)
                    self._ended.append(ended)
                    self._shown.end(ended)
        self._shown.update(self._active)

    def _start(self, job: Job) -> None:
        try:
            self._active.append(Child(job))
        except OSError as error:
            why = f"{job.directory}: the run cannot be started: {error}"
            self._ended.append(Ended(job, "stopped", STOPPED, (why,)))
            self._shown.end(self._ended[-1])

    def _stop(self) -> None:
        """Start no further run, and let the active ones finish their steps and save."""
        self._waiting.clear()
        for child in self._active:
            child.ask_to_stop()


def _end(request: ManyRequest, jobs: Sequence[Job], ended: Sequence[Ended]) -> None:
    """Print how all runs ended, and end with the worst of their exit codes."""
    by_place = {each.job.directory: each for each in ended}
    runs = [by_place.get(job.directory) or _not_marched(job) for job in jobs]
    if not request.common.quiet:
        _print_table(runs)
    for each in runs:
        for line in each.said if each.code else ():
            say(as_typed(line, request.varied))
    stopped = [each.job.name for each in runs if each.code == STOPPED]
    lines = [f"{len(stopped)} of {len(runs)} runs stopped: {', '.join(stopped)}"] if stopped else []
    if any(each.code == INTERRUPTED for each in runs):
        stop(*lines, "interrupted", f"continue with: {request.resuming}", code=INTERRUPTED)
    if stopped:
        stop(*lines)


def _not_marched(job: Job) -> Ended:
    if job.standing is not Standing.FINISHED:
        return Ended(job, "not begun", INTERRUPTED)
    remove_leftovers(job.directory)
    return Ended(job, "was finished", DONE)


def _print_table(runs: Sequence[Ended]) -> None:
    try:
        with printing():
            print_table(runs)
    except OSError as error:
        unwritten("stdout")
        if not isinstance(error, BrokenPipeError):
            say(f"the table of the runs cannot be printed: {error.strerror or error}")
