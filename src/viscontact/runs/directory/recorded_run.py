"""Description of a recorded run, and its state at the last checkpoint."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from viscontact.fourier import transforms_by
from viscontact.grid import Grid
from viscontact.problem.problem import Problem
from viscontact.results.descriptions import describe
from viscontact.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.atomic_files import fresh_name
from viscontact.runs.directory.checkpoint import (
    REMEDY,
    Checkpoint,
    is_checkpoint,
    load_checkpoint,
)
from viscontact.runs.directory.differences import Difference, differences
from viscontact.runs.directory.lock_check import LockCheck, never_lost
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.result_writer import ResultWriter, working_files
from viscontact.runs.directory.stored_result import stored_run
from viscontact.simulation.march import March
from viscontact.simulation.provenance import describe_problem, run_attributes
from viscontact.simulation.setup import RunSetup


class ChangedCaseError(ValueError):
    """A run that cannot be resumed, because its case has changed; `changes` are the differences."""

    def __init__(self, changes: Sequence[Difference]) -> None:
        super().__init__("; ".join(map(str, changes)))
        self.changes = tuple(changes)


@dataclass(frozen=True)
class RecordedRun:
    """A run, its directory, and the choice of the quantities that are recorded."""

    directory: Path
    run: RunSetup
    fields: str | Sequence[float]  # "all", "none" or the instants of kept fields [s]
    title: str = ""  # of the result
    errors: bool = False  # True if errors of the scalars are estimated after the march
    check: LockCheck = never_lost  # of the lock of the directory, before each write

    @property
    def case(self) -> dict[str, Any]:
        """Description of the run as plain data, which a run that is resumed must equal."""
        return plain_case(self.run.problem, self.run.grid, self.fields, errors=self.errors)

    @property
    def contents(self) -> Contents:
        """Contents of the result."""
        case, problem = self.case, self.run.problem
        about = {name: json.dumps(case[name]) for name in ("fields", "errors")}
        attributes = {"title": self.title, **run_attributes(self.run), **about}
        return Contents(
            self.run.grid,
            problem.instants,
            self.fields,
            attributes,
            self.errors,
            problem.tolerance if _fits_single_precision(problem) else 0.0,
            moving=problem.motion is not None,
        )

    @property
    def result_path(self) -> Path:
        """Path of the result."""
        return self.directory / RESULT_NAME

    def load_checkpoint(self) -> Checkpoint:
        """Load the last checkpoint.

        FileNotFoundError if there is none, ChangedCaseError if it is of another case, ValueError if
        it cannot be read.
        """
        saved = load_checkpoint(self.directory / STATE_NAME)
        if changes := differences(saved.case, self.case):
            raise ChangedCaseError(changes)
        return saved

    def with_transforms(self, library: str) -> RecordedRun:
        """Return the run with its first library of transforms; ValueError if not installed."""
        try:
            transforms_by(library)
        except ValueError as error:
            raise ValueError(
                f"{self.directory}: the run has used the Fourier transforms of {library}, and no "
                f"others give the same bits: {error}; or start the run again with --overwrite"
            ) from error
        return replace(self, run=replace(self.run, transforms=library))

    def resumed_march(self, saved: Checkpoint) -> March:
        """Return the march at a checkpoint; refuse one that does not fit with a ValueError."""
        try:
            return March(self.run, saved.march or None)
        except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
            path = self.directory / STATE_NAME
            raise ValueError(f"{path}: does not fit the run it says it is of; {REMEDY}") from error

    def resumed_writer(self, saved: Checkpoint) -> ResultWriter:
        """Return the writer of the result at a checkpoint.

        ValueError if the result is of another run, cannot be read, or has fewer rows.
        """
        path = self.result_path
        try:
            is_other = path.is_file() and stored_run(path).case != self.case
        except ValueError as error:
            raise ValueError(f"{error}; {REMEDY}") from error
        if is_other:
            raise ValueError(f"{path} belongs to another run than {STATE_NAME}; {REMEDY}")
        return ResultWriter.resume(path, self.contents, saved.result, self.check)

    def new_writer(self) -> ResultWriter:
        """Return the writer of a new result."""
        return ResultWriter(self.result_path, self.contents, self.check)

    def new_log(self) -> ProgressLog:
        """Return a new progress log; a link in its place is replaced, not written through."""
        path = self.directory / PROGRESS_NAME
        self.check()
        path.unlink(missing_ok=True)
        return ProgressLog(path, self.check)

    def resumed_log(self, saved: Checkpoint) -> ProgressLog:
        """Return the progress log with the lines of a checkpoint, or raise a ValueError."""
        path = self.directory / PROGRESS_NAME
        return ProgressLog.resume(path, saved.lines, saved.reached, self.check)


def plain_case(
    problem: Problem, grid: Grid | None, fields: str | Sequence[float], *, errors: bool
) -> dict[str, Any]:
    """Describe a run as plain data; without a grid, all but the grid."""
    described = {
        **describe_problem(problem, grid),
        "fields": describe(fields),
        "errors": errors,
    }
    plain: dict[str, Any] = json.loads(json.dumps(described))
    if grid is None:
        del plain["grid"]
    return plain


def remove_restart_files(directory: Path) -> None:
    """Remove the files of a run directory that a finished run does not need."""
    state = directory / STATE_NAME
    if is_checkpoint(state):
        state.unlink()
    fresh = (fresh_name(state), fresh_name(directory / PROGRESS_NAME))
    for file in (*fresh, *working_files(directory / RESULT_NAME)):
        file.unlink(missing_ok=True)


def _fits_single_precision(problem: Problem) -> bool:
    """True if pressures are far from the ends of single precision's range, 1e-38 to 3e38 Pa."""
    compliance, level = float(problem.compliance(problem.end)), problem.load.largest_level
    return 1e-20 <= compliance <= 1e10 and 1e-25 <= level <= 1e15
