"""Status of a sweep as lines, printed once or renewed until all runs have ended."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Iterator
from pathlib import Path
from textwrap import shorten

from viscontact.cli.terminal.messages import STOPPED, put, refuse, stop
from viscontact.studies.sweep.states import State
from viscontact.studies.sweep.status import LISTED, ListedRun, SweepStatus, sweep_status
from viscontact.units.formatting import format_quantity

#: Time between two looks [s], and as a multiple of the time that a look takes.
_PAUSE, _SHARE = 2.0, 10.0
#: Largest part that is printed before all runs have ended.
_NEARLY = 0.99
#: Longest message in the list of runs [characters].
_MESSAGE = 200


def print_status(directory: Path, *, watch: bool) -> None:
    """Print the status of a sweep; exit code 1 if a run has failed."""
    status = _watch_status(directory) if watch else _look(directory)
    if not watch:
        put("\n".join(status_lines(directory, status)))
    if status.counts[State.FAILED]:
        stop(code=STOPPED)


def status_lines(directory: Path, status: SweepStatus) -> Iterator[str]:
    """Yield the number of runs in each state, the progress, and the runs that need attention."""
    counts = [f"{count} {state.value}" for state, count in status.counts.items() if count]
    runs = "1 run" if status.total == 1 else f"{status.total} runs"
    yield f"{directory}: {runs}: {', '.join(reversed(counts))}"
    if not status.has_ended:
        # A run whose errors are estimated is not done yet.
        yield f"{min(status.part, _NEARLY):.0%} done{_time_left(status)}"
    for state, listed in status.listed.items():
        for each in listed:
            message = shorten(each.state.message, _MESSAGE, placeholder=" ...")
            yield "  ".join(filter(None, (f"  {state.value:8}{each.name}", _part(each), message)))
        if (more := status.counts[state] - LISTED) > 0:
            yield f"  {state.value:8}... and {more} more"
    if status.changes:
        runs = "1 run has" if status.changes == 1 else f"{status.changes} runs have"
        yield f"{runs} settings of {'its' if status.changes == 1 else 'their'} own:"
        for name, settings in status.changed:
            yield f"  {name}  {shorten(settings, _MESSAGE, placeholder=' ...')}"
        if (more := status.changes - LISTED) > 0:
            yield f"  ... and {more} more"


def _time_left(status: SweepStatus) -> str:
    left = status.left or 0.0
    return f", about {format_quantity(left, 's', 2)} left" if left >= 1.0 else ""


def _part(run: ListedRun) -> str:
    """Finished part of a run that has not ended."""
    if run.state.state is State.FAILED:
        return ""
    estimating = run.state.state is State.RUNNING and run.part == 1
    return "estimating errors" if estimating else f"{run.part:.0%}"


def _look(directory: Path) -> SweepStatus:
    try:
        return sweep_status(directory)
    except (OSError, ValueError) as error:
        refuse(str(error))


def _watch_status(directory: Path) -> SweepStatus:
    """Renew the lines on a terminal until all runs have ended; elsewhere, print each change."""
    from rich.live import Live

    from viscontact.cli.terminal.console import TextConsole, styled

    is_terminal = sys.stdout.isatty()
    printed = ""
    with Live(console=TextConsole(), auto_refresh=False, transient=False) as live:
        while True:
            began = clock.monotonic()
            status = _look(directory)
            text = "\n".join(status_lines(directory, status))
            if is_terminal:
                live.update(styled(text), refresh=True)
            elif text != printed:
                put(text, flush=True)
            printed = text
            if status.has_ended:
                return status
            clock.sleep(max(_PAUSE, _SHARE * (clock.monotonic() - began)))
