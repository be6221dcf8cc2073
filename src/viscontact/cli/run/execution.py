"""A run from its case file to its directory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager, suppress
from functools import partial
from pathlib import Path

from viscontact.cli.run.attempt import Attempt, attempted
from viscontact.cli.run.resuming import refuse_changed
from viscontact.cli.run.run_directory import taken, write_case
from viscontact.cli.run.summary import print_summary
from viscontact.cli.terminal.interruption import Interruption, watched_interruption
from viscontact.cli.terminal.messages import INTERRUPTED, refuse, say, stop
from viscontact.cli.terminal.progress import shown_progress
from viscontact.cli.terminal.streams import printing, unwritten
from viscontact.errors import ConvergenceError, DomainError
from viscontact.run_files import RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.runs.directory.recorded_run import ChangedCaseError, remove_traces
from viscontact.runs.directory.recorder import RunRecord, Undisturbed
from viscontact.runs.processes.job import Standing
from viscontact.runs.processes.request import RunRequest
from viscontact.units.formatting import format_quantity


def execute(
    path: Path,
    output: Path | None = None,
    *,
    overwrite: bool = False,
    resume: bool = False,
    settings: Sequence[str] | None = None,
    threads: int = 1,
    quiet: bool = False,
) -> Path:
    """Run a case and write its result."""
    if overwrite and resume:
        refuse("--resume goes on with a run and --overwrite begins it anew: give one of them")
    request = RunRequest(path, output, overwrite, resume, tuple(settings or ()), threads, quiet)
    with watched_interruption() as interruption:
        with before_the_first_step():
            attempt = attempted(request, interruption)
            # Looked at before anything is created, and again once no other run can change it.
            stands = attempt.standing()
        directory = attempt.recorded.directory
        if stands is not Standing.FINISHED:
            with taken(directory):
                stands = attempt.standing()
                if stands is not Standing.FINISHED:
                    _run(attempt, stands)
                    return directory
    _say_finished(attempt)
    return directory


def _run(attempt: Attempt, stands: Standing) -> None:
    """Begin or go on, to the end; the directory is this run's alone."""
    with before_the_first_step():
        record = _begun(attempt) if stands is Standing.NEW else _taken_up(attempt)
    with closing(record):
        _march(attempt, record)
    if not attempt.request.quiet:
        _tell(attempt)


def _tell(attempt: Attempt) -> None:
    """Print the summary; the run is finished, whether or not anybody reads it."""
    directory = attempt.recorded.directory
    try:
        with printing():
            print_summary(directory)
    except OSError as error:
        if unwritten("stdout") is None and not isinstance(error, BrokenPipeError):
            stop(f"{directory}: the run is finished, but its result cannot be read: {error}")
        why = error.strerror or str(error)
        say(f"{directory}: the run is finished; its table cannot be printed: {why}")


def _begun(attempt: Attempt) -> RunRecord:
    recorded, postponed = attempt.recorded, attempt.interruption.postponed
    if attempt.request.resume:
        attempt.say(f"{recorded.directory}: nothing is saved there yet; starting at the beginning")
    write = partial(_write_case, attempt)
    try:
        return _whole(postponed, partial(RunRecord, recorded, write, postponed))
    except OSError as error:
        refuse(f"{recorded.directory}: cannot be written: {error}")


def _taken_up(attempt: Attempt) -> RunRecord:
    recorded, postponed = attempt.recorded, attempt.interruption.postponed
    write = partial(_write_case, attempt)
    try:
        record = _whole(postponed, partial(RunRecord.resume, recorded, write, postponed))
    except ChangedCaseError as error:
        refuse_changed(recorded.directory, attempt.prepared.case, error.changes)
    except ValueError as error:
        refuse(str(error))
    except OSError as error:
        stop(
            f"{recorded.directory}: the run cannot go on: {error}",
            f"what it keeps is as it was; once that is mended: {attempt.request.resuming}",
        )
    made = attempt.made(*record.resumed)
    time = record.resumed.time
    at = "" if time is None else f", t = {format_quantity(time, 's')}"
    attempt.say(f"{recorded.directory}: going on after {made}{'' if ', up to t =' in made else at}")
    return record


def _whole(postponed: Undisturbed, make: Callable[[], RunRecord]) -> RunRecord:
    """Make a record whole; if somebody wants to stop meanwhile, close it again."""
    with ExitStack() as opened:
        with postponed():
            record = make()
            opened.callback(record.close)
        opened.pop_all()
    return record


