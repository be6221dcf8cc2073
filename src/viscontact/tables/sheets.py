"""Spreadsheets as tables: the sheet that is read, and its rows of cells."""

from __future__ import annotations

import difflib
import re
import zipfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from viscontact.tables.text import Row, looks_like_number, require_file

if TYPE_CHECKING:
    from python_calamine import CalamineWorkbook

#: Suffixes of spreadsheets: of Excel, old and new, and of LibreOffice.
SPREADSHEETS = (".xlsx", ".xlsm", ".xls", ".ods")

_NAME = re.compile(r"(?P<file>.+\.(?:xlsx|xlsm|xls|ods))#(?P<sheet>.+)", re.IGNORECASE)
_DIMENSION = re.compile(rb'<dimension ref="[A-Z]+\d+:([A-Z]+)(\d+)"')
# A sheet is read as a full rectangle; a single cell far away would fill the memory.
_MOST_CELLS = 20_000_000
# Largest whole number of a cell that is written without an exponent.
_WHOLE = 1e15


@dataclass(frozen=True)
class Sheet:
    """Rows of a sheet that are not empty, the name of the sheet, and other sheets with rows."""

    name: str
    rows: list[Row]
    others: tuple[str, ...] = ()


def split_sheet(path: Path) -> tuple[Path, str | None]:
    """File and sheet of a path such as ``creep.xlsx#Sheet2``; None without a sheet.

    >>> split_sheet(Path("a/creep.xlsx#23 C")), split_sheet(Path("creep#1.csv"))[1]
    ((PosixPath('a/creep.xlsx'), '23 C'), None)
    """
    found = _NAME.fullmatch(path.name)
    if found is None or path.exists():
        return path, None
    return path.with_name(found["file"]), found["sheet"]


def is_spreadsheet(path: Path) -> bool:
    """True for the name of a spreadsheet, with or without that of a sheet.

    >>> is_spreadsheet(Path("creep.ods#Data")), is_spreadsheet(Path("creep.csv"))
    (True, False)
    """
    return split_sheet(path)[0].suffix.lower() in SPREADSHEETS


def read_sheet(path: Path, holds: Callable[[list[Row]], bool] | None = None) -> Sheet:
    """Read the named sheet of a spreadsheet, or the first with a table; rows count from 1.

    `holds` tells whether rows are the wanted table; without it, numbers below a row are one.
    """
    # Titles above the table, and empty columns before and behind it, are left out.
    from python_calamine import CalamineError, CalamineWorkbook  # slow to load, and rarely needed

    file, wanted = split_sheet(path)
    require_file(file)
    _refuse_far_cells(file)
    try:
        with CalamineWorkbook.from_path(file) as book:
            return _choose_sheet(file.name, book, wanted, holds or _holds_table)
    except (CalamineError, OSError) as error:
        raise ValueError(
            f"{file.name}: cannot be read as a spreadsheet: {error}; open it and save it again, "
            "without a password, or save the sheet as CSV"
        ) from error


def _choose_sheet(
    name: str, book: CalamineWorkbook, wanted: str | None, holds: Callable[[list[Row]], bool]
) -> Sheet:
    if wanted is not None:
        if wanted not in book.sheet_names:
            near = difflib.get_close_matches(wanted, book.sheet_names, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            listed = ", ".join(map(repr, book.sheet_names))
            raise ValueError(f"{name}: has no sheet {wanted!r}{hint}; there are {listed}")
        rows = _rows(book, wanted)
        if not rows:
            raise ValueError(f"{name}#{wanted} is empty")
        others = () if holds(rows) else _holding(_shown_sheets(book), holds)
        return Sheet(wanted, rows, tuple(each for each in others if each != wanted))
    read = _shown_sheets(book)
    if not read:
        raise ValueError(f"{name} is empty; the first row of a table names columns and units")
    found = _holding(read, holds)
    first = (*found, *_holding(read, _holds_table), *read)[0]
    return Sheet(first, read[first], tuple(each for each in found if each != first))


def _shown_sheets(book: CalamineWorkbook) -> dict[str, list[Row]]:
    """Rows of the sheets that are neither hidden nor empty."""
    shown = [
        each.name for each in book.sheets_metadata if each.visible == type(each.visible).Visible
    ]
    return {each: rows for each in shown if (rows := _rows(book, each))}


def _holding(sheets: dict[str, list[Row]], holds: Callable[[list[Row]], bool]) -> tuple[str, ...]:
    return tuple(name for name, rows in sheets.items() if holds(rows))


def _holds_table(rows: list[Row]) -> bool:
    """True if there are numbers below the first row."""
    return any(looks_like_number(cell) for row in rows[1:] for cell in row.cells)


def _rows(book: CalamineWorkbook, name: str) -> list[Row]:
    sheet = book.get_sheet_by_name(name)
    above = sheet.start[0] if sheet.start is not None else 0
    found = [
        Row(line, tuple(map(_text, cells)))
        for line, cells in enumerate(sheet.to_python(), start=above + 1)
    ]
    return _without_margins([row for row in found if any(row.cells)])


def _without_margins(rows: list[Row]) -> list[Row]:
    """Rows without titles above the table, and without empty columns beside it."""
    width = max((sum(map(bool, row.cells)) for row in rows), default=0)
    start = next((i for i, row in enumerate(rows) if not _is_title(row, width)), 0)
    rows = rows[start:]
    filled = {place for row in rows for place, cell in enumerate(row.cells) if cell}
    begin, end = min(filled, default=0), max(filled, default=-1) + 1
    return [Row(row.line, row.cells[begin:end]) for row in rows]


def _is_title(row: Row, width: int) -> bool:
    """True for a single text above rows of several cells."""
    cells = [cell for cell in row.cells if cell]
    return len(cells) == 1 < width and not looks_like_number(cells[0])


def _text(value: object) -> str:
    """Text of a cell; a number has all its digits, and a date is one as ISO 8601 writes it."""
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, float):
        return f"{value:.0f}" if value.is_integer() and abs(value) < _WHOLE else repr(value)
    return str(value)


def _refuse_far_cells(file: Path) -> None:
    """Refuse sheets whose stated extent does not fit into the memory."""
    with suppress(OSError, zipfile.BadZipFile), zipfile.ZipFile(file) as packed:
        for part in packed.namelist():
            if not re.fullmatch(r"xl/worksheets/[^/]+\.xml", part):
                continue
            with packed.open(part) as sheet:
                stated = _DIMENSION.search(sheet.read(4096))
            if stated and _column(stated[1]) * int(stated[2]) > _MOST_CELLS:
                corner = (stated[1] + stated[2]).decode()
                raise ValueError(
                    f"{file.name}: a sheet extends to the cell {corner}; delete the cells far away "
                    "from the table, or save the table as CSV"
                )


def _column(letters: bytes) -> int:
    """Number of a column, from 1."""
    number = 0
    for letter in letters:
        number = 26 * number + letter - ord("A") + 1
    return number
