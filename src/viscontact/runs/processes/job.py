"""A run that is to be computed by a process of its own."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from viscontact.runs.processes.request import RunRequest


class Standing(Enum):
    """How a run stands to its directory."""

    NEW = "begins"
    STOPPED = "goes on"
    FINISHED = "is over"


@dataclass(frozen=True)
class Job:
    """One of several runs, checked.

    Attributes
    ----------
    request : RunRequest
        What is asked for, its directory included.
    directory : Path
        That directory.
    name : str
        What it is called among the others.
    standing : Standing
        Whether it begins, goes on, or is over already.
    instants : int or None
        How many it will have; None where it chooses its steps.
    end : float
        Its last instant [s].
    work : float
        Cells times steps: how much there is to do, compared with the others.
    memory : float
        What it will hold [bytes].
    """

    request: RunRequest
    directory: Path
    name: str
    standing: Standing
    instants: int | None
    end: float
    work: float
    memory: float
