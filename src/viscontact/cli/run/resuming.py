"""Whether a run begins, goes on, or is over already."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NoReturn

from viscontact.case import Case
from viscontact.cli.run.case_changes import case_changes
from viscontact.cli.run.run_directory import is_of_a_run, refuse_no_directory, refuse_occupied
from viscontact.cli.terminal.messages import refuse
from viscontact.run_files import CASE_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.differences import Difference, differences
from viscontact.runs.directory.recorded_run import Recorded
from viscontact.runs.directory.stored_result import StoredRun, stored_run
from viscontact.runs.processes.job import Standing
from viscontact.runs.processes.request import RunRequest


def standing(request: RunRequest, recorded: Recorded, case: Case) -> Standing:
    """Tell what is to be done in the directory of a run.

    Parameters
    ----------
    request : RunRequest
        What is asked for.
    recorded : Recorded
        The run.
    case : Case
        The case it is from.

    Returns
    -------
    Standing
        Whether the run begins, goes on, or is over.

    Raises
    ------
    typer.Exit
        With code 2, if something would be lost, or the run cannot go on.
    """
    directory = recorded.directory
    refuse_no_directory(directory)
    if not request.resume:
        refuse_occupied(directory, case, overwrite=request.overwrite)
        return Standing.NEW
    stored = _stored(directory)
    is_complete = isinstance(stored, StoredRun) and stored.complete
    if isinstance(stored, StoredRun) and is_complete and stored.case == recorded.case:
        return Standing.FINISHED
    if (directory / STATE_NAME).exists() and is_of_a_run(directory):
        return Standing.STOPPED
    if isinstance(stored, str):
        refuse(f"{stored}; replace it with --overwrite, or choose another directory with -o DIR")
    if stored is not None and is_complete:
        refuse_changed(directory, case, differences(stored.case, recorded.case))
    if stored is not None and stored.rows:
        refuse(
            f"{directory}: its result cannot be continued, as {STATE_NAME} is not there; replace "
            "it with --overwrite, or choose another directory with -o DIR"
        )
    refuse_occupied(directory, case, overwrite=False)
    return Standing.NEW


def refuse_changed(directory: Path, case: Case, changes: Iterable[Difference]) -> NoReturn:
    """Refuse to go on with a run as another one, and show what differs.

    Parameters
    ----------
    directory : Path
        Where the run is.
    case : Case
        The case now.
    changes : iterable of Difference
        How the runs differ, in SI units.

    Raises
    ------
    typer.Exit
        With code 2.
    """
    refuse(
        f"{directory}: holds a run of another case; replace it with --overwrite, or choose another "
        "directory with -o DIR; what differs:",
        *case_changes(directory / CASE_NAME, case, changes),
    )


def _stored(directory: Path) -> StoredRun | str | None:
    """What the result says of itself, or why it cannot; None without one."""
    result = directory / RESULT_NAME
    if not (result.exists() or result.is_symlink()):
        return None
    try:
        return stored_run(result)
    except ValueError as error:
        return str(error)
