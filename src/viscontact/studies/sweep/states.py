"""States of runs, read from the names of the files in their directories."""

from __future__ import annotations

import json
import os
from contextlib import suppress
from enum import Enum
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.line_digests import read_entries
from viscontact.results.run_files import FAILURE_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import is_locked
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.request import DONE, INTERRUPTED

#: Part of a progress log that holds its last line [bytes].
_LAST_LINE = 2**16


class State(Enum):
    """State of a run in its directory."""

    WAITING = "waiting"
    RUNNING = "running"
    STOPPED = "stopped"
    FAILED = "failed"
    DONE = "done"


@dataclass(frozen=True)
class RunState:
    """State of a run, and why it has failed or stopped; empty where that is not recorded."""

    state: State
    message: str = ""
    verdict: str = ""  # the worst on the allowable values; empty without any
    decided_by: str = ""  # quantities with that verdict; empty if all have passed
    warnings: tuple[str, ...] = ()  # of a finished run


def run_state(directory: Path) -> RunState:
    """Read the state of a run from its directory, which may be missing."""
    # A run with a result but without restart data is done. A failure is that of the last attempt;
    # it is stopped, not failed, if it was interrupted on request.
    try:
        names = {each.name for each in os.scandir(directory)}
    except OSError:
        return RunState(State.WAITING)
    if RESULT_NAME in names and not names & {STATE_NAME, FAILURE_NAME}:
        return RunState(State.DONE)
    if is_locked(directory):
        return RunState(State.RUNNING)
    if FAILURE_NAME in names:
        return _failure(directory / FAILURE_NAME)
    return RunState(State.STOPPED if STATE_NAME in names else State.WAITING)


def state_at_end(ended: Ended) -> State:
    """State of a run of a command that has ended; the directory tells where the run has not."""
    if ended.code == DONE:
        return State.DONE
    if ended.code == INTERRUPTED or ended.outcome in ("lost", "not begun"):
        return run_state(ended.job.directory).state
    return State.FAILED


def _failure(path: Path) -> RunState:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        given = found["message"]
        message = given if isinstance(given, str) else "; ".join(map(str, given))
        stopped = found.get("code") == INTERRUPTED
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return RunState(State.FAILED, f"{path} cannot be read")
    return RunState(State.STOPPED if stopped else State.FAILED, " ".join(message.split()))


def last_line(directory: Path) -> dict[str, Any]:
    """Return the last complete line of the progress log of a run; empty without one."""
    with suppress(OSError, ValueError, RecursionError):
        with (directory / PROGRESS_NAME).open("rb") as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - _LAST_LINE))
            lines = file.read().rpartition(b"\n")[0]
        return read_entries(lines.rpartition(b"\n")[2])
    return {}


def finished_part(directory: Path) -> float:
    """Return the finished part of the march of a run, 0 to 1."""
    part = last_line(directory).get("part")
    return min(max(float(part), 0.0), 1.0) if isinstance(part, int | float) else 0.0
