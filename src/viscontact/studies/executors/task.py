"""Task: a recorded run as words and numbers, which any process that sees its disk can perform."""

from __future__ import annotations

import os
import threading
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import field, replace
from pathlib import Path
from typing import Protocol, Self

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.state import ContactState
from viscontact.results.run_files import ATTEMPT_NAME
from viscontact.runs.command_error import CommandError
from viscontact.runs.directory.failure import write_failure
from viscontact.runs.directory.lock import is_locked
from viscontact.runs.directory.recorder import BATCH_PAUSE
from viscontact.runs.execution.case_digests import Digests, changed_parts
from viscontact.runs.execution.checked_run import CheckedRun, checked_run
from viscontact.runs.execution.execution import Monitor, execute_checked
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.processes.child import Child
from viscontact.runs.processes.job import RunStage
from viscontact.runs.processes.request import DONE, INTERRUPTED, REFUSED, STOPPED, RunRequest
from viscontact.simulation.transient.state_generator import Progress

#: Longest predicted duration of a run that is computed in the process of its task [s].
LONGEST_WARM = 10.0
#: Time between two looks at a process or a lock [s].
PAUSE = 0.1
#: Attempts of a run whose process is killed.
ATTEMPTS = 2

#: netCDF-4 may be used by one thread at a time.
ONE_AT_A_TIME = threading.Lock()


@dataclass(frozen=True)
class Task:
    """A run in its directory; a file `stop` asks it to finish its step, save and end."""

    # What an earlier task with the same `token` has left there, because its process was killed, is
    # resumed.

    request: RunRequest
    directory: Path
    token: str
    stop: Path | None = None
    digests: Digests = field(default_factory=dict)  # of the case; empty if it may change

    def compute(self, stops: StopRequests) -> TaskEnd:
        """Compute the run, or what is left of it, unless its case has changed."""
        pairs = (text.partition("=") for text in self.request.settings)
        settings = {key.strip(): value for key, _, value in pairs}
        if parts := changed_parts(self.request.case, settings, self.digests):
            why = (
                f"{self.request.case}: has changed since the first run began: {', '.join(parts)}; "
                "compute the changed case in a new directory, or undo the change and continue"
            )
            return TaskEnd("refused", STOPPED, (why,))
        return _attempt(self, stops)

    def elsewhere(self, stop: Path) -> Self:
        """Return the task with absolute paths, which the file may stop."""
        directory = self.directory.absolute()
        request = replace(self.request, case=self.request.case.absolute(), output=directory)
        return replace(self, request=request, directory=directory, stop=stop)


@dataclass(frozen=True)
class TaskEnd:
    """End of a run: one word, exit code, and lines of its error output."""

    word: str  # "done", "refused", "stopped", "killed", "interrupted" or "not begun"
    code: int  # 0 done, 1 stopped, 130 interrupted, also before it began
    lines: tuple[str, ...] = ()


class RecordedTask(Protocol):
    """Task that computes a run in its directory."""

    @property
    def directory(self) -> Path:
        """Directory of the run."""

    @property
    def stop(self) -> Path | None:
        """File that asks the run to save and end."""

    def compute(self, stops: StopRequests) -> TaskEnd:
        """Compute the run, or what is left of it."""

    def elsewhere(self, stop: Path) -> Self:
        """Return the task with absolute paths, which the file may stop."""


def perform(task: RecordedTask, stops: StopRequests | None = None) -> TaskEnd:
    """Compute a run in its directory, or what remains of it; a failure is written there."""
    # Short runs are computed in this process, one at a time; others are processes of their own.
    stops = StopRequests(task.stop) if stops is None else stops
    while is_locked(task.directory) and not stops.requested:
        clock.sleep(PAUSE)  # the process of an earlier attempt, or of the run itself, is saving
    if stops.requested:
        return TaskEnd("not begun", INTERRUPTED)
    above = task.directory.parent
    if not _is_there(above):  # not made again, without the manifest that it held
        why = f"{task.directory}: cannot be made: {above} has been removed meanwhile"
        return TaskEnd("refused", STOPPED, (why,))
    outcome = task.compute(stops)
    if is_locked(task.directory):
        return outcome  # another run has taken it over: its files are left alone
    if outcome.code == STOPPED:
        write_failure(task.directory, outcome.word, outcome.code, outcome.lines)
    with suppress(OSError):
        (task.directory / ATTEMPT_NAME).unlink(missing_ok=True)
    return outcome


