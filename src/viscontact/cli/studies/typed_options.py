"""Options of study commands as arguments of Python functions, and messages about them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

from viscontact.cli.sweep.plan_options import key_of
from viscontact.cli.terminal.messages import refuse
from viscontact.studies.typed_values import split_values
from viscontact.units.parsing import parse_quantity

T = TypeVar("T")

#: Options whose names are not those of the arguments, which begin the messages of studies.
_OPTIONS = {"constraints": "--constraint", "directory": "-o"}
#: What was typed without an option, or begins messages about the case.
_NO_OPTIONS = ("case", "files", "settings", "output")


def as_typed(message: str, typed: Mapping[str, Any]) -> str:
    """Message about an argument of a study, with the option that was typed."""
    found = re.match(r"\w+(?=: | must)", message)
    name = found.group() if found else ""
    is_typed = name not in _NO_OPTIONS and typed.get(name) is not None
    own = f"--{name.replace('_', '-')}" if is_typed else name
    return _OPTIONS.get(name, own) + message[len(name) :]


def shared_arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of every study: case, values that are set, and directory."""
    settings = settings_of(typed["settings"])
    return {"case": case_of(typed), "settings": settings, "directory": typed["output"]}


def by_key(
    option: str, texts: Sequence[str] | None, remedy: str, read: Callable[[str], T]
) -> dict[str, T]:
    """Values by key, each read from the text behind the equals sign; `remedy` shows how."""
    found: dict[str, T] = {}
    for text in texts or ():
        key, value = key_of(text), text.partition("=")[2].strip()
        if not (key and value):
            refuse(f"{option} {text}: write {remedy}")
        if key in found:
            refuse(f"{option} {key}: is given twice; give it once")
        found[key] = read(value)
    return found


def case_of(typed: Mapping[str, Any]) -> Path:
    """Case file; by its whole path for workers of a cluster, whose directory is another one."""
    case: Path = typed["case"]
    return case if typed["scheduler"] is None else case.absolute()


def settings_of(texts: Sequence[str] | None) -> dict[str, str]:
    """Values of ``--set`` by key."""
    return by_key("--set", texts, "KEY=VALUE, with the unit, e.g. 'load.force=20 kN'", str)


def scenarios_of(texts: Sequence[str] | None) -> dict[str, list[str]]:
    """Values of ``--over`` by key."""
    remedy = "KEY=VALUE, with the unit, e.g. 'load.eccentricity_x=0 mm,5 mm'"
    return by_key("--over", texts, remedy, split_values)


def instant(text: str) -> Any:
    """Place of a scalar: worst, end, a speed [m/s] or a time [s]."""
    if text in ("worst", "end"):
        return text
    with suppress(ValueError):
        return parse_quantity(text, "speed")
    return quantity("--at", text, "time", _OR_WORDS)


_OR_WORDS = "write worst, end or a time, or in steady motion a speed: "


def quantity(option: str, text: str | None, kind: str, remedy: str = "") -> float | None:
    """Value of an option in SI units; None if it was not given."""
    try:
        return None if text is None else parse_quantity(text, kind)
    except ValueError as error:
        refuse(f"{option}: {remedy}{error}")
