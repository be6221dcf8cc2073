"""How a run stands, as plain data."""

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

from viscontact.plot import FIGURES
from viscontact.results.netcdf import open_results
from viscontact.results.summary import summary_rows
from viscontact.results.variables import SCALARS
from viscontact.run_files import RESULT_NAME
from viscontact.units.formatting import format_quantity
from viscontact.web.runs.run import Work
from viscontact.web.workspace.pictures import DAMAGED
from viscontact.web.workspace.problems import Problem, lines_of, problem_of

_STAGES = {"waiting": "waiting", "running": "steps"}
#: Of a run that was stopped.
_ITS = "what it has computed is kept"
#: Lines of the command line that say what to type, where the page has buttons.
_COMMANDS = ("go on with:", "with that changed,", "once that is mended:", "interrupted")
_WITHOUT_COMMAND = re.compile(r"^the run: (?=the run )|; [^;]*--overwrite[^;]*$")


def status_of(work: Work, found: Mapping[str, Any]) -> dict[str, Any]:
    """Return how a run stands."""
    asked, course, left = work.asked, work.course, work.seconds_left
    problems = _problems(work)
    # Of one that failed, its own words say more.
    is_whole = not work.is_over or "table" in found or asked.state == "failed"
    is_damaged = course.instants > 0 and not is_whole
    table = found.get("table") or _table(course.first, course.last)
    steps = None if asked.instants is None else max(asked.instants - 1, 1)
    return {
        **{"id": work.name, "title": asked.title, "label": work.label},
        "quality": asked.quality,
        **{"created": asked.created, "state": asked.state, "over": work.is_over},
        **{"resumable": work.can_go_on and not is_damaged, "stage": _stage(work)},
        "part": round(work.part, 4),
        "step": max(course.instants - 1, 0),
        "steps": steps,
        "end": asked.end,
        "time": format_quantity(course.time, "s") if course.instants else None,
        "seconds_left": None if left is None else round(left, 1),
        "message": DAMAGED if is_damaged else _message(work, [*lines_of(problems)]),
        "problems": [asdict(each) for each in problems],
        "warnings": found.get("warnings", list(course.last.get("warnings", []))),
        "scalars": _scalars(course.last, {row["name"] for row in table}),
        "table": table,
        "figures": list(FIGURES) if course.instants and not is_damaged else [],
        "field_times": found.get("field_times", []),
        "field_times_text": found.get("field_times_text", []),
    }


def found_by(directory: Path) -> dict[str, Any]:
    """Return what the result of a run says, in words."""
    if not (directory / RESULT_NAME).is_file():
        return {}
    with open_results(directory) as ds:
        if not ds.sizes.get("time"):
            return {}
        times = _field_times(ds)
        rows = [
            {**{"name": row.name, "title": row.title, "unit": row.unit, "start": row.first},
             **{"end": row.last, "largest": row.largest, "error": _error(ds, row.largest_error)}}
            for row in summary_rows(ds)
        ]  # fmt: skip
        return {
            "table": rows,
            "warnings": str(ds.attrs.get("warnings", "")).splitlines(),
            "field_times": times,
            "field_times_text": [format_quantity(time, "s") for time in times],
        }


def _field_times(ds: xr.Dataset) -> list[float]:
    if "pressure" not in ds:
        return []
    return [float(time) for time in ds[ds["pressure"].dims[0]].values if math.isfinite(time)]


def _error(ds: xr.Dataset, told: str) -> str:
    """The error of a scalar; nothing where none was to be estimated."""
    has_errors = json.loads(str(ds.attrs.get("errors", "false")))
    return told if has_errors else ""


def _stage(work: Work) -> str:
    if work.is_over:
        return "over"
    if work.is_estimating:
        return "errors"
    return "starting" if work.is_at_work and not work.course.instants else _STAGES[work.asked.state]


def _problems(work: Work) -> list[Problem]:
    if work.asked.state != "failed":
        return []
    said = [line for line in work.asked.said if not line.startswith(_COMMANDS)]
    told = (line.replace(str(work.directory), "the run") for line in said)
    return [problem_of(_WITHOUT_COMMAND.sub("", line), work.given) for line in told]


def _message(work: Work, problems: Sequence[str]) -> str:
    asked, course = work.asked, work.course
    of = "" if asked.instants is None else f" of {asked.instants}"
    made = f"{course.instants}{of} instants"
    reached = f"{made}, t = {format_quantity(course.time, 's')}" if course.instants else ""
    told = {
        "waiting": "waiting for its turn",
        "running": reached or "starting",
        "done": f"done: {made}",
        "cancelled": f"cancelled {_kept(work)}",
        "interrupted": f"the server was stopped {_kept(work)}",
        "failed": problems[0] if problems else "the run stopped, and did not say why",
    }
    if work.is_estimating:
        return "all steps are done; estimating errors, from two coarser runs of the same case"
    return told[asked.state]


def _kept(work: Work) -> str:
    """When a run was stopped, and what it has to go on from."""
    asked, course = work.asked, work.course
    if not course.instants:
        return "before its first step; there is nothing to show yet"
    if course.part >= 1:
        return f"after its last step, before its error bars; {_ITS}"
    of = "" if asked.instants is None else f" of {asked.instants - 1}"
    return (
        f"after step {course.instants - 1}{of}, at t = {format_quantity(course.time, 's')}; {_ITS}"
    )


def _scalars(line: Mapping[str, Any], names: Collection[str]) -> dict[str, Any]:
    """The last values of those that are more than rounding: as numbers, and in words."""
    told = {}
    for name, variable in SCALARS.items():
        value = line.get(name)
        if name in names and isinstance(value, int | float):
            told[name] = {"value": value, "text": format_quantity(value, variable.units, 4)}
    return told


def _table(first: Mapping[str, Any], last: Mapping[str, Any]) -> list[dict[str, str]]:
    """The table of a run at work: its first and its last instant so far."""
    if not last:
        return []
    numbers = {
        name: ("time", np.array([_number(line.get(name)) for line in (first, last)]))
        for name in SCALARS
        if name != "outcome"
    }
    return [
        {**{"name": row.name, "title": row.title, "unit": row.unit, "start": row.first},
         **{"end": row.last, "largest": "", "error": ""}}
        for row in summary_rows(xr.Dataset(numbers))
    ]  # fmt: skip


def _number(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else math.nan
