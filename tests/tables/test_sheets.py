"""Spreadsheets as tables: sheets, margins, numbers as stored, dates, and other formats."""

from __future__ import annotations

import base64
import datetime
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import viscontact as vc
from viscontact.case import read_case
from viscontact.studies.sweep.design_table import read_design
from viscontact.tables import read_line, read_table
from viscontact.tables.sheets import read_sheet

CREEP = [("time [s]", "D [1/GPa]"), (1, 0.1), (10, 1 / 3), (100.5, 0.7)]

# Written by xlwt 1.3: the rows time [s], D [1/GPa]; 1, 0.5; 10, 0.625 in a sheet "Creep".
OLD_EXCEL = (
    "eNrtWD1oFEEU/mZy/+Que/EiJEJcAkaNAQk2Nsn6f5XhtFGMQS9mi5B4CWsaLTQarxQEK8UmkMYmauMPKig2gkJEC0"
    "EQ7tTOSlCwSG5983YXL6dFDvRQmW+Zb96+eTPzdn7e7uzLxXRp7nZHGTUYQBMqbhyRKp2gFA9uDFC56yoxyGOUXI1/"
    "CvEYTWQkjAfJF1E1h2q+y5C4FXpCDLyndBRTGJws2GYDsYt9yAvlQz+xwHXSpNDOXrUyn2Bew3yTLR8y72DNJeZ+si"
    "2JI1i0Bnu2+6v4sOzishRUu3e5zlvW9KENz9QqPndZeLZh7HTG8hN/Z0FnqBnzoHnL2gXbyU+UkKEJnMdX1wS+BDv1"
    "san1jdULkP7bSn30F/orMgTMwD3OC7yIJJ42qZIwdju2PbWE9bwqpRdbp8dO2ubQqWEKwXvMob6t2Vx+OKFCMm9hY8"
    "UWTvLSbiYeRQvLaW7GoIaWbnx+tX8kZx1jzQyHbS+4b1D+wMV5VYMqp7iEXWLbHuYtzBe41XUsdzBnyG/Ku3NtvrBv"
    "lm0ucmk39bON8draWCVvIrn46cC9zuIHazPJC9nymczCG2sOXfSyGaX66ppFr+gV164q3LeCXPiB4B1z+09BISYN33"
    "fXf4O1YBkJFtPM3p0aHeHbixr7R9SHYPsI83O2V5ayxvKsTLAuTeNEoyZT/rh7+GgNyFbcUQYUoH4gAQ0NDQ0NDQ0N"
    "DY2GQfif9uojP8RHD+8AEfX/6yxTqujfJP8tDmKSrmk6mO5FgXIHp+taP2sRFkFbYpV1gv+FCoeodwfjGGE/xutev3"
    "QAFNXPs+qKxu/bQvX2X6nHzz/c/3f3asQV"
)

# As LibreOffice writes it, with the parts that matter.
OPEN_DOCUMENT = """<?xml version="1.0" encoding="UTF-8"?>
<office:document-content office:version="1.2"
 xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0"
 xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0"
 xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0">
<office:body><office:spreadsheet><table:table table:name="Creep">%s</table:table>
</office:spreadsheet></office:body></office:document-content>"""

MANIFEST = """<?xml version="1.0" encoding="UTF-8"?>
<manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0">
<manifest:file-entry manifest:full-path="content.xml" manifest:media-type="text/xml"/>
</manifest:manifest>"""


def workbook(path: Path, sheets: dict[str, list[Any]], at: tuple[int, int] = (1, 1)) -> Path:
    """Write sheets of rows, the first cell of each at a row and column from 1."""
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for i, row in enumerate(rows, start=at[0]):
            for j, cell in enumerate(row, start=at[1]):
                sheet.cell(i, j, cell)
    book.save(path)
    return path


def open_document(path: Path, rows: list[Any]) -> Path:
    text = '<table:table-cell office:value-type="string"><text:p>{0}</text:p></table:table-cell>'
    number = '<table:table-cell office:value-type="float" office:value="{0!r}"/>'
    cells = ([(text if isinstance(c, str) else number).format(c) for c in row] for row in rows)
    lines = "".join(f"<table:table-row>{''.join(row)}</table:table-row>" for row in cells)
    with zipfile.ZipFile(path, "w") as packed:
        packed.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        packed.writestr("META-INF/manifest.xml", MANIFEST)
        packed.writestr("content.xml", OPEN_DOCUMENT % lines)
    return path


