"""Spreadsheets as tables: the sheet that is read, and its rows of cells."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.packed_files import read_packed
from viscontact.tables.text import Row, looks_like_number, require_file
from viscontact.tables.workbook_cells import read_workbook

#: Suffixes of spreadsheets: of Excel, old and new, and of LibreOffice.
SPREADSHEETS = (".xlsx", ".xlsm", ".xls", ".ods")

_NAME = re.compile(r"(?P<file>.+\.(?:xlsx|xlsm|xls|ods))#(?P<sheet>.+)", re.IGNORECASE)


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
    file, wanted = split_sheet(path)
    require_file(file)
    remedy = "delete the cells far away from the table, or save the table as CSV"
    found = read_packed(file, read_workbook, wanted, remedy=remedy)
    sheets = {
        name: [Row(line, tuple(cells)) for line, cells in rows]
        for name, rows in found.values["sheets"].items()
    }
    names = found.values["names"]
    return _choose_sheet(file.name, names, sheets, wanted, holds or _holds_table)


def _choose_sheet(
    name: str,
    names: list[str],
    sheets: dict[str, list[Row]],
    wanted: str | None,
    holds: Callable[[list[Row]], bool],
) -> Sheet:
    """Choose among the `sheets` with rows, which are shown or `wanted`; `names` has all."""
    if wanted is not None:
        if wanted not in names:
            near = difflib.get_close_matches(wanted, names, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            listed = ", ".join(map(repr, names))
            raise ValueError(f"{name}: has no sheet {wanted!r}{hint}; there are {listed}")
        rows = sheets.pop(wanted, [])
        if not rows:
            raise ValueError(f"{name}#{wanted} is empty")
        return Sheet(wanted, rows, () if holds(rows) else _holding(sheets, holds))
    if not sheets:
        raise ValueError(f"{name} is empty; the first row of a table names columns and units")
    found = _holding(sheets, holds)
    first = (*found, *_holding(sheets, _holds_table), *sheets)[0]
    return Sheet(first, sheets[first], tuple(each for each in found if each != first))


def _holding(sheets: dict[str, list[Row]], holds: Callable[[list[Row]], bool]) -> tuple[str, ...]:
    return tuple(name for name, rows in sheets.items() if holds(rows))


def _holds_table(rows: list[Row]) -> bool:
    """True if there are numbers below the first row."""
    return any(looks_like_number(cell) for row in rows[1:] for cell in row.cells)
