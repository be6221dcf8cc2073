"""Table of runs, CSV or spreadsheet: headings are keys of the case, each row is a run."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from viscontact.studies.sweep.designs import Design, Heading
from viscontact.tables import Row, decimal_number, looks_like_number, read_rows

# "load.force [N]" or "load.force (kN)"; brackets with a number at the key are an entry of a list.
_HEADING = re.compile(
    r"(?P<key>[^\s\[\]()]+(?:\[\d+\][^\s\[\]()]*)*)"
    r"(?:\s*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>.*)\)))?"
)
_NO_UNIT = ("", "-", "–", "—", "1", "none")


def read_design(path: Path) -> Design:
    """Read a table of runs; ValueError names its line and column."""
    # A cell below a heading with a unit is a number; any other cell is a value as ``--set`` takes
    # it.
    header, *rows = read_rows(path, example="load.force [N], time.end")
    columns = _columns(path, header)
    if not rows:
        raise ValueError(f"{path}: has a header and no rows; write a row for each run")
    numbers = [cell for row in rows for cell in row.cells if looks_like_number(cell)]
    mark = "," if any("," in cell for cell in numbers) else "."
    return Design(
        "table",
        tuple(column.key for column in columns),
        tuple(_values(path, row, columns, mark) for row in rows),
        tuple(row.line for row in rows),
        tuple(columns),
    )


def _columns(path: Path, header: Row) -> list[Heading]:
    cells = list(header.cells)
    while cells and not cells[-1]:  # spreadsheets export empty columns at the end
        cells.pop()
    columns = [_column(f"{path}:{header.line}", place, cell) for place, cell in enumerate(cells, 1)]
    for key, count in Counter(column.key for column in columns).items():
        if count > 1:
            raise ValueError(f"{path}:{header.line}: {count} columns are {key}; leave one of them")
    return columns


def _column(where: str, place: int, cell: str) -> Heading:
    example = "as 'load.force [N]'"
    if looks_like_number(cell):
        raise ValueError(
            f"{where}: there is no header, but {cell!r} in column {place}; the first row names the "
            f"keys and units, {example}"
        )
    found = _HEADING.fullmatch(cell)
    if found is None:
        shown = repr(cell[:60]) if cell else "is empty,"
        raise ValueError(
            f"{where}: column {place}: the heading {shown} names no key; write a key and, in "
            f"brackets, a unit, {example}"
        )
    unit = (found["square"] or found["round"] or "").strip()
    return Heading(cell, found["key"], "" if unit in _NO_UNIT else unit)


def _values(path: Path, row: Row, columns: list[Heading], mark: str) -> tuple[str, ...]:
    missing = columns[len(row.cells) :]
    if missing or any(row.cells[len(columns) :]):
        remedy = (
            f"add a value of {missing[0].text!r}"
            if missing
            else "write a cell with commas in quotes, and decimal commas with semicolons between "
            "the cells"
        )
        raise ValueError(
            f"{path}:{row.line}: has {len(row.cells)} cell{'s' if len(row.cells) > 1 else ''}, the "
            f"header {len(columns)}; {remedy}"
        )
    cells = zip(row.cells, columns, strict=False)
    return tuple(_value(f"{path}:{row.line}", cell, column, mark) for cell, column in cells)


def _value(where: str, cell: str, column: Heading, mark: str) -> str:
    try:
        if cell and not column.unit and not looks_like_number(cell):
            return cell
        number = decimal_number(cell, mark)
    except ValueError as error:
        raise ValueError(f"{where}: column {column.text!r}: {error}{_hint(cell, column)}") from None
    return f"{number} {column.unit}" if column.unit else number


def _hint(cell: str, column: Heading) -> str:
    """Remedy for a cell with a unit of its own; empty for any other."""
    if not (column.unit and re.match(r"[+-]?[\d.,]+\s*[^\W\d]", cell)):
        return ""
    return (
        f"; write it without unit, as the heading has one, or name the heading {column.key!r} and "
        "write a unit in each cell"
    )
