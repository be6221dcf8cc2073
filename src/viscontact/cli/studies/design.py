"""Command `design`: its options as arguments of `viscontact.design`, and what it prints."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from viscontact.cli.studies.execution import Records, conclude, performed
from viscontact.cli.studies.profiles import execute_profile_design
from viscontact.cli.studies.typed_options import (
    by_key,
    instant,
    scenarios_of,
    shared_arguments,
)
from viscontact.cli.terminal.messages import refuse
from viscontact.studies.design.design import design
from viscontact.studies.journal import JOURNAL_NAME
from viscontact.studies.study_files import BEST_NAME
from viscontact.studies.typed_values import bounds, typed_parameter

_CHANGE = "KEY=VALUE, with the unit, e.g. 'indenter.crown_radius=20 mm:2 m:log'"
_SCATTER = "KEY=VALUE, with the unit, e.g. 'material.poisson_ratio=0.36:0.40'"


def execute(typed: Mapping[str, Any]) -> None:
    """Search, write the result to its directory, and print it; `typed` are the options by name."""
    if typed["profile"] is not None or typed["drop_tolerance"] is not None:
        execute_profile_design(typed)
        return
    search, output = partial(design, **design_arguments(typed)), typed["output"]
    found = performed(search, Records(output, output / JOURNAL_NAME), typed)
    about = f"{found.runs} runs; the best trial has its error on the cells of the case"
    conclude(found, output, [BEST_NAME], [about])


def design_arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.design` by name."""
    if not typed["change"]:
        refuse("--change: name a parameter, e.g. --change indenter.crown_radius='20 mm:2 m:log'")
    if not typed["minimise"] and not typed["maximise"]:
        refuse("give --minimise or --maximise, e.g. --minimise peak_pressure")
    return {
        **shared_arguments(typed),
        "change": by_key("--change", typed["change"], _CHANGE, typed_parameter),
        "minimise": typed["minimise"] or (),
        "maximise": typed["maximise"] or (),
        "at": instant(typed["at"]),
        "over": scenarios_of(typed["over"]),
        "scatter": by_key("--scatter", typed["scatter"], _SCATTER, _scatter),
        "constraints": typed["constraint"] or (),
        "clear_of_ends": bool(typed.get("clear_of_ends")),
        "runs": typed["runs"],
    }


def _scatter(given: str) -> tuple[str, ...] | str:
    """Bounds as a tuple, or a number with its tolerance."""
    return bounds(given) if ":" in given else given
