"""What was asked for of a run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Asked:
    """What was asked for, and how it stands; kept beside the run."""

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
