"""Run that is to be computed by a process of its own."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from viscontact.runs.processes.request import RunRequest


class Standing(Enum):
    """State of a run in its directory."""

    NEW = "new"
    STOPPED = "stopped"
    FINISHED = "finished"


@dataclass(frozen=True)
class Job:
    """One of several runs, checked.

    Attributes
    ----------
    request : RunRequest
        Arguments of the run, with its directory.
    directory : Path
        That directory.
    name : str
        Name among the other runs.
    standing : Standing
        Whether the run begins, is resumed, or is finished already.
    instants : int or None
        Number of instants; None where the run chooses its steps.
    end : float
        Last instant [s].
    work : float
        Cells times steps, a relative measure of the computing time.
    memory : float
        Memory of the run [bytes].
    """

    request: RunRequest
    directory: Path
    name: str
    standing: Standing
    instants: int | None
    end: float
    work: float
    memory: float
