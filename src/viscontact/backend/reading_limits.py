"""Limits of memory and time for reading a file, and how a reading ends that exceeds them."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

#: Environment variable that raises the limit of memory [MB].
VARIABLE = "VISCONTACT_READING_MB"
#: Least limit of memory [bytes], limit per byte of the file, and time per least limit [s].
_LEAST, _PER_BYTE, _SECONDS = 500_000_000, 20, 20.0


class End(Enum):
    """End of the process of a reading that gives no answer; the value is for a message."""

    MEMORY = "needs more than {memory} of memory to read, the limit for {size}"
    TIME = "takes more than {seconds} to read, the limit for {size}"
    CRASH = "ends the process that reads it ({how}); the file is damaged"


@dataclass(frozen=True)
class ReadingLimits:
    """Memory [bytes], beside that of the libraries, and time [s] for a file of some size [bytes].

    >>> ReadingLimits(size=1000, memory=500_000_000).seconds
    20.0
    """

    size: int
    memory: int

    @property
    def seconds(self) -> float:
        """Time, in proportion to the memory [s]."""
        return _SECONDS * self.memory / _LEAST

    @property
    def is_least(self) -> bool:
        """True for the limits of a small file."""
        return self.memory <= _LEAST

    def message(self, name: str, end: End, remedy: str, how: str = "") -> str:
        """Refusal of the file `name`, with what to do."""
        memory = f"{self.memory / 1e6:.0f} MB"
        size = f"a file of {max(self.size / 1e6, 1e-3):.3g} MB"
        words = end.value.format(memory=memory, size=size, seconds=f"{self.seconds:.0f} s", how=how)
        raised = f"; the environment variable {VARIABLE} raises the limit"
        return f"{name}: {words}; {remedy}{'' if end is End.CRASH else raised}"


def reading_limits(file: Path) -> ReadingLimits:
    """Limits for a file: 500 MB or 20 times its size, whichever is more, and 20 s per 500 MB."""
    size = file.stat().st_size
    return ReadingLimits(size, max(_LEAST, _PER_BYTE * size, _given_memory()))


def _given_memory() -> int:
    """Memory that the environment variable allows [bytes]; 0 without it."""
    text = os.environ.get(VARIABLE, "0")
    try:
        given = float(text)
    except ValueError:
        given = math.nan
    if not 0 <= given < math.inf:
        raise ValueError(f"{VARIABLE}: must be a number of megabytes, as 4000, got {text!r}")
    return int(1e6 * given)
