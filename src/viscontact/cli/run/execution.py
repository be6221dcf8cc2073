"""Execution of a run at the command line: its messages, its progress and its summary."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.cli.terminal.messages import say, stop
from viscontact.cli.terminal.progress import shown_progress
from viscontact.cli.terminal.streams import printing, unwritten
from viscontact.runs.execution.execution import Monitor, execute_run
from viscontact.runs.processes.request import RunRequest


def execute(request: RunRequest) -> Path:
    """Run a case, write its result, and print a summary; return the run directory."""
    quiet = request.quiet
    with watched_interruption() as interruption:
        progress = partial(shown_progress, quiet=quiet)
        monitor = Monitor(interruption, _ignore if quiet else say, progress)
        directory, is_computed = execute_run(request, monitor)
        if is_computed and not quiet:
            _print_summary(directory)
    return directory


def _ignore(line: str) -> None:
    """Print nothing."""


def _print_summary(directory: Path) -> None:
    """Print the summary of a finished run; an output that cannot be written is no failure."""
    # Its dataset takes half a second to import, here after the run instead of before it.
    from viscontact.cli.run.summary import print_summary

    try:
        with printing():
            print_summary(directory)
    except OSError as error:
        if unwritten("stdout") is None and not isinstance(error, BrokenPipeError):
            stop(f"{directory}: the run is finished, but its result cannot be read: {error}")
        why = error.strerror or str(error)
        say(f"{directory}: the run is finished; its table cannot be printed: {why}")
