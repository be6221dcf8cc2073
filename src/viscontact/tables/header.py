"""Header of a table: columns, quantities and units from its first one or two rows."""

from __future__ import annotations

import difflib
from collections.abc import Mapping

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.creep_tests import chosen_level
from viscontact.tables.heading_cells import (
    HeadingCell,
    by_unit,
    column_scale,
    heading_cell,
    is_known,
)
from viscontact.tables.names import QUANTITIES, Data, Meaning, known_names, meaning
from viscontact.tables.text import Row, looks_like_number
from viscontact.units.parsing import UnitScale

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


def read_header(
    source: str,
    rows: list[Row],
    columns: Mapping[str, str | None],
    stress: float | None = None,
) -> Header:
    """Read the header; `columns` maps headings to quantities, `stress` [Pa] chooses a test."""
    _require_names(source, rows[0])
    cells = _without_empty_end(rows[0].cells)
    headings = [heading_cell(cell, rows[0].line) for cell in cells]
    in_two_rows = len(rows) > 1 and _are_units(headings, rows[1].cells)
    if in_two_rows:
        units = (*rows[1].cells, *[""] * len(cells))
        headings = [
            _with_unit(heading, unit.strip("[]() "), rows[1].line)
            for heading, unit in zip(headings, units, strict=False)
        ]
    meanings = _meanings(source, headings, columns)
    found = tuple(
        Column(place, heading.text, stated, column_scale(source, heading, stated), heading.stress)
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
            found = ", ".join(repr(column.heading) for column in columns)
            raise ValueError(
                f"{source}: has no strain of a creep test; there are {found}; leave the stress out"
            )
        return columns, stress
    level = chosen_level(source, sorted(set(levels)), stress)
    return tuple(column for column in columns if column.stress in (None, level)), level


def _are_units(headings: list[HeadingCell], cells: tuple[str, ...]) -> bool:
    """True if the second row holds units: it has no numbers, and a known name above has no unit."""
    lacking = any(h.unit is None and (not h.name or is_known(h.name)) for h in headings)
    without = lacking or all(h.unit is None for h in headings)
    return without and not any(map(looks_like_number, cells))


def _with_unit(heading: HeadingCell, unit: str, line: int) -> HeadingCell:
    """Heading with the unit of the second row, unless it has one and the row none."""
    if heading.unit is not None and not unit:
        return heading
    name = heading.text if heading.unit is not None else heading.name
    return HeadingCell(heading.text, name, unit, line, heading.stress)


def _meanings(
    source: str, headings: list[HeadingCell], given: Mapping[str, str | None]
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
    meant = [by_unit(h, _meaning(source, h, given)) for h in headings]
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


def _is_of_creep_test(stated: Meaning | None) -> bool:
    return stated is not None and stated.quantity in ("strain", "stress")


def _meaning(source: str, heading: HeadingCell, given: Mapping[str, str | None]) -> Meaning | None:
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
