"""Ctrl-C once: finish the step. Twice: stop now. A polite request to end counts as Ctrl-C."""

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
from viscontact.cli.terminal.streams import lead_nowhere

#: Where they exist: Ctrl-C, what batch systems send, a terminal that closes, Ctrl-Break.
_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")

#: A batch system sends its signal to every process of a job, and a process that passes it on sends
#: it again: within this time [s] that is one request. Ctrl-C is pressed by somebody who means it.
_ONE_REQUEST = 2.0


class Interruption:
    """Whether somebody has asked to stop."""

    def __init__(self) -> None:
        self.requested = False
        self.seen = False
        self.over = False
        self._marching = False
        self._postponed = 0
        self._pending = False
        self._requested_at = -math.inf
        # A stream that has no terminal, such as a log, outlives the terminal.
        self._on_terminal = [name for name in ("stdout", "stderr") if getattr(sys, name).isatty()]

    @contextmanager
    def marching(self) -> Iterator[None]:
        """Within it, the first request lets the step be finished; else each one stops at once."""
        self._marching = True
        try:
            yield
        finally:
            self._marching = False

    @contextmanager
    def postponed(self) -> Iterator[None]:
        """Within it, nothing is stopped: a request to stop now waits until its end."""
        self._postponed += 1
        try:
            yield
        except BaseException:
            self._pending = False  # it ends here anyway, and says why
            raise
        finally:
            self._postponed -= 1
        if self._pending and not self._postponed:
            self._pending = False
            raise KeyboardInterrupt

    def handle(self, number: int, frame: FrameType | None) -> None:
        """Note the first request; the second one ends the step as well."""
        self.seen = True
        if number == getattr(signal, "SIGHUP", None):
            self._leave_terminal()
        if self.over:
            return
        again = clock.monotonic() - self._requested_at < _ONE_REQUEST
        if again and number != signal.SIGINT:
            return
        self._requested_at = clock.monotonic()
        if self._marching and not self.requested:
            self.requested = True
            _notice("stopping after this step; once more to stop now")
        elif self._postponed:
            self._pending = True
        else:
            raise KeyboardInterrupt

    def _leave_terminal(self) -> None:
        """Write to nowhere instead of to a terminal that is gone, which would be an error."""
        for name in self._on_terminal:
            lead_nowhere(name)


@contextmanager
def watched_interruption(*, until_exit: bool = False) -> Iterator[Interruption]:
    """Catch Ctrl-C and polite requests to end, for as long as the block runs."""
    standing = getattr(signal.getsignal(signal.SIGINT), "__self__", None)
    if isinstance(standing, Interruption):
        yield standing  # one for all who ask
        return
    interruption = Interruption()
    before: dict[int, Any] = {}
    # Only the main thread may handle signals; elsewhere they stay as they are.
    with suppress(ValueError):
        for number in filter(None, (getattr(signal, name, None) for name in _SIGNALS)):
            if not _is_to_be_ignored(number):
                before[number] = signal.signal(number, interruption.handle)
    try:
        yield interruption
    finally:
        for caught, handler in before.items():
            # None: whoever set it did not do so from Python.
            after = signal.SIG_DFL if handler is None else handler
            signal.signal(caught, signal.SIG_IGN if until_exit else after)


def _is_to_be_ignored(number: int) -> bool:
    # nohup: the run is to outlive its terminal
    return number == getattr(signal, "SIGHUP", None) and signal.getsignal(number) == signal.SIG_IGN


def _notice(line: str) -> None:
    try:
        say(line)
    except RuntimeError:  # it came while a line was being written, which must not be begun again
        with suppress(OSError):
            os.write(2, f"{line}\n".encode())
