"""Description of a recorded run, over time or speed, and its state at the last checkpoint."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import Any, Self

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.analysis import Analysis, States, fits_single_precision
from viscontact.runs.directory.atomic_files import fresh_name
from viscontact.runs.directory.checkpoint import (
    REMEDY,
    Checkpoint,
    is_checkpoint,
    load_checkpoint,
)
from viscontact.runs.directory.differences import Difference, differences
from viscontact.runs.directory.earlier_result import stored_run
from viscontact.runs.directory.lock_check import LockCheck, never_lost
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.result_writer import ResultWriter, working_files


class ChangedCaseError(ValueError):
    """A run that cannot be resumed, because its case has changed; `changes` are the differences."""

    def __init__(self, changes: Sequence[Difference]) -> None:
        super().__init__("; ".join(map(str, changes)))
        self.changes = tuple(changes)


@dataclass(frozen=True)
class Recorded:
    """A run, its directory, and what its result is to say of it."""

    directory: Path
    run: Analysis[Any, Any]
    title: str = ""  # of the result
    check: LockCheck = never_lost  # of the lock of the directory, before each write
    #: Attributes of the result that come from the case file.
    filed: Mapping[str, Any] = field(default_factory=dict)

    @property
    def contents(self) -> Contents:
        """Contents of the result."""
        run, case = self.run, self.run.case
        about = {name: json.dumps(case[name]) for name in ("fields", "errors")}
        fits_single = fits_single_precision(run.contact, run.longest_creep)
        return Contents(
            run.grid,
            run.places,
            run.fields,
            {"title": self.title, **self.filed, **run.attributes, **about, **run.fluid_attributes},
            run.errors,
            run.contact.tolerance if fits_single else 0.0,
            parts=run.parts,
            over=run.axis.name,
            creepages=run.creepages,
        )

    @property
    def result_path(self) -> Path:
        """Path of the result."""
        return self.directory / RESULT_NAME

    def load_checkpoint(self) -> Checkpoint:
        """Load the last checkpoint; FileNotFoundError, ChangedCaseError, ValueError."""
        saved = load_checkpoint(self.directory / STATE_NAME)
        if changes := differences(saved.case, self.run.case):
            raise ChangedCaseError(changes)
        return saved

    def with_libraries(self, transforms: str, inner_loops: str) -> Self:
        """Return the run with its first transforms and inner loops; ValueError if not installed."""
        try:
            return replace(self, run=self.run.with_libraries(transforms, inner_loops))
        except ValueError as error:
            raise ValueError(
                f"{self.directory}: the run has used the Fourier transforms of {transforms} and "
                f"{inner_loops} inner loops, and no others give the same bits: {error}; or "
                "start the run again with --overwrite"
            ) from error

    def resumed_march(self, saved: Checkpoint) -> States:
        """Return the march at a checkpoint; refuse one that does not fit with a ValueError."""
        try:
            march: States = self.run.states(saved.march or None)
            return march
        except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
            path = self.directory / STATE_NAME
            raise ValueError(f"{path}: does not fit the run it says it is of; {REMEDY}") from error

    def resumed_writer(self, saved: Checkpoint) -> ResultWriter:
        """Return the writer at a checkpoint; ValueError if the result does not belong to it."""
        path = self.result_path
        try:
            is_other = path.is_file() and stored_run(path).case != self.run.case
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


def remove_restart_files(directory: Path) -> None:
    """Remove the files of a run directory that a finished run does not need."""
    state = directory / STATE_NAME
    if is_checkpoint(state):
        state.unlink()
    fresh = (fresh_name(state), fresh_name(directory / PROGRESS_NAME))
    for file in (*fresh, *working_files(directory / RESULT_NAME)):
        file.unlink(missing_ok=True)
