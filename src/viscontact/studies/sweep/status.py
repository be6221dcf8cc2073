"""Status of a sweep: number of runs in each state, finished part and time left."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import field
from pathlib import Path
from statistics import median

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_files import (
    CASE_NAME,
    MANIFEST_NAME,
    PROGRESS_NAME,
    RESULT_NAME,
    STATE_NAME,
)
from viscontact.studies.sweep.manifest import SweepRun, read_manifest
from viscontact.studies.sweep.states import RunState, State, finished_part, run_state

#: Most runs that are listed in each state.
LISTED = 10
#: States whose runs are listed, with those that need attention last.
_LISTED_STATES = (State.RUNNING, State.STOPPED, State.FAILED)


@dataclass(frozen=True)
class ListedRun:
    """Name, state and finished part of a run."""

    name: str
    state: RunState
    part: float  # 0 to 1


@dataclass
class SweepStatus:
    """States of the runs of a sweep at some instant."""

    counts: dict[State, int] = field(default_factory=lambda: dict.fromkeys(State, 0))
    #: The first runs of a state that needs attention.
    listed: dict[State, list[ListedRun]] = field(
        default_factory=lambda: {state: [] for state in _LISTED_STATES}
    )
    #: Names and settings of the first runs that have settings of their own, and their number.
    changed: list[tuple[str, str]] = field(default_factory=list)
    changes: int = 0
    #: Sum of the finished parts of all runs; a failed run counts as ended.
    parts: float = 0.0
    #: Sum of the parts that are to be computed by waiting and running runs.
    remaining: float = 0.0
    #: Wall times of finished runs, and expected ones of running runs [s].
    durations: list[float] = field(default_factory=list)

    @property
    def total(self) -> int:
        """Number of all runs."""
        return sum(self.counts.values())

    @property
    def part(self) -> float:
        """Finished part of all the work, 0 to 1, if all runs are equally long."""
        return self.parts / self.total

    @property
    def left(self) -> float | None:
        """Time until the running and waiting runs have ended [s]; None if it is not known."""
        running = self.counts[State.RUNNING]
        if not (running and self.durations):
            return None
        return self.remaining * median(self.durations) / running

    @property
    def has_ended(self) -> bool:
        """True if no run is running or waiting."""
        return not (self.counts[State.RUNNING] or self.counts[State.WAITING])

    def add(self, run: SweepRun, directory: Path) -> None:
        """Take a run into account."""
        found = run_state(directory)
        if run.changed:
            self.changes += 1
            if len(self.changed) < LISTED:
                self.changed.append((run.name, run.own_settings))
        state = found.state
        ended = state in (State.DONE, State.FAILED)
        part = 1.0 if ended else 0.0 if state is State.WAITING else finished_part(directory)
        self.counts[state] += 1
        self.parts += part
        if state in (State.WAITING, State.RUNNING):
            self.remaining += 1.0 - part
        if state in (State.DONE, State.RUNNING):
            self.durations.extend(_durations(directory, state, part))
        if state in self.listed and len(self.listed[state]) < LISTED:
            self.listed[state].append(ListedRun(run.name, found, part))


def sweep_status(place: Path) -> SweepStatus:
    """Read the status of a sweep or of a single run; FileNotFoundError, ValueError if damaged."""
    manifest = place if place.name == MANIFEST_NAME else place / MANIFEST_NAME
    status = SweepStatus()
    for run in _runs(manifest):
        status.add(run, manifest.parent / run.directory)
    return status


def _runs(manifest: Path) -> Iterator[SweepRun]:
    if manifest.is_file():
        yield from read_manifest(manifest)
        return
    directory = manifest.parent
    names = (CASE_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME)
    if not any((directory / name).is_file() for name in names):
        raise FileNotFoundError(f"{directory}: neither a sweep ({MANIFEST_NAME}) nor a run there")
    yield SweepRun(0, directory.resolve().name, ".", {}, (), "", "cases")


def _durations(directory: Path, state: State, part: float) -> Iterator[float]:
    """Wall time of a run [s], expected from its finished part while it is running."""
    with suppress(OSError):
        began = (directory / CASE_NAME).stat().st_mtime
        if state is State.DONE:
            yield max((directory / RESULT_NAME).stat().st_mtime - began, 0.0)
        elif part > 0:
            yield max(clock.time() - began, 0.0) / part