def test_numbers_are_read_as_they_are_stored_not_as_they_are_shown(tmp_path: Path) -> None:
    path = workbook(tmp_path / "creep.xlsx", {"Sheet1": CREEP})
    book = openpyxl.load_workbook(path)
    book["Sheet1"]["B3"].number_format = "0.0"  # shown as 0.3
    book.save(path)
    table = read_table(path)
    assert table.data == "uniaxial"
    assert table.lines.tolist() == [2, 3, 4]
    assert table["time"].tolist() == [1.0, 10.0, 100.5]
    np.testing.assert_allclose(table["creep_compliance"], [1e-10, 1e-9 / 3, 7e-10], rtol=1e-15)


def test_old_excel_and_open_document_files_are_read_too(tmp_path: Path) -> None:
    old = tmp_path / "creep.xls"
    old.write_bytes(zlib.decompress(base64.b64decode(OLD_EXCEL)))
    new = open_document(tmp_path / "creep.ods", [CREEP[0], (1, 0.5), (10, 0.625)])
    for table in (read_table(old), read_table(new)):
        assert table["time"].tolist() == [1.0, 10.0]
        np.testing.assert_allclose(table["creep_compliance"], [5e-10, 6.25e-10], rtol=1e-15)


def test_titles_units_and_empty_margins_around_a_table_are_left_out(tmp_path: Path) -> None:
    rows = [
        ("Creep of POM at 23 °C",),
        (),
        ("", "time", "D", "remark"),
        ("", "s", "1/GPa", ""),
        ("", 1, 0.5, "first"),
        (),
        ("", 10, 0.6, ""),
        ("", ""),
    ]
    table = read_table(workbook(tmp_path / "creep.xlsx", {"A": rows}, at=(3, 4)))
    assert table["time"].tolist() == [1.0, 10.0]
    assert table.lines.tolist() == [7, 9]  # as the spreadsheet counts its rows
    assert table.left_out == ("remark",)


def test_the_first_sheet_with_numbers_is_read_and_named_or_the_chosen_one(tmp_path: Path) -> None:
    other = [CREEP[0], (1, 0.2), (10, 0.25)]
    sheets = {"Cover": [("Report",), ("Mr X",)], "23 C": CREEP, "60 C": other}
    path = workbook(tmp_path / "creep.xlsx", sheets)
    assert read_table(path).source.name == "creep.xlsx#23 C"
    chosen = read_table(tmp_path / "creep.xlsx#60 C")
    assert chosen["creep_compliance"].tolist() == [2e-10, 2.5e-10]
    with pytest.raises(ValueError, match=r"has no sheet '60C'; did you mean '60 C'\?; there"):
        read_table(tmp_path / "creep.xlsx#60C")
    with pytest.raises(ValueError, match=r"creep\.xlsx#Cover: .*the sheets '23 C', '60 C' do"):
        read_table(tmp_path / "creep.xlsx#Cover")


def test_a_table_is_found_by_numbers_below_the_row_of_names(tmp_path: Path) -> None:
    """A year beside a title is none; units and remarks belong to one."""
    sheets = {
        "Cover": [("Report", 2026), ("Mr X", "")],
        "Remarks": [("time", "D", "remark"), ("s", "1/GPa", ""), (1, 0.5, "first"), (10, 0.6, "")],
    }
    found = read_sheet(workbook(tmp_path / "creep.xlsx", sheets))
    assert (found.name, found.others) == ("Remarks", ())


def test_hidden_sheets_are_read_only_by_name(tmp_path: Path) -> None:
    path = workbook(tmp_path / "creep.xlsx", {"Old": [*CREEP[:2], (5, 9)], "New": CREEP})
    book = openpyxl.load_workbook(path)
    book["Old"].sheet_state = "hidden"
    book.save(path)
    assert len(read_table(path)) == 3
    assert len(read_table(tmp_path / "creep.xlsx#Old")) == 2


