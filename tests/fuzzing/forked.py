"""The command in processes that have imported all it needs: forked from one that waits for it.

All else is as when a user types it: a process with streams, limits and an end of its own.
"""

from __future__ import annotations

import multiprocessing
import os
import resource
import sys
from pathlib import Path
from typing import NamedTuple

from viscontact.cli import main

#: What the commands import where they need it.
LOADED = ("viscontact.cli.run.execution", "viscontact.cli.run.summary", "pint")

_FORKS = multiprocessing.get_context("forkserver")
_FORKS.set_forkserver_preload(["viscontact.cli.shell", *LOADED])


class Done(NamedTuple):
    """How a process ended, and what it printed."""

    returncode: int | None
    stdout: str
    stderr: str


def command(arguments: tuple[str, ...], room: int, seconds: float, papers: Path) -> Done:
    """Run the command with so much address space [bytes], its standard input open and silent.

    What it prints is kept in `papers`; it is killed where it takes longer.
    """
    process = _FORKS.Process(target=_run, args=(arguments, room, papers))
    process.start()
    process.join(seconds)
    if process.exitcode is None:
        process.kill()
        process.join()
        raise TimeoutError(f"viscontact {' '.join(arguments)} took longer than {seconds:g} s")
    out, err = ((papers / name).read_text(errors="replace") for name in ("out", "err"))
    return Done(process.exitcode, out, err)


def _run(arguments: tuple[str, ...], room: int, papers: Path) -> None:
    silent, _ = os.pipe()  # its other end stays open as long as the process
    os.dup2(silent, 0)
    for number, name in ((1, "out"), (2, "err")):
        os.dup2(os.open(papers / name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
    sys.stdin = open(0, closefd=False)  # noqa: SIM115  the process's own
    resource.setrlimit(resource.RLIMIT_AS, (room, room))
    sys.argv = ["viscontact", *arguments]
    sys.exit(main())
