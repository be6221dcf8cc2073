"""The page of a sweep: its states, its response, and a row for each run."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from drawing.plotly.figure_data import figures_in
from synthetic_sweeps import hertz_sweep
from viscontact.report import sweep_page, write_sweep_report
from viscontact.report.sweep_page import MOST_ROWS

FORCES = ([1e3, 8e3, 2e3], "N")
MARKUP = "</title><script>alert(1)</script>"


def cells(page: str) -> list[list[str]]:
    rows = re.findall(r"<tr>(.*?)</tr>", page, flags=re.DOTALL)
    return [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]


def test_page_has_a_row_for_each_run(tmp_path: Path) -> None:
    write_sweep_report(hertz_sweep(load__force=FORCES), tmp_path / "a.html", title="forces")
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    head, *rows = cells(page)
    assert head[:4] == ["run", "state", "Load force [kN]", "Approach [µm]"]
    assert [row[:3] for row in rows] == [["0", "done", "1"], ["1", "done", "8"], ["2", "done", "2"]]
    # 1000**(2/3) and 8000**(2/3)
    assert [row[3] for row in rows[:2]] == ["100 ± 10", "400 ± 40"]
    # A figure for each scalar, as its place and as data.
    figures = figures_in(page)
    assert list(figures) == ["response-approach", "response-contact_area", "response-peak_pressure"]
    assert [f'id="{name}"' in page for name in figures] == 3 * [True]
    assert "<img" not in page


def test_runs_without_a_result_are_listed_with_their_message() -> None:
    ds = hertz_sweep(load__force=FORCES)
    ds["state"] = "load.force", ["done", "failed", "done"]
    ds["message"] = "load.force", ["", f"grid: the rim {MARKUP}", ""]
    for name in ("approach", "contact_area", "peak_pressure", "force"):
        ds[name][1] = np.nan
    page = sweep_page(ds, title=MARKUP)
    assert "run 1 (failed): grid: the rim" in page
    assert cells(page)[2] == ["1", "failed", "8", "", "", ""]
    assert "<script>alert" not in page


def test_warnings_of_runs_that_differ_in_numbers_are_listed_once() -> None:
    ds = hertz_sweep(load__force=FORCES)
    deep = "the approach is {} of the thickness of the layers, 5 mm"
    texts = ["", "\n".join([deep.format(0.12), f"a seam {MARKUP}"]), deep.format(0.3)]
    ds["warnings"] = "load.force", texts
    page = sweep_page(ds, title="deep")
    assert f"2 runs warn, as run 2: {deep.format(0.3)}" in page
    assert "run 1: a seam" in page
    assert deep.format(0.12) not in page
    assert "<script>alert" not in page


def test_page_without_any_result_has_no_figure() -> None:
    ds = hertz_sweep(load__force=FORCES)[["state", "message"]]
    ds["state"][:] = "fail"
    page = sweep_page(ds, title="none")
    assert "<script" not in page
    assert len(cells(page)) == 4


def test_page_of_many_runs_has_the_first_rows() -> None:
    forces = np.linspace(1e3, 2e3, MOST_ROWS + 5)
    page = sweep_page(hertz_sweep(load__force=(forces, "N")), title="many")
    assert len(cells(page)) == 1 + MOST_ROWS
    assert f"The first {MOST_ROWS} of {MOST_ROWS + 5} runs" in page


def test_a_single_finished_run_has_its_values_and_no_figure() -> None:
    ds = hertz_sweep(load__force=FORCES)
    ds["state"] = "load.force", ["failed", "done", "failed"]
    for name in ("approach", "contact_area", "peak_pressure", "force"):
        ds[name][[0, 2]] = np.nan
    page = sweep_page(ds, title="one")
    assert "Not drawn: One run is finished." in page
    assert [row[2:4] for row in cells(page)[1:]] == [["1", ""], ["8", "400 ± 40"], ["2", ""]]


def test_runs_of_no_varied_key_have_their_names() -> None:
    page = sweep_page(hertz_sweep(load__force=([8e3], "N")), title="one")
    assert cells(page)[0][:4] == ["run", "state", "Name", "Force [kN]"]
    assert cells(page)[1][:4] == ["0", "done", "run 0", "8.00 ± 0.80"]
