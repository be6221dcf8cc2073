"""Requests to stop by Ctrl-C, SIGTERM, SIGHUP and Ctrl-Break."""

from __future__ import annotations

import math
import os
import signal
import sys
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

from viscontact.cli.terminal.messages import say
from viscontact.cli.terminal.streams import discard
from viscontact.runs.execution.stop_requests import StopRequests

#: Ctrl-C, SIGTERM of batch systems, a closed terminal and Ctrl-Break, where they exist.
_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")

#: A batch system signals every process of a job, and a parent may pass the signal on: signals
#: within this time [s] count as one request, except Ctrl-C, which is pressed deliberately.
_ONE_REQUEST = 2.0


class Interruption(StopRequests):
    """Requests to stop by signals; `seen`: a signal has arrived."""

    def __init__(self) -> None:
        super().__init__()
        self.seen = False
        self._requested_at = -math.inf
        # A stream that is not a terminal, such as a log file, stays open when the terminal closes.
        self._on_terminal = [name for name in ("stdout", "stderr") if getattr(sys, name).isatty()]

    def handle(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal: note the first request, and raise KeyboardInterrupt on the second."""
        self.seen = True
        if number == getattr(signal, "SIGHUP", None):
            self._leave_terminal()
        if self.over:
            return
        again = clock.monotonic() - self._requested_at < _ONE_REQUEST
        if again and number != signal.SIGINT:
            return
        self._requested_at = clock.monotonic()
        if self.request():
            _notice("stopping after this step; once more to stop now")

    def _leave_terminal(self) -> None:
        """Discard further output to a terminal that has been closed."""
        for name in self._on_terminal:
            discard(name)


@contextmanager
def watched_interruption(*, until_exit: bool = False) -> Iterator[Interruption]:
    """Handle requests to stop within the block; with `until_exit`, ignore later ones."""
    current = getattr(signal.getsignal(signal.SIGINT), "__self__", None)
    if isinstance(current, Interruption):
        yield current  # nested blocks share it
        return
    interruption = Interruption()
    before: dict[int, Any] = {}
    # Only the main thread may handle signals; in other threads they are left unchanged.
    with suppress(ValueError):
        for number in filter(None, (getattr(signal, name, None) for name in _SIGNALS)):
            if not _is_ignored(number):
                before[number] = signal.signal(number, interruption.handle)
    try:
        yield interruption
    finally:
        for caught, handler in before.items():
            # None: the handler was not set from Python.
            after = signal.SIG_DFL if handler is None else handler
            signal.signal(caught, signal.SIG_IGN if until_exit else after)


def _is_ignored(number: int) -> bool:
    # Under nohup the run continues when its terminal closes.
    return number == getattr(signal, "SIGHUP", None) and signal.getsignal(number) == signal.SIG_IGN


def _notice(line: str) -> None:
    try:
        say(line)
    except RuntimeError:  # the signal arrived within another write to stderr
        with suppress(OSError):
            os.write(2, f"{line}\n".encode())
