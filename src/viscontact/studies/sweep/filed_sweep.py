"""Title block, dates, input files and allowable values that the results of a sweep share."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import Any

from viscontact.results.filed_case import FiledCase, started_at
from viscontact.results.run_files import MANIFEST_NAME, RESULT_NAME
from viscontact.results.stored_result import StoredFile
from viscontact.results.variables import ALLOWABLE
from viscontact.studies.sweep.manifest import read_manifest
from viscontact.studies.sweep.states import State, run_state

#: Attributes of a result that are read.
_KEPT = ("title", "title_block", "started", "input_files", ALLOWABLE)
#: Role of the case of a single run among its input files.
_OWN_CASE = "case as run"


def filed_attributes(directory: Path) -> dict[str, str]:
    """Return attributes of a sweep like those of a result; empty without a finished run."""
    # Title, title block and allowable values are those in which all finished runs agree, the start
    # is that of the first run, and the input files are those of all runs, without their own cases.
    found = list(_of_finished(directory))
    if not found:
        return {}
    shared: dict[str, str] = {
        name: found[0][name]
        for name in ("title", "title_block")
        if name in found[0] and all(each.get(name) == found[0][name] for each in found)
    }
    starts = [each["started"] for each in found if started_at(each)]
    if starts:
        shared["started"] = min(starts, key=datetime.fromisoformat)
    return shared | {"input_files": json.dumps(_files(found)), ALLOWABLE: _limits(found)}


def _of_finished(directory: Path) -> Iterator[dict[str, Any]]:
    for run in read_manifest(directory / MANIFEST_NAME):
        place = directory / run.directory
        if run_state(place).state is State.DONE:
            # One that cannot be opened is a failed run of the report.
            with suppress(OSError, RuntimeError):
                yield _attributes(place / RESULT_NAME)


def _attributes(path: Path) -> dict[str, Any]:
    with StoredFile(path, noted=False) as file:
        return {name: file.getncattr(name) for name in _KEPT if name in file.ncattrs()}


def _files(found: Sequence[Mapping[str, Any]]) -> list[dict[str, str]]:
    """All input files of the runs, each once."""
    files = {
        (each["name"], each["role"], each["sha256"]): dict(each)
        for attributes in found
        for each in FiledCase.of(attributes).input_files
        if each["role"] != _OWN_CASE
    }
    return list(files.values())


def _limits(found: Sequence[Mapping[str, Any]]) -> str:
    """Allowable values that all runs have, as an attribute of a result without verdicts."""
    given = [json.loads(each.get(ALLOWABLE, "{}")) for each in found]
    limits = [{name: each["limit"] for name, each in run.items()} for run in given]
    shared = {
        name: {"limit": limit}
        for name, limit in limits[0].items()
        if all(run.get(name) == limit for run in limits)
    }
    return json.dumps(shared)
