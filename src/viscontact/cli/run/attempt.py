"""A run that is about to be made: what was asked for, what it is, and where it goes."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from viscontact.cli.results.stored import progress_made
from viscontact.cli.run.preparation import prepare
from viscontact.cli.run.resuming import standing
from viscontact.cli.run.run_directory import chosen_directory
from viscontact.cli.terminal.interruption import Interruption
from viscontact.cli.terminal.messages import refuse, say
from viscontact.run_files import CASE_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.recorded_run import Recorded
from viscontact.runs.preparation import PreparedRun
from viscontact.runs.processes.job import Standing
from viscontact.runs.processes.request import RunRequest


@dataclass(frozen=True)
class Attempt:
    """What a run was asked for, what it is, what is recorded of it, and who may stop it."""

    request: RunRequest
    prepared: PreparedRun
    recorded: Recorded
    interruption: Interruption

    def standing(self) -> Standing:
        """Whether the run begins, goes on, or is over already; refuse it if none of these."""
        return standing(self.request, self.recorded, self.prepared.case)

    def say(self, line: str) -> None:
        """Say a line unless only errors are wanted."""
        if not self.request.quiet:
            say(line)

    def made(self, instants: int, reached: float | None) -> str:
        """Say how far the run has come."""
        run = self.recorded.run
        return progress_made(instants, reached, run.times.tolist(), run.adaptive)


def attempted(request: RunRequest, interruption: Interruption) -> Attempt:
    """Return a run that is asked for, checked; nothing is created."""
    directory = _directory(request)
    prepared = prepare(request.case, request.settings, request.threads)
    case = prepared.case
    recorded = Recorded(directory, prepared.run, case.fields, case.title, case.errors)
    return Attempt(request, prepared, recorded, interruption)


def _directory(request: RunRequest) -> Path:
    """Where the run goes, as a path that netCDF takes as it is."""
    case, beside = request.case, request.case.parent
    is_runs_own = any((beside / name).is_file() for name in (RESULT_NAME, STATE_NAME))
    if request.output is None and case.name == CASE_NAME and is_runs_own:
        directory = beside  # the case as it was run
    else:
        directory = chosen_directory(case, request.output)
    whole = str(directory.absolute())
    if os.name != "nt" and "\\" in whole:
        refuse(f"{directory}: netCDF files cannot lie below a name with a backslash: choose -o DIR")
    try:
        whole.encode()
    except UnicodeEncodeError:
        refuse(
            f"{directory}: netCDF files cannot lie below a name that is not UTF-8: choose -o DIR"
        )
    # To netCDF, "~", a blank in front and "file:" mean something of their own.
    is_plain = not directory.parts or not (directory.parts[0][0] in "~ \t" or ":" in str(directory))
    return directory if is_plain else directory.absolute()
