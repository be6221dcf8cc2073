"""Columns that the reader of a table is told: names of all of them, or meanings of some."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from viscontact.tables.heading_cells import heading_cell
from viscontact.tables.names import QUANTITIES, meaning
from viscontact.tables.text import Row, looks_like_number

#: What a caller states of the columns: meanings by heading, or a heading line.
GivenColumns = Mapping[str, str | None] | str | None

_EXAMPLE = "'time [s], force [nN]'"


def parted_columns(given: GivenColumns) -> tuple[Mapping[str, str | None], tuple[str, ...]]:
    """Meanings by heading, and names of all columns, if they are given.

    A text is a heading line, ``time [s], , force [nN]`` with nothing for a column that is not read,
    or meanings, ``E_1=relaxation_modulus, remark=``.
    """
    if given is None:
        return {}, ()
    if not isinstance(given, str):
        return given, ()
    mark = next((each for each in ";\t" if each in given), ",")
    cells = [cell.strip() for cell in given.split(mark)]
    if not any(cells):
        raise ValueError(f"columns: names no column; write e.g. {_EXAMPLE}")
    if all("=" in cell for cell in cells):
        pairs = (cell.rpartition("=") for cell in cells)
        return {heading.strip(): meant.strip() or None for heading, _, meant in pairs}, ()
    return _named_quantities(cells), tuple(cells)


def _named_quantities(headings: list[str]) -> dict[str, str | None]:
    """Quantities that are known by name only where a caller names the columns."""
    named = ((heading, heading_cell(heading, 0).name.strip()) for heading in headings if heading)
    return {
        heading: name for heading, name in named if name in QUANTITIES and meaning(name) is None
    }


def with_typed_meanings(message: str, name: str) -> str:
    """A message whose meanings of columns are text: ``columns={'E': None}`` is ``NAME 'E='``."""

    def typed(match: re.Match[str]) -> str:
        return f"{name} '{match[2]}={'' if match[3] == 'None' else match[3]}'"

    return re.sub(r"columns=\{(['\"])(.+?)\1: '?(\w+)'?\}", typed, message)


def with_given_heading(
    source: str, rows: list[Row], names: tuple[str, ...], known: Callable[[str], bool]
) -> list[Row]:
    """Rows of a table below the given names, from the first one on that has numbers there."""
    for name in filter(None, names):
        if not known(name):
            raise ValueError(
                f"columns: {name!r} names no known quantity; write e.g. {_EXAMPLE}, and nothing "
                "for a column that is not to be read"
            )
    places = [place for place, name in enumerate(names) if name]
    first = next((i for i, row in enumerate(rows) if _has_numbers(row, places)), None)
    width = max(
        (place for row in rows[first:] for place, cell in enumerate(row.cells, 1) if cell),
        default=0,
    )
    if first is None or width != len(names):
        raise ValueError(
            f"columns: {len(names)} names, but {source} has {width} columns; name each, as "
            f"{_EXAMPLE}, and write nothing between the commas for one that is not to be read"
        )
    return [Row(rows[first].line, names), *rows[first:]]


def _has_numbers(row: Row, places: list[int]) -> bool:
    return max(places) < len(row.cells) and all(looks_like_number(row.cells[p]) for p in places)
