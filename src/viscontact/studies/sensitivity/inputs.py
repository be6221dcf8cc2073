"""Inputs of a case: its numbers, by key, and their values nearby."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import Case
from viscontact.case.errors import KeyPath, dotted
from viscontact.studies.sweep.axes import coordinate
from viscontact.units.parsing import split_quantity

#: Sections of a case whose numbers are inputs, and one whose lists are columns of a table.
SECTIONS = (
    *("indenter", "material", "indenter_material", "load", "friction", "tangential"),
    *("adhesion", "motion", "temperature"),
)
TABLE_SECTION = "tangential"
#: Sections of materials, whose laws have a scale.
OF_MATERIALS = ("material", "indenter_material")
#: Sections whose numbers belong to the computation, not to the contact.
NO_INPUTS = ("grid", "time", "output", "tolerance", "report", "allowable", "title")


@dataclass(frozen=True)
class CaseNumber:
    """Number of a case, as it is written there."""

    key: str
    text: str
    value: float  # SI
    units: str  # SI, "1" for a plain number

    def at(self, shift: float) -> str:
        """Value whose logarithm differs by some shift, as ``--set`` takes it."""
        number, unit = split_quantity(self.text)
        if self.units == "K":  # a temperature in degrees has an offset
            number, unit = repr(self.value), "K"
        return f"{float(number) * math.exp(shift):.12g} {unit}".rstrip()


def inputs_of(case: Case) -> list[CaseNumber]:
    """Return the numbers other than zero of the contact, in the order of the sections."""
    # Those of a table within the case, such as the points of a load, are left out.
    found = []
    for section in SECTIONS:
        for path, value in _values_in(case.document.data.get(section), (section,)):
            given = _input(dotted(path), value)
            if given is not None and given.value != 0.0:
                found.append(given)
    return found


def input_of(case: Case, key: str) -> CaseNumber:
    """Return the number of a case with a key; ValueError if there is none, or it is zero."""
    if key.partition(".")[0] in NO_INPUTS:
        raise ValueError(f"{key}: cells, steps and output of a case are no inputs of the contact")
    for data in (case.document.data, case.document.data_as_typed):
        for section in SECTIONS:
            for path, value in _values_in(data.get(section), (section,), deep=True):
                if dotted(path) != key:
                    continue
                given = _input(key, value)
                if given is None:
                    raise ValueError(f"{key}: must be a number, the case has {str(value)[:40]!r}")
                if given.value == 0.0:
                    raise ValueError(
                        f"{key}: is 0, which gives no scale for a step; write a value in the case"
                    )
                return given
    section, last = key.split(".")[0], key.split(".")[-1]
    if last == "scale" and section in OF_MATERIALS:
        return CaseNumber(key, "1", 1.0, "1")  # of a law that is as it was measured
    known = ", ".join(each.key for each in inputs_of(case))
    raise ValueError(f"{key}: the case has no such number; its inputs are {known}")


def _values_in(data: Any, path: KeyPath, *, deep: bool = False) -> Iterator[tuple[KeyPath, Any]]:
    """Yield paths and values; those of tables within the case only if `deep`."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield from _values_in(value, (*path, key), deep=deep)
    elif isinstance(data, list):
        is_table = path[0] == TABLE_SECTION or any(isinstance(each, list) for each in data)
        for number, value in enumerate(data if deep or not is_table else ()):
            yield from _values_in(value, (*path, number), deep=deep)
    else:
        yield path, data


def _input(key: str, value: Any) -> CaseNumber | None:
    """Input of a number with or without unit; None for any other value."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return None
    text = value if isinstance(value, str) else repr(value)
    found = coordinate(key, "input", [text])
    if not np.issubdtype(found.dtype, np.number):
        return None
    return CaseNumber(key, text, float(found.values[0]), str(found.attrs["units"]))
