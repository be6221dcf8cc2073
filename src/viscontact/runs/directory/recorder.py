"""A run and its directory: marched, recorded, and resumed after an interruption."""

from __future__ import annotations

import logging
import time as clock
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, nullcontext, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple, Self

from viscontact.mechanics.state import ContactState, Outcome
from viscontact.results.run_files import STATE_NAME
from viscontact.results.variables import ALLOWABLE, error_name, with_errors_per_length
from viscontact.runs.analysis import States
from viscontact.runs.directory.checkpoint import Checkpoint, save_checkpoint
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.recorded import Recorded, remove_restart_files
from viscontact.runs.directory.result_writer import ResultWriter
from viscontact.simulation.accuracy.error_bars import ErrorBars

if TYPE_CHECKING:
    from viscontact.simulation.transient.state_generator import Progress

_LOG = logging.getLogger("viscontact")

#: Least time between two checkpoints: in seconds, and as a multiple of what the last one took.
PAUSE, SHARE = 1.0, 20.0
#: Time from the start of a run of a batch to its first checkpoint: until then it is repeated, not
#: resumed [s].
BATCH_PAUSE = 1.0

#: Context within which no signal interrupts what has to be written together.
Undisturbed = Callable[[], AbstractContextManager[object]]


class Reached(NamedTuple):
    """Number of finished rows, and the instant [s] or the speed [m/s] of the last of them."""

    rows: int
    place: float | None


