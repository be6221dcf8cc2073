"""Command `design`: its options as arguments of `viscontact.design`, and what it prints."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

from viscontact.cli.studies.arguments import (
    bounds,
    by_key,
    case_of,
    instant,
    scenarios_of,
    settings_of,
)
from viscontact.cli.studies.execution import REPORT_NAME, Records, performed, show, write_report
from viscontact.cli.sweep.plan_options import split_values
from viscontact.cli.terminal.messages import refuse
from viscontact.studies.design.design import design
from viscontact.studies.design.result_files import BEST_NAME
from viscontact.studies.journal import JOURNAL_NAME

_CHANGE = "KEY=VALUE, with the unit, e.g. 'indenter.crown_radius=20 mm:2 m:log'"
_SCATTER = "KEY=VALUE, with the unit, e.g. 'material.poisson_ratio=0.36:0.40'"


def execute_design(typed: Mapping[str, Any]) -> None:
    """Search, write the result to its directory, and print it; `typed` are the options by name."""
    search, output = partial(design, **design_arguments(typed)), typed["output"]
    found = performed(search, trials_in(output), typed)
    show(found, [f"{found.runs} runs; the best trial has its error on the cells of the case"])
    write_report(found, output / REPORT_NAME)
    print(output / BEST_NAME)


def trials_in(directory: Path) -> Records:
    """Trials in the directory of a design."""
    refusal = (
        "holds a design already; continue it with --resume, replace it with --overwrite, or choose "
        "another directory with -o DIR"
    )
    return Records(directory, directory / JOURNAL_NAME, "the finished trials", refusal)


def design_arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.design` by name."""
    if not typed["change"]:
        refuse("--change: name a parameter, e.g. --change indenter.crown_radius='20 mm:2 m:log'")
    if not typed["minimise"] and not typed["maximise"]:
        refuse("give --minimise or --maximise, e.g. --minimise peak_pressure")
    return {
        "case": case_of(typed),
        "change": by_key("--change", typed["change"], _CHANGE, _parameter),
        "minimise": typed["minimise"] or (),
        "maximise": typed["maximise"] or (),
        "at": instant(typed["at"]),
        "over": scenarios_of(typed["over"]),
        "scatter": by_key("--scatter", typed["scatter"], _SCATTER, _scatter),
        "constraints": typed["constraint"] or (),
        "settings": settings_of(typed["settings"]),
        "runs": typed["runs"],
        "directory": typed["output"],
    }


def _parameter(given: str) -> tuple[str, ...] | list[str]:
    """Bounds of a range as a tuple, or a list of values."""
    is_range = ":" in given and given[0] not in "[{"
    return bounds(given) if is_range else split_values(given)


def _scatter(given: str) -> tuple[str, ...] | str:
    """Bounds as a tuple, or a number with its tolerance."""
    return bounds(given) if ":" in given else given
