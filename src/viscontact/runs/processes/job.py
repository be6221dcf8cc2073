"""Run that is to be computed by a process of its own."""

from __future__ import annotations

from enum import Enum
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.processes.request import RunRequest


class RunStage(Enum):
    """State of a run in its directory."""

    NEW = "new"
    STOPPED = "stopped"
    FINISHED = "finished"


@dataclass(frozen=True)
class Job:
    """One of several runs, checked."""

    request: RunRequest
    directory: Path
    name: str  # among the other runs
    standing: RunStage
    instants: int | None  # their number; None where the run chooses its steps
    end: float  # last instant [s]
    work: float  # cells times steps, a relative measure of the computing time
    memory: float  # [bytes]
