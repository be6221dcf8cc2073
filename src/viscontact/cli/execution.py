"""A run from its case file to its directory."""

from __future__ import annotations

import time as clock
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from viscontact.cli.interruption import watched_interruption
from viscontact.cli.messages import INTERRUPTED, stop
from viscontact.cli.preparation import Prepared, prepare
from viscontact.cli.progress import shown_progress
from viscontact.cli.run_directory import chosen_directory, refuse_occupied, set_up
from viscontact.cli.stored import progress_made
from viscontact.cli.summary import print_summary
from viscontact.dataset import run_attributes
from viscontact.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.marching import march_run
from viscontact.recording.result_writer import ResultWriter
from viscontact.state import ContactState


@dataclass
class Record:
    """The states of a run without their fields, as they come."""

    states: list[ContactState] = field(default_factory=list)
    interrupted: bool = False


def execute(
    path: Path,
    output: Path | None = None,
    *,
    overwrite: bool = False,
    settings: Sequence[str] | None = None,
    threads: int = 1,
    quiet: bool = False,
) -> Path:
    """Run a case and write its result.

    Parameters
    ----------
    path : Path
        The case file.
    output : Path, optional
        The run's directory; beside the file when left out.
    overwrite : bool
        Replace the result that the directory holds.
    settings : sequence of str, optional
        The values of ``--set``.
    threads : int
        Threads of one Fourier transform.
    quiet : bool
        Print errors only.

    Returns
    -------
    Path
        The run's directory.

    Raises
    ------
    typer.Exit
        With code 2 if refused before anything was created, 1 if stopped during the run, 130
        if interrupted.
    """
    prepared = prepare(path, settings or [], threads)
    directory = chosen_directory(path, output)
    refuse_occupied(directory, prepared.case, overwrite=overwrite)
    result = set_up(directory, prepared.case)
    record, started = Record(), clock.perf_counter()
    _march_into(result, prepared, record, quiet=quiet)
    if not quiet:
        print_summary(prepared.run, record.states, directory, clock.perf_counter() - started)
    return directory


def _march_into(result: Path, prepared: Prepared, record: Record, *, quiet: bool) -> None:
    """March and write; whatever ends it early, the completed steps stay."""
    try:
        _write_states(result, prepared, record, quiet=quiet)
    except (ConvergenceError, DomainError) as error:
        problems = prepared.case.error(str(error)).problems
        stop(*problems, _kept(result, prepared, record))
    except (OSError, RuntimeError, MemoryError) as error:
        # netCDF raises RuntimeError where the disk is full
        why = str(error) or type(error).__name__
        stop(f"{result}: the run stopped: {why}", _kept(result, prepared, record))
    except KeyboardInterrupt:
        record.interrupted = True
    if record.interrupted:
        advice = ["continuing with --resume is not built yet; start again with --overwrite"]
        kept = _kept(result, prepared, record)
        stop("interrupted", kept, *(advice if record.states else ()), code=INTERRUPTED)


def _write_states(result: Path, prepared: Prepared, record: Record, *, quiet: bool) -> None:
    run, case = prepared.run, prepared.case
    attributes = {"title": case.title, **run_attributes(run)}
    with (
        watched_interruption() as interruption,
        ResultWriter(
            result, run.grid, run.times, fields=case.fields, attributes=attributes
        ) as writer,
        shown_progress(None if run.adaptive else len(run.times), quiet=quiet) as progress,
        warnings.catch_warnings(),
    ):
        # They travel with the states, and the summary prints them.
        warnings.simplefilter("ignore", AccuracyWarning)
        if not result.exists():
            writer.publish()
        for state in march_run(run, progress):
            writer.append(state)
            writer.publish()
            record.states.append(state.without_fields())
            if interruption.requested and state.time < run.times[-1]:
                record.interrupted = True
                return
        writer.finish()


def _kept(result: Path, prepared: Prepared, record: Record) -> str:
    reached = record.states[-1].time if record.states else None
    run = prepared.run
    made = progress_made(len(record.states), reached, run.times.tolist(), run.adaptive)
    return f"{result.parent} keeps {made}"
