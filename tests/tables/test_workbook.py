"""Workbooks as other programs read them: openpyxl, and the reader of tables."""

from __future__ import annotations

import io
from pathlib import Path

import openpyxl
import pytest

from viscontact.tables.sheets import read_sheet
from viscontact.tables.workbook import write_csv_or_workbook, write_workbook

ROWS = [
    ["time [s]", "peak_pressure [Pa]", "outcome", "note"],
    ["0.0", "1.2345678901234567e+08", "contact", ""],
    ["-1e-05", "inf", 'a < b & "c"', " spaced\x07 "],
    ["12", "nan", "1_000", "0x10"],
]


def test_another_program_reads_numbers_and_texts(tmp_path: Path) -> None:
    path = tmp_path / "table.xlsx"
    with path.open("wb") as file:
        write_workbook(file, ROWS)
    sheet = openpyxl.load_workbook(path).active
    assert sheet is not None
    assert [list(row) for row in sheet.iter_rows(values_only=True)] == [
        ROWS[0],
        [0, 1.2345678901234567e8, "contact", None],
        [-1e-5, "inf", 'a < b & "c"', " spaced "],
        [12, "nan", "1_000", "0x10"],
    ]
    assert sheet.freeze_panes == "A2"


def test_a_workbook_is_read_as_a_table_again(tmp_path: Path) -> None:
    path = tmp_path / "creep.xlsx"
    with path.open("wb") as file:
        write_csv_or_workbook(file, "time [s],D [1/GPa]\n1,0.44\n10,0.47\n", path)
    sheet = read_sheet(path)
    assert sheet.name == "viscontact"
    assert [list(row.cells) for row in sheet.rows] == [
        ["time [s]", "D [1/GPa]"],
        ["1", "0.44"],
        ["10", "0.47"],
    ]


def test_other_names_hold_the_csv(tmp_path: Path) -> None:
    file = io.BytesIO()
    write_csv_or_workbook(file, "a\n1\n", tmp_path / "a.csv")
    assert file.getvalue() == b"a\n1\n"


def test_columns_beyond_z_have_two_letters() -> None:
    file = io.BytesIO()
    write_workbook(file, [[str(number) for number in range(60)]])
    sheet = openpyxl.load_workbook(file).active
    assert sheet is not None
    assert sheet["BH1"].value == 59


def test_more_columns_than_a_sheet_has_are_refused() -> None:
    with pytest.raises(ValueError, match="a sheet has at most 1048576 rows and 16384 columns"):
        write_workbook(io.BytesIO(), [["1"] * 16_385])


def test_two_writings_give_the_same_file() -> None:
    first, second = io.BytesIO(), io.BytesIO()
    for file in (first, second):
        write_workbook(file, ROWS)
    assert first.getvalue() == second.getvalue()
