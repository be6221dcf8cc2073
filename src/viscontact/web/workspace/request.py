"""What was asked for of a run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Asked:
    """What was asked for, and how it stands; kept beside the run.

    Attributes
    ----------
    title : str
        What the case is called.
    quality : str
        ``"full"`` or ``"coarse"``.
    created : str
        When it was asked for, in UTC.
    settings : tuple of str
        What differs from the case as it was given, as ``--set`` takes it.
    instants : int or None
        How many the run will have; None where it chooses its steps.
    end : float
        Its last instant [s].
    work : float
        Cells times steps.
    memory : float
        What it will hold [bytes].
    errors : bool
        Whether the errors of its scalars are estimated in the end.
    state : str
        waiting, running, done, cancelled, interrupted or failed.
    said : tuple of str
        What it had to say for itself when it ended.
    label : str
        What the run is called, where others have the same title.
    """

    title: str
    quality: str
    created: str
    settings: tuple[str, ...]
    instants: int | None
    end: float
    work: float
    memory: float
    errors: bool
    state: str = "waiting"
    said: tuple[str, ...] = ()
    label: str = ""
