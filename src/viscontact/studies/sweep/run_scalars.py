"""Scalars of finished runs with their errors, read from the progress log or from the result."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import field
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.state import Outcome
from viscontact.results.line_digests import is_as_written, read_entries
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME
from viscontact.results.stored_result import StoredFile
from viscontact.results.variables import AXES, ERRORS, RUN_VALUES, SCALARS, error_name
from viscontact.runs.directory.netcdf_layout import described_fields
from viscontact.runs.directory.progress_log import reached_in
from viscontact.studies.sweep.states import last_line

#: Columns of a table of scalars.
COLUMNS = (*AXES, *SCALARS, *ERRORS)
_FIRST = {f'{{"{name}"'.encode() for name in AXES}
#: A column of results of bodies that adhere.
_ADHERES = "least_pressure"
_OUTCOMES = {outcome.name.lower(): outcome.value for outcome in Outcome}


@dataclass(frozen=True)
class RunOutline:
    """Instants or speeds of a finished run, and what its result holds."""

    over: str  # "time" or "speed"
    rows: Floats  # instants [s] or speeds [m/s]
    columns: frozenset[str]  # those of `COLUMNS` that the result states
    fields: dict[str, Any] | None  # as `described_fields` returns it
    verdict: str = ""  # the worst on the allowable values; empty without any
    decided_by: str = ""  # quantities with that verdict; empty if all have passed
    values: Mapping[str, float] = field(default_factory=dict)  # of the whole run, with errors
    warnings: tuple[str, ...] = ()


def run_outline(directory: Path) -> RunOutline:
    """Read the outline of a finished run; OSError or ValueError if it cannot be read."""
    end = last_line(directory)
    with suppress(OSError, ValueError, LookupError, TypeError):  # then the result is the source
        if end.get("complete"):
            with (directory / PROGRESS_NAME).open("rb") as lines:
                rows = np.array([_row_value(line, row) for row, line in enumerate(lines)])
            over = next(name for name in AXES if name in end)
            columns = frozenset(set(COLUMNS) & set(end))
            verdict, decided_by = (str(end.get(name, "")) for name in ("verdict", "decided_by"))
            values = _run_values(directory) if _ADHERES in columns else {}
            warned = _warnings(end, directory)
            fields = end.get("fields")
            return RunOutline(over, rows, columns, fields, verdict, decided_by, values, warned)
    with StoredFile(directory / RESULT_NAME, noted=False) as file:
        over = _axis_of(file)
        rows = np.asarray(file.variables[over][:], dtype=np.float64)
        columns, values = frozenset(_stored_columns(file)), _values_of(file)
        warned = _stated_warnings(file)
        fields = described_fields(file)
        return RunOutline(over, rows, columns, fields, values=values, warnings=warned)


def _warnings(end: Mapping[str, Any], directory: Path) -> tuple[str, ...]:
    """Warnings by the last line of a log; by the result of one of an earlier version."""
    if "all_warnings" in end:
        return tuple(map(str, end["all_warnings"]))
    with StoredFile(directory / RESULT_NAME, noted=False) as file:
        return _stated_warnings(file)


def _stated_warnings(file: StoredFile) -> tuple[str, ...]:
    if "warnings" not in file.ncattrs():
        return ()
    return tuple(str(file.getncattr("warnings")).splitlines())


def run_scalars(directory: Path) -> Floats:
    """Read the `COLUMNS` of a run in SI units, NaN where not stated; OSError or ValueError."""
    with suppress(OSError, ValueError, LookupError, TypeError, AttributeError):
        if last_line(directory).get("complete"):
            with (directory / PROGRESS_NAME).open("rb") as lines:
                rows = [_row(_read_line(line, row)) for row, line in enumerate(lines)]
                return np.array(rows, dtype=np.float64)
    return _of_result(directory / RESULT_NAME)


def _read_line(line: bytes, row: int) -> dict[str, Any]:
    # Without a digest the result, which has some, is the source.
    if not is_as_written(line, row):
        raise ValueError("the line has no digest")
    return read_entries(line)


def _row_value(line: bytes, row: int) -> float:
    if not line.endswith(b"}\n") or not is_as_written(line, row):
        raise ValueError("the line is not complete")
    # It comes first; to parse the whole line takes thirty times as long.
    name, _, rest = line[:64].partition(b": ")
    number = rest.partition(b",")[0]
    return float(number) if name in _FIRST else reached_in(json.loads(line))


def _run_values(directory: Path) -> dict[str, float]:
    """Values of a run with their errors, which are attributes of its result alone."""
    with StoredFile(directory / RESULT_NAME, noted=False) as file:
        return _values_of(file)


def _values_of(file: StoredFile) -> dict[str, float]:
    stored = file.ncattrs()
    names = [each for name in RUN_VALUES for each in (name, error_name(name)) if each in stored]
    return {name: float(file.getncattr(name)) for name in names}


def _axis_of(file: StoredFile) -> str:
    return next((name for name in AXES if name in file.dimensions), "time")


def _row(entries: dict[str, Any]) -> list[Any]:
    entries["outcome"] = _OUTCOMES.get(entries.get("outcome", ""), np.nan)
    # NumPy reads None as NaN and "inf" as infinite.
    return [entries.get(name) for name in COLUMNS]


def _stored_columns(file: StoredFile) -> list[str]:
    return [name for name in COLUMNS if name in file.variables]


def _of_result(path: Path) -> Floats:
    with StoredFile(path, noted=False) as file:
        table = np.full((len(file.dimensions[_axis_of(file)]), len(COLUMNS)), np.nan)
        for name in _stored_columns(file):
            table[:, COLUMNS.index(name)] = file.variables[name][:]
    return table