class Recorder:
    """A run under way, recorded in its directory.

    An OSError of any method leaves the previous checkpoint and result, from which the run can be
    resumed. The LockLost of the lock's check ends the run without a write.
    """

    # A checkpoint publishes the result and saves the restart state of the march. It comes after the
    # first step, or in a batch, whose runs are short, after the first one that ends a pause or more
    # after the start; then once a second or less often, so that checkpoints take at most a
    # twentieth of the time. The march is deterministic: a resumed run computes the same bits again.

    saved: Reached  # at the last checkpoint, from which `resume` continues
    shown: Reached  # in the published result
    resumed: Reached  # when the run was resumed
    _writer: ResultWriter

    def __init__(
        self,
        recorded: Recorded,
        on_begin: Callable[[], None] | None = None,
        undisturbed: Undisturbed = nullcontext,
        pause: float = 0.0,
    ) -> None:
        self._set_up(recorded, recorded.run.states(), on_begin, undisturbed)
        self._pause = pause  # from the start to the first checkpoint, 0 once there is one [s]
        self._writer = recorded.new_writer()

    @classmethod
    def resume(
        cls,
        recorded: Recorded,
        on_begin: Callable[[], None] | None = None,
        undisturbed: Undisturbed = nullcontext,
    ) -> Self:
        """Continue from the last checkpoint; errors as of `load_checkpoint` before any change."""
        saved = recorded.load_checkpoint()
        recorded = recorded.with_libraries(saved.transforms, saved.inner_loops)
        record = cls.__new__(cls)
        record._set_up(recorded, recorded.resumed_march(saved), on_begin, undisturbed)
        if not saved.march:
            # Before the first step the directory may still hold the files of an earlier run.
            record._writer = recorded.new_writer()
            return record
        with ExitStack() as opened:
            record._lines = opened.enter_context(recorded.resumed_log(saved))
            record._writer = opened.enter_context(recorded.resumed_writer(saved))
            if on_begin is not None:
                recorded.check()
                on_begin()
            opened.pop_all()
        record._rows, record._place = int(saved.result["rows"]), saved.reached
        _LOG.info("%s: resumed after %d states", recorded.directory, record._rows)
        record.saved = record.shown = record.resumed = record._reached_place
        return record

    def _set_up(
        self,
        recorded: Recorded,
        march: States,
        on_begin: Callable[[], None] | None,
        undisturbed: Undisturbed,
    ) -> None:
        self._recorded, self._march = recorded, march
        self._on_begin, self._undisturbed = on_begin, undisturbed
        self._lines: ProgressLog | None = None
        self._due = self._pause = 0.0
        self._rows = 0
        self._place: float | None = None
        self.saved = self.shown = self.resumed = Reached(0, None)

    @property
    def _reached_place(self) -> Reached:
        return Reached(self._rows, self._place)

    def steps(self, progress: Progress | None = None) -> Iterator[ContactState | None]:
        """March, and yield each converged step once recorded, None for an inner one; as `march`."""
        march = self._march
        if self._pause:
            self._due = clock.monotonic() + self._pause
        for state in march:
            with self._undisturbed():
                self._record(state)
            if state is not None and progress is not None:
                progress(state, march.done, march.done + march.left)
            # A failed step is no equilibrium to continue from: the march is about to raise.
            if march.outcome is not Outcome.NOT_CONVERGED:
                yield state

    def checkpoint(self) -> None:
        """Publish the result and save the restart state; call it between two steps only."""
        if self._lines is None:
            return
        began = clock.monotonic()
        with self._undisturbed():
            if self._publish():
                # The log must not be behind the state, not even after a power cut.
                self._lines.flush_to_disk()
                self._save()
                self._writer.reopen()
        now = clock.monotonic()
        self._due, self._pause = now + max(PAUSE, SHARE * (now - began)), 0.0

    def publish(self) -> None:
        """Publish the result, also where the march has been stopped within a step."""
        if self._lines is not None:
            with self._undisturbed():
                self._publish()

    def estimate_errors(self, on_step: Callable[[], None] | None = None) -> ErrorBars | None:
        """Estimate the errors of the scalars after the last step; None where none are requested."""
        if not self._recorded.run.errors:
            return None
        # A run whose first one is not due yet takes less time to repeat than to save.
        if not self._pause or clock.monotonic() >= self._due:
            self.checkpoint()
        with self._undisturbed():
            history = self._writer.history()
        writer, march = self._writer, self._march
        run, issued = self._recorded.run, writer.warnings
        bars = run.error_bars(march, history, writer.grid, issued, on_step)
        return replace(bars, values=with_errors_per_length(bars.values, writer.grid))

    def finish(self, bars: ErrorBars | None = None) -> None:
        """Publish the complete result, with errors and verdicts, and remove the restart state."""
        attributes, judged = self._verdicts(bars)
        with self._undisturbed():
            if self._lines is not None:
                # Before the state is removed: a line lost in a power cut could not be repeated.
                errors = None if bars is None else bars.values
                warned = [*self._writer.warnings, *(() if bars is None else bars.warnings)]
                ended = {"all_warnings": warned, **judged}
                self._lines.finish(errors, self._writer.described_fields(), ended)
            self._writer.finish(bars, attributes)
            self.shown = self._reached_place
            self.close()
            self._recorded.check()
            remove_restart_files(self._recorded.directory)

    def _verdicts(self, bars: ErrorBars | None) -> tuple[dict[str, str], dict[str, str]]:
        """Attribute of the result with its verdicts, and the worst one; empty without limits."""
        if ALLOWABLE not in self._recorded.filed or self._lines is None:
            return {}, {}
        # xarray and pandas take a third of the start of a run: imported after it, where needed.
        from viscontact.results.netcdf import open_results
        from viscontact.results.verdicts import (
            deciding,
            final_verdicts,
            overall,
            verdict_attribute,
        )

        self.publish()
        over = self._recorded.run.axis.name
        errors = {} if bars is None else bars.values
        with open_results(self._recorded.result_path) as ds:
            stated = {error_name(name): (over, values) for name, values in errors.items()}
            found = final_verdicts(ds.assign(stated))
        judged = {"verdict": overall(found) or "", "decided_by": deciding(found)}
        return {ALLOWABLE: verdict_attribute(found)}, judged

    def close(self) -> None:
        """Close all files; never fails, and further calls do nothing."""
        self._writer.close()
        if self._lines is not None:
            with suppress(OSError):
                self._lines.close()

    def _record(self, state: ContactState | None) -> None:
        failed = self._march.outcome is Outcome.NOT_CONVERGED
        if self._lines is None:
            if failed:
                return  # nothing to keep, and an earlier result stays
            self._begin()
        if state is not None:
            self._write(state, failed)
        if not failed and clock.monotonic() >= self._due:
            self.checkpoint()

    def _write(self, state: ContactState, failed: bool) -> None:
        assert self._lines is not None  # begun
        state = self._recorded.run.leaking(state)
        part = self._recorded.run.part(self._march, state)
        is_last = part >= 1 and not failed
        if not is_last:
            self._lines.append(state, part)
        self._writer.append(self._recorded.run.recorded_state(state))
        if not failed:
            self._rows, self._place = self._rows + 1, float(getattr(state, state.over))
        if is_last:
            self._publish()  # a reader of the last line finds all rows in the result
            self._lines.append(state, part)

    def _begin(self) -> None:
        """Take the directory over for this run, as late as possible: an earlier result stays."""
        # From here on this run can be resumed, and no earlier one.
        self._save(begun=False)
        if self._on_begin is not None:
            self._recorded.check()
            self._on_begin()
        self._lines = self._recorded.new_log()

    def _save(self, *, begun: bool = True) -> None:
        recorded = self._recorded
        lines = 0 if self._lines is None else self._lines.count
        march = self._march.restart_data() if begun else {}
        setup = recorded.run.setup
        state = lines, self._place, self._writer.position, march
        libraries = setup.transforms, setup.inner_loops
        checkpoint = Checkpoint(recorded.run.case, *state, *libraries)
        save_checkpoint(recorded.directory / STATE_NAME, checkpoint, recorded.check)
        self.saved = self._reached_place

    def _publish(self) -> bool:
        done = self._writer.publish()
        if done:
            self.shown = self._reached_place
        return done