@pytest.mark.parametrize(
    ("cell", "why"),
    [
        (datetime.date(2024, 2, 1), "'2024-02-01' is a date or a time of day, not a number"),
        (datetime.datetime(2024, 2, 1, 10, 30), "'2024-02-01 10:30:00' is a date"),
        (datetime.time(3, 4), "'03:04:00' is a date or a time of day"),
        (True, "'True' is not a number"),
        ("n/a", "'n/a' is not a number"),
        (None, "the cell is empty"),
    ],
)
def test_a_cell_that_is_no_number_is_refused_with_its_row(
    cell: object, why: str, tmp_path: Path
) -> None:
    path = workbook(tmp_path / "creep.xlsx", {"A": [*CREEP, (cell, 0.8)]})
    with pytest.raises(ValueError, match=r"creep\.xlsx:5: column 'time \[s\]'") as caught:
        read_table(path)
    assert why in str(caught.value)


def test_dates_in_columns_that_are_not_read_do_no_harm(tmp_path: Path) -> None:
    rows = [(*CREEP[0], "when"), (1, 0.5, datetime.date(2024, 2, 1)), (2, 0.6, "")]
    table = read_table(workbook(tmp_path / "creep.xlsx", {"A": rows}))
    assert table.left_out == ("when",)
    assert len(table) == 2


def test_cells_beside_the_table_and_broken_or_empty_files_are_refused(tmp_path: Path) -> None:
    beside = workbook(tmp_path / "beside.xlsx", {"A": [*CREEP, (200, 0.8, "", "late")]})
    with pytest.raises(ValueError, match=r"beside\.xlsx:5 has 4 entries.*clear the cells beside"):
        read_table(beside)
    with pytest.raises(ValueError, match=r"none\.xlsx is empty"):
        read_table(workbook(tmp_path / "none.xlsx", {"A": []}))
    for start in (b"PK\x03\x04\x14\x00", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", b"time [s]\n1\n"):
        (tmp_path / "broken.xlsx").write_bytes(start + bytes(100))
        with pytest.raises(ValueError, match=r"broken\.xlsx: cannot be read as a spreadsheet"):
            read_table(tmp_path / "broken.xlsx")
    with pytest.raises(ValueError, match=r"no such file .*creep\.xlsx"):
        read_table(tmp_path / "creep.xlsx#A")


def test_a_case_reads_its_tables_from_sheets_and_keeps_a_copy(tmp_path: Path) -> None:
    sheets = {
        "Law": CREEP,
        "Load": [("time [s]", "force [N]"), (0, 0), (1, 5), (9, 5)],
        "Crown": [("x [mm]", "drop [um]"), (0, 0), (4, 1.5), (5, 3)],
    }
    path = workbook(tmp_path / "data.xlsx", sheets)
    (tmp_path / "case.yaml").write_text(
        "indenter: {shape: roller, radius: 5 mm, half_length: 5 mm, profile: {kind: table, "
        "file: data.xlsx#Crown}}\n"
        "material: {law: table, file: data.xlsx#Law, poisson_ratio: 0.4}\n"
        "load: {kind: history, file: data.xlsx#Load}\n"
        "time: {end: 9 s, steps: 3}\n"
    )
    case = read_case(tmp_path / "case.yaml")
    assert case.load.level_at(np.array([0.5, 5.0])).tolist() == [2.5, 5.0]
    assert set(case.files.values()) == {path}
    assert list(case.file_names.values()) == ["data.xlsx"]
    copied = tmp_path / "run" / "case.yaml"
    copied.parent.mkdir()
    copied.write_text(case.text)
    (copied.parent / "data.xlsx").write_bytes(path.read_bytes())
    again = read_case(copied)
    assert again.load.level_at(np.array([0.5])).tolist() == [2.5]
    assert "data.xlsx#Crown" in case.text


def test_profiles_designs_and_height_maps_are_read_from_sheets(tmp_path: Path) -> None:
    sheets = {
        "Line": [("x", "height"), ("mm", "um"), (0, 1.5), (4, -2)],
        "Plan": [("load.force [kN]", "material.law", "time.steps"), (0.5, "zener", 40)],
        "Map": [(0, 1, 2), ("", 1, ""), (3, 4, 5)],
    }
    path = workbook(tmp_path / "all.xlsx", sheets)
    assert read_line(f"{path}#Line", "x") == ([0.0, 4e-3], [-1.5e-6, 2e-6])
    design = read_design(Path(f"{path}#Plan"))
    assert design.settings(0) == ("load.force=0.5 kN", "material.law=zener", "time.steps=40")
    surface = vc.read_surface(f"{path}#Map", spacing=1e-6, height_unit="nm")
    np.testing.assert_array_equal(
        surface.heights, 1e-9 * np.array([[0, np.nan, 3], [1, 1, 4], [2, np.nan, 5]])
    )
