"""What is said on stderr, and the exit codes."""

from __future__ import annotations

import sys
from typing import NoReturn

import typer

DONE, STOPPED, REFUSED, INTERRUPTED = 0, 1, 2, 130


def say(line: str) -> None:
    """Print a line on stderr, where messages do not mix with results."""
    print(line, file=sys.stderr, flush=True)


def refuse(*lines: str) -> NoReturn:
    """Say why nothing was done, and end with exit code 2."""
    for line in lines:
        say(line)
    raise typer.Exit(REFUSED)


def stop(*lines: str, code: int = STOPPED) -> NoReturn:
    """Say why the work ended early, and end with exit code 1 or another one."""
    for line in lines:
        say(line)
    raise typer.Exit(code)