def _write_case(attempt: Attempt) -> None:
    write_case(attempt.recorded.directory, attempt.prepared.case)


def _march(attempt: Attempt, record: RunRecord) -> None:
    """March and record; whatever ends it early, the completed steps stay."""
    try:
        with attempt.interruption.marching():
            is_whole = _is_marched_to_the_end(attempt, record)
    except (ConvergenceError, DomainError) as error:
        _publish(record)
        # A resumed run would end in the same way.
        remedy = "with that changed, run it again" + (
            " with --overwrite" if record.shown.instants else ""
        )
        stop(*attempt.prepared.case.error(str(error)).problems, _kept(attempt, record), remedy)
    except (OSError, MemoryError) as error:
        _publish(record)
        why = f"{attempt.recorded.directory}: the run stopped: {str(error) or type(error).__name__}"
        stop(why, _resumable(attempt, record), f"once that is mended: {_remedy(attempt, record)}")
    except KeyboardInterrupt:
        _publish(record)
        is_whole = False
    if not is_whole:
        kept = _resumable(attempt, record)
        stop("interrupted", kept, f"go on with: {_remedy(attempt, record)}", code=INTERRUPTED)


def _is_marched_to_the_end(attempt: Attempt, record: RunRecord) -> bool:
    """March until the end, or until somebody wants it to stop, and leave everything saved."""
    recorded = attempt.recorded
    run = recorded.run
    total = None if run.adaptive else len(run.times)
    with shown_progress(total, record.resumed.instants, quiet=attempt.request.quiet) as progress:
        for state in record.steps(progress):
            is_last = state is not None and state.time >= run.times[-1]
            if attempt.interruption.requested and not is_last:
                record.checkpoint()
                return False
    if recorded.errors:
        attempt.say("estimating errors, from two coarser runs of the same case")
    record.finish(record.estimate_errors(partial(_stop_if_asked, attempt.interruption)))
    attempt.interruption.over = True
    return True


def _stop_if_asked(interruption: Interruption) -> None:
    """End the estimate of errors; it is made anew when the run is taken up."""
    if interruption.requested:
        raise KeyboardInterrupt


def _publish(record: RunRecord) -> None:
    # The steps since the last checkpoint can be shown, but not resumed from within a step.
    with suppress(OSError, KeyboardInterrupt):
        record.publish()


def _kept(attempt: Attempt, record: RunRecord) -> str:
    directory = attempt.recorded.directory
    if _is_gone(attempt, record):
        return f"{directory} is not there any more, and what it kept has gone with it"
    if not record.shown.instants:
        return f"{directory} keeps nothing yet: no instant was finished"
    return f"{directory} keeps {attempt.made(*record.shown)}"


def _resumable(attempt: Attempt, record: RunRecord) -> str:
    saved = record.saved.instants
    lost = saved < record.shown.instants and not _is_gone(attempt, record)
    return _kept(attempt, record) + (f"; the run goes on after {saved}" if lost else "")


def _remedy(attempt: Attempt, record: RunRecord) -> str:
    """The command to type next; without a step there is nothing to go on from."""
    keeps = record.shown.instants and not _is_gone(attempt, record)
    return attempt.request.resuming if keeps else attempt.request.repeating


def _is_gone(attempt: Attempt, record: RunRecord) -> bool:
    """Whether the directory has been removed or moved during the run."""
    files = (attempt.recorded.directory / name for name in (RESULT_NAME, STATE_NAME))
    return record.shown.instants > 0 and not any(file.exists() for file in files)


def _say_finished(attempt: Attempt) -> None:
    directory, run = attempt.recorded.directory, attempt.recorded.run
    tidy(directory)
    attempt.say(
        f"{directory}: is finished already, up to t = "
        f"{format_quantity(float(run.times[-1]), 's')}; --overwrite computes it anew"
    )


def tidy(directory: Path) -> None:
    """Remove what a finished run has left that was killed in its last moment."""
    with suppress(OSError, DirectoryInUse), locked(directory):
        remove_traces(directory)


@contextmanager
def before_the_first_step() -> Iterator[None]:
    """Within it, a request to stop finds nothing to save."""
    try:
        yield
    except KeyboardInterrupt:
        stop("interrupted before the first step; nothing has been changed", code=INTERRUPTED)
