"""Report of a design: its tables against the trials that it is made from."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import pytest
import xarray as xr

from viscontact.plot import trials
from viscontact.report import write_design_report

RADII = [50e-3, 20e-3, 30e-3, 40e-3]


@pytest.fixture
def table() -> xr.Dataset:
    """Four trials: the case, one on coarse cells, the best one, and one without a limit."""
    peaks = np.array([[100e6, 200e6], [90e6, 160e6], [80e6, 150e6], [70e6, 140e6]])
    errors = np.array([[1e6, 2e6], [9e6, 9e6], [1e6, 1.5e6], [1e6, np.inf]])
    over, units = ("trial", "scenario"), {"units": "Pa"}
    return xr.Dataset(
        {
            "peak_pressure": ("trial", peaks[:, 1], units),
            "peak_pressure_error": ("trial", errors[:, 1], units),
            "peak_pressure_of_scenarios": (over, peaks, units),
            "peak_pressure_of_scenarios_error": (over, errors, units),
            "contact_length": ("trial", [9e-3, 7e-3, 8e-3, 9e-3], {"units": "m"}),
            "contact_length_error": ("trial", [1e-4] * 4, {"units": "m"}),
            "feasible": ("trial", [True, True, True, False]),
            "level": ("trial", ["case", "coarse", "case", "case"]),
            "message": ("trial", [""] * 4),
        },
        {
            "trial": range(4),
            "scenario": ["e=0mm", "e=5mm"],
            "indenter.crown_radius": ("trial", RADII, {"units": "m"}),
        },
        {
            **{"goal": "peak_pressure", "best": 2, "notes": "the optimum lies at a < b"},
            "constraints": "contact_length <= 18 mm",
        },
    )


def rows(page: str) -> list[list[str]]:
    """Cells of all rows of the tables of a page."""
    found = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", page)]
    return [row for row in found if row]


def test_the_report_states_the_gain_in_each_scenario(table: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    write_design_report(table, {}, path, title="Crown", headline="least peak_pressure")
    page = path.read_text(encoding="utf-8")
    found = {row[0]: row[1:] for row in rows(page)}
    assert found["Indenter crown radius"] == ["50 mm", "30 mm", ""]
    # 150 for 200 MPa, 80 for 100 MPa.
    assert found["Peak pressure, worst scenario"][1:] == ["150.0 ± 1.5 MPa", "−25 %"]
    assert found["Peak pressure, e=0mm"] == ["100.0 ± 1.0 MPa", "80.0 ± 1.0 MPa", "−20 %"]
    assert found["contact_length &lt;= 18 mm"] == ["9.00 ± 0.10 mm", "8.00 ± 0.10 mm", ""]
    assert found["3"][-1] == "no limit"
    assert "<li>the optimum lies at a &lt; b</li>" in page
    assert "http" not in page.replace("http://www.w3.org", "").split("<body>")[1]


def test_the_gain_is_left_out_where_a_value_has_no_limit(table: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    table["peak_pressure_error"][0] = np.inf
    write_design_report(table, {}, path, title="Crown", headline="")
    found = {row[0]: row[1:] for row in rows(path.read_text(encoding="utf-8"))}
    assert found["Peak pressure, worst scenario"][2] == ""


def test_the_trade_off_is_in_the_order_of_the_first_goal(
    table: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.report.design_page.drawn_figure", lambda *_: Element("p"))
    goals = table.assign_attrs(goal="contact_length peak_pressure")
    for end in ("", "_error"):
        of_scenarios = goals[f"contact_length{end}"].expand_dims(scenario=table.scenario)
        goals[f"contact_length_of_scenarios{end}"] = of_scenarios.transpose("trial", "scenario")
    goals["on_front"] = ("trial", [False, True, True, True])
    path = tmp_path / "report.html"
    write_design_report(goals, {}, path, title="Crown", headline="both least")
    chapter = path.read_text(encoding="utf-8").partition(">Trade-off<")[2]
    assert [row[0] for row in rows(chapter.partition("</table>")[0])] == ["1", "2", "3"]


def test_the_trials_are_drawn_in_groups_over_the_parameter(table: xr.Dataset) -> None:
    (axes,) = trials(table).axes
    drawn = {str(line.get_label()): line.get_xydata() for line in axes.lines}
    assert axes.get_xlabel() == "Indenter crown radius [mm]"
    np.testing.assert_allclose(drawn["coarse cells"], [[20.0, 160.0]])
    np.testing.assert_allclose(drawn["cells of the case"], [[50.0, 200.0], [30.0, 150.0]])
    np.testing.assert_allclose(drawn["not feasible"], [[40.0, 140.0]])
    np.testing.assert_allclose(drawn["best"], [[30.0, 150.0]])


def test_the_report_of_a_parameter_shows_what_is_bounded(table: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    goal = table.assign_attrs(goal="indenter.crown_radius", best=1)
    write_design_report(goal, {}, path, title="Crown", headline="least indenter.crown_radius")
    found = rows(path.read_text(encoding="utf-8"))
    assert ["Indenter crown radius", "50 mm", "20 mm", ""] in found
    assert ["1", "coarse", "20 mm", "7.00 ± 0.10 mm", "feasible"] in found
    (axes,) = trials(goal).axes
    assert axes.get_ylabel() == "Contact length, along x [mm]"
    assert "at most 18 mm" in {text.get_text() for text in axes.texts}
