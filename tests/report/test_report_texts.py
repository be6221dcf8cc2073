"""Texts of the report: changes, measured tables, headings, title block."""

from __future__ import annotations

import xarray as xr

from viscontact.report.creep_gains import relative_change
from viscontact.report.measured import measured_text
from viscontact.report.result_chapters import heading_of
from viscontact.report.title_block import title_entries


def test_relative_change_of_zero_is_empty() -> None:
    assert relative_change(400e6, 300e6) == "−25 %"
    assert relative_change(0.0, 1.0) == ""


def test_measured_table_is_described_with_file_columns_and_test() -> None:
    columns = [{"heading": "time [s]", "values": [1.0]}, {"heading": "D [1/GPa]"}]
    found = measured_text({"file": "pom.csv", "rows": 1, "columns": columns, "data": "uniaxial"})
    assert (
        found
        == "As measured: 1 row of pom.csv, columns “time [s]” and “D [1/GPa]” (uniaxial test)."
    )


def test_heading_has_the_label_unless_it_repeats_the_title() -> None:
    ball = xr.Dataset(attrs={"title": "Ball"})
    found = [heading_of(ball, label) for label in ("", "run-2", "Ball, force 2 N")]
    assert found == ["Ball", "Ball (run-2)", "Ball, force 2 N"]


def test_title_block_has_the_known_entries() -> None:
    found = title_entries(xr.Dataset(attrs={"title_block": '{"project": "P-7", "revision": "B"}'}))
    assert found == [("Project", "P-7"), ("Revision", "B")]
