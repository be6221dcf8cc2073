"""Execution of a run, from its case file to its run directory."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, closing, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_files import RESULT_NAME, STATE_NAME
from viscontact.runs.command_error import refuse, stop
from viscontact.runs.directory.failure import remove_failure
from viscontact.runs.directory.lock import DirectoryInUse, awaited_lease, locked
from viscontact.runs.directory.lock_check import LockLost
from viscontact.runs.directory.recorded import ChangedCaseError, remove_restart_files
from viscontact.runs.directory.recorder import Recorder, Undisturbed
from viscontact.runs.execution.checked_run import CheckedRun, checked_run
from viscontact.runs.execution.directory_state import refuse_changed
from viscontact.runs.execution.run_directory import reserved, write_case
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.processes.job import RunStage
from viscontact.runs.processes.request import INTERRUPTED, RunRequest

if TYPE_CHECKING:
    from viscontact.simulation.transient.state_generator import Progress


@dataclass(frozen=True)
class Monitor:
    """Requests to stop a run, and the outputs of its messages and of its progress."""

    stops: StopRequests
    say: Callable[[str], None]
    #: Called with the number of rows, None if the run chooses its steps, and the finished ones.
    progress: Callable[[int | None, int], AbstractContextManager[Progress]]
    pause: float = 0.0  # from the start of a run to its first checkpoint [s]


def execute_run(request: RunRequest, monitor: Monitor) -> tuple[Path, bool]:
    """Run a case; return its directory, False if finished before. CommandError if it ends early."""
    with before_the_first_step():
        checked = checked_run(request)
    return execute_checked(checked, monitor)


def execute_checked(checked: CheckedRun, monitor: Monitor) -> tuple[Path, bool]:
    """Run a checked case, as `execute_run`."""
    with before_the_first_step():
        # Checked before anything is created, and again when the directory is locked.
        standing = checked.standing()
    directory = checked.recorded.directory
    if standing is not RunStage.FINISHED:
        if message := awaited_lease(directory):
            monitor.say(message)
        with reserved(directory) as check:
            standing = checked.standing()
            if standing is not RunStage.FINISHED:
                remove_failure(directory)
                _run(checked.with_lock(check), standing, monitor)
                return directory, True
    _say_finished(checked, monitor)
    return directory, False


def _run(checked: CheckedRun, standing: RunStage, monitor: Monitor) -> None:
    """Compute the run from its beginning or its last saved step; the directory is locked."""
    with before_the_first_step():
        if standing is RunStage.NEW:
            record = _new_record(checked, monitor)
        else:
            record = _resumed_record(checked, monitor)
    with closing(record):
        _march(checked, record, monitor)


def _new_record(checked: CheckedRun, monitor: Monitor) -> Recorder:
    recorded, postponed = checked.recorded, monitor.stops.postponed
    if checked.request.resume:
        monitor.say(f"{recorded.directory}: nothing is saved there yet; starting at the beginning")
    write = partial(write_case, recorded.directory, checked.prepared.case)
    try:
        return _opened_record(
            postponed, partial(Recorder, recorded, write, postponed, monitor.pause)
        )
    except OSError as error:
        refuse(f"{recorded.directory}: cannot be written: {error}")


def _resumed_record(checked: CheckedRun, monitor: Monitor) -> Recorder:
    recorded, postponed = checked.recorded, monitor.stops.postponed
    write = partial(write_case, recorded.directory, checked.prepared.case)
    try:
        record = _opened_record(postponed, partial(Recorder.resume, recorded, write, postponed))
    except ChangedCaseError as error:
        refuse_changed(recorded.directory, checked.prepared.case, error.changes)
    except ValueError as error:
        refuse(str(error))
    except OSError as error:
        stop(
            f"{recorded.directory}: the run cannot be continued: {error}",
            f"what it keeps is unchanged; after correcting that: {checked.request.resuming}",
            resumable=True,
        )
    monitor.say(f"{recorded.directory}: continuing after {recorded.run.continued(*record.resumed)}")
    return record


def _opened_record(postponed: Undisturbed, make: Callable[[], Recorder]) -> Recorder:
    """Open a record completely; on a request to stop in the meantime, close it again."""
    with ExitStack() as opened:
        with postponed():
            record = make()
            opened.callback(record.close)
        opened.pop_all()
    return record


def _march(checked: CheckedRun, record: Recorder, monitor: Monitor) -> None:
    """March and record; the completed steps are kept however it ends."""
    try:
        with monitor.stops.marching():
            is_complete = _complete_march(checked, record, monitor)
    except (ConvergenceError, DomainError, ValueError) as error:
        _publish(record)
        # A resumed run would stop at the same step.
        option = " with --overwrite" if record.shown.rows else ""
        remedy = f"with that changed, run it again{option}"
        stop(*checked.prepared.case.error(str(error)).problems, _note(checked, record), remedy)
    except LockLost as error:
        stop(f"{error}; that run continues, and this one has stopped before its next write")
    except (OSError, MemoryError) as error:
        _publish(record)
        why = f"{checked.recorded.directory}: the run stopped: {str(error) or type(error).__name__}"
        remedy = f"after correcting that: {_remedy(checked, record)}"
        stop(why, _resumable(checked, record), remedy, resumable=True)
    except KeyboardInterrupt:
        _publish(record)
        is_complete = False
    if not is_complete:
        lines = _resumable(checked, record), f"continue with: {_remedy(checked, record)}"
        stop("interrupted", *lines, code=INTERRUPTED, resumable=True)


def _complete_march(checked: CheckedRun, record: Recorder, monitor: Monitor) -> bool:
    """March to the end and save everything; False after a request to stop."""
    recorded = checked.recorded
    with monitor.progress(recorded.run.total, record.resumed.rows) as progress:
        for state in record.steps(progress):
            is_last = state is not None and recorded.run.is_last(state)
            if monitor.stops.requested and not is_last:
                record.checkpoint()
                return False
    if recorded.run.errors and recorded.run.axis.is_history:  # speeds come with theirs
        monitor.say("estimating errors, from coarser runs of the same case")
    record.finish(record.estimate_errors(partial(_stop_if_requested, monitor)))
    monitor.stops.over = True
    return True


def _stop_if_requested(monitor: Monitor) -> None:
    """End the estimation of errors on request; it is repeated when the run is resumed."""
    if monitor.stops.requested:
        raise KeyboardInterrupt


def _publish(record: Recorder) -> None:
    # The steps since the last checkpoint can be shown, but not resumed from within a step.
    with suppress(OSError, KeyboardInterrupt):
        record.publish()


def _note(checked: CheckedRun, record: Recorder) -> str:
    directory = checked.recorded.directory
    if _is_gone(checked, record):
        return f"{directory} no longer exists, and neither does what it kept"
    if not record.shown.rows:
        return f"{directory} keeps nothing yet: no {checked.recorded.run.axis.row} was finished"
    return f"{directory} keeps {checked.recorded.run.made(*record.shown)}"


def _resumable(checked: CheckedRun, record: Recorder) -> str:
    saved = record.saved.rows
    lost = saved < record.shown.rows and not _is_gone(checked, record)
    return _note(checked, record) + (f"; a resumed run continues after {saved}" if lost else "")


def _remedy(checked: CheckedRun, record: Recorder) -> str:
    """Command to type next: it resumes the run, or repeats it where no step is saved."""
    keeps = record.shown.rows and not _is_gone(checked, record)
    return checked.request.resuming if keeps else checked.request.repeating


def _is_gone(checked: CheckedRun, record: Recorder) -> bool:
    """True if the directory has been removed or moved during the run."""
    files = (checked.recorded.directory / name for name in (RESULT_NAME, STATE_NAME))
    return record.shown.rows > 0 and not any(file.exists() for file in files)


def _say_finished(checked: CheckedRun, monitor: Monitor) -> None:
    directory, extent = checked.recorded.directory, checked.recorded.run.extent
    remove_leftovers(directory)
    monitor.say(f"{directory}: is finished already, {extent}; --overwrite computes it again")


def remove_leftovers(directory: Path) -> None:
    """Remove temporary files of a finished run whose process was killed at its end."""
    with suppress(OSError, DirectoryInUse), locked(directory):
        remove_restart_files(directory)
        remove_failure(directory)


@contextmanager
def before_the_first_step() -> Iterator[None]:
    """End with a message on a request to stop, as nothing has been saved yet."""
    try:
        yield
    except KeyboardInterrupt:
        stop("interrupted before the first step; nothing has been changed", code=INTERRUPTED)
