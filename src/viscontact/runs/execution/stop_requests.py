"""Requests to stop: the first lets the current step be finished, the second stops at once."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

#: Time between two looks at a file that requests to stop [s].
_PAUSE = 0.5


class StopRequests:
    """State of the requests to stop; none has an effect once the work is `over`."""

    # Any process that sees the disk can request a stop by making the file.

    def __init__(self, file: Path | None = None) -> None:
        self.over = False
        self.file, self._looked_at = file, -_PAUSE
        self._requested = False
        self._marching = False
        self._postponed = 0
        self._pending = False

    @property
    def requested(self) -> bool:
        """True after a request to stop after the current step; the file is seen at intervals."""
        now = clock.monotonic()
        if self.file is not None and not self._requested and now - self._looked_at >= _PAUSE:
            self._looked_at = now
            self._requested = self.file.exists()
        return self._requested

    @contextmanager
    def marching(self) -> Iterator[None]:
        """Within the block, the first request lets the step be finished."""
        self._marching = True
        try:
            yield
        finally:
            self._marching = False

    @contextmanager
    def postponed(self) -> Iterator[None]:
        """Within the block, a request to stop at once waits until its end."""
        self._postponed += 1
        try:
            yield
        except BaseException:
            self._pending = False  # the error ends the work in any case
            raise
        finally:
            self._postponed -= 1
        if self._pending and not self._postponed:
            self._pending = False
            raise KeyboardInterrupt

    def request(self) -> bool:
        """Note a request; True if the step may be finished, KeyboardInterrupt for the second."""
        if self._marching and not self._requested:
            self._requested = True
            return True
        if not self._postponed:
            raise KeyboardInterrupt
        self._pending = True
        return False
