"""What lies in a run's directory to go on from: a checkpoint, and the steps solved since."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from viscontact.runs.directory.checkpoint import STATE_NAME, Checkpoint, save_checkpoint
from viscontact.runs.directory.step_log import LOG_NAME, StepLog, logged_steps
from viscontact.simulation.solved_step import StepRecord
from viscontact.time_integration.restart_data import RestartData


class RestartFiles:
    """The last checkpoint of a run and the log behind it.

    Parameters
    ----------
    directory : Path
        The run's directory.
    last : Checkpoint
        The one to begin with; the start of a new run, of which nothing is on disk yet.

    Attributes
    ----------
    steps : int
        How many steps the run has taken; counted by who takes them.
    """

    def __init__(self, directory: Path, last: Checkpoint) -> None:
        self.steps = last.steps
        self._state, self._path = directory / STATE_NAME, directory / LOG_NAME
        self._case, self._token, self._transforms = last.case, last.token, last.transforms
        self._log: StepLog | None = None

    def solved(self) -> Iterator[StepRecord]:
        """Return the steps that had been solved since the checkpoint."""
        return logged_steps(self._path, self._token, self.steps)

    def start_log(self) -> None:
        """Begin the log of the steps from here on."""
        if self._log is not None:
            self._log.close()
        self._log = StepLog(self._path, self._token, self.steps)

    def append(self, solved: StepRecord) -> None:
        """Add a step to the log, which has been started."""
        assert self._log is not None
        self._log.append(solved)

    def save(
        self, march: RestartData, reached: float | None, lines: int, result: Mapping[str, Any]
    ) -> None:
        """Save a checkpoint, and begin a new log behind it.

        Parameters
        ----------
        march : dict
            What the march has `restart_data`; empty before the first step.
        reached : float or None
            The last instant that is kept [s].
        lines : int
            Lines of the progress log.
        result : mapping
            Where the result's writer stands.

        Raises
        ------
        OSError
            If it cannot be written; what was saved last is still there.
        """
        saved = (self._case, self._token, self.steps, lines, reached, dict(result), march)
        save_checkpoint(self._state, Checkpoint(*saved, self._transforms))
        self.start_log()

    def close(self) -> None:
        """Close the log; never fails, and further calls do nothing."""
        if self._log is not None:
            with suppress(OSError):
                self._log.close()
