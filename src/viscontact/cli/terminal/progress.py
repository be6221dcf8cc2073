"""Progress of one run: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from viscontact.cli.terminal.messages import say
from viscontact.mechanics.state import ContactState
from viscontact.units.formatting import format_quantity

if TYPE_CHECKING:
    from viscontact.simulation.transient.state_generator import Progress as Report

#: A plain line is printed after this part of the work, or after this time [s].
LINE_PART, _LINE_SECONDS = 0.1, 30.0


class Pace:
    """Intervals between plain lines of progress, from a part of the work on, and the time left."""

    def __init__(self, first: float = LINE_PART) -> None:
        self._started = self._line_at = clock.perf_counter()
        self._next = first

    def seconds_left(self, part: float) -> float | None:
        """Time left after a part of the work [s]; None if no line is due."""
        now = clock.perf_counter()
        is_due = part >= min(self._next - 1e-9, 1.0) or now - self._line_at >= _LINE_SECONDS
        if part <= 0 or not is_due:
            return None
        self._next, self._line_at = part + LINE_PART, now
        return (now - self._started) / part * (1 - part)


@contextmanager
def shown_progress(total: int | None, done: int = 0, *, quiet: bool) -> Iterator[Report]:
    """Display the progress of a run; `total` is None where the number of steps is estimated."""
    if quiet:
        yield lambda state, done, total: None
    elif sys.stderr.isatty():
        # Rich takes time to import, and plain lines do not need it.
        from viscontact.cli.terminal.bars import run_bar

        bar = run_bar()
        task = bar.add_task("", total=total, completed=done, row="", details="")
        bar.start()
        try:
            yield lambda state, done, total: bar.update(
                task, completed=done, total=total, row=_row(state), details=_details(state)
            )
        finally:
            # A closed terminal is not a reason for a run to fail.
            with suppress(OSError):
                bar.stop()
    else:
        yield _PlainLines(done, guessed=total is None)


@contextmanager
def counted(
    unit: str, *, quiet: bool = False, line: str = ""
) -> Iterator[Callable[[int, int], None]]:
    """Display how many units of some work are done; `line` is a template for plain lines."""
    if quiet or not sys.stderr.isatty():
        yield (lambda done, total: None) if quiet or not line else _lines(line)
        return
    from viscontact.cli.terminal.bars import counting_bar

    bar = counting_bar(unit)
    task = bar.add_task("", total=None)
    bar.start()
    try:
        yield lambda done, total: bar.update(task, completed=done, total=total)
    finally:
        with suppress(OSError):  # a closed terminal
            bar.stop()


def _lines(template: str) -> Callable[[int, int], None]:
    """Print lines at intervals."""
    pace = Pace()

    def show(done: int, total: int) -> None:
        if done < total and (left := pace.seconds_left(done / total)) is not None:
            say(template.format(done=done, total=total, left=left))

    return show


class _PlainLines:
    """Progress of a run as plain lines at intervals."""

    def __init__(self, before: int, *, guessed: bool) -> None:
        self._before = before
        self._of = " of about " if guessed else "/"
        self._pace = Pace(first=0.0)

    def __call__(self, state: ContactState, done: int, total: int) -> None:
        left = self._pace.seconds_left((done - self._before) / (total - self._before))
        if left is not None:
            of = self._of if done < total else "/"
            say(f"{_row(state)} {done}{of}{total}, about {left:.0f} s left, {_details(state)}")


def _details(state: ContactState) -> str:
    area, length = state.contact_area, state.grid.line_length
    extent = format_quantity(area / length, "m") if length else format_quantity(area, "m2")
    contact = f"contact {extent}{' wide' if length else ''}" if area else "no contact"
    place = (
        f"t = {format_quantity(state.time, 's')}"
        if state.speed is None
        else format_quantity(state.speed, "m/s")
    )
    return f"{place}, {state.iterations} iterations, {contact}"


def _row(state: ContactState) -> str:
    return "step" if state.speed is None else "speed"
