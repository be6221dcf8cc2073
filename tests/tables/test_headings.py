"""Headings anywhere in a file: the numbers do not depend on what stands above and between them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest
from hypothesis import strategies as st

from closeness import close_to
from random_examples import given_few_or_many
from viscontact.tables import read_line, read_rows, read_table

NAMES, UNITS = ("time", "Speichermodul G'", "Temperatur", "remark"), ("min", "kPa", "°C", "")
ABOVE = ("Test:|gel A", "Operator|N. N.|7", "Samples", "23 °C|2024-05-01", "Points|4", "µ|é|ü")
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252")


@given_few_or_many(
    60,
    300,
    st.lists(
        st.tuples(*[st.floats(0, 1e6).map(lambda v: round(v, 4))] * 3), min_size=2, max_size=6
    ),
    st.lists(st.sampled_from(ABOVE), max_size=5),
    st.sampled_from(ENCODINGS),
    st.sampled_from([("\t", ","), ("\t", "."), (";", ","), (";", "."), (",", "."), ("|", ".")]),
    st.booleans(),
    st.booleans(),
)
def test_numbers_do_not_depend_on_how_a_table_is_written(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float, ...]],
    above: list[str],
    encoding: str,
    marks: tuple[str, str],
    in_two_rows: bool,
    blank: bool,
) -> None:
    separator, decimal = marks
    heading = (
        [NAMES, *([("",) * 4] if blank else []), UNITS]
        if in_two_rows
        else [tuple(f"{n} [{u}]" if u else n for n, u in zip(NAMES, UNITS, strict=True))]
    )
    body = [(*(f"{v:.4f}".replace(".", decimal) for v in row), "ok") for row in rows]
    lines = [line.replace("|", separator) for line in above]
    lines += [separator.join(cells) for cells in (*heading, *body)]
    path = tmp_path_factory.getbasetemp() / "any.csv"
    path.write_bytes("\r\n".join(lines).encode(encoding))
    found = read_table(path)
    expected = np.array(rows).T
    np.testing.assert_allclose(found["time"], 60 * expected[0], rtol=1e-14)
    np.testing.assert_allclose(found["storage_modulus"], 1e3 * expected[1], rtol=1e-14)
    np.testing.assert_allclose(found["temperature"], expected[2] + 273.15, rtol=1e-14)
    assert found.data == "shear"


def test_heading_in_a_comment_is_read_where_no_other_names_a_column(tmp_path: Path) -> None:
    path = tmp_path / "record.txt"
    path.write_text("# made by hand\n#\n# time [s]  force [nN]\n0.0  1.5\n0.5  2.5\n")
    assert read_table(path)["force"].tolist() == close_to([1.5e-9, 2.5e-9])
    path.write_text("# time [s], force [N]\ntime [s], force [nN]\n0, 1.5\n1, 2\n")
    assert read_table(path)["force"].tolist() == close_to([1.5e-9, 2e-9])


def test_a_broken_row_before_the_next_interval_is_not_lost(tmp_path: Path) -> None:
    block = "No.;time [s];G [Pa]\n1;1;8\n2;2;{}\n"
    path = tmp_path / "intervals.csv"
    path.write_text(block.format("7") + "Interval 2\n" + block.format("6"))
    assert read_table(path)["relaxation_modulus"].tolist() == [8.0, 7.0, 8.0, 6.0]
    path.write_text(block.format("") + "Interval 2\n" + block.format("6"))
    with pytest.raises(ValueError, match=r"intervals\.csv:3: column 'G \[Pa\]': the cell is empty"):
        read_table(path)


def workbook(path: Path, sheets: dict[str, list[Any]]) -> Path:
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


def test_the_sheet_that_would_do_is_read_or_named(tmp_path: Path) -> None:
    sheets = {
        "Specimen": [("Width", "Height"), (10, 4)],
        "Creep": [("time [s]", "J [1/MPa]"), (1, 0.5), (2, 0.6)],
        "Load": [("made in 2024",), ("time", "force"), ("s", "kN"), (0, 0), (1, 5)],
    }
    path = workbook(tmp_path / "test.xlsx", sheets)
    assert read_table(path).source.name == "test.xlsx#Creep"
    wanted = read_table(path, wanted=("force", "approach"))
    assert wanted["force"].tolist() == [0.0, 5e3]
    alone = workbook(tmp_path / "one.xlsx", {n: sheets[n] for n in ("Specimen", "Load")})
    assert read_table(alone)["time"].tolist() == [0.0, 1.0]
    with pytest.raises(ValueError, match=r"one\.xlsx#Specimen: holds no table .* 'Load' does"):
        read_table(f"{alone}#Specimen")


def test_lines_of_points_are_found_below_others_too(tmp_path: Path) -> None:
    path = tmp_path / "crown.csv"
    path.write_text("crown of roll 7\nmeasured;2024\nx;drop\nmm;um\n0;0\n4;1,5\n")
    positions, drops = read_line(path, "x")
    assert positions == [0.0, 4e-3]
    assert drops == close_to([0.0, 1.5e-6])


def test_a_number_with_its_unit_is_one_cell(tmp_path: Path) -> None:
    path = tmp_path / "plan.csv"
    path.write_text("load.force\n5 N\n6 N\n")
    assert [row.cells for row in read_rows(path)] == [("load.force",), ("5 N",), ("6 N",)]


def test_semicolons_separate_among_words_and_decimal_commas(tmp_path: Path) -> None:
    path = tmp_path / "words.csv"
    path.write_text("Report\nZeit;remark;status;Kraft\ns;-;-;N\n2,5;ok;ok;6,25\n3,5;ok;ok;7\n")
    assert read_table(path)["force"].tolist() == [6.25, 7.0]
    path.write_text('time [s],force [N],remark\n1,2,"good; fine"\n2,3,"good"\n')
    assert read_table(path)["force"].tolist() == [2.0, 3.0]


def test_names_above_the_heading_that_have_no_numbers_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "channels.csv"
    path.write_text("Channels,Time,Force\nmade,by,hand\nt,Load,remark\ns,N,\n1,2,ok\n2,3,ok\n")
    found = read_table(path)
    assert (found["time"].tolist(), found["force"].tolist()) == ([1.0, 2.0], [2.0, 3.0])
