"""Header of a table: columns, quantities and units from its first one or two rows."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from viscontact.tables.creep_tests import STRAIN_UNITS, chosen_level, split_stress
from viscontact.tables.names import QUANTITIES, Data, Meaning, known_names, meaning
from viscontact.tables.text import Row, looks_like_number
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
# Stress and strain are those of a creep test if there is nothing else to be measured.
_OF_CREEP_TEST = ("time", "temperature", "set", "creep_modulus", "strain", "stress")


@dataclass(frozen=True)
class Column:
    """Column to read: its place from 0, heading, meaning, scale to SI, and stress [Pa]."""

    place: int
    heading: str
    meaning: Meaning
    scale: UnitScale
    stress: float | None = None

    def si(self, number: str) -> float:
        """SI value of a number in the column."""
        value = self.scale.si(number)
        if self.meaning.quantity != "creep_modulus":
            return value
        if value == 0.0:
            raise ValueError(f"{number!r} is no modulus")
        return 1.0 / value

    @property
    def quantity(self) -> str:
        """Quantity of the SI values."""
        named = self.meaning.quantity
        return "creep_compliance" if named == "creep_modulus" else named


@dataclass(frozen=True)
class Header:
    """Columns to read, headings left out, cells in a row, header rows (1, 2), stress [Pa]."""

    columns: tuple[Column, ...]
    left_out: tuple[str, ...]
    width: int
    rows: int
    stress: float | None = None

    @property
    def data(self) -> Data | None:
        """Kind of test that the headings state, or None."""
        return next((c.meaning.data for c in self.columns if c.meaning.data), None)


@dataclass(frozen=True)
class _Heading:
    """Cell of the header: its text, the name and unit in it, its line, and a stress [Pa]."""

    text: str
    name: str
    unit: str | None
    line: int
    stress: float | None = None


def read_header(
    source: str,
    rows: list[Row],
    columns: Mapping[str, str | None],
    stress: float | None = None,
) -> Header:
    """Read the header; `columns` maps headings to quantities, `stress` [Pa] chooses a test."""
    _require_names(source, rows[0])
    cells = _without_empty_end(rows[0].cells)
    headings = [_heading(cell, rows[0].line) for cell in cells]
    in_two_rows = len(rows) > 1 and _are_units(headings, rows[1].cells)
    if in_two_rows:
        units = (*rows[1].cells, *[""] * len(cells))
        headings = [
            _with_unit(heading, unit.strip("[]() "), rows[1].line)
            for heading, unit in zip(headings, units, strict=False)
        ]
    meanings = _meanings(source, headings, columns)
    found = tuple(
        Column(place, heading.text, stated, _scale(source, heading, stated), heading.stress)
        for place, (heading, stated) in enumerate(zip(headings, meanings, strict=True))
        if stated is not None
    )
    found, level = _at_stress(source, found, stress)
    read = {column.place for column in found}
    left = tuple(h.text for place, h in enumerate(headings) if h.text and place not in read)
    _require_some(source, rows[0].line, found, left)
    found = tuple(_settle_meaning(source, column, found) for column in found)
    _require_once(source, found)
    return Header(found, left, len(cells), 2 if in_two_rows else 1, level)


def _require_names(source: str, row: Row) -> None:
    if any(looks_like_number(cell) for cell in row.cells):
        raise ValueError(
            f"{source}:{row.line}: there is no header; the first row names columns and units, as "
            "'time [s], creep_compliance [1/MPa]'; the names of all columns can be given in columns"
        )


def _without_empty_end(cells: tuple[str, ...]) -> tuple[str, ...]:
    # Spreadsheets export empty columns at the end.
    end = max((place for place, cell in enumerate(cells, start=1) if cell), default=0)
    return cells[:end]


def _at_stress(
    source: str, columns: tuple[Column, ...], stress: float | None
) -> tuple[tuple[Column, ...], float | None]:
    """Columns without those of creep tests at other stresses, and the stress that is left [Pa]."""
    levels = [column.stress for column in columns if column.stress is not None]
    if not levels:
        if stress is not None and not any(_is_of_creep_test(c.meaning) for c in columns):
            raise ValueError(f"{source}: has no strain of a creep test; leave the stress out")
        return columns, stress
    level = chosen_level(source, sorted(set(levels)), stress)
    return tuple(column for column in columns if column.stress in (None, level)), level


def quantity_named(cell: str, columns: Mapping[str, str | None]) -> str | None:
    """Quantity that the text of a heading names, by itself or by `columns`; None if it names none.

    >>> quantity_named("Zeit [min]", {}), quantity_named("u", {"u": "approach"})
    ('time', 'approach')
    """
    if len(cell) > _LONGEST_HEADING:
        return None
    found = _heading(cell, 0)
    for name in (found.text, found.name):
        if name in columns:
            return columns[name]
    stated = _by_unit(found, meaning(found.name))
    return None if stated is None else stated.quantity


def _heading(text: str, line: int) -> _Heading:
    name, stress = split_stress(text)
    if stress is not None:
        return _Heading(text, name, None, line, stress)
    found = _unit_of(text, line)
    name, stress = split_stress(found.name)
    return found if stress is None else _Heading(text, name, found.unit, line, stress)


def _unit_of(text: str, line: int) -> _Heading:
    if len(text) > _LONGEST_HEADING or meaning(text) is not None:
        return _Heading(text, text, None, line)
    for pattern in (*_BRACKETS, *_LOOSE):
        match = pattern.fullmatch(text)
        if match and (pattern in _BRACKETS or _is_known(match["name"])):
            return _Heading(text, match["name"], match["unit"].strip(), line)
    return _Heading(text, text, None, line)


def _is_known(name: str) -> bool:
    return meaning(name) is not None or name.strip().lower() in _COORDINATES


def _are_units(headings: list[_Heading], cells: tuple[str, ...]) -> bool:
    """True if the second row holds units: it has no numbers, and a known name above has no unit."""
    lacking = any(h.unit is None and (not h.name or _is_known(h.name)) for h in headings)
    without = lacking or all(h.unit is None for h in headings)
    return without and not any(map(looks_like_number, cells))


def _with_unit(heading: _Heading, unit: str, line: int) -> _Heading:
    """Heading with the unit of the second row, unless it has one and the row none."""
    if heading.unit is not None and not unit:
        return heading
    name = heading.text if heading.unit is not None else heading.name
    return _Heading(heading.text, name, unit, line, heading.stress)


def _meanings(
    source: str, headings: list[_Heading], given: Mapping[str, str | None]
) -> list[Meaning | None]:
    known = {*QUANTITIES, "frequency"}
    for heading, quantity in given.items():
        if quantity is not None and quantity not in known:
            raise ValueError(
                f"columns: {quantity!r} is no quantity; there are {', '.join(sorted(known))}"
            )
        if not any(heading in (h.text, h.name) for h in headings):
            found = ", ".join(repr(h.text) for h in headings)
            raise ValueError(f"columns: {source} has no column {heading!r}; there are {found}")
    meant = [_by_unit(h, _meaning(source, h, given)) for h in headings]
    meant = _without_idle_moduli(meant)
    if all(each is None or each.quantity in _OF_CREEP_TEST for each in meant):
        return meant
    named = {heading for heading, quantity in given.items() if quantity in ("strain", "stress")}
    return [
        stated if named & {heading.text, heading.name} or not _is_of_creep_test(stated) else None
        for heading, stated in zip(headings, meant, strict=True)
    ]


def _without_idle_moduli(meant: list[Meaning | None]) -> list[Meaning | None]:
    """Meanings without |G*| and the phase angle where storage and loss are there, or one lacks."""
    found = {each.quantity for each in meant if each is not None}
    has_loss = bool(found & {"loss_modulus", "loss_tangent"})
    idle = set()
    if "storage_modulus" in found or ("phase_angle" not in found and "loss_tangent" not in found):
        idle.add("complex_modulus")
    if has_loss or not found & {"storage_modulus", "complex_modulus"}:
        idle.add("phase_angle")
    return [None if each is not None and each.quantity in idle else each for each in meant]


def _by_unit(heading: _Heading, stated: Meaning | None) -> Meaning | None:
    """Meaning of a heading; a deflection in volts is a signal, and a δ in degrees a phase."""
    if stated is not None and stated.quantity == "deflection" and heading.unit in ("V", "mV"):
        return Meaning("signal")
    if heading.name.strip() == "δ" and heading.unit in ("°", "deg", "rad", "mrad"):
        return Meaning("phase_angle")
    return stated


def _is_of_creep_test(stated: Meaning | None) -> bool:
    return stated is not None and stated.quantity in ("strain", "stress")


def _meaning(source: str, heading: _Heading, given: Mapping[str, str | None]) -> Meaning | None:
    stated = meaning(heading.name)
    for name in (heading.text, heading.name):
        if name in given:
            quantity = given[name]
            return None if quantity is None else Meaning(quantity, stated.data if stated else None)
    if stated is None:
        # Nearly a known name: a misspelling, not another column.
        near = difflib.get_close_matches(heading.name.lower(), known_names(), n=1, cutoff=0.85)
        if near:
            raise ValueError(
                f"{source}:{heading.line}: column {heading.text!r}: did you mean {near[0]!r}? "
                f"If not, leave it out with columns={{{heading.text!r}: None}}"
            )
    return stated


def _scale(source: str, heading: _Heading, stated: Meaning) -> UnitScale:
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


def _strain_scale(where: str, heading: _Heading) -> UnitScale:
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


def _require_some(source: str, line: int, found: tuple[Column, ...], left: tuple[str, ...]) -> None:
    if found:
        return
    listed = ", ".join(map(repr, left))
    where = (
        f"none of the columns {listed} is known"
        if line == 1
        else f"no line names a known quantity; line {line} looks most like a heading, with {listed}"
    )
    raise ValueError(
        f"{source}: {where}; names are e.g. {', '.join(QUANTITIES)}, each with its unit, as "
        "'time [s]'; the names of all columns can be given in columns"
    )


def _settle_meaning(source: str, column: Column, columns: tuple[Column, ...]) -> Column:
    """Column with its meaning among the others: E over time is a relaxation modulus."""
    stated = column.meaning
    quantity = "angular_frequency" if stated.quantity == "frequency" else stated.quantity
    frequency = any("frequency" in c.meaning.quantity for c in columns)
    if quantity in ("modulus", "creep_compliance") and frequency:
        raise ValueError(
            f"{source}: column {column.heading!r} is ambiguous with a frequency; name its quantity "
            f"with columns={{{column.heading!r}: 'storage_modulus'}}, or None to leave it out"
        )
    quantity = "relaxation_modulus" if quantity == "modulus" else quantity
    settled = Meaning(quantity, stated.data, stated.logarithm)
    return Column(column.place, column.heading, settled, column.scale)


def _require_once(source: str, columns: tuple[Column, ...]) -> None:
    seen: dict[str, Column] = {}
    for column in columns:
        other = seen.setdefault(column.quantity, column)
        if other is not column:
            raise ValueError(
                f"{source}: the columns {other.heading!r} and {column.heading!r} are both "
                f"{column.quantity}; leave one out with columns={{{column.heading!r}: "
                "None}"
            )
    stated = {column.meaning.data: column.heading for column in columns if column.meaning.data}
    if len(stated) > 1:
        found = " and ".join(f"{heading!r} ({data})" for data, heading in stated.items())
        raise ValueError(f"{source}: columns of different tests, {found}; give one test a file")
