"""Progress of one run: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from viscontact.cli.terminal.messages import say
from viscontact.simulation.state_generator import Progress as Report
from viscontact.state import ContactState
from viscontact.units.formatting import format_quantity

#: A plain line is printed after this part of the run, or after this time [s].
_LINE_PART, _LINE_SECONDS = 0.1, 30.0


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
def counted(unit: str, *, quiet: bool = False) -> Iterator[Callable[[int, int], None]]:
    """Display on a terminal how many frames, runs or other units of some work are done."""
    if quiet or not sys.stderr.isatty():
        yield lambda done, total: None
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


class _PlainLines:
    """Progress as plain lines at intervals."""

    def __init__(self, before: int, *, guessed: bool) -> None:
        self._before = before
        self._of = " of about " if guessed else "/"
        self._started = self._said_at = clock.perf_counter()
        self._next = before + 1

    def __call__(self, state: ContactState, done: int, total: int) -> None:
        now = clock.perf_counter()
        if done < self._next and done < total and now - self._said_at < _LINE_SECONDS:
            return
        self._next, self._said_at = done + max(1, round(total * _LINE_PART)), now
        left = (now - self._started) / (done - self._before) * (total - done)
        of = self._of if done < total else "/"
        say(f"{_row(state)} {done}{of}{total}, about {left:.0f} s left, {_details(state)}")


def _details(state: ContactState) -> str:
    area = state.contact_area
    contact = f"contact {format_quantity(area, 'm2')}" if area else "no contact"
    place = (
        f"t = {format_quantity(state.time, 's')}"
        if state.speed is None
        else format_quantity(state.speed, "m/s")
    )
    return f"{place}, {state.iterations} iterations, {contact}"


def _row(state: ContactState) -> str:
    return "step" if state.speed is None else "speed"
