"""Process of one run, for its parent: `python -m viscontact.cli.child_run`.

It imports what a run needs, then waits for the arguments of one on its standard input: a line of
JSON, such as `["run", "case.yaml"]`. The parent holds the other end. When it closes it, or ends for
any reason, the current step is finished and saved, and the run ends; without a run, the process
does.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
from contextlib import suppress
from importlib import import_module
from typing import NoReturn

from viscontact.cli.entry import has_memory, limit_libraries, main
from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.cli.terminal.messages import INTERRUPTED, STOPPED, CommandError
from viscontact.runs.processes.request import RESUMABLE

#: Packages of which a run loads what its case needs.
_OF_ANY_CASE = (
    *("bodies.indenters", "bodies.laws", "bodies.loads"),
    *("mechanics.halfspace", "mechanics.problem", "mechanics.time_integration"),
    *("simulation.accuracy", "simulation.meshing", "simulation.transient"),
)


def run_of_parent() -> int:
    """Wait for the arguments of a run, compute it, and return its exit code."""
    with watched_interruption(until_exit=True) as interruption:
        try:
            with interruption.postponed():
                _import_run()
            words = _read_arguments()
        except KeyboardInterrupt:
            return INTERRUPTED
        if not words:  # the parent needs no run any more
            return INTERRUPTED
        threading.Thread(target=_stop_at_end_of_input, daemon=True).start()
        sys.argv[1:] = words
        return main(code_of=_code_for_parent)


def _import_run() -> None:
    """Import what `viscontact run` imports; it meets an error again, and reports it."""
    limit_libraries()
    if has_memory():
        with suppress(Exception):
            for name in ("commands.running", "run.execution", "shell", "sweep.execution"):
                import_module(f"viscontact.cli.{name}")
            import_module("viscontact.cli.sweep.single_task")
            for name in _OF_ANY_CASE:
                package = import_module(f"viscontact.{name}")
                for each in package.__all__:
                    getattr(package, each)


def _code_for_parent(end: CommandError) -> int:
    """Exit code that tells a stopped run that can go on from one that cannot."""
    return RESUMABLE if end.resumable and end.code == STOPPED else end.code


def _read_arguments() -> list[str]:
    line = sys.stdin.buffer.readline()
    words: list[str] = json.loads(line) if line.endswith(b"\n") else []
    return words


def _stop_at_end_of_input() -> None:
    while os.read(0, 1):
        pass
    signal.raise_signal(signal.SIGTERM)


def _end(code: int) -> NoReturn:
    """End the process at once: to tear down all that was imported takes a fifth of a second."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


if __name__ == "__main__":
    _end(run_of_parent())
