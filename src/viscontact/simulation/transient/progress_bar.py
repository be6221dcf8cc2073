"""Bar of a run that is started from Python: `progress=True`."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

_Report = TypeVar("_Report", bound=Callable[..., object])

#: Shortest time between two lines [s], and number of characters of the bar.
_PAUSE, _WIDTH = 0.1, 20


class ProgressBar:
    """Bar on stderr, called with (any, done, total), for a `unit`; `then` follows the last."""

    # One line that is written over, so that terminals and notebooks show it alike.
    def __init__(self, unit: str, then: str = "") -> None:
        self._unit, self._then = unit, then
        self._started, self._said_at, self._length = clock.perf_counter(), -_PAUSE, 0

    def __call__(self, _: object, done: int, total: int) -> None:
        """Write the line again, at most ten times a second."""
        now = clock.perf_counter()
        if done < total and now - self._said_at < _PAUSE:
            return
        self._said_at, spent = now, now - self._started
        filled = round(_WIDTH * done / total) if total else _WIDTH
        left = f"about {_duration_text(spent / done * (total - done))} left"
        ending = f", then {self._then}" if self._then else ""
        rest = left if done < total else f"{_duration_text(spent)}{ending}"
        line = f"{self._unit} {done}/{total} [{'#' * filled:<{_WIDTH}}], {rest}"
        # Spaces over what the line before had more.
        text = f"\r{line:<{self._length}}" + ("" if done < total else "\n")
        self._length = len(line)
        with suppress(OSError):  # a closed terminal is not a reason for a run to fail
            print(text, end="", file=sys.stderr, flush=True)


def reported(progress: _Report | bool | None, bar: ProgressBar) -> _Report | ProgressBar | None:
    """Return what the progress of a run is given to: the function, the bar for True, or None."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return bar
    if not callable(progress):
        raise TypeError(f"progress: wanted True or a function, got {progress!r}")
    return progress


def _duration_text(seconds: float) -> str:
    """Return a duration, such as ``"12 s"`` or ``"3 min"``."""
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"
