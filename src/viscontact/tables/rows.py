"""Rows of cells of a file: text or spreadsheet."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.headings import FoundTable, Names, find_table
from viscontact.tables.sheets import is_spreadsheet, read_sheet, split_sheet
from viscontact.tables.splitting import TextRows, rows_of_text
from viscontact.tables.text import Row

_EXAMPLE = "time [s], force [kN]"


@dataclass(frozen=True)
class SourceTable:
    """Table in a file: its path with the sheet, where there are several, and its rows.

    `others` are further sheets that hold such a table.
    """

    path: Path
    found: FoundTable
    others: tuple[str, ...] = ()


def read_rows(path: Path, example: str = _EXAMPLE) -> list[Row]:
    """Read the rows of a file that are not empty.

    Parameters
    ----------
    path : Path
        A text file in UTF-8, UTF-16, Windows-1252 or Latin-1; cells are separated by tabs,
        semicolons, commas, bars or blanks, whichever leaves most numbers whole. Comments begin
        with ``#``, ``%`` or ``//``. Or a spreadsheet (XLSX, XLSM, XLS, ODS): the sheet named
        behind ``#``, as ``creep.xlsx#Sheet2``, or the first one that holds numbers below a row.
    example : str
        First row of such a table, for messages.

    Returns
    -------
    list of Row
        Rows with their lines in the file or sheet; they may have different numbers of cells.

    Raises
    ------
    ValueError
        If the file cannot be read, is neither text nor spreadsheet, is empty, or is beyond bounds.
    """
    return read_sheet(path).rows if is_spreadsheet(path) else rows_of_text(path, example).rows


def read_source(
    path: Path, names: Names, suits: Callable[[FoundTable], bool] | None = None
) -> SourceTable:
    """Find the table of a file by a heading whose cells are `names`.

    Of several sheets, the first one whose table `suits` is read; without it, one that has a name.
    """
    if not is_spreadsheet(path):
        text = rows_of_text(path, _EXAMPLE)
        return SourceTable(path, find_table(text.rows, text.comments, names))

    def holds(rows: list[Row]) -> bool:
        found = find_table(rows, [], names)
        return found.known > 0 and (suits is None or suits(found))

    sheet = read_sheet(path, holds)
    file, named = split_sheet(path)
    several = named is not None or sheet.others
    where = file.with_name(f"{file.name}#{sheet.name}") if several else file
    return SourceTable(where, find_table(sheet.rows, [], names), sheet.others)


def read_plain(
    path: Path, holds: Callable[[list[Row]], bool] | None = None
) -> tuple[Path, TextRows]:
    """Path with the sheet where there are several, and all rows and comments of a file.

    The first sheet whose rows `holds` accepts is read, or else the first one with numbers.
    """
    if not is_spreadsheet(path):
        return path, rows_of_text(path, _EXAMPLE)
    sheet = read_sheet(path, holds)
    file, named = split_sheet(path)
    several = named is not None or sheet.others
    return file.with_name(f"{file.name}#{sheet.name}") if several else file, TextRows(
        sheet.rows, []
    )
