"""Arguments of `viscontact run` and of studies, and exit codes."""

from __future__ import annotations

import os
import shlex
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass

#: Exit codes: finished, stopped during the run, refused before it, interrupted.
DONE, STOPPED, REFUSED, INTERRUPTED = 0, 1, 2, 130
#: Exit code of the process of a run, for its parent: stopped, and goes on once resumed.
RESUMABLE = 75


@dataclass(frozen=True)
class RunRequest:
    """Arguments of ``viscontact run``, or of the command of a study, which takes the same."""

    case: Path
    output: Path | None = None  # run directory; next to the case file when left out
    overwrite: bool = False
    resume: bool = False
    settings: tuple[str, ...] = ()  # values of --set
    threads: int = 1  # of one Fourier transform
    quiet: bool = False  # print errors only
    command: str = "run"
    options: tuple[str, ...] = ()  # further words, as those of --vary

    @property
    def resuming(self) -> str:
        """Shell command that resumes the run."""
        words = replace(self, resume=False, overwrite=False).words()
        return command(*words, "--resume", name=self.command)

    @property
    def repeating(self) -> str:
        """Shell command that repeats the request."""
        return command(*self.words(), name=self.command)

    def words(self) -> Iterator[str]:
        """Words after the name of the command, the case first."""
        yield no_option(self.case)
        if self.output is not None:
            yield from ("-o", no_option(self.output))
        for setting in self.settings:
            yield from ("--set", setting)
        if self.threads != 1:
            yield from ("--threads", str(self.threads))
        if self.quiet:
            yield "--quiet"
        yield from self.options
        yield from (f"--{name}" for name in ("resume", "overwrite") if getattr(self, name))


def no_option(path: Path) -> str:
    """Return a path that cannot be read as an option."""
    return f"./{path}" if str(path).startswith("-") else str(path)


def command(*words: str, name: str = "run") -> str:
    """Return a command of viscontact with these words, quoted for the shell."""
    whole = ["viscontact", name, *words]
    # Windows quotes in its own way.
    return subprocess.list2cmdline(whole) if os.name == "nt" else shlex.join(whole)
