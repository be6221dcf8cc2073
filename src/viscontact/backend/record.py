"""Content of a file as its reader returns it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray


@dataclass(frozen=True)
class Record:
    """Values as JSON has them, and arrays of numbers by name: what a process hands to another."""

    values: Any = None
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)
