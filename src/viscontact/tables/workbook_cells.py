"""Cells of a spreadsheet as texts, read by calamine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from viscontact.backend.record import Record
from viscontact.tables.text import MOST_ROWS, looks_like_number

if TYPE_CHECKING:
    from python_calamine import CalamineWorkbook

# Largest whole number of a cell that is written without an exponent.
_WHOLE = 1e15

#: Number of a row, from 1, and its cells.
_Cells = tuple[int, tuple[str, ...]]


def read_workbook(file: Path, wanted: str | None) -> Record:
    """Names of all sheets, and rows of those that are not empty and either shown or `wanted`.

    Empty rows, titles above the table, and empty columns before and behind it are left out.
    """
    # Slow to load, and rarely needed.
    from python_calamine import CalamineError, CalamineWorkbook

    try:
        with CalamineWorkbook.from_path(file) as book:
            shown = [
                each.name
                for each in book.sheets_metadata
                if each.visible == type(each.visible).Visible or each.name == wanted
            ]
            sheets = {each: rows for each in shown if (rows := _rows(file.name, book, each))}
            return Record({"names": book.sheet_names, "sheets": sheets})
    except (CalamineError, OSError) as error:
        raise ValueError(
            f"{file.name}: cannot be read as a spreadsheet: {error}; open it and save it again, "
            "without a password, or save the sheet as CSV"
        ) from error


def _rows(file: str, book: CalamineWorkbook, name: str) -> list[_Cells]:
    sheet = book.get_sheet_by_name(name)
    above = sheet.start[0] if sheet.start is not None else 0
    found = [
        (line, tuple(map(_text, cells)))
        for line, cells in enumerate(sheet.to_python(), start=above + 1)
    ]
    filled = [(line, cells) for line, cells in found if any(cells)]
    if len(filled) > MOST_ROWS:
        raise ValueError(f"{file}#{name}: more than {MOST_ROWS} rows; keep fewer of them")
    return _without_margins(filled)


def _without_margins(rows: list[_Cells]) -> list[_Cells]:
    """Rows without titles above the table, and without empty columns beside it."""
    width = max((sum(map(bool, cells)) for _, cells in rows), default=0)
    start = next((i for i, (_, cells) in enumerate(rows) if not _is_title(cells, width)), 0)
    rows = rows[start:]
    filled = {place for _, cells in rows for place, cell in enumerate(cells) if cell}
    begin, end = min(filled, default=0), max(filled, default=-1) + 1
    return [(line, cells[begin:end]) for line, cells in rows]


def _is_title(row: tuple[str, ...], width: int) -> bool:
    """True for a single text above rows of several cells."""
    cells = [cell for cell in row if cell]
    return len(cells) == 1 < width and not looks_like_number(cells[0])


def _text(value: object) -> str:
    """Text of a cell; a number has all its digits, and a date is one as ISO 8601 writes it."""
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, float):
        return f"{value:.0f}" if value.is_integer() and abs(value) < _WHOLE else repr(value)
    return str(value)
