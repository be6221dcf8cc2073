"""A run as a process of its own, which ends when the one that began it is gone."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Any

from viscontact.runs.processes.exit_codes import DONE, INTERRUPTED, REFUSED, STOPPED
from viscontact.runs.processes.job import Job
from viscontact.runs.processes.progress import Course


@dataclass(frozen=True)
class Ended:
    """How one of several runs ended.

    Attributes
    ----------
    job : Job
        The run.
    outcome : str
        In a word.
    code : int
        0 done, 1 stopped, 130 interrupted, be it before it began.
    said : tuple of str
        What it had to say for itself.
    """

    job: Job
    outcome: str
    code: int
    said: tuple[str, ...] = ()


class Child:
    """A run at work.

    A process of its own, so that all that holds for a run holds for each of many: the lock of its
    directory, what it saves and when, how it meets signals. What it says is kept for the end.

    Parameters
    ----------
    job : Job
        The run.

    Attributes
    ----------
    job : Job
        The run.
    course : Course
        How far it has come.

    Raises
    ------
    OSError
        If the system starts no further process.
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
        """Ask it to finish its step, save and end; once is enough."""
        # It takes the end of its input as a request, on any system. If Ctrl-C has reached it as
        # well, the two are one request; Ctrl-C does not count twice.
        self._asked = True
        if self._process.stdin is not None:
            self._process.stdin.close()

    def ended(self) -> Ended | None:
        """How it has ended; None while it is at work."""
        code = self._process.poll()
        return None if code is None else self._ended(code)

    def wait(self) -> Ended:
        """Wait for its end."""
        return self._ended(self._process.wait())

    def _ended(self, code: int) -> Ended:
        self._said.seek(0)
        lines = tuple(self._said.read().decode("utf-8", errors="replace").splitlines())
        self._opened.close()
        if code == DONE:
            return Ended(self.job, "done", DONE)
        # Before it has met signals, they end it at once.
        by_request = {INTERRUPTED, -signal.SIGINT, -signal.SIGTERM}
        if code == INTERRUPTED or (self._asked and code in by_request):
            return Ended(self.job, "interrupted", INTERRUPTED)
        if code < 0:
            why = f"{self.job.directory}: the run was killed by signal {-code}"
            way_on = f"continue with: {replace(self.job.request, quiet=False).resuming}"
            return Ended(self.job, "killed", STOPPED, (*lines, why, way_on))
        # Others have begun: that nothing was changed is true of this one alone.
        return Ended(self.job, "refused" if code == REFUSED else "stopped", STOPPED, lines)


def _started(job: Job, said: Any) -> subprocess.Popen[bytes]:
    request = replace(job.request, output=job.directory, quiet=True)
    # -P: what lies in the working directory is not imported in place of a library.
    command = [sys.executable, "-P", "-m", "viscontact.cli.child_run", "run", *request.words()]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    # Nothing is ever written to its input. That it ends, as it does with this process, asks it to.
    held, nowhere = subprocess.PIPE, subprocess.DEVNULL
    return subprocess.Popen(command, stdin=held, stdout=nowhere, stderr=said, env=environment)
