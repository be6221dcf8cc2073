"""Run in a process of its own, which ends when its parent process is gone."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from contextlib import ExitStack, suppress
from dataclasses import replace

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.processes.job import Job
from viscontact.runs.processes.request import DONE, INTERRUPTED, REFUSED, RESUMABLE, STOPPED


@dataclass(frozen=True)
class Ended:
    """End of one of several runs."""

    job: Job
    outcome: str  # one word
    code: int  # 0 done, 1 stopped, 130 interrupted, also before it began
    lines: tuple[str, ...] = ()  # lines of its error output
    resumable: bool = False  # it stopped for a reason that can be corrected


class RunProcess:
    """Process that imports what a run needs, and waits for one; OSError if none can be started."""

    def __init__(self) -> None:
        # -P: no file of the working directory is imported in place of a library.
        command = [sys.executable, "-P", "-m", "viscontact.cli.child_run"]
        environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
        with ExitStack() as opened:
            self.error_output = opened.enter_context(tempfile.TemporaryFile())
            # The end of its input, also with this process, requests a stop.
            self.process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=self.error_output,
                env=environment,
            )
            opened.callback(self.end_input)
            self._opened = opened.pop_all()

    def begin(self, words: Iterable[str]) -> bool:
        """Begin a command with these words; False if the process has ended meanwhile."""
        assert self.process.stdin is not None
        try:
            self.process.stdin.write(json.dumps([*words]).encode() + b"\n")
            self.process.stdin.flush()
        except OSError:
            return False
        return self.process.poll() is None

    def end_input(self) -> None:
        """Request that the run, or the process without one, ends."""
        if self.process.stdin is not None:
            with suppress(OSError):  # what has not been sent to a process that has ended
                self.process.stdin.close()

    def close(self) -> None:
        """Release what the process needed; one that still waits is ended."""
        self.process.kill()
        self.process.wait()
        self._opened.close()


class Child:
    """Process of a run, which locks its directory, saves and handles signals as a command does.

    `spare` is a process that waits for a run. An OSError means that the system starts no process.
    """

    def __init__(self, job: Job, spare: RunProcess | None = None) -> None:
        self.job = job
        self._stopping = self._killed = False
        whole = replace(job.request, output=job.directory, quiet=True)
        words = [whole.command, *whole.words()]
        if spare is not None and not spare.begin(words):
            spare.close()
            spare = None
        if spare is None:
            spare = RunProcess()
            spare.begin(words)  # one that ends at once says why
        self._run = spare

    def ask_to_stop(self) -> None:
        """Request that the run finishes its step, saves and ends; further calls do nothing."""
        # The end of its input is the request, on any system. Together with a Ctrl-C that has
        # reached the process too, it counts as one request.
        self._stopping = True
        self._run.end_input()

    def kill(self) -> None:
        """End the process at once: what it has saved remains."""
        self._stopping = self._killed = True
        self._run.process.kill()

    def ended(self) -> Ended | None:
        """Return how the run has ended; None while it continues."""
        code = self._run.process.poll()
        return None if code is None else self._end_of(code)

    def wait(self) -> Ended:
        """Wait for the end of the run."""
        return self._end_of(self._run.process.wait())

    def _end_of(self, code: int) -> Ended:
        self._run.error_output.seek(0)
        lines = tuple(self._run.error_output.read().decode("utf-8", errors="replace").splitlines())
        self._run.close()
        if code == DONE:
            return Ended(self.job, "done", DONE)
        # Until the process handles signals, they end it at once.
        by_request = {INTERRUPTED, -signal.SIGINT, -signal.SIGTERM}
        is_requested = self._killed or (self._stopping and code in by_request)
        if code == INTERRUPTED or is_requested:
            return Ended(self.job, "interrupted", INTERRUPTED)
        if code < 0:
            why = f"{self.job.directory}: the run was killed by signal {-code}"
            way_on = f"continue with: {replace(self.job.request, quiet=False).resuming}"
            return Ended(self.job, "killed", STOPPED, (*lines, why, way_on), resumable=True)
        # Not the exit code of a refusal: other runs of the command have begun.
        word = "refused" if code == REFUSED else "stopped"
        return Ended(self.job, word, STOPPED, lines, resumable=code == RESUMABLE)
