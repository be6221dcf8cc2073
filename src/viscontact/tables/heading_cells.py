"""Cells of a header: names, quantities and units in their texts, and scales of columns."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.creep_tests import STRAIN_UNITS, split_stress
from viscontact.tables.names import QUANTITIES, Meaning, meaning
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.parsing import UnitScale, parse_scale

# "time [s]", "time (s)", "time in s", "time / s"; the last two only behind a name that is known.
_BRACKETS = (
    re.compile(r"(?P<name>.+?)\s*\[(?P<unit>[^\]]*)\]"),
    re.compile(r"(?P<name>.+?)\s*\((?P<unit>[^()]*(?:\([^()]*\)[^()]*)*)\)"),
)
_LOOSE = (
    re.compile(r"(?P<name>.+?)\s+in\s+(?P<unit>\S+)"),
    re.compile(r"(?P<name>.+?)\s*/\s*(?P<unit>.+)"),
)
_LONGEST_HEADING = 200
_NO_UNIT = ("", "-", "–", "—", "1", "none")
# Names without a meaning of their own: readers of shapes and surfaces state it.
_COORDINATES = ("x", "y", "z", "r", "drop", "height")
# Units as some programs write them.
_SPELT = {"Sec": "s", "sek": "s", "Sek": "s", "Min": "min", "° C": "degC", "Deg C": "degC"}


@dataclass(frozen=True)
class HeadingCell:
    """Cell of the header: its text, the name and unit in it, its line, and a stress [Pa]."""

    text: str
    name: str
    unit: str | None
    line: int
    stress: float | None = None


def quantity_named(cell: str, columns: Mapping[str, str | None]) -> str | None:
    """Quantity that the text of a heading names, by itself or by `columns`; None if it names none.

    >>> quantity_named("Zeit [min]", {}), quantity_named("u", {"u": "approach"})
    ('time', 'approach')
    """
    if len(cell) > _LONGEST_HEADING:
        return None
    found = heading_cell(cell, 0)
    for name in (found.text, found.name):
        if name in columns:
            return columns[name]
    stated = by_unit(found, meaning(found.name))
    return None if stated is None else stated.quantity


def heading_cell(text: str, line: int) -> HeadingCell:
    """Name, unit and stress in the text of a cell."""
    name, stress = split_stress(text)
    if stress is not None:
        return HeadingCell(text, name, None, line, stress)
    found = _unit_of(text, line)
    name, stress = split_stress(found.name)
    return found if stress is None else HeadingCell(text, name, found.unit, line, stress)


def _unit_of(text: str, line: int) -> HeadingCell:
    if len(text) > _LONGEST_HEADING or meaning(text) is not None:
        return HeadingCell(text, text, None, line)
    for pattern in (*_BRACKETS, *_LOOSE):
        match = pattern.fullmatch(text)
        if match and (pattern in _BRACKETS or is_known(match["name"])):
            return HeadingCell(text, match["name"], match["unit"].strip(), line)
    return HeadingCell(text, text, None, line)


def is_known(name: str) -> bool:
    """True for the name of a quantity or of a coordinate."""
    return meaning(name) is not None or name.strip().lower() in _COORDINATES


def by_unit(heading: HeadingCell, stated: Meaning | None) -> Meaning | None:
    """Meaning of a heading; a deflection in volts is a signal, and a δ in degrees a phase."""
    if stated is not None and stated.quantity == "deflection" and heading.unit in ("V", "mV"):
        return Meaning("signal")
    if heading.name.strip() == "δ" and heading.unit in ("°", "deg", "rad", "mrad"):
        return Meaning("phase_angle")
    return stated


def column_scale(source: str, heading: HeadingCell, stated: Meaning) -> UnitScale:
    """Scale of a column to SI; ValueError for a unit that is missing or measures something else."""
    where = f"{source}:{heading.line}: column {heading.text!r}"
    frequency = stated.quantity in ("frequency", "angular_frequency")
    if stated.quantity == "strain":
        return _strain_scale(where, heading)
    dimension = "pressure" if stated.quantity == "modulus" else QUANTITIES.get(stated.quantity)
    if dimension is None and not frequency:
        if heading.unit is not None and heading.unit.lower() not in _NO_UNIT:
            raise ValueError(f"{where}: {stated.quantity} has no unit, got {heading.unit!r}")
        return UnitScale(1.0)
    if heading.unit is None or (heading.unit in _NO_UNIT and heading.unit != "1"):
        example = DIMENSIONS[dimension or "frequency"].unit
        raise ValueError(
            f"{where}: has no unit; write e.g. '{heading.name} [{example}]', or a second row "
            "of units"
        )
    unit = _SPELT.get(heading.unit, heading.unit)
    try:
        if frequency:
            return _angular(stated.quantity, unit)
        assert dimension is not None  # only frequencies have none
        return parse_scale(unit, dimension)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from error


def _strain_scale(where: str, heading: HeadingCell) -> UnitScale:
    # Without a unit, 0.5 may be 0.5 or 0.5 %.
    if heading.unit not in STRAIN_UNITS:
        got = "it has none" if heading.unit is None else f"got {heading.unit!r}"
        raise ValueError(
            f"{where}: a strain has one of the units {', '.join(STRAIN_UNITS)}, {got}; write e.g. "
            f"'{heading.name} [%]'"
        )
    return UnitScale(STRAIN_UNITS[heading.unit])


def _angular(quantity: str, unit: str) -> UnitScale:
    """Scale to rad/s; 1/s is a frequency or an angular frequency by the name of the column."""
    try:
        return parse_scale(unit, "angular frequency")
    except ValueError:
        factor = parse_scale(unit, "frequency").factor
    if quantity == "frequency":
        return UnitScale(2 * math.pi * factor)
    if "hz" in unit.lower():
        raise ValueError(
            f"an angular frequency is in rad/s, got {unit!r}: call a frequency in {unit} 'f', or "
            "give the unit rad/s"
        )
    return UnitScale(factor)
