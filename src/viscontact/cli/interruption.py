"""Ctrl-C once: finish the step. Twice: stop now."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

from viscontact.cli.messages import say


class Interruption:
    """Whether the user has asked to stop."""

    def __init__(self) -> None:
        self.requested = False

    def handle(self, number: int, frame: FrameType | None) -> None:
        """Note the first request; the second one ends the step as well."""
        if self.requested:
            raise KeyboardInterrupt
        self.requested = True
        say("stopping after this step; once more to stop now")


@contextmanager
def watched_interruption() -> Iterator[Interruption]:
    """Catch Ctrl-C and a polite request to end, for as long as the block runs.

    Yields
    ------
    Interruption
        Ask it after each step.
    """
    interruption = Interruption()
    before: dict[int, Any] = {}
    # Only the main thread may handle signals; elsewhere they stay as they are.
    with suppress(ValueError):
        for number in (signal.SIGINT, signal.SIGTERM):
            before[number] = signal.signal(number, interruption.handle)
    try:
        yield interruption
    finally:
        for caught, handler in before.items():
            signal.signal(caught, handler)
