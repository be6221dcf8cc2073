"""Runs that wait, are at work, and are over; so many at once, and in which order."""

from __future__ import annotations

from os import cpu_count

from viscontact.runs.free_memory import available_memory
from viscontact.web.runs.run import Work
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.problems import RequestError
from viscontact.web.workspace.request import Asked

#: A coarse answer is not to wait until a long run is over, even on a single core.
_LEAST_AT_ONCE = 2


def usual_at_once() -> int:
    """Return how many runs are computed at once if nobody says."""
    return max(_LEAST_AT_ONCE, (cpu_count() or 1) - 1)


class Workshop:
    """All runs of a folder."""

    def __init__(self, folder: Folder, at_once: int) -> None:
        self._folder, self.at_once, self.is_closing = folder, at_once, False
        self._works = {name: Work(folder, name, asked) for name, asked in folder.runs()}
        for work in self._works.values():
            work.take_up()

    @property
    def works(self) -> list[Work]:
        """All runs, the newest first; those that are to be forgotten are left out."""
        return [work for work in reversed(self._works.values()) if not work.is_unwanted]

    def work(self, name: str) -> Work:
        """Return a run."""
        work = self._works.get(name)
        if work is None or work.is_unwanted:
            raise RequestError(404, f"there is no run {name[:40]!r}; it may have been removed")
        return work

    def ask(self, name: str, asked: Asked) -> Work:
        """Let a run wait for its turn."""
        self._works[name] = work = Work(self._folder, name, asked)
        self.look()
        return work

    def cancel(self, work: Work) -> None:
        """Stop a run as Ctrl-C does: its step is finished, and what it has done is kept."""
        if work.is_foreign:
            raise RequestError(
                409,
                "this run was begun by an earlier server that was killed, and goes on by itself "
                "until it is over",
            )
        work.stop("cancelled")

    def resume(self, work: Work) -> None:
        """Go on with a run that stopped early."""
        if not work.can_go_on:
            raise RequestError(
                409, f"this run is {work.asked.state}; there is nothing to go on with"
            )
        work.stand("waiting")
        self.look()

    def forget(self, work: Work) -> None:
        """Remove a run and all that is kept of it; one at work is cancelled first."""
        self.cancel(work)
        work.is_unwanted = True
        self.look()
        if not work.is_unwanted:
            raise RequestError(507, f"the run cannot be removed from {work.directory.parent}")

    def look(self) -> None:
        """Look after all runs: see who has ended, and begin what can be begun."""
        for work in list(self._works.values()):
            if work.is_at_work:
                work.look()
            if work.is_unwanted and work.is_over:
                self._remove(work)
        while not self.is_closing and (chosen := self._next()) is not None:
            chosen.start()

    def _remove(self, work: Work) -> None:
        """Remove a run, which is still there where its files cannot be removed."""
        try:
            self._folder.remove_run(work.name)
        except OSError:
            work.is_unwanted = False
        else:
            del self._works[work.name]

    def end(self) -> None:
        """Begin no more, and ask the runs at work to finish their steps and save."""
        self.is_closing = True
        for work in self._works.values():
            if not work.is_over:
                work.stop("interrupted")

    def close(self) -> None:
        """Wait until the runs at work have ended."""
        self.end()
        for work in list(self._works.values()):
            work.wait()
        self.look()

    def _next(self) -> Work | None:
        """The run that is begun next: coarse ones first, as they are soon over."""
        active = sum(work.is_at_work for work in self._works.values())
        waiting = [work for work in self._works.values() if work.asked.state == "waiting"]
        if not waiting or active >= self.at_once:
            return None
        chosen = min(waiting, key=lambda work: work.asked.quality != "coarse")
        # None has been admitted that does not fit alone.
        if not active:
            return chosen
        # What those hold that have taken steps is not free any more.
        beginning = [work for work in self._works.values() if work.is_beginning]
        promised = sum(work.asked.memory for work in beginning)
        return chosen if chosen.asked.memory + promised <= available_memory() else None
