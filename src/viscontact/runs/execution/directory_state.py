"""State of a run directory: new, stopped or finished, or refused."""

from __future__ import annotations

from collections.abc import Iterable
from math import isclose
from pathlib import Path
from typing import Any, NoReturn

from viscontact.case import Case, CaseError
from viscontact.case.document import read_document
from viscontact.case.yaml_source import parse
from viscontact.results.run_files import CASE_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.command_error import refuse
from viscontact.runs.directory.differences import Difference, differences
from viscontact.runs.directory.earlier_result import StoredRun, stored_run
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.execution.run_directory import (
    is_of_a_run,
    refuse_no_directory,
    refuse_occupied,
)
from viscontact.runs.processes.job import RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.parsing import parse_quantity

#: Largest number of changes of a case that are listed.
_MAX_CHANGES = 12
#: What needs no other run.
_ANOTHER_FLUID = "  (for another fluid: viscontact leakage DIR, with the settings as options)"
#: Keys without influence on the numbers.
_IRRELEVANT = ("title", "report", "allowable")


def standing(request: RunRequest, recorded: Recorded, case: Case) -> RunStage:
    """Return whether the run of a directory is new, stopped or finished; refuse it otherwise."""
    directory = recorded.directory
    refuse_no_directory(directory)
    if not request.resume:
        refuse_occupied(directory, case, overwrite=request.overwrite)
        return RunStage.NEW
    stored = _stored_summary(directory)
    is_complete = isinstance(stored, StoredRun) and stored.complete
    if isinstance(stored, StoredRun) and is_complete and stored.case == recorded.run.case:
        return RunStage.FINISHED
    if (directory / STATE_NAME).exists() and is_of_a_run(directory):
        return RunStage.STOPPED
    if isinstance(stored, str):
        refuse(f"{stored}; replace it with --overwrite, or choose another directory with -o DIR")
    if stored is not None and is_complete:
        refuse_changed(directory, case, differences(stored.case, recorded.run.case))
    if stored is not None and stored.rows:
        refuse(
            f"{directory}: its result cannot be continued, as {STATE_NAME} is not there; replace "
            "it with --overwrite, or choose another directory with -o DIR"
        )
    refuse_occupied(directory, case, overwrite=False)
    return RunStage.NEW


def refuse_changed(directory: Path, case: Case, changes: Iterable[Difference]) -> NoReturn:
    """Refuse to resume a run of another case, and list the differences."""
    refuse(
        f"{directory}: holds a run of another case; replace it with --overwrite, or choose another "
        "directory with -o DIR; what differs:",
        *(lines := _case_changes(directory / CASE_NAME, case, changes)),
        *([_ANOTHER_FLUID] if any(line.startswith("  leakage") for line in lines) else []),
    )


def _stored_summary(directory: Path) -> StoredRun | str | None:
    """Summary of the stored result, or the reason why it cannot be read; None without one."""
    result = directory / RESULT_NAME
    if not (result.exists() or result.is_symlink()):
        return None
    try:
        return stored_run(result)
    except ValueError as error:
        return str(error)


def _case_changes(kept: Path, case: Case, computed: Iterable[Difference]) -> list[str]:
    """Return a line for each change of the case."""
    # The computed differences, in SI units, are used where the files are equal, as when a table
    # that they name has changed.
    try:
        written = differences(read_document(kept).data, parse(case.text)[0])
    except CaseError:
        written = ()
    changes = [each for each in written if not _means_the_same(each)] or list(computed)
    lines = [f"  {each}" for each in changes[:_MAX_CHANGES]]
    return lines + (
        [f"  and {len(changes) - _MAX_CHANGES} more"] if len(changes) > _MAX_CHANGES else []
    )


def _means_the_same(change: Difference) -> bool:
    if change.where.partition(".")[0] in _IRRELEVANT:
        return True
    return any(
        isclose(one, other, rel_tol=1e-12)
        for dimension in DIMENSIONS
        if (one := _quantity(change.before, dimension)) is not None
        and (other := _quantity(change.now, dimension)) is not None
    )


def _quantity(value: Any, dimension: str) -> float | None:
    try:
        return parse_quantity(value, dimension) if isinstance(value, str) else None
    except ValueError:
        return None
