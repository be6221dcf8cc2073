"""Description of a recorded run, over time or speed, and its state at the last checkpoint."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Generic, Protocol, Self, TypeVar

from viscontact.accuracy.error_bars import ErrorBars
from viscontact.backend.arrays import Floats
from viscontact.problem.kept_fields import KeptFields
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
from viscontact.state import ContactState, Outcome
from viscontact.time_integration.restart_data import RestartData


class ChangedCaseError(ValueError):
    """A run that cannot be resumed, because its case has changed; `changes` are the differences."""

    def __init__(self, changes: Sequence[Difference]) -> None:
        super().__init__("; ".join(map(str, changes)))
        self.changes = tuple(changes)


class Marching(Protocol):
    """Loop over the states of a run, which can stop and continue after any of them."""

    done: int  # states so far
    outcome: Outcome  # of the last step

    @property
    def left(self) -> int:
        """States still to come; an estimate where the run chooses its steps."""

    def __iter__(self) -> Iterator[ContactState | None]:
        """Yield the remaining states, None for an inner step."""

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""


class Preparation(Protocol):
    """Checked and complete setup of a run."""

    @property
    def transforms(self) -> str:
        """Library of the Fourier transforms."""

    def with_transforms(self, library: str) -> Self:
        """Return the run with another library; ValueError if it is not installed."""


Run = TypeVar("Run", bound=Preparation)


@dataclass(frozen=True)
class Recorded(ABC, Generic[Run]):
    """A run, its directory, and the choice of the quantities that are recorded."""

    directory: Path
    run: Run
    title: str = ""  # of the result
    errors: bool = False  # True if errors of the scalars are estimated
    check: LockCheck = never_lost  # of the lock of the directory, before each write
    #: Attributes of the result that come from the case file.
    filed: Mapping[str, Any] = field(default_factory=dict)

    #: Name of a row of the result, for messages.
    row = "instant"

    @property
    @abstractmethod
    def case(self) -> dict[str, Any]:
        """Description of the run as plain data, which a run that is resumed must equal."""

    @property
    @abstractmethod
    def fields(self) -> KeptFields:
        """Choice of the fields that are kept."""

    @property
    @abstractmethod
    def contents(self) -> Contents:
        """Contents of the result."""

    @property
    @abstractmethod
    def total(self) -> int | None:
        """Number of rows; None where the run chooses its steps."""

    @property
    @abstractmethod
    def work(self) -> float:
        """Cells times rows, a relative measure of the computing time."""

    @property
    @abstractmethod
    def memory(self) -> float:
        """Memory of the run [bytes]."""

    @property
    @abstractmethod
    def seconds(self) -> float:
        """Predicted time of the run on this machine [s]."""

    @property
    @abstractmethod
    def extent(self) -> str:
        """How far the finished run goes, in words."""

    @abstractmethod
    def march(self, saved: RestartData | None = None) -> Marching:
        """Return the march from the beginning, or from the restart data of an earlier one."""

    @abstractmethod
    def recorded_state(self, state: ContactState) -> ContactState:
        """Return a state of the march as it is written to the result."""

    @abstractmethod
    def is_last(self, state: ContactState) -> bool:
        """True for the last state of the run."""

    @abstractmethod
    def part(self, march: Marching, state: ContactState) -> float:
        """Finished part of the march, after a state."""

    @abstractmethod
    def made(self, rows: int, reached: float | None) -> str:
        """Describe the progress of the run, up to the instant [s] or speed [m/s] reached."""

    @abstractmethod
    def continued(self, rows: int, reached: float | None) -> str:
        """Describe where a run is resumed, as `made`."""

    @abstractmethod
    def error_bars(
        self,
        march: Marching,
        history: Mapping[str, Floats],
        writer: ResultWriter,
        on_step: Callable[[], None] | None = None,
    ) -> ErrorBars:
        """Errors of the scalars after the last step; `on_step` is called in coarser runs."""

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

    def with_transforms(self, library: str) -> Self:
        """Return the run with its first library of transforms; ValueError if not installed."""
        try:
            return replace(self, run=self.run.with_transforms(library))
        except ValueError as error:
            raise ValueError(
                f"{self.directory}: the run has used the Fourier transforms of {library}, and no "
                f"others give the same bits: {error}; or start the run again with --overwrite"
            ) from error

    def resumed_march(self, saved: Checkpoint) -> Marching:
        """Return the march at a checkpoint; refuse one that does not fit with a ValueError."""
        try:
            return self.march(saved.march or None)
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


def remove_restart_files(directory: Path) -> None:
    """Remove the files of a run directory that a finished run does not need."""
    state = directory / STATE_NAME
    if is_checkpoint(state):
        state.unlink()
    fresh = (fresh_name(state), fresh_name(directory / PROGRESS_NAME))
    for file in (*fresh, *working_files(directory / RESULT_NAME)):
        file.unlink(missing_ok=True)
