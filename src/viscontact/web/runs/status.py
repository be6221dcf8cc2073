"""Status of a run as plain data."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.drawing.figures import names_of
from viscontact.results.netcdf import open_results
from viscontact.results.run_axis import SPEED, TIME, in_order, run_axis
from viscontact.results.run_files import RESULT_NAME
from viscontact.results.summary import summary_rows
from viscontact.results.variables import SCALARS
from viscontact.results.verdicts import compared, verdicts
from viscontact.units.formatting import format_quantity
from viscontact.web.runs.run import ManagedRun
from viscontact.web.workspace.pictures import DAMAGED
from viscontact.web.workspace.problems import InputProblem, lines_of, problem_of

_STAGES = {"waiting": "waiting", "running": "steps"}
#: Name of a step of a run.
_STEPS = {TIME: "step", SPEED: "speed"}
#: End of the message about a stopped run.
_ITS = "its results are kept"
#: First words of messages that name commands, for which the page has buttons.
_COMMANDS = ("continue with:", "with that changed,", "after correcting that:", "interrupted")
_WITHOUT_COMMAND = re.compile(r"^the run: (?=the run )|; [^;]*--overwrite[^;]*$")


def status_of(run: ManagedRun, summary: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Return the status of a run, with the summary of its result once that has been read."""
    entry, course, left = run.entry, run.course, run.seconds_left
    found = summary or {}
    problems = problems_of(run)
    # The message of a failed run is more specific.
    is_readable = summary is None or "table" in found or entry.state == "failed"
    is_damaged = course.instants > 0 and not is_readable
    table = found.get("table") or _table(course.first, course.last)
    return {
        **{"id": run.name, "title": entry.title, "label": run.label},
        "quality": entry.quality,
        **{"created": entry.created, "state": entry.state, "over": run.is_over},
        **{"resumable": run.is_resumable and not is_damaged, "stage": _stage(run)},
        "part": round(run.part, 4),
        **{"axis": run.axis.name, "begin": entry.begin, "end": entry.end},
        **{"step": _steps_of(run, course.instants), "steps": _total(run)},
        "reached": run.axis.place(course.time, 6) if course.instants else None,
        "seconds_left": None if left is None else round(left, 1),
        "message": DAMAGED if is_damaged else _message(run, [*lines_of(problems)]),
        "problems": [asdict(each) for each in problems],
        "warnings": found.get("warnings", list(course.last.get("warnings", []))),
        "scalars": _scalars(course.last, {row["name"] for row in table}),
        "table": table,
        "figures": _figures(run) if course.instants and not is_damaged else [],
        **{name: found.get(name, []) for name in ("verdicts", "fields", "fields_text")},
    }


def result_summary(directory: Path) -> dict[str, Any]:
    """Return a summary of the result of a run, with formatted numbers."""
    if not (directory / RESULT_NAME).is_file():
        return {}
    with open_results(directory) as stored:
        ds, axis = in_order(stored), run_axis(stored)
        if not ds.sizes.get(axis.name):
            return {}
        places = _field_places(ds)
        rows = [
            {**{"name": row.name, "title": row.title, "unit": row.unit, "start": row.first},
             **{"end": row.last, "largest": row.largest, "error": _error(ds, row.largest_error)}}
            for row in summary_rows(ds)
        ]  # fmt: skip
        return {
            "table": rows,
            "warnings": str(ds.attrs.get("warnings", "")).splitlines(),
            "verdicts": [
                {"verdict": each.verdict, "text": compared(ds, each)} for each in verdicts(ds)
            ],
            "fields": places,
            "fields_text": [axis.quantity(place, 6) for place in places],
        }


def _field_places(ds: xr.Dataset) -> list[float]:
    if "pressure" not in ds:
        return []
    return [float(each) for each in ds[ds["pressure"].dims[0]].values if math.isfinite(each)]


def _error(ds: xr.Dataset, text: str) -> str:
    """Error of a scalar; empty where errors were not requested."""
    has_errors = json.loads(str(ds.attrs.get("errors", "false")))
    return text if has_errors else ""


def _stage(run: ManagedRun) -> str:
    if run.is_over:
        return "over"
    if run.is_estimating:
        return "errors"
    return "starting" if run.is_at_work and not run.course.instants else _STAGES[run.entry.state]


def problems_of(run: ManagedRun) -> list[InputProblem]:
    """Return the problems that a failed run states; none of another one."""
    if run.entry.state != "failed":
        return []
    lines = [line for line in run.entry.said if not line.startswith(_COMMANDS)]
    lines = [line.replace(str(run.directory), "the run") for line in lines]
    return [problem_of(_WITHOUT_COMMAND.sub("", line), run.given) for line in lines]


def _message(run: ManagedRun, problems: Sequence[str]) -> str:
    entry, course = run.entry, run.course
    of = "" if entry.instants is None else f" of {entry.instants}"
    made = f"{course.instants}{of} {run.axis.row}s"
    reached = f"{made}, {run.axis.place(course.time, 6)}" if course.instants else ""
    messages = {
        "waiting": "waiting for its turn",
        "running": reached or "starting",
        "done": f"done: {made}",
        "cancelled": f"cancelled {_kept_text(run)}",
        "interrupted": f"the server was stopped {_kept_text(run)}",
        "failed": problems[0] if problems else "the run stopped without a message",
    }
    if run.is_estimating:
        return "all steps are done; estimating errors, from coarser runs of the same case"
    return messages[entry.state]


def _kept_text(run: ManagedRun) -> str:
    """Part of a message: when the run was stopped, and what is kept."""
    entry, course, step = run.entry, run.course, _STEPS[run.axis]
    if not course.instants:
        return f"before its first {step}; there is nothing to show yet"
    if entry.errors and course.part >= 1:
        return f"after its last {step}, before its error bars; {_ITS}"
    of = "" if entry.instants is None else f" of {_steps_of(run, entry.instants)}"
    place = run.axis.place(course.time, 6)
    return f"after {step} {_steps_of(run, course.instants)}{of}, at {place}; {_ITS}"


def _figures(run: ManagedRun) -> list[str]:
    return names_of("both", run.axis.name)


def _steps_of(run: ManagedRun, states: int) -> int:
    """Steps to reach a number of instants; each speed counts."""
    return max(states - 1, 0) if run.axis.is_history else states


def _total(run: ManagedRun) -> int | None:
    return None if run.entry.instants is None else max(_steps_of(run, run.entry.instants), 1)


def _scalars(line: Mapping[str, Any], names: Collection[str]) -> dict[str, Any]:
    """Last values of the named scalars, as numbers and as text."""
    scalars = {}
    for name, variable in SCALARS.items():
        value = line.get(name)
        if name in names and isinstance(value, int | float):
            scalars[name] = {"value": value, "text": format_quantity(value, variable.units, 4)}
    return scalars


def _table(first: Mapping[str, Any], last: Mapping[str, Any]) -> list[dict[str, str]]:
    """Table of an active run: its first and its latest instant or speed."""
    if not last:
        return []
    over = "speed" if "speed" in last else "time"
    numbers = {
        name: (over, np.array([_number(line.get(name)) for line in (first, last)]))
        for name, each in SCALARS.items()
        if name != "outcome" and (name in last or not each.per_length_of)
    }
    return [
        {**{"name": row.name, "title": row.title, "unit": row.unit, "start": row.first},
         **{"end": row.last, "largest": "", "error": ""}}
        for row in summary_rows(xr.Dataset(numbers))
    ]  # fmt: skip


def _number(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else math.nan
