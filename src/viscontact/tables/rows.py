"""Rows of cells of a file: text or spreadsheet."""

from __future__ import annotations

from pathlib import Path

from viscontact.tables.sheets import is_spreadsheet, read_sheet, split_sheet
from viscontact.tables.text import Row, rows_of_text


def read_rows(path: Path, example: str = "time [s], force [kN]") -> list[Row]:
    """Read the rows of a file that are not empty.

    Parameters
    ----------
    path : Path
        A text file in UTF-8, UTF-16 with a byte-order mark, Windows-1252 or Latin-1; cells are
        separated by tabs, semicolons or commas, whichever its first row has. Comments begin with
        ``#``, ``%`` or ``//``. Or a spreadsheet (XLSX, XLSM, XLS, ODS): the sheet named
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
    return read_source(path, example)[1]


def read_source(path: Path, example: str = "time [s], force [kN]") -> tuple[Path, list[Row]]:
    """Path with the sheet that is read where there are several, and the rows of a file."""
    if not is_spreadsheet(path):
        return path, rows_of_text(path, example)
    sheet = read_sheet(path)
    file, named = split_sheet(path)
    several = named is not None or sheet.others
    return file.with_name(f"{file.name}#{sheet.name}") if several else file, sheet.rows
