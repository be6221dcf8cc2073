"""Header of a table: columns, quantities and units from its first one or two rows."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from viscontact.tables.names import QUANTITIES, Data, Meaning, known_names, meaning
from viscontact.tables.text import Row, looks_like_number
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.parsing import Scale, parse_scale

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


@dataclass(frozen=True)
class Column:
    """Column to read: its place from 0, heading, meaning, and scale to SI."""

    place: int
    heading: str
    meaning: Meaning
    scale: Scale


@dataclass(frozen=True)
class Header:
    """Columns to read, headings left out, cells in a row, and header rows (1, or 2 with units)."""

    columns: tuple[Column, ...]
    left_out: tuple[str, ...]
    width: int
    rows: int

    @property
    def data(self) -> Data | None:
        """Kind of test that the headings state, or None."""
        return next((c.meaning.data for c in self.columns if c.meaning.data), None)


@dataclass(frozen=True)
class _Heading:
    """Cell of the header: its text, the name and unit in it, and its line."""

    text: str
    name: str
    unit: str | None
    line: int


def read_header(source: str, rows: list[Row], columns: Mapping[str, str | None]) -> Header:
    """Read the header; `columns` maps headings to quantities, or to None to leave them out."""
    _require_names(source, rows[0])
    cells = _without_empty_end(rows[0].cells)
    headings = [_heading(cell, rows[0].line) for cell in cells]
    in_two_rows = len(rows) > 1 and _are_units(headings, rows[1].cells)
    if in_two_rows:
        units = (*rows[1].cells, *[""] * len(cells))
        headings = [
            _Heading(h.text, h.name, unit.strip("[]() "), rows[1].line)
            for h, unit in zip(headings, units, strict=False)
        ]
    meanings = _meanings(source, headings, columns)
    found = tuple(
        Column(place, heading.text, stated, _scale(source, heading, stated))
        for place, (heading, stated) in enumerate(zip(headings, meanings, strict=True))
        if stated is not None
    )
    left = tuple(h.text for h, stated in zip(headings, meanings, strict=True) if stated is None)
    _require_some(source, found, left)
    found = tuple(_settled(source, column, found) for column in found)
    _require_once(source, found)
    return Header(found, left, len(cells), 2 if in_two_rows else 1)


def _require_names(source: str, row: Row) -> None:
    if any(looks_like_number(cell) for cell in row.cells):
        raise ValueError(
            f"{source}:{row.line}: there is no header; the first row names columns and units, as "
            "'time [s], creep_compliance [1/MPa]'"
        )


def _without_empty_end(cells: tuple[str, ...]) -> tuple[str, ...]:
    # Spreadsheets export empty columns at the end.
    end = max((place for place, cell in enumerate(cells, start=1) if cell), default=0)
    return cells[:end]


def _heading(text: str, line: int) -> _Heading:
    if len(text) > _LONGEST_HEADING or meaning(text) is not None:
        return _Heading(text, text, None, line)
    for pattern in (*_BRACKETS, *_LOOSE):
        match = pattern.fullmatch(text)
        if match and (pattern in _BRACKETS or meaning(match["name"])):
            return _Heading(text, match["name"], match["unit"].strip(), line)
    return _Heading(text, text, None, line)


def _are_units(headings: list[_Heading], cells: tuple[str, ...]) -> bool:
    """True if the second row holds units: no unit in the first, and no numbers."""
    return all(h.unit is None for h in headings) and not any(map(looks_like_number, cells))


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
    return [_meaning(source, heading, given) for heading in headings]


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


def _scale(source: str, heading: _Heading, stated: Meaning) -> Scale:
    where = f"{source}:{heading.line}: column {heading.text!r}"
    frequency = stated.quantity in ("frequency", "angular_frequency")
    dimension = "pressure" if stated.quantity == "modulus" else QUANTITIES.get(stated.quantity)
    if dimension is None and not frequency:
        if heading.unit is not None and heading.unit.lower() not in _NO_UNIT:
            raise ValueError(f"{where}: {stated.quantity} has no unit, got {heading.unit!r}")
        return Scale(1.0)
    if heading.unit is None or (heading.unit in _NO_UNIT and heading.unit != "1"):
        example = DIMENSIONS[dimension or "frequency"].unit
        raise ValueError(
            f"{where}: has no unit; write e.g. '{heading.name} [{example}]', or a second row "
            "of units"
        )
    try:
        if frequency:
            return _angular(stated.quantity, heading.unit)
        assert dimension is not None  # only frequencies have none
        return parse_scale(heading.unit, dimension)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from error


def _angular(quantity: str, unit: str) -> Scale:
    """Scale to rad/s; 1/s is a frequency or an angular frequency by the name of the column."""
    try:
        return parse_scale(unit, "angular frequency")
    except ValueError:
        factor = parse_scale(unit, "frequency").factor
    if quantity == "frequency":
        return Scale(2 * math.pi * factor)
    if "hz" in unit.lower():
        raise ValueError(
            f"an angular frequency is in rad/s, got {unit!r}: call a frequency in {unit} 'f', or "
            "give the unit rad/s"
        )
    return Scale(factor)


def _require_some(source: str, found: tuple[Column, ...], left: tuple[str, ...]) -> None:
    if not found:
        raise ValueError(
            f"{source}: none of the columns {', '.join(map(repr, left))} is known; names are e.g. "
            f"{', '.join(QUANTITIES)}, each with its unit, as 'time [s]'"
        )


def _settled(source: str, column: Column, columns: tuple[Column, ...]) -> Column:
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
        other = seen.setdefault(column.meaning.quantity, column)
        if other is not column:
            raise ValueError(
                f"{source}: the columns {other.heading!r} and {column.heading!r} are both "
                f"{column.meaning.quantity}; leave one out with columns={{{column.heading!r}: "
                "None}"
            )
    stated = {column.meaning.data: column.heading for column in columns if column.meaning.data}
    if len(stated) > 1:
        found = " and ".join(f"{heading!r} ({data})" for data, heading in stated.items())
        raise ValueError(f"{source}: columns of different tests, {found}; give one test a file")
