"""Messages on stderr, and the end of a command with an exit code."""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import NoReturn

from viscontact.runs.processes.request import DONE, INTERRUPTED, REFUSED, STOPPED

__all__ = ["DONE", "INTERRUPTED", "REFUSED", "STOPPED", "CommandError", "refuse", "say", "stop"]


class CommandError(Exception):
    """End of a command with an exit code, and the lines that `main` prints on stderr."""

    def __init__(self, code: int, lines: tuple[str, ...]) -> None:
        super().__init__("; ".join(lines))
        self.code, self.lines = code, lines


def say(line: str) -> None:
    """Print a line on stderr, where messages do not mix with results."""
    # A closed stream or terminal is not a reason for a run to fail.
    with suppress(OSError):
        print(line, file=sys.stderr, flush=True)


def refuse(*lines: str) -> NoReturn:
    """End the command before anything was created, with exit code 2 and the reasons."""
    raise CommandError(REFUSED, lines)


def stop(*lines: str, code: int = STOPPED) -> NoReturn:
    """End the command during its work, with exit code 1 or another one and the reasons."""
    raise CommandError(code, lines)
