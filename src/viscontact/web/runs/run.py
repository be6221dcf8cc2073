"""A run that waits, is at work, or is over."""

from __future__ import annotations

import time as clock
from contextlib import suppress
from dataclasses import replace

from viscontact.run_files import LOCK_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.runs.processes.child import Child, Ended
from viscontact.runs.processes.exit_codes import DONE, INTERRUPTED
from viscontact.runs.processes.job import Job, Standing
from viscontact.runs.processes.progress import Course
from viscontact.runs.processes.request import RunRequest
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.request import Asked

#: Errors take about so much of the time of the march before them.
ERRORS_PART = 0.67

#: States in which nothing changes any more by itself.
OVER = ("done", "cancelled", "interrupted", "failed")


class Work:
    """A run, from the wish for it on."""

    def __init__(self, folder: Folder, name: str, asked: Asked) -> None:
        self.name, self.asked, self.is_unwanted = name, asked, False
        self.directory, self.given = folder.directory(name), folder.given(name)
        self._folder = folder
        self._child: Child | None = None
        self._wish = ""
        self._pace: tuple[float, float] | None = None
        self._marched: float | None = None
        self._since, self._before = 0.0, 0
        self.course = Course(self._job(Standing.STOPPED))

    @property
    def label(self) -> str:
        """What it is called among others; runs of an earlier version have a title only."""
        return self.asked.label or self.asked.title

    @property
    def is_over(self) -> bool:
        """Whether nothing changes any more by itself."""
        return self.asked.state in OVER

    @property
    def is_at_work(self) -> bool:
        """Whether it is being computed."""
        return self.asked.state == "running"

    @property
    def is_beginning(self) -> bool:
        """Whether its process has begun, and has not taken a step yet."""
        return self._child is not None and self.course.instants == self._before

    @property
    def can_go_on(self) -> bool:
        """Whether it stopped early, and what it keeps can be gone on with."""
        if self.asked.state in ("cancelled", "interrupted"):
            return True
        # What failed for a reason that can be mended, such as a full disk, says how to go on.
        told = any("--resume" in line for line in self.asked.said)
        return self.asked.state == "failed" and told and (self.directory / STATE_NAME).is_file()

    def start(self) -> None:
        """Start its process, or take down why that is impossible."""
        saved = (self.directory / STATE_NAME).is_file()
        job = self._job(Standing.STOPPED if saved else Standing.NEW)
        self._pace, self._marched, self._wish = None, None, ""
        try:
            self._child = Child(job)
        except OSError as error:
            self.stand("failed", f"the run cannot be started: {error}")
            return
        self.course = self._child.course
        self._before = self.course.instants
        self.stand("running")

    def look(self) -> None:
        """Look how far it has come, and whether it has ended."""
        if self._child is None:
            self._look_from_outside()
            return
        self.course.look()
        self._keep_pace()
        if (ended := self._child.ended()) is not None:
            self._end(ended)

    def stop(self, state: str) -> None:
        """Let it finish its step, save and end; one that waits is over at once."""
        if self.asked.state == "waiting":
            self.stand(state)
        elif self._child is not None:
            self._wish = self._wish or state
            self._child.ask_to_stop()

    def wait(self) -> None:
        """Wait for its end."""
        if self._child is not None:
            self._end(self._child.wait())

    @property
    def is_foreign(self) -> bool:
        """Whether it is at work, but not for this server: an earlier one was killed."""
        return self.is_at_work and self._child is None

    @property
    def is_estimating(self) -> bool:
        """Whether its steps are done, and its errors are being estimated."""
        return self.is_at_work and self.asked.errors and self.course.part >= 1

    @property
    def part(self) -> float:
        """How much of it is done, errors included, from 0 to 1."""
        if self.asked.state == "done":
            return 1.0
        if not self.asked.errors:
            return self.course.part
        whole = 1 + ERRORS_PART
        if not self.is_estimating or not self._marched:
            return self.course.part / whole
        needed = ERRORS_PART * self._marched
        return (1 + ERRORS_PART * min((clock.monotonic() - self._since) / needed, 0.95)) / whole

    @property
    def seconds_left(self) -> float | None:
        """How long it will take, as far as its pace tells [s]."""
        if not self.is_at_work or self._pace is None:
            return None
        if self._marched is not None:
            left = ERRORS_PART * self._marched - (clock.monotonic() - self._since)
            return max(left, 0.0) if self.asked.errors else 0.0
        began, before = self._pace
        if self.course.part <= before:
            return None
        each = (clock.monotonic() - began) / (self.course.part - before)
        ahead = 1 - self.course.part + (ERRORS_PART if self.asked.errors else 0.0)
        return each * ahead

    def stand(self, state: str, *said: str) -> None:
        """Take down how it stands, here and in the folder."""
        self.asked = replace(self.asked, state=state, said=said)
        with suppress(OSError):  # a full disk; who asks is told nevertheless
            self._folder.keep(self.name, self.asked)

    def take_up(self) -> None:
        """Find out how it stands when a server begins that has not seen its end."""
        if self.is_over:
            return
        if self._is_complete():
            self.stand("done")
        elif self._is_in_use():
            self.stand("running")
        else:
            self.stand("interrupted")

    def _end(self, ended: Ended) -> None:
        self._child = None
        self.course.look()
        by_request = self._wish or "interrupted"
        states = {DONE: "done", INTERRUPTED: by_request}
        self.stand(states.get(ended.code, "failed"), *ended.said)

    def _look_from_outside(self) -> None:
        """Look at a run of an earlier server that was killed: it goes on by itself."""
        self.course.look()
        if not self._is_in_use():
            self.take_up()

    def _keep_pace(self) -> None:
        part, now = self.course.part, clock.monotonic()
        if self._pace is None and self.course.instants:
            self._pace = now, part  # what earlier processes did says nothing about the time left
        if self._marched is None and part >= 1 and self._pace is not None:
            self._marched, self._since = now - self._pace[0], now

    def _job(self, standing: Standing) -> Job:
        asked, case = self.asked, self._folder.given(self.name)
        request = RunRequest(case, self.directory, resume=True, settings=asked.settings)
        return Job(
            *(request, self.directory, self.name, standing),
            *(asked.instants, asked.end, asked.work, asked.memory),
        )

    def _is_complete(self) -> bool:
        # What resuming needs is removed when a run is over.
        saved = (self.directory / STATE_NAME).exists()
        return bool(self.course.instants) and (self.directory / RESULT_NAME).exists() and not saved

    def _is_in_use(self) -> bool:
        if not (self.directory / LOCK_NAME).exists():
            return False
        try:
            with locked(self.directory):
                return False
        except DirectoryInUse:
            return True
        except OSError:
            return False
