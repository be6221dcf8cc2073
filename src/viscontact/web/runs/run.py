"""Run of the calculator page: waiting, running or over."""

from __future__ import annotations

import time as clock
from contextlib import suppress
from dataclasses import replace

from viscontact.results.run_axis import RUN_AXES, RunAxis
from viscontact.results.run_files import RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import is_locked
from viscontact.runs.processes.child import Child, Ended, RunProcess
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.progress import RunProgress
from viscontact.runs.processes.request import DONE, INTERRUPTED, RunRequest
from viscontact.web.runs.live_scalars import LiveScalars
from viscontact.web.workspace.folder import Folder, RunEntry

#: Usual time for estimating errors, as a part of the time of the march [-].
ERRORS_PART = 0.3

#: Final states.
OVER = ("done", "cancelled", "interrupted", "failed")


class ManagedRun:
    """Run with its entry, its process and its progress."""

    def __init__(self, folder: Folder, name: str, entry: RunEntry) -> None:
        self.name, self.entry, self.is_deleted = name, entry, False
        self.directory, self.given = folder.directory(name), folder.given(name)
        self._folder = folder
        self._child: Child | None = None
        self._stop_state = ""
        self.live = LiveScalars(self.directory)
        self._pace: tuple[float, float] | None = None
        self._marched: float | None = None
        self._since, self._before = 0.0, 0
        self._started_at = 0.0
        self.course = self._new_course(self._job(RunStage.STOPPED))

    @property
    def label(self) -> str:
        """Label among other runs; runs of an earlier version have a title only."""
        return self.entry.label or self.entry.title

    @property
    def axis(self) -> RunAxis:
        """Quantity in which the states of the run differ."""
        return RUN_AXES["speed" if self.entry.over == "speed" else "time"]

    @property
    def workers(self) -> int:
        """Number of runs that it computes at the same time."""
        return 1

    @property
    def is_over(self) -> bool:
        """True if the state is final."""
        return self.entry.state in OVER

    @property
    def is_at_work(self) -> bool:
        """True if the run is being computed."""
        return self.entry.state == "running"

    @property
    def is_starting(self) -> bool:
        """True if the process has been started and has not completed a step."""
        return self._child is not None and self.course.instants == self._before

    @property
    def seconds_at_work(self) -> float:
        """Time since its process was started [s]."""
        return clock.monotonic() - self._started_at

    @property
    def stage(self) -> str:
        """State of the run: waiting, running, estimating errors, or over."""
        return "errors" if self.is_estimating else self.entry.state

    @property
    def is_resumable(self) -> bool:
        """True if the run stopped early and can be continued."""
        if self.entry.state in ("cancelled", "interrupted"):
            return True
        is_left = self.entry.state == "failed" and self.entry.resumable
        return is_left and self._is_saved()

    def start(self, spare: RunProcess | None) -> None:
        """Start the run in a process that waits for one, or note why that failed."""
        job = self._job(RunStage.STOPPED if self._is_saved() else RunStage.NEW)
        self.course = self._new_course(job)
        self._pace, self._marched, self._stop_state = None, None, ""
        try:
            self._child = Child(job, spare)
        except OSError as error:
            self.set_state("failed", f"the run cannot be started: {error}")
            return
        self._before, self._started_at = self.course.instants, clock.monotonic()
        self.set_state("running")

    def poll(self) -> None:
        """Update the progress, and note the end of the process."""
        if self._child is None:
            self._poll_lock()
            return
        self._look()
        self._keep_pace()
        if (ended := self._child.ended()) is not None:
            self._end(ended)

    def stop(self, state: str) -> None:
        """Stop after the current step; a waiting run is over at once."""
        if self.entry.state == "waiting":
            self.set_state(state)
        elif self._child is not None:
            self._stop_state = self._stop_state or state
            self._child.ask_to_stop()

    @property
    def has_process(self) -> bool:
        """True if a process of this server computes it."""
        return self._child is not None

    def kill(self) -> None:
        """End the process at once; the run can be continued."""
        if self._child is not None:
            self._stop_state = self._stop_state or "interrupted"
            self._child.kill()

    def wait(self) -> None:
        """Wait for the end of the process."""
        if self._child is not None:
            self._end(self._child.wait())

    @property
    def is_foreign(self) -> bool:
        """True if the process was started by an earlier server that was killed."""
        return self.is_at_work and self._child is None

    @property
    def is_estimating(self) -> bool:
        """True if all steps are done and the errors are being estimated."""
        return self.is_at_work and self.entry.errors and self.course.part >= 1

    @property
    def part(self) -> float:
        """Completed part of the run, errors included, 0 to 1."""
        if self.entry.state == "done":
            return 1.0
        if not self.entry.errors:
            return self.course.part
        whole = 1 + ERRORS_PART
        if not self.is_estimating or not self._marched:
            return self.course.part / whole
        needed = ERRORS_PART * self._marched
        return (1 + ERRORS_PART * min((clock.monotonic() - self._since) / needed, 0.95)) / whole

    @property
    def seconds_left(self) -> float | None:
        """Predicted time left [s]; None where unknown."""
        if not self.is_at_work or self._pace is None:
            return None
        if self._marched is not None:
            left = ERRORS_PART * self._marched - (clock.monotonic() - self._since)
            return max(left, 0.0) if self.entry.errors else 0.0
        began, before = self._pace
        if self.course.part <= before:
            return None
        each = (clock.monotonic() - began) / (self.course.part - before)
        ahead = 1 - self.course.part + (ERRORS_PART if self.entry.errors else 0.0)
        return each * ahead

    def set_state(self, state: str, *lines: str, resumable: bool = False) -> None:
        """Change the state, here and in the folder."""
        self.entry = replace(self.entry, state=state, said=lines, resumable=resumable)
        with suppress(OSError):  # a full disk; the state is kept in memory
            self._folder.keep(self.name, self.entry)

    def restore_state(self) -> None:
        """Determine the state of a run that an earlier server started."""
        if self.is_over:
            return
        if self._is_complete():
            self.set_state("done")
        elif self._is_in_use():
            self.set_state("running")
        else:
            self.set_state("interrupted")

    def _end(self, ended: Ended) -> None:
        self._child = None
        self.course.look()
        by_request = self._stop_state or "interrupted"
        states = {DONE: "done", INTERRUPTED: by_request}
        state = states.get(ended.code, "failed")
        self.set_state(state, *ended.lines, resumable=ended.resumable)

    def _poll_lock(self) -> None:
        """Update a run of an earlier server, which ends when its lock is free."""
        self._look()
        if not self._is_in_use():
            self.restore_state()

    def _look(self) -> None:
        """Read the progress."""
        self.course.look()

    def _keep_pace(self) -> None:
        part, now = self.course.part, clock.monotonic()
        if self._pace is None and self.course.instants:
            self._pace = now, part  # work of earlier processes is left out of the estimate
        if self._marched is None and part >= 1 and self._pace is not None:
            self._marched, self._since = now - self._pace[0], now

    def _job(self, standing: RunStage) -> Job:
        entry, case = self.entry, self._folder.given(self.name)
        request = RunRequest(case, self.directory, resume=True, settings=entry.settings)
        return Job(
            *(request, self.directory, self.name, standing),
            *(entry.instants, entry.end, entry.work, entry.memory),
        )

    def _new_course(self, job: Job) -> RunProgress:
        return RunProgress(job)

    def _is_saved(self) -> bool:
        """True if the run can be continued from what is saved."""
        return (self.directory / STATE_NAME).is_file()

    def _is_in_use(self) -> bool:
        """True if a process computes the run."""
        return is_locked(self.directory)

    def _is_complete(self) -> bool:
        # The restart file is removed when a run is complete.
        saved = (self.directory / STATE_NAME).exists()
        return bool(self.course.instants) and (self.directory / RESULT_NAME).exists() and not saved
