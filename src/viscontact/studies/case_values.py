"""Case of a study with other values of some keys."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import xarray as xr

from viscontact.case import Case, CaseError, read_case
from viscontact.runs.preparation import analysis_of
from viscontact.runs.solving import solve
from viscontact.simulation.transient.found_events import carried_out


def case_path(case: str | PathLike[str]) -> Path:
    """Path of the case file of a study; ValueError for objects in its place."""
    if isinstance(case, str | PathLike):
        return Path(case)
    raise ValueError(
        "case: must be the path of a case file, whose keys the study changes, got "
        f"{type(case).__name__}; simulate_many takes runs of Python objects"
    )


def result_of(case: Case) -> xr.Dataset:
    """Result of a case, over time or over speed."""
    return solve(analysis_of(carried_out(case), errors=case.errors))


def result_with(path: Path, settings: Mapping[str, str]) -> xr.Dataset:
    """Result of a case with settings."""
    return result_of(case_with(path, settings))


def texts(settings: Mapping[str, Any] | None) -> dict[str, str]:
    """Values by key as text, as ``--set`` takes them."""
    return {key: str(value) for key, value in (settings or {}).items()}


def case_with(path: Path, settings: Mapping[str, str]) -> Case:
    """Read a case with settings; CaseError without the name of an option."""
    try:
        return read_case(path, [f"{key}={value}" for key, value in settings.items()])
    except CaseError as error:
        raise CaseError(*map(without_option, error.problems)) from None


def without_option(problem: str) -> str:
    """Problem of a case without the option of the command line that it names."""
    return problem.removeprefix("--set ")


def fields_setting(case: Case) -> dict[str, str]:
    """Setting of runs without fields; none for a case with a leakage, which is found from them."""
    return {} if case.leakage else {"output.fields": "none"}


def fingerprint(case: Case) -> str:
    """Digest of a case and of the files that it names."""
    return hashlib.sha256(b"".join(sorted(case.digests.values()))).hexdigest()


def refuse_repeated(**groups: Sequence[str]) -> None:
    """Raise ValueError if a key is given twice, in one argument or in several."""
    *others, last = groups
    where = f", in {', '.join(others)} or {last}" if others else ""
    keys = [key for group in groups.values() for key in group]
    for key in keys:
        if keys.count(key) > 1:
            raise ValueError(f"{key}: is given twice{where}; give it once")
