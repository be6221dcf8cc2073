"""A run and its directory: marched, recorded, and gone on with after whatever stopped it."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext, suppress
from typing import Self

from viscontact.accuracy.error_bars import ErrorBars, error_bars
from viscontact.runs.directory.checkpoint import Checkpoint
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.recorded_run import (
    Recorded,
    check_lines,
    new_lines,
    new_state,
    new_writer,
    remove_traces,
    restored_march,
    same_lines,
    same_writer,
    saved_state,
)
from viscontact.runs.directory.restart_files import RestartFiles
from viscontact.simulation.march import CompletedStep, March
from viscontact.simulation.state_generator import Progress
from viscontact.state import ContactState, Outcome

#: Between two checkpoints lie at least this time [s] and this many times what one takes.
PAUSE, SHARE = 1.0, 20.0

#: How a step's writing is kept together, should the caller be able to disturb it.
Undisturbed = Callable[[], AbstractContextManager[object]]


class RunRecord:
    """A run on its way into its directory.

    After each step the directory holds all that it takes to go on from there: what the run
    restart_data
    at the last checkpoint, and the steps solved since. A checkpoint puts the result in its place
    too. It comes after the first step, and then once a second or less often, so that checkpoints
    take a twentieth of the time at most.

    Parameters
    ----------
    recorded : Recorded
        What is recorded.
    on_begin : callable, optional
        Called once, when the directory is the run's: to write what else belongs there.
    undisturbed : callable, optional
        Makes a context within which nothing interrupts, for what has to be written together.

    Attributes
    ----------
    kept : int
        How many instants are recorded, as `resume` would find them.
    published : int
        How many the result shows; a last one that has failed among them.
    reached : float or None
        The last one that is kept [s].
    resumed : int
        How many there were when the run was taken up; 0 for a new one.
    """

    def __init__(
        self,
        recorded: Recorded,
        on_begin: Callable[[], None] | None = None,
        undisturbed: Undisturbed = nullcontext,
    ) -> None:
        self._set_up(recorded, new_state(recorded), March(recorded.run), on_begin, undisturbed)
        self._writer = new_writer(recorded)

    @classmethod
    def resume(
        cls,
        recorded: Recorded,
        on_begin: Callable[[], None] | None = None,
        undisturbed: Undisturbed = nullcontext,
    ) -> Self:
        """Take up a run where it was stopped.

        Parameters
        ----------
        recorded : Recorded
            What is recorded, as before.
        on_begin, undisturbed : callable, optional
            As for a new run.

        Raises
        ------
        FileNotFoundError
            If nothing is saved.
        ChangedCaseError
            If what is saved is of another case.
        ValueError
            If a file that is needed is damaged or somebody else's; nothing has been changed then.
        OSError
            If something cannot be written; what was saved is still there.
        """
        saved = saved_state(recorded)
        recorded = recorded.by(saved.transforms)
        march = restored_march(recorded, saved)
        record = cls.__new__(cls)
        record._set_up(recorded, saved, march, on_begin, undisturbed)
        # Before the first checkpoint the directory may still hold what an earlier run has left.
        is_new = saved.steps == 0
        if not is_new:
            check_lines(recorded, saved)
        record._writer = new_writer(recorded) if is_new else same_writer(recorded, saved.result)
        try:
            record._lines = new_lines(recorded) if is_new else same_lines(recorded, saved)
            record._take_up()
        except BaseException:
            record.close()
            raise
        return record

    def _set_up(
        self,
        recorded: Recorded,
        saved: Checkpoint,
        march: March,
        on_begin: Callable[[], None] | None,
        undisturbed: Undisturbed,
    ) -> None:
        self._recorded, self._march = recorded, march
        self._on_begin, self._undisturbed = on_begin, undisturbed
        self._restart = RestartFiles(recorded.directory, saved)
        self._lines: ProgressLog | None = None
        self._due = 0.0
        self._instants = self.kept = self.published = self.resumed = int(saved.result["rows"])
        self.reached = saved.reached

    def _take_up(self) -> None:
        """Take the steps again that had been solved since the checkpoint."""
        if self._on_begin is not None:
            self._on_begin()
        for solved in self._restart.solved():
            self._write(taken := self._march.repeat(solved))
            self.reached = self.reached if taken.state is None else taken.state.time
        self.kept = self.resumed = self._instants
        if self._restart.steps:
            self.checkpoint()
        else:
            self._restart.start_log()

    def steps(self, progress: Progress | None = None) -> Iterator[ContactState | None]:
        """March on, and record each step before it is shown.

        Parameters
        ----------
        progress : callable, optional
            Called with (state, done, total) after each instant.

        Yields
        ------
        ContactState or None
            One for each of the run's steps that are left, but none for a step that has failed;
            None for an inner one that nobody asked for.

        Raises
        ------
        ConvergenceError, DomainError
            As in `march`; what has been recorded stays.
        OSError
            If something cannot be written; likewise.
        """
        for taken in self._march:
            with self._undisturbed():
                self._record(taken)
            if taken.state is not None and progress is not None:
                progress(taken.state, taken.done, taken.done + taken.left)
            # Nobody is to save, and go on from, what is no equilibrium: the march is about to stop.
            if taken.solved.outcome is not Outcome.NOT_CONVERGED:
                yield taken.state

    def checkpoint(self) -> None:
        """Put the result in its place, and save what it takes to go on.

        Raises
        ------
        OSError
            If something cannot be written; what was saved last is still there.
        """
        if self._lines is None:
            return
        began = clock.monotonic()
        with self._undisturbed():
            if self._publish():
                # The log must not be behind the state, not even after a power cut.
                self._lines.flush_to_disk()
                self._restart.save(
                    self._march.restart_data(),
                    self.reached,
                    self._lines.count,
                    self._writer.position,
                )
                self.kept = self._instants
        now = clock.monotonic()
        self._due = now + max(PAUSE, SHARE * (now - began))

    def publish(self) -> None:
        """Put the result in its place, where the march may be within a step.

        Raises
        ------
        OSError
            If that fails; what was published last is still there.
        """
        if self._lines is not None:
            with self._undisturbed():
                self._publish()

    def estimate_errors(self, on_step: Callable[[], None] | None = None) -> ErrorBars | None:
        """Estimate the errors of the scalars, once all steps are taken; save these before.

        Parameters
        ----------
        on_step : callable, optional
            Called after each step of a companion; what it raises ends the estimate, which is made
            anew then when the run is taken up.

        Returns
        -------
        ErrorBars or None
            None where none are wanted.

        Raises
        ------
        OSError
            If something cannot be written; what has been recorded stays.
        """
        if not self._recorded.errors:
            return None
        self.checkpoint()
        with self._undisturbed():
            history = self._writer.history()
        return error_bars(self._recorded.run.on(self._writer.grid), history, on_step)

    def finish(self, bars: ErrorBars | None = None) -> None:
        """Put the result in its place, complete; nothing is needed any more to go on.

        Parameters
        ----------
        bars : ErrorBars, optional
            From `estimate_errors`.

        Raises
        ------
        OSError
            If that fails; the run can be resumed.
        """
        with self._undisturbed():
            if self._lines is not None:
                # Once the state is gone nothing could bring back a line that the power took.
                self._lines.flush_to_disk()
            self._writer.finish(bars)
            self.published = self._instants
            self.close()
            remove_traces(self._recorded.directory)

    def close(self) -> None:
        """Close all files; never fails, and further calls do nothing."""
        self._writer.close()
        self._restart.close()
        if self._lines is not None:
            with suppress(OSError):
                self._lines.close()

    def _record(self, taken: CompletedStep) -> None:
        """Log the step before anything else, so that it is never solved again."""
        failed = taken.solved.outcome is Outcome.NOT_CONVERGED
        if failed and not self._restart.steps:
            return  # there is nothing to keep, and what was there stays
        if self._lines is None:
            self._begin()
        if not failed:
            self._restart.append(taken.solved)
            if taken.state is not None:
                self.kept, self.reached = self.kept + 1, taken.state.time
        self._write(taken)
        # Nobody wants to go on after a step that has failed.
        if not failed and clock.monotonic() >= self._due:
            self.checkpoint()

    def _write(self, taken: CompletedStep) -> None:
        self._restart.steps += 1
        if taken.state is None:
            return
        assert self._lines is not None  # begun
        self._writer.append(taken.state)
        self._lines.append(taken.state)
        self._instants += 1

    def _begin(self) -> None:
        """Make the directory this run's, as late as possible: what was there stays until then."""
        # From here on this run can be resumed, and no other: a log left over is another run's.
        self._restart.save({}, self.reached, 0, self._writer.position)
        if self._on_begin is not None:
            self._on_begin()
        self._lines = new_lines(self._recorded)

    def _publish(self) -> bool:
        done = self._writer.publish()
        if done:
            self.published = self._instants
        return done
