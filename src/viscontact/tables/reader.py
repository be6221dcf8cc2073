"""Reader of measured tables from CSV files and spreadsheets."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from os import PathLike
from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.tables.creep_tests import with_creep_compliance
from viscontact.tables.given_columns import GivenColumns, parted_columns, with_given_heading
from viscontact.tables.header import Column, Header, read_header
from viscontact.tables.heading_cells import quantity_named
from viscontact.tables.headings import FoundTable
from viscontact.tables.isochronous import isochronous_table
from viscontact.tables.oscillations import with_moduli
from viscontact.tables.rows import read_plain, read_source
from viscontact.tables.table import Table, read_only
from viscontact.tables.text import Row, decimal_number


def read_table(
    path: str | PathLike[str],
    columns: GivenColumns = None,
    *,
    stress: float | None = None,
    wanted: Collection[str] = (),
    gaps: Mapping[str, Collection[str]] | None = None,
) -> Table:
    r"""Read a measured table from a CSV file or a spreadsheet.

    Parameters
    ----------
    path : path-like
        The file: text, or a spreadsheet (XLSX, XLSM, XLS, ODS), with its sheet behind
        ``#`` (``creep.xlsx#Sheet2``) or the first sheet that holds a table. The header names
        columns and units in one row (``time [s], E' (MPa)``) or two (names, then units), below
        any lines of an instrument or in a comment.
    columns : mapping or str, optional
        Meaning of columns with unknown names: heading to a quantity (a key of
        `viscontact.tables.names.QUANTITIES`, or ``"frequency"``), or to None to leave the
        column out; as text ``"E_1=relaxation_modulus, remark="``. Or names of all columns, for a
        file without a header or in place of its own: ``"time [s], , force [nN]"``, with nothing
        for a column that is not read.
    stress : float, optional
        Stress of a creep test that is given as strain, where neither a heading nor a column
        states it, or the one that is meant where there are several [Pa].
    wanted : collection of str, optional
        Quantities for which the table is read: a sheet that has one of them is preferred.
    gaps : mapping, optional
        Texts, in small letters, of cells that hold no value, by quantity; they arrive as NaN. An
        empty cell, and any other text that is no number, is refused without them.

    Returns
    -------
    Table
        The columns in SI units.

    Raises
    ------
    ValueError
        If the file cannot be read, has no header, a unit is missing or measures something
        else, a quantity is not clear or there twice, a row is ragged, or a cell is no finite
        number: with the line of the file and the column.

    Notes
    -----
    Text may be UTF-8 or UTF-16 (with or without a byte-order mark), Windows-1252 or Latin-1; cells
    are separated by tabs, semicolons, commas, bars or blanks; numbers may have decimal commas where
    the separator is none. The header is the row with numbers below it that names most quantities.
    Where the same header comes again, as rheometers write one for each interval, the rows below it
    belong to the same table. Absolute modulus and phase angle arrive as storage and loss modulus.
    Frequencies arrive in rad/s, whether they are written in Hz or so;
    temperatures in K; logarithms of shift factors (``log_aT``, decimal, or ``ln_aT``) as
    a_T. A creep modulus E_c arrives as the creep compliance 1/E_c. The strain of a creep test
    arrives as strain over stress; its stress is in its heading (``strain at 5 MPa [%]``), in a
    column ``stress [MPa]``, or given. Isochronous curves (``strain [%], stress at 1 h [MPa],
    stress at 10 h [MPa]``, or stress and strains) arrive as the creep compliance at the given
    stress, with a row for each time. Stress and strain in other tables are left out. Files are
    bounded at 50 MB and a million rows. Numbers of a spreadsheet are read as they are stored, not
    as they are shown; titles above the table and empty rows and columns around it are left out;
    dates are refused.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "dma.csv")
    >>> _ = file.write_text("f;E';T\nHz;MPa;°C\n0,1;8097,2;-50\n", encoding="utf-8")
    >>> table = read_table(file)
    >>> table.data, [round(float(values[0]), 6) for values in table.columns.values()]
    ('uniaxial', [0.628319, 8097200000.0, 223.15])
    """
    meanings, names = parted_columns(columns)
    path, rows = _table_rows(Path(path), meanings, names, frozenset(wanted))
    isochronous = isochronous_table(path, rows, stress)
    if isochronous is not None:
        return isochronous
    header = read_header(path.name, rows[:2], meanings, stress)
    body = rows[header.rows :]
    if not body:
        raise ValueError(f"{path.name} has a header and no rows; export the measured values too")
    values = _values(path.name, header, body, gaps or {})
    quantities = [column.quantity for column in header.columns]
    table = Table(
        source=path,
        columns={n: read_only(v.copy()) for n, v in zip(quantities, values.T, strict=True)},
        data=header.data,
        headings={c.quantity: c.heading for c in header.columns},
        lines=np.array([row.line for row in body], dtype=np.int64),
        left_out=header.left_out,
    )
    return with_creep_compliance(with_moduli(table), header.stress)


def _table_rows(
    path: Path,
    meanings: Mapping[str, str | None],
    names: tuple[str, ...],
    wanted: frozenset[str],
) -> tuple[Path, list[Row]]:
    """Path with the sheet that is read, and the rows of its table from the heading on."""

    def known(cell: str) -> bool:
        return quantity_named(cell, meanings) is not None

    def suits(found: FoundTable) -> bool:
        return not wanted.isdisjoint(quantity_named(c, meanings) for c in found.rows[0].cells)

    if names:
        path, text = read_plain(path)
        return path, with_given_heading(path.name, text.rows, names, known)
    source = read_source(path, known, suits if wanted else None)
    if source.found.known == 0 and source.others:
        raise ValueError(
            f"{source.path.name}: holds no table with a known heading; "
            f"{_listed_sheets(source.others)}"
        )
    if source.found.further:
        raise ValueError(
            f"{source.path.name}: has several tables, with headings in the lines "
            f"{', '.join(map(str, source.found.further))}; save the one that is meant in a file "
            "of its own"
        )
    return source.path, source.found.rows


def _listed_sheets(names: tuple[str, ...]) -> str:
    listed = ", ".join(map(repr, names))
    return f"the sheet {listed} does" if len(names) == 1 else f"the sheets {listed} do"


def _values(
    source: str, header: Header, rows: list[Row], gaps: Mapping[str, Collection[str]]
) -> Floats:
    places = [column.place for column in header.columns]
    for row in rows:
        _require_width(source, header.width, row)
    # A comma between digits is a decimal mark everywhere or nowhere.
    comma = any("," in row.cells[place] for row in rows for place in places)
    mark = "," if comma else "."
    values = np.empty((len(rows), len(places)))
    for i, row in enumerate(rows):
        for j, column in enumerate(header.columns):
            is_gap = row.cells[column.place].lower() in gaps.get(column.quantity, ())
            values[i, j] = math.nan if is_gap else _value(source, row, column, mark)
    return values


def _require_width(source: str, width: int, row: Row) -> None:
    # Spreadsheets export empty cells at the end.
    if len(row.cells) < width or any(row.cells[width:]):
        raise ValueError(
            f"{source}:{row.line} has {len(row.cells)} entries, the header {width}; decimal commas "
            "need semicolons or tabs between the columns; in a spreadsheet, clear the cells beside "
            "the table"
        )


def _value(source: str, row: Row, column: Column, mark: str) -> float:
    try:
        value = column.si(decimal_number(row.cells[column.place], mark))
        base = column.meaning.logarithm
        if base is not None:
            value = _power(base, value)
        if not math.isfinite(value):
            raise ValueError(f"{row.cells[column.place]!r} is beyond all numbers")
    except ValueError as error:
        raise ValueError(f"{source}:{row.line}: column {column.heading!r}: {error}") from None
    return value


def _power(base: float, exponent: float) -> float:
    try:
        return float(base**exponent)
    except OverflowError:
        return math.inf
