"""Tolerances of numbers in a case file, such as '12 mm ± 0.02 mm', which runs do not use."""

from __future__ import annotations

import re
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import field
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import yaml_source
from viscontact.case.errors import KeyPath
from viscontact.units.tolerances import read_toleranced

#: Begin of a number with a tolerance, correct or not.
_LOOKS_TOLERANCED = re.compile(r"\s*([+-]?[\d.][^±]*?)\s*(?:±|\+/-|\+-).*")

#: Sections whose numbers may have a tolerance.
SECTIONS = (
    *("indenter", "material", "indenter_material", "load", "motion", "temperature"),
    *("friction", "tangential", "adhesion"),
)


@dataclass(frozen=True)
class NominalData:
    """Data of a case with nominal values, and what was written in their places."""

    data: dict[str, Any]
    tolerances: dict[KeyPath, str] = field(default_factory=dict)
    problems: tuple[tuple[KeyPath, str], ...] = ()


def nominal(data: dict[str, Any]) -> NominalData:
    """Replace numbers with a tolerance by their nominal values."""
    sections = ((name, data[name]) for name in SECTIONS if name in data)
    found = [each for name, section in sections for each in _with_tolerance(section, (name,))]
    if not found:
        return NominalData(data)
    made, problems = NominalData(deepcopy(data)), []
    for path, text in found:
        plain = _LOOKS_TOLERANCED.sub(r"\1", text, count=1)
        try:
            read = read_toleranced(text)
        except ValueError as error:
            problems.append((path, str(error)))
        else:
            assert read is not None
            made.tolerances[path], plain = text, read.nominal
        parent: Any = made.data
        for step in path[:-1]:
            parent = parent[step]
        parent[path[-1]] = yaml_source.parse_value(plain)
    return NominalData(made.data, made.tolerances, tuple(problems))


def _with_tolerance(data: Any, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    """Yield paths and texts of numbers with a tolerance, correct or not."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield from _with_tolerance(value, (*path, key))
    elif isinstance(data, list):
        for number, value in enumerate(data):
            yield from _with_tolerance(value, (*path, number))
    elif isinstance(data, str) and path[-1] != "file" and _LOOKS_TOLERANCED.match(data):
        yield path, data
