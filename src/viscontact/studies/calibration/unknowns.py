"""Unknowns of a calibration: ranges of keys of the case, of contact points and of a stiffness."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import Case
from viscontact.case.aliases import value_at
from viscontact.case.overrides import key_path
from viscontact.studies.space import Range, given_range
from viscontact.units.parsing import parse_any_quantity, parse_quantity

#: Unknowns that are no keys of the case.
CONTACT_POINT, MACHINE_STIFFNESS = "contact_point", "machine_stiffness"
#: Most unknowns of a calibration.
MOST_UNKNOWNS = 12
#: Part of the range that stands for a key without a plain value in the case.
_MIDDLE = 0.5


@dataclass(frozen=True)
class Unknown:
    """Unknown value: its range, and the part of the range, 0 to 1, where the search begins."""

    bounds: Range
    start: float

    @property
    def name(self) -> str:
        """Key of the case, or the name of a contact point or of the stiffness."""
        return self.bounds.key

    @property
    def unit(self) -> str:
        """SI unit."""
        return parse_any_quantity(self.bounds.value(1.0))[1]

    def text(self, part: float) -> str:
        """Value at a part of the range, as ``--set`` takes it."""
        return self.bounds.value(part)

    def si(self, part: float) -> float:
        """Value at a part of the range in SI units; beyond the range, too."""
        return parse_any_quantity(self.text(part))[0]


def unknowns_of(
    change: Mapping[str, Any],
    contact_point: Any,
    machine_stiffness: Any,
    records: int,
    case: Case,
) -> tuple[Unknown, ...]:
    """Unknowns of a calibration of some records; ValueError names the argument."""
    if not isinstance(change, Mapping) or not change:
        raise ValueError(
            "change: name a key, as {'material.shear_modulus': ('1 MPa', '1 GPa', 'log')}"
        )
    found = [_of_case(key, given, case) for key, given in change.items()]
    if contact_point is not None:
        names = [f"{CONTACT_POINT}[{n + 1}]" for n in range(records)]
        for name in names if records > 1 else [CONTACT_POINT]:
            bounds = _of_dimension(CONTACT_POINT, name, contact_point, "length")
            found.append(Unknown(bounds, _MIDDLE))
    if machine_stiffness is not None:
        name = MACHINE_STIFFNESS
        bounds = _of_dimension(name, name, machine_stiffness, "stiffness")
        if parse_any_quantity(bounds.value(0.0))[0] <= 0:
            raise ValueError(f"{MACHINE_STIFFNESS}: must be above zero, got {bounds.value(0.0)}")
        found.append(Unknown(bounds, _MIDDLE))
    if len(found) > MOST_UNKNOWNS:
        raise ValueError(f"change: must have {MOST_UNKNOWNS} unknowns at most, got {len(found)}")
    return tuple(found)


def values_at(unknowns: Sequence[Unknown], point: Floats) -> dict[str, str]:
    """Values at a point of the ranges, by name."""
    return {u.name: u.text(float(part)) for u, part in zip(unknowns, point, strict=True)}


def case_settings(unknowns: Sequence[Unknown], point: Floats) -> dict[str, str]:
    """Values of the case at a point, by key, without those of the machine."""
    values = values_at(unknowns, point)
    return {key: value for key, value in values.items() if not is_of_machine(key)}


def is_of_machine(name: str) -> bool:
    """True for a contact point and for the stiffness of the machine."""
    return name.startswith(CONTACT_POINT) or name == MACHINE_STIFFNESS


def _of_case(key: str, given: Any, case: Case) -> Unknown:
    if key.partition(".")[0] in ("grid", "output", "time", "load", "title"):
        raise ValueError(
            f"change: {key}: is no unknown; the load follows from the record, and cells and steps "
            "from the case"
        )
    if not key_path(key):
        raise ValueError(f"change: {key}: is no key; write e.g. material.shear_modulus")
    bounds = given_range("change", key, given)
    return Unknown(bounds, _own_part(bounds, value_at(case.document.data, key_path(key))))


def _of_dimension(name: str, key: str, given: Any, dimension: str) -> Range:
    """Range of an unknown that is no key of the case."""
    found = given_range(name, name, given)
    try:
        for text in list(given)[:2]:
            parse_quantity(str(text), dimension)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    return replace(found, key=key)


def _own_part(bounds: Range, own: Any) -> float:
    """Part of the range at which the case's own value lies, or its middle."""
    try:
        return part_of(bounds, parse_any_quantity(str(own))[0])
    except ValueError:  # not a plain value
        return _MIDDLE


def part_of(bounds: Range, value: float) -> float:
    """Part of a range at which a value in SI units lies; that of the nearer bound beyond it."""
    low, high = (parse_any_quantity(bounds.value(end))[0] for end in (0.0, 1.0))
    if bounds.logarithmic:
        part = math.log(value / low) / math.log(high / low) if value > 0 else 0.0
    else:
        part = (value - low) / (high - low)
    return min(max(part, 0.0), 1.0)
