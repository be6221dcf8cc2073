"""Tables written as XLSX workbooks, the format of spreadsheets (ISO/IEC 29500)."""

from __future__ import annotations

import csv
import io
import math
import re
import zipfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import BinaryIO
from xml.sax.saxutils import escape

#: Suffix of workbooks.
WORKBOOK = ".xlsx"

#: Most rows and columns of a sheet.
_MOST_ROWS, _MOST_COLUMNS = 1_048_576, 16_384
#: Widths of columns in letters.
_NARROWEST, _WIDEST = 10, 40
# Characters that XML cannot hold.
_UNWRITABLE = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")

_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml"
#: The parts beside the sheet.
_PARTS = {
    "[Content_Types].xml": f'<Types xmlns="{_PACKAGE}/content-types">'
    '<Default Extension="rels" '
    'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Override PartName="/xl/workbook.xml" ContentType="{_TYPE}.sheet.main+xml"/>'
    f'<Override PartName="/xl/worksheets/sheet1.xml" ContentType="{_TYPE}.worksheet+xml"/>'
    "</Types>",
    "_rels/.rels": f'<Relationships xmlns="{_PACKAGE}/relationships">'
    f'<Relationship Id="rId1" Type="{_OFFICE}/officeDocument" Target="xl/workbook.xml"/>'
    "</Relationships>",
    "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}">'
    '<sheets><sheet name="viscontact" sheetId="1" r:id="rId1"/></sheets></workbook>',
    "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{_PACKAGE}/relationships">'
    f'<Relationship Id="rId1" Type="{_OFFICE}/worksheet" Target="worksheets/sheet1.xml"/>'
    "</Relationships>",
}


def write_workbook(file: BinaryIO, rows: Iterable[Sequence[str]]) -> None:
    """Write rows of cells as a workbook of one sheet; ValueError if they are too many for it."""
    # Finite numbers are written as numbers, so that the program that shows them chooses the decimal
    # separator; empty cells are left out.
    table = [list(row) for row in rows]
    columns = max(map(len, table), default=0)
    if len(table) > _MOST_ROWS or columns > _MOST_COLUMNS:
        raise ValueError(
            f"a sheet has at most {_MOST_ROWS} rows and {_MOST_COLUMNS} columns, got {len(table)} "
            f"and {columns}; write CSV instead"
        )
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in {**_PARTS, "xl/worksheets/sheet1.xml": _sheet(table, columns)}.items():
            # A date of its own would give another file at each writing.
            part = zipfile.ZipInfo(name)
            part.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(part, _HEAD + text)


def write_csv_or_workbook(file: BinaryIO, text: str, path: Path) -> None:
    """Write a table that is given as CSV, as a workbook where the name of the file says so."""
    if path.suffix.lower() == WORKBOOK:
        write_workbook(file, csv.reader(io.StringIO(text)))
    else:
        file.write(text.encode("utf-8"))


def _sheet(table: list[list[str]], columns: int) -> str:
    """Text of a sheet, whose first row remains visible."""
    pane = '<pane ySplit="1" topLeftCell="A2" activePane="bottomLeft" state="frozen"/>'
    view = f'<sheetViews><sheetView workbookViewId="0">{pane}</sheetView></sheetViews>'
    heads = table[0] if table else []
    widths = [min(max(len(head) + 2, _NARROWEST), _WIDEST) for head in heads]
    cols = "".join(
        f'<col min="{number}" max="{number}" width="{width}" customWidth="1"/>'
        for number, width in enumerate(widths, start=1)
    )
    names = [_letters(number) for number in range(columns)]
    data = "".join(
        f'<row r="{number}">{"".join(map(_cell, row, _places(names, number)))}</row>'
        for number, row in enumerate(table, start=1)
    )
    cols = f"<cols>{cols}</cols>" if cols else ""
    return f'<worksheet xmlns="{_MAIN}">{view}{cols}<sheetData>{data}</sheetData></worksheet>'


def _places(names: list[str], row: int) -> Iterable[str]:
    return (f"{name}{row}" for name in names)


def _letters(number: int) -> str:
    """Name of a column, counted from 0."""
    name, number = "", number + 1
    while number:
        number, letter = divmod(number - 1, 26)
        name = chr(ord("A") + letter) + name
    return name


def _cell(text: str, place: str) -> str:
    """Element of a cell: a number, a text, or nothing."""
    if not text:
        return ""
    if _is_number(text):
        return f'<c r="{place}"><v>{text}</v></c>'
    shown = escape(_UNWRITABLE.sub("", text))
    keep = ' xml:space="preserve"' if shown != shown.strip() else ""
    return f'<c r="{place}" t="inlineStr"><is><t{keep}>{shown}</t></is></c>'


def _is_number(text: str) -> bool:
    """True for a finite decimal number as Python and spreadsheets write it."""
    try:
        return math.isfinite(float(text)) and re.fullmatch(r"[-+0-9.eE]+", text) is not None
    except ValueError:
        return False
