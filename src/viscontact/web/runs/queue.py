"""Queue of runs: a limited number at the same time, coarse ones first."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from viscontact.runs.machine.cores import usable_cores
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.processes.child import RunProcess
from viscontact.web.runs.run import ManagedRun
from viscontact.web.runs.study import StudyRun
from viscontact.web.workspace.folder import Folder, RunEntry
from viscontact.web.workspace.problems import RequestError

#: Time at the beginning of a run, for which its user waits, without the start of a process for the
#: next one, which takes a second of a processor [s].
_UNDISTURBED = 5.0

#: Least number of runs at the same time, so that a coarse answer need not wait for a long run.
_LEAST_AT_ONCE = 2


#: Largest number of runs that wait.
MOST_WAITING = 50
#: Time until the next run may begin: if unknown, and at most [s].
_UNKNOWN_END, _LATEST_END = 10, 600


def usual_at_once() -> int:
    """Return the default number of runs at the same time."""
    return max(_LEAST_AT_ONCE, usable_cores() - 1)


class RunQueue:
    """All runs of a folder; with `keeps_spare`, a process waits for the next one."""

    def __init__(self, folder: Folder, at_once: int, *, keeps_spare: bool = False) -> None:
        self._folder, self.at_once, self.is_closing = folder, at_once, False
        self._keeps_spare, self._entering = keeps_spare, 0
        self._spare: RunProcess | None = None
        self._runs = {name: _managed(folder, name, entry) for name, entry in folder.runs()}
        for run in self._runs.values():
            run.restore_state()

    @property
    def is_at_work(self) -> bool:
        """True if a run is waiting or being computed."""
        return any(not run.is_over for run in self._runs.values())

    @property
    def runs(self) -> list[ManagedRun]:
        """All runs, the newest first, without those being deleted."""
        return [run for run in reversed(self._runs.values()) if not run.is_deleted]

    def run(self, name: str) -> ManagedRun:
        """Return a run by its name."""
        run = self._runs.get(name)
        if run is None or run.is_deleted:
            raise RequestError(404, f"there is no run {name[:40]!r}; it may have been removed")
        return run

    @contextmanager
    def place(self) -> Iterator[None]:
        """Keep a place for a run that is added within the block; RequestError if too many wait."""
        waiting = sum(run.entry.state == "waiting" for run in self._runs.values())
        if waiting + self._entering >= MOST_WAITING:
            raise RequestError(
                429,
                f"{MOST_WAITING} runs are waiting already; wait until one of them has begun, or "
                "cancel some",
                retry_after=self._next_end(),
            )
        self._entering += 1
        try:
            yield
        finally:
            self._entering -= 1

    def _next_end(self) -> int:
        """Predicted time until the next run may begin [s]."""
        left = (run.seconds_left for run in self._runs.values() if run.is_at_work)
        known = [seconds for seconds in left if seconds is not None]
        return min(max(math.ceil(min(known, default=_UNKNOWN_END)), 1), _LATEST_END)

    def add(self, name: str, entry: RunEntry) -> ManagedRun:
        """Add a run to the queue."""
        self._runs[name] = run = _managed(self._folder, name, entry)
        self.poll()
        return run

    def cancel(self, run: ManagedRun) -> None:
        """Stop a run after its current step; its results are kept."""
        if run.is_foreign:
            raise RequestError(
                409,
                "this run was started by an earlier server that was killed; it continues by itself "
                "until it is over",
            )
        run.stop("cancelled")

    def resume(self, run: ManagedRun) -> None:
        """Continue a run that stopped early."""
        if not run.is_resumable:
            raise RequestError(409, f"this run is {run.entry.state}; it cannot be continued")
        with self.place():
            run.set_state("waiting")
        self.poll()

    def delete(self, run: ManagedRun) -> None:
        """Remove a run and its files; an active one is cancelled first."""
        self.cancel(run)
        run.is_deleted = True
        self.poll()
        if not run.is_deleted:
            raise RequestError(507, f"the run cannot be removed from {run.directory.parent}")

    def poll(self) -> None:
        """Check all runs: note those that have ended, and start waiting ones."""
        for run in list(self._runs.values()):
            if run.is_at_work:
                run.poll()
            if run.is_deleted and run.is_over:
                self._remove(run)
        while not self.is_closing and (chosen := self._next_run()) is not None:
            spare, self._spare = self._spare, None
            chosen.start(spare)
        if self._keeps_spare and self._spare is None and self._has_room():
            with suppress(OSError):  # no process can be started; the next run reports it
                self._spare = RunProcess()

    def _has_room(self) -> bool:
        """True if a further run could begin, and none is held up by the start of a process."""
        active = [run for run in self._runs.values() if run.is_at_work]
        is_held_up = any(run.is_starting or run.seconds_at_work < _UNDISTURBED for run in active)
        at_work = sum(run.workers for run in active)
        return not self.is_closing and at_work < self.at_once and not is_held_up

    def _remove(self, run: ManagedRun) -> None:
        """Remove a run, unless its files cannot be removed."""
        try:
            self._folder.remove_run(run.name)
        except OSError:
            run.is_deleted = False
        else:
            del self._runs[run.name]

    def end(self) -> None:
        """Start no further runs, and let the active ones finish their steps and save."""
        self.is_closing = True
        if self._spare is not None:
            self._spare.close()
            self._spare = None
        for run in self._runs.values():
            if not run.is_over:
                run.stop("interrupted")

    @property
    def has_processes(self) -> bool:
        """True if a process of this server computes a run."""
        return any(run.has_process for run in self._runs.values())

    def close(self) -> None:
        """End the processes of runs that have not yet ended; these continue from what is saved."""
        self.end()
        for run in self._runs.values():
            run.kill()
        for run in list(self._runs.values()):
            run.wait()
        self.poll()

    def _next_run(self) -> ManagedRun | None:
        """Run to start next: coarse ones first, as they are short."""
        active = sum(run.workers for run in self._runs.values() if run.is_at_work)
        waiting = [run for run in self._runs.values() if run.entry.state == "waiting"]
        if not waiting or active >= self.at_once:
            return None
        chosen = min(waiting, key=lambda run: run.entry.quality != "coarse")
        # Each run fits into the memory alone; this was checked.
        if not active:
            return chosen
        # Runs with completed steps have allocated their memory already.
        beginning = [run for run in self._runs.values() if run.is_starting]
        promised = sum(run.entry.memory for run in beginning)
        return chosen if chosen.entry.memory + promised <= available_memory() else None


def _managed(folder: Folder, name: str, entry: RunEntry) -> ManagedRun:
    """Run or study of an entry."""
    kind = ManagedRun if entry.study is None else StudyRun
    return kind(folder, name, entry)
