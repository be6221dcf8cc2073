"""Run that has been read and checked, before anything is created."""

from __future__ import annotations

import hashlib
import os
from dataclasses import replace
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case.case import Case
from viscontact.case.errors import dotted
from viscontact.results.filed_case import FiledCase
from viscontact.results.run_files import CASE_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.command_error import refuse
from viscontact.runs.directory.lock_check import LockCheck
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.execution.directory_state import standing
from viscontact.runs.execution.prepared_case import prepare
from viscontact.runs.execution.run_directory import chosen_directory
from viscontact.runs.preparation import PreparedRun
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import RunRequest


@dataclass(frozen=True)
class CheckedRun:
    """Request for a run, its checked case, and its run directory."""

    request: RunRequest
    prepared: PreparedRun
    recorded: Recorded

    def with_lock(self, check: LockCheck) -> CheckedRun:
        """Return the run with the check of its directory's lock."""
        return replace(self, recorded=replace(self.recorded, check=check))

    def standing(self) -> RunStage:
        """Return whether the run is new, stopped or finished; refuse it in all other cases."""
        return standing(self.request, self.recorded, self.prepared.case)

    def job(self, standing: RunStage) -> Job:
        """Return the run as one of several."""
        recorded = self.recorded
        directory, run = recorded.directory, recorded.run
        about = (run.total, float(run.places[-1]), run.work, run.memory)
        return Job(self.request, directory, directory.name, standing, *about)


def checked_run(request: RunRequest, memory: float | None = None) -> CheckedRun:
    """Check a run and choose its directory, creating nothing; it may need some memory [bytes]."""
    directory = directory_of(request)
    found = prepare(request.case, request.settings, request.threads, memory)
    case = found.case
    recorded = Recorded(directory, found.run, case.title, filed=filed_case(case).attributes)
    return CheckedRun(request, found, recorded)


def directory_of(request: RunRequest) -> Path:
    """Return the directory of a run, as a path that netCDF opens unchanged."""
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
    # netCDF gives "~", a leading blank and "file:" a special meaning.
    is_plain = not directory.parts or not (directory.parts[0][0] in "~ \t" or ":" in str(directory))
    return directory if is_plain else directory.absolute()


def filed_case(case: Case) -> FiledCase:
    """Return what a result keeps of a case."""
    return FiledCase(
        case.title_block,
        _input_files(case),
        case.document.data_with_tolerances,
        case.measured,
        case.allowable,
    )


def _input_files(case: Case) -> list[dict[str, str]]:
    """Name, role and SHA-256 of each file of a case; the case file may differ from that as run."""
    typed, run = case.digests.get(case.document.path, b""), hashlib.sha256(case.text.encode())
    found = [_entry(CASE_NAME, "case as run", run.digest())]
    if typed and typed != run.digest():
        found.insert(0, _entry(case.document.path.name, "case file", typed))
    named = {path: dotted(key) for key, path in case.files.items()}
    files = (_entry(case.file_names[path], named[path], case.digests[path]) for path in named)
    return [*found, *sorted(files, key=lambda entry: entry["role"])]


def _entry(name: str, role: str, digest: bytes) -> dict[str, str]:
    return {"name": name, "role": role, "sha256": digest.hex()}