def _is_there(directory: Path) -> bool:
    """Test whether a directory exists that another machine may have made a moment ago."""
    if directory.is_dir():
        return True
    with suppress(OSError):
        os.scandir(directory.parent).close()  # lets a network file system look for new names
    return directory.is_dir()


def _attempt(task: Task, stops: StopRequests) -> TaskEnd:
    """Resume an earlier attempt of this task, or begin."""
    request, mark = task.request, task.directory / ATTEMPT_NAME
    if request.resume:
        return _compute(request, task.directory, stops)
    try:
        if mark.is_file() and mark.read_text(encoding="utf-8") == task.token:
            resumed = replace(request, resume=True, overwrite=False)
            outcome = _compute(resumed, task.directory, stops)
            # Killed before it had replaced an earlier run, it left nothing to resume.
            return (
                outcome if outcome.word != "refused" else _compute(request, task.directory, stops)
            )
        task.directory.mkdir(exist_ok=True)
        mark.write_text(task.token, encoding="utf-8")
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        return TaskEnd("refused", STOPPED, (f"{task.directory}: cannot be written: {why}",))
    return _compute(request, task.directory, stops)


def _compute(request: RunRequest, directory: Path, stops: StopRequests) -> TaskEnd:
    try:
        with ONE_AT_A_TIME:
            checked = checked_run(replace(request, output=directory, quiet=True))
            if checked.recorded.run.seconds <= LONGEST_WARM:
                execute_checked(checked, Monitor(stops, _ignore, _no_progress, pause=BATCH_PAUSE))
                return TaskEnd("done", DONE)
        return _in_process(checked, stops)
    except CommandError as end:
        return _note_end(end)
    except KeyboardInterrupt:
        return TaskEnd("interrupted", INTERRUPTED)
    except MemoryError:
        return TaskEnd("stopped", STOPPED, (f"{directory}: there is too little memory",))
    except Exception as error:
        why = f"{directory}: unexpected {type(error).__name__}: {error}"
        return TaskEnd("stopped", STOPPED, (why, "this is a fault of viscontact; report it"))


def _note_end(end: CommandError) -> TaskEnd:
    if end.code == INTERRUPTED:
        return TaskEnd("interrupted", INTERRUPTED)
    # Not the exit code of a refusal: other runs of the command have begun.
    return TaskEnd("refused" if end.code == REFUSED else "stopped", STOPPED, end.lines)


def _in_process(checked: CheckedRun, stops: StopRequests) -> TaskEnd:
    """Compute a run in a process of its own, which is resumed once if it is killed."""
    job = checked.job(RunStage.NEW)
    for _ in range(ATTEMPTS):
        ended = _waited_for(Child(job), stops)
        if ended.word != "killed":
            break
        job = replace(job, request=replace(job.request, resume=True, overwrite=False))
    return ended


def _waited_for(child: Child, stops: StopRequests) -> TaskEnd:
    with stops.marching():
        ended = None
        while ended is None:
            try:
                if stops.requested:
                    child.ask_to_stop()
                clock.sleep(PAUSE)
                ended = child.ended()
            except KeyboardInterrupt:
                child.ask_to_stop()
    return TaskEnd(ended.outcome, ended.code, ended.lines)


def _ignore(line: str) -> None:
    """Print nothing."""


@contextmanager
def _no_progress(total: int | None, done: int) -> Iterator[Progress]:
    def report(state: ContactState, done: int, total: int) -> None:
        """Show nothing."""

    yield report
