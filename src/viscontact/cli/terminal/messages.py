"""Messages on stderr, results on stdout, and the end of a command with an exit code."""

from __future__ import annotations

import sys
from contextlib import suppress

from viscontact.runs.command_error import CommandError, refuse, stop
from viscontact.runs.processes.request import DONE, INTERRUPTED, REFUSED, STOPPED
from viscontact.units.visible import visible

__all__ = ["DONE", "INTERRUPTED", "REFUSED", "STOPPED", "CommandError", "refuse", "stop"]


def say(line: str) -> None:
    """Print a line on stderr, where messages do not mix with results."""
    # A closed stream or terminal is not a reason for a run to fail.
    with suppress(OSError):
        print(visible(line), file=sys.stderr, flush=True)


def put(found: object, *, end: str = "\n", flush: bool = False) -> None:
    """Print on stdout, with control characters as escapes."""
    print(visible(str(found)), end=end, flush=flush)
