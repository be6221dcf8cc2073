"""What is said on stderr, and the exit codes."""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import NoReturn

from viscontact.runs.processes.exit_codes import DONE, INTERRUPTED, REFUSED, STOPPED

__all__ = ["DONE", "INTERRUPTED", "REFUSED", "STOPPED", "refuse", "say", "stop"]


def say(line: str) -> None:
    """Print a line on stderr, where messages do not mix with results."""
    # Whoever closed it, or the terminal, does not want to know; a run goes on.
    with suppress(OSError):
        print(line, file=sys.stderr, flush=True)


def refuse(*lines: str) -> NoReturn:
    """Say why nothing was done, and end with exit code 2."""
    for line in lines:
        say(line)
    _leave(REFUSED)


def stop(*lines: str, code: int = STOPPED) -> NoReturn:
    """Say why the work ended early, and end with exit code 1 or another one."""
    for line in lines:
        say(line)
    _leave(code)


def _leave(code: int) -> NoReturn:
    import typer  # late: nothing heavy before signals are met

    raise typer.Exit(code)
