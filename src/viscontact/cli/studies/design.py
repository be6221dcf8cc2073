"""Options of `design`, as the arguments of `viscontact.design`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from viscontact.cli.sweep.plan_options import split_values
from viscontact.cli.terminal.messages import refuse
from viscontact.units.parsing import parse_quantity

#: Options by the names of the arguments, at the beginning of a message.
_OPTIONS = {
    "change": "--change",
    "over": "--over",
    "scatter": "--scatter",
    "constraints": "--constraint",
    "minimise": "--minimise",
    "maximise": "--maximise",
    "at": "--at",
    "runs": "--runs",
    "drop_tolerance": "--drop-tolerance",
    "directory": "-o",
}


@dataclass(frozen=True)
class DesignRequest:
    """Options of `design`, as they were typed."""

    case: Path
    output: Path
    change: Sequence[str]  # KEY=LOW:HIGH[:log] or KEY=A,B,...
    minimise: Sequence[str]
    maximise: Sequence[str]
    at: str
    over: Sequence[str]  # KEY=A,B,...
    scatter: Sequence[str]  # KEY=LOW:HIGH or KEY=VALUE ± TOLERANCE
    constraints: Sequence[str]
    settings: Sequence[str]
    runs: int | None
    jobs: int

    def arguments(self) -> dict[str, Any]:
        """Arguments of `viscontact.design` by name."""
        if not self.change:
            refuse(
                "--change: name a parameter, e.g. --change indenter.crown_radius='20 mm:2 m:log'"
            )
        if not self.minimise and not self.maximise:
            refuse("give --minimise or --maximise, e.g. --minimise peak_pressure")
        return {
            "case": self.case,
            "change": keys("--change", self.change, _parameter),
            "minimise": self.minimise,
            "maximise": self.maximise,
            "at": instant(self.at),
            "over": keys("--over", self.over, split_values),
            "scatter": keys("--scatter", self.scatter, _scatter),
            "constraints": list(self.constraints),
            "settings": keys("--set", self.settings, str),
            "runs": self.runs,
            "workers": self.jobs,
            "directory": self.output,
        }


def as_typed(message: str) -> str:
    """Message about an argument of `viscontact.design`, with the option that was typed.

    >>> as_typed("constraints: write SCALAR<=VALUE")
    '--constraint: write SCALAR<=VALUE'
    """
    name = re.match(r"\w+(?=: )", message)
    option = _OPTIONS.get(name.group() if name else "")
    return message if name is None or option is None else option + message[name.end() :]


def keys(option: str, texts: Sequence[str], read: Any) -> dict[str, Any]:
    """Values by key, each read from the text behind the equals sign."""
    found: dict[str, Any] = {}
    for text in texts:
        key, equals, given = (part.strip() for part in text.partition("="))
        if not (key and equals and given):
            refuse(f"{option} {text}: write KEY=VALUE, with the unit, e.g. {_EXAMPLES[option]}")
        if key in found:
            refuse(f"{option} {key}: is given twice; give it once")
        found[key] = read(given)
    return found


_EXAMPLES = {
    "--change": "'indenter.crown_radius=20 mm:2 m:log'",
    "--over": "'load.eccentricity_x=0 mm,5 mm'",
    "--scatter": "'material.poisson_ratio=0.36:0.40'",
    "--set": "'load.force=20 kN'",
}


def _parameter(given: str) -> Any:
    """Bounds of a range as a tuple, or a list of values."""
    bounds = tuple(part.strip() for part in given.split(":"))
    if len(bounds) == 1 or given[:1] in "[{":
        return split_values(given)
    return bounds


def _scatter(given: str) -> Any:
    """Bounds as a tuple, or a number with its tolerance."""
    bounds = tuple(part.strip() for part in given.split(":"))
    return bounds if len(bounds) > 1 else given


def instant(text: str) -> Any:
    """Instant of a goal: worst, end or a time [s]."""
    if text in ("worst", "end"):
        return text
    try:
        return parse_quantity(text, "time")
    except ValueError as error:
        refuse(f"--at: write worst, end or a time: {error}")
