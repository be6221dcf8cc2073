"""What is recorded of a run, and what takes it up again from what is saved."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

from viscontact.fourier import transforms_by
from viscontact.results.provenance import describe
from viscontact.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.checkpoint import Checkpoint, is_checkpoint, load_checkpoint
from viscontact.runs.directory.differences import Difference, differences
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.result_validation import REMEDY
from viscontact.runs.directory.result_writer import ResultWriter, working_files
from viscontact.runs.directory.stored_result import stored_run
from viscontact.simulation.march import March
from viscontact.simulation.provenance import describe_problem, run_attributes
from viscontact.simulation.setup import RunSetup
from viscontact.time_integration.restart_data import RestartData


class ChangedCaseError(ValueError):
    """A run that cannot be gone on with, because it is another one now.

    Attributes
    ----------
    changes : tuple of Difference
        What differs.
    """

    def __init__(self, changes: Sequence[Difference]) -> None:
        super().__init__("; ".join(map(str, changes)))
        self.changes = tuple(changes)


@dataclass(frozen=True)
class Recorded:
    """What is recorded of which run.

    Attributes
    ----------
    directory : Path
        Where.
    run : RunSetup
        The run.
    fields : "all", "none" or sequence of float
        Instants [s] whose fields are kept.
    title : str
        The result's title.
    errors : bool
        Whether the errors of the scalars are estimated once the march is over.
    """

    directory: Path
    run: RunSetup
    fields: str | Sequence[float]
    title: str = ""
    errors: bool = False

    @property
    def case(self) -> dict[str, Any]:
        """The run in plain words: what must be the same to go on with it."""
        described = {
            **describe_problem(self.run.problem, self.run.grid),
            "fields": describe(self.fields),
            "errors": self.errors,
        }
        plain: dict[str, Any] = json.loads(json.dumps(described))
        return plain

    @property
    def contents(self) -> Contents:
        """What the result is to hold."""
        about = {name: json.dumps(self.case[name]) for name in ("fields", "errors")}
        attributes = {"title": self.title, **run_attributes(self.run), **about}
        grid, problem = self.run.grid, self.run.problem
        return Contents(
            grid, problem.instants, self.fields, attributes, self.errors, problem.tolerance
        )

    def by(self, transforms: str) -> Recorded:
        """The same by the Fourier transforms that it was begun with.

        Parameters
        ----------
        transforms : str
            Their library.

        Raises
        ------
        ValueError
            If they are not installed.
        """
        try:
            transforms_by(transforms)
        except ValueError as error:
            raise ValueError(
                f"{self.directory}: the run was begun with the Fourier transforms of {transforms}, "
                f"and to the last bit no others do: {error}; or start the run anew with --overwrite"
            ) from error
        return replace(self, run=replace(self.run, transforms=transforms))


def saved_state(recorded: Recorded) -> Checkpoint:
    """Load what is saved of a run.

    Parameters
    ----------
    recorded : Recorded
        The run.

    Raises
    ------
    FileNotFoundError
        If nothing is saved.
    ChangedCaseError
        If what is saved is of another case.
    ValueError
        If it cannot be read.
    """
    saved = load_checkpoint(recorded.directory / STATE_NAME)
    if changes := differences(saved.case, recorded.case):
        raise ChangedCaseError(changes)
    return saved


def restored_march(recorded: Recorded, saved: Checkpoint) -> March:
    """Return the march as it was when its state was saved.

    Parameters
    ----------
    recorded : Recorded
        The run.
    saved : Checkpoint
        Its state.

    Raises
    ------
    ValueError
        If the two do not fit together.
    """
    try:
        return March(recorded.run, saved.march or None)
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        path = recorded.directory / STATE_NAME
        raise ValueError(f"{path}: does not fit the run it says it is of; {REMEDY}") from error


def new_writer(recorded: Recorded) -> ResultWriter:
    """Return the writer of a new result.

    Parameters
    ----------
    recorded : Recorded
        The run.
    """
    return ResultWriter(recorded.directory / RESULT_NAME, recorded.contents)


def same_writer(recorded: Recorded, position: RestartData) -> ResultWriter:
    """Return the writer of a result that is there, at a position of its.

    Parameters
    ----------
    recorded : Recorded
        The run.
    position : dict
        From `ResultWriter.position`.

    Raises
    ------
    ValueError
        If the result is another run's, cannot be read, or has not come that far.
    """
    path = recorded.directory / RESULT_NAME
    try:
        is_other = path.is_file() and stored_run(path).case != recorded.case
    except ValueError as error:
        raise ValueError(f"{error}; {REMEDY}") from error
    if is_other:
        raise ValueError(f"{path} is of another run than {STATE_NAME} beside it; {REMEDY}")
    return ResultWriter.resume(path, recorded.contents, position)


def new_lines(recorded: Recorded) -> ProgressLog:
    """Return a new progress log; a link in its place is replaced, not written through.

    Parameters
    ----------
    recorded : Recorded
        The run.
    """
    path = recorded.directory / PROGRESS_NAME
    path.unlink(missing_ok=True)
    return ProgressLog(path)


def check_lines(recorded: Recorded, saved: Checkpoint) -> None:
    """Make certain that the progress log has the lines that a state knows of; change nothing.

    Parameters
    ----------
    recorded : Recorded
        The run.
    saved : Checkpoint
        Its state.

    Raises
    ------
    ValueError
        If those lines are not all there, or are something else's.
    """
    path = recorded.directory / PROGRESS_NAME
    try:
        with path.open(encoding="utf-8") as file:
            lines = [json.loads(line) for line in islice(file, saved.lines)]
            reached = float(lines[-1]["time"]) if lines else None
    except OSError as error:
        raise ValueError(f"{path} cannot be read ({error.strerror}); {REMEDY}") from error
    except (ValueError, LookupError, TypeError, OverflowError, RecursionError) as error:
        raise ValueError(
            f"{path} is damaged, or was written by something else; {REMEDY}"
        ) from error
    if len(lines) < saved.lines or reached != saved.reached:
        raise ValueError(f"{path} is not the course of this run so far; {REMEDY}")


def same_lines(recorded: Recorded, saved: Checkpoint) -> ProgressLog:
    """Return the progress log that is there, cut to the lines that a state knows of.

    Parameters
    ----------
    recorded : Recorded
        The run.
    saved : Checkpoint
        Its state.

    Raises
    ------
    ValueError
        If those lines are not all there; nothing has been changed then.
    """
    return ProgressLog.resume(recorded.directory / PROGRESS_NAME, saved.lines)


def remove_traces(directory: Path) -> None:
    """Remove what nobody needs once a run is over, and nothing that is somebody else's.

    Parameters
    ----------
    directory : Path
        The run's.
    """
    if is_checkpoint(directory / STATE_NAME):
        (directory / STATE_NAME).unlink()
    (directory / f".{STATE_NAME}.new").unlink(missing_ok=True)
    for file in working_files(directory / RESULT_NAME):
        file.unlink(missing_ok=True)
