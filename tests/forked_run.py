"""`viscontact run` in processes that are forked from one that has imported it.

All else is as when a user types it: a process with streams and an end of its own.
"""

from __future__ import annotations

import multiprocessing
import os
import sys
from pathlib import Path

from viscontact.cli import main


class ForkedRun:
    """A run of case.yaml in a folder, begun or resumed; it is the only one there at a time."""

    def __init__(self, folder: Path, directory: str) -> None:
        self._errors = folder / "errors.txt"
        # The context whose server the conftest has told what to import.
        forked = multiprocessing.get_context("forkserver")
        self._process = forked.Process(target=_run, args=(folder, directory, self._errors))
        self._process.start()

    def is_over(self) -> bool:
        """Return whether the process has ended."""
        return self._process.exitcode is not None

    def kill(self) -> None:
        """Kill the process."""
        self._process.kill()

    def ended(self, seconds: float = 300) -> tuple[int, str]:
        """Wait for the end; return how it ended, and what it wrote to its standard error."""
        self._process.join(seconds)
        if self._process.exitcode is None:
            self._process.kill()
            raise TimeoutError(f"the run took longer than {seconds:g} s")
        return self._process.exitcode, self._errors.read_text(encoding="utf-8")


def _run(folder: Path, directory: str, errors: Path) -> None:
    os.chdir(folder)
    for number, path in ((1, os.devnull), (2, errors)):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
    sys.argv = ["viscontact", "run", "case.yaml", "-o", directory, "--resume"]
    sys.exit(main())
