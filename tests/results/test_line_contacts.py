"""A line contact states what a unit of its length has: its period is not shown, nor matters."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.drawing.content.map import maps_at
from viscontact.drawing.plotly.sections import sections
from viscontact.plot import history
from viscontact.reference import hertz_line
from viscontact.report.page import report_page
from viscontact.results.summary import headline, summary_rows
from viscontact.results.variables import SCALARS, Place, per_length, shown_in

# The approach of a line contact has no datum, and the peak at a wedge's edge no limit.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RADIUS, LINE_LOAD = 5e-3, 1e5
PMMA = vc.Material(vc.Elastic(1e9), 0.3)
RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e4), 0.5)  # retarded by 10 ms
#: Scalars of a period, those with another name per unit length included.
OF_PERIOD = {each.per_length_of for each in SCALARS.values() if each.per_length_of}


def pressed(period: float, rows: int = 1) -> xr.Dataset:
    cylinder = vc.Paraboloid(math.inf, RADIUS)
    grid = vc.Grid((rows, 96), (period, 1.5e-3), periodic=(True, False))
    return vc.simulate(cylinder, PMMA, vc.step(LINE_LOAD * period), grid, [0.0])


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    return pressed(1e-3)


@pytest.fixture(scope="module")
def rolling() -> xr.Dataset:
    cylinder, load = vc.Paraboloid(math.inf, 0.03), vc.step(0.5, tilt_y=0.0)
    grid = vc.Grid((1, 64), (1e-3, 8e-3), periodic=(True, False))
    return vc.steady(cylinder, RUBBER, load, [0.1, 1.0], grid=grid, rolling=True)


def test_width_and_load_are_those_of_hertz(ds: xr.Dataset) -> None:
    """Johnson 1985, eq. 4.43."""
    modulus = 1 / float(PMMA.contact_compliance()(0.0))
    width = 2 * hertz_line(LINE_LOAD, RADIUS, modulus).half_width
    assert float(ds.force_per_length[0]) == close_to(LINE_LOAD, rel=1e-6)
    assert float(ds.strip_width[0]) == close_to(width, abs=float(ds.strip_width_error[0]))
    assert ds.force_per_length.attrs["units"] == "N/m"


def test_length_of_the_period_does_not_matter(ds: xr.Dataset) -> None:
    other = pressed(0.25)
    names = [name for name in ds if str(name).endswith("_per_length") or name == "strip_width"]
    for name in some(names):
        ours, theirs = float(ds[name][0]), float(other[name][0])
        assert math.isnan(ours) == math.isnan(theirs)
        if not math.isnan(ours):
            assert ours == close_to(theirs, rel=1e-5)


def test_values_and_errors_are_those_of_a_period_over_its_length(rolling: xr.Dataset) -> None:
    stored = [name for name in OF_PERIOD if name in rolling]
    assert {"resistance_y", "dissipation", "contact_area"} <= set(stored)
    for name in some(stored):
        for end in ("", "_error"):
            assert rolling[per_length(name) + end].values == close_to(
                rolling[name + end].values / 1e-3, rel=1e-12
            )


def test_power_is_the_resistance_times_the_speed(rolling: xr.Dataset) -> None:
    power = rolling.resistance_y_per_length * rolling.speed
    assert rolling.dissipation_per_length.values == close_to(power.values, rel=1e-3)


def test_several_cells_along_a_period_have_no_values_per_length() -> None:
    wavy = pressed(1e-3, rows=4)
    assert not [name for name in wavy if str(name).endswith("_per_length")]
    assert "contact_area" in [row.name for row in summary_rows(wavy)]


def test_no_period_is_shown(ds: xr.Dataset, rolling: xr.Dataset) -> None:
    period = OF_PERIOD | {"contact_length", "contact_width", "peak_line_load"}
    for result in (ds, rolling):
        rows = {row.name for row in summary_rows(result)}
        assert {"force_per_length", "strip_width"} <= rows
        assert not period & rows
        for place in Place:
            assert not period & set(shown_in(place, result))
    assert "944.1 µm wide under 100 kN/m" in headline(ds)
    assert "dissipation_per_length" in shown_in(Place.FACTS, rolling)


def test_history_of_a_moving_line_contact_is_drawn_per_length() -> None:
    motion = vc.reciprocating(1e-4, 0.02, 1, rolling=True)
    cylinder, load = vc.Paraboloid(math.inf, 0.03), vc.step(500.0, tilt_y=0.0)
    times = np.linspace(0.0, 0.02, 9)
    moved = vc.simulate(cylinder, RUBBER, load, times=times, motion=motion, errors=False)
    labels = [axes.get_ylabel().replace("\n", " ") for axes in history(moved).axes]
    assert any(label.startswith("Resistance along y per length [") for label in labels)
    assert any(label.startswith("Width of the strip [") for label in labels)
    assert not any(
        label.startswith(("Contact area", "Peak line load", "Force")) for label in labels
    )


def test_report_of_an_automatic_grid_shows_a_strip_in_its_true_shape() -> None:
    cylinder, load = vc.Paraboloid(math.inf, RADIUS), vc.step(LINE_LOAD)
    pressed = vc.simulate(cylinder, PMMA, load, times=[0.0, 1.0], errors=False)
    maps = maps_at(pressed, None, "pressure-map")
    assert np.ptp(maps.window.x) == close_to(np.ptp(maps.window.y))
    assert np.nanmax(maps.cells(0, 100)) == close_to(float(pressed.peak_pressure[-1]), rel=1e-6)
    # Nothing varies along the strip.
    names = [figure.layout.meta["name"] for figure in sections(maps)]
    assert names == ["section-y"]
    page = report_page(pressed)
    assert "Width of the strip" in page
    assert "Contact area" not in page


CASE = """
title: Two rolls
indenter: {shape: cylinder, diameter: 20 mm, counter_diameter: 20 mm}
material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.3}
load: {kind: step, line_load: 100 N/mm}
time: {end: 1 s, steps: 2, spacing: uniform}
"""


def test_case_with_a_line_load_and_two_diameters_needs_no_period(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("case.yaml").write_text(CASE)
    assert main(["check", "case.yaml"]) == 0
    checked = capsys.readouterr().out
    assert "160 cells across 1.889 mm (automatic), line along x" in checked
    assert "µm wide" in checked
    assert " long" not in checked
    assert main(["run", "case.yaml", "--quiet"]) == 0
    with vc.open_results("case") as ds:
        modulus = 1 / float(PMMA.contact_compliance()(0.0))
        width = 2 * hertz_line(LINE_LOAD, RADIUS, modulus).half_width
        assert ds.force_per_length.values == close_to(LINE_LOAD, rel=1e-6)
        assert np.all(np.abs(ds.strip_width - width) <= ds.strip_width_error)
    lines = Path("case/progress.jsonl").read_text().splitlines()
    assert json.loads(lines[-1])["force_per_length"] == close_to(LINE_LOAD, rel=1e-6)


@pytest.mark.parametrize(
    "load",
    [
        "{kind: history, points: [[0 s, 0 N/mm], [1 s, 100 N/mm]]}",
        "{kind: history, sentences: ramp to 100 N/mm in 1 s}",
        "{kind: ramp, line_load: 100 kN/m, duration: 1 s}",
    ],
)
def test_line_loads_act_on_the_period_of_the_grid(tmp_path: Path, load: str) -> None:
    (tmp_path / "case.yaml").write_text(CASE.replace("{kind: step, line_load: 100 N/mm}", load))
    on_a_metre = read_case(tmp_path / "case.yaml").load
    grid = "grid={shape: [1, 96], size: [2 mm, 3 mm], periodic: [true, false]}"
    on_two_millimetres = read_case(tmp_path / "case.yaml", [grid]).load
    assert on_a_metre.level_at(0.5) == close_to(5e4)
    assert on_two_millimetres.level_at(0.5) == close_to(100.0)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "shape: cylinder, diameter: 20 mm, counter_diameter",
            "shape: sphere, diameter",
            "line contact",
        ),
        ("line_load: 100", "force: 1 N, line_load: 100", "line_load and force exclude each other"),
        ("line_load: 100 N/mm", "approach: 1 um", "has no datum"),
    ],
)
def test_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, message: str
) -> None:
    (tmp_path / "case.yaml").write_text(CASE.replace(old, new))
    assert main(["check", str(tmp_path / "case.yaml")]) == 2
    assert message in " ".join(capsys.readouterr().err.split())


def test_automatic_grid_suits_a_wedge_and_a_cylinder_along_y() -> None:
    """Johnson 1985, section 5.2: half width q tan(a)/E*; eq. 4.43 along the other axis."""
    modulus = 1 / float(PMMA.contact_compliance()(0.0))
    wedge = vc.simulate(vc.Wedge(1.4), PMMA, vc.step(1e4), times=[0.0], errors=False)
    exact = 2 * 1e4 * math.tan(1.4) / modulus
    assert float(wedge.strip_width[0]) == close_to(exact, rel=1e-4)
    along_y = vc.Paraboloid(RADIUS, math.inf)
    turned = vc.simulate(along_y, PMMA, vc.step(LINE_LOAD), times=[0.0], errors=False)
    width = 2 * hertz_line(LINE_LOAD, RADIUS, modulus).half_width
    assert float(turned.strip_width[0]) == close_to(width, rel=1e-4)
    assert "contact_width" not in [row.name for row in summary_rows(turned)]


def test_rolls_that_turn_need_their_own_radius(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = CASE.replace("\nload:", "\nindenter_material: pmma-paper\nload:").replace(
        "time: {end: 1 s, steps: 2, spacing: uniform}",
        "motion: {kind: steady, speed: 1 m/s, along: y, rolling: true}",
    )
    (tmp_path / "case.yaml").write_text(case)
    assert main(["check", str(tmp_path / "case.yaml")]) == 2
    assert "turns with its own radius" in " ".join(capsys.readouterr().err.split())
