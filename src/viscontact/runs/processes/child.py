"""Run in a process of its own, which ends when its parent process is gone."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Any

from viscontact.runs.processes.job import Job
from viscontact.runs.processes.progress import Course
from viscontact.runs.processes.request import DONE, INTERRUPTED, REFUSED, STOPPED


@dataclass(frozen=True)
class Ended:
    """End of one of several runs."""

    job: Job
    outcome: str  # one word
    code: int  # 0 done, 1 stopped, 130 interrupted, also before it began
    said: tuple[str, ...] = ()  # lines of its error output


class Child:
    """Process of a run, which locks its directory, saves and handles signals as a single run does.

    Its error output is kept until its end. An OSError means that the system starts no process.
    """

    def __init__(self, job: Job) -> None:
        self.job = job
        self.course = Course(job)
        self._asked = False
        with ExitStack() as opened:
            self._said = opened.enter_context(tempfile.TemporaryFile())
            self._process = _started(job, self._said)
            if self._process.stdin is not None:
                opened.callback(self._process.stdin.close)
            self._opened = opened.pop_all()  # until it has ended

    def ask_to_stop(self) -> None:
        """Request that the run finishes its step, saves and ends; further calls do nothing."""
        # The end of its input is the request, on any system. Together with a Ctrl-C that has
        # reached the process too, it counts as one request.
        self._asked = True
        if self._process.stdin is not None:
            self._process.stdin.close()

    def ended(self) -> Ended | None:
        """Return how the run has ended; None while it continues."""
        code = self._process.poll()
        return None if code is None else self._ended(code)

    def wait(self) -> Ended:
        """Wait for the end of the run."""
        return self._ended(self._process.wait())

    def _ended(self, code: int) -> Ended:
        self._said.seek(0)
        lines = tuple(self._said.read().decode("utf-8", errors="replace").splitlines())
        self._opened.close()
        if code == DONE:
            return Ended(self.job, "done", DONE)
        # Until the process handles signals, they end it at once.
        by_request = {INTERRUPTED, -signal.SIGINT, -signal.SIGTERM}
        if code == INTERRUPTED or (self._asked and code in by_request):
            return Ended(self.job, "interrupted", INTERRUPTED)
        if code < 0:
            why = f"{self.job.directory}: the run was killed by signal {-code}"
            way_on = f"continue with: {replace(self.job.request, quiet=False).resuming}"
            return Ended(self.job, "killed", STOPPED, (*lines, why, way_on))
        # Not the exit code of a refusal: other runs of the command have begun.
        return Ended(self.job, "refused" if code == REFUSED else "stopped", STOPPED, lines)


def _started(job: Job, said: Any) -> subprocess.Popen[bytes]:
    request = replace(job.request, output=job.directory, quiet=True)
    # -P: no file of the working directory is imported in place of a library.
    command = [sys.executable, "-P", "-m", "viscontact.cli.child_run", "run", *request.words()]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    # Nothing is written to its input, whose end, also with this process, requests a stop.
    held, nowhere = subprocess.PIPE, subprocess.DEVNULL
    return subprocess.Popen(command, stdin=held, stdout=nowhere, stderr=said, env=environment)
