"""Gain of a design over a week and a year of creep."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to

WEEK, YEAR = 7 * 86400.0, 365.25 * 86400.0
# Half of the creep happens within the first second, the other half within the first week.
BALL = """
indenter: {shape: paraboloid, radius_x: 5 mm, radius_y: 5 mm}
material:
  law: creep-series
  instant: 0.5 / MPa
  amplitudes: [0.5 / MPa, 0.5 / MPa]
  times: [0.1 s, 86400 s]
  data: deviatoric
  poisson_ratio: 0.5
load: {kind: step, force: 0.05 N}
time: {end: 10 s, steps: 6, spacing: log, first: 0.1 s}
grid: {shape: [44, 44], size: [2.6 mm, 2.6 mm]}
output: {errors: false}
"""
FORCES = {"load.force": ["0.02 N", "0.03 N"]}


def designed(folder: Path, text: str) -> vc.DesignResult:
    path = folder / "ball.yaml"
    path.write_text(text)
    return vc.design(path, FORCES, minimise="approach", at="end", workers=1)


def test_the_gain_over_a_year_follows_the_growing_contact(tmp_path: Path) -> None:
    found = designed(tmp_path, BALL)
    years = found.over_a_year()
    assert list(years) == ["case", "best"]
    for name, force in (("case", 0.05), ("best", 0.02)):
        run = years[name]
        assert not isinstance(run, str)
        assert run.time.values[-1] == YEAR
        for time in (0.0, 1e1, WEEK, YEAR):
            # a^3 = 3 R F (1 - nu) Phi(t) / 4 (Lee and Radok 1960), and the approach is a^2 / R.
            creep = 0.5e-6 * (3 - np.exp(-time / 0.1) - np.exp(-time / 86400))
            exact = (3 * 5e-3 * force * 0.5 * creep / 4) ** (2 / 3) / 5e-3
            approach = float(run.approach.sel(time=time, method="nearest"))
            assert approach == close_to(exact, rel=0.01)
    found.report(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    table = re.findall(r"<td>Approach</td><td>(.*?)</td>.*?</tr>", page)
    assert table == ["0 s", "10 s (end of the case)", "1 day", "1 week", "1 year"]
    # (0.02 / 0.05)^(2/3) = 0.543, at all times.
    assert len(re.findall("<td>−46 %</td>", page)) >= 5


def test_without_creep_or_a_held_load_there_is_no_year_of_it(tmp_path: Path) -> None:
    load = "{kind: triangle, force: 0.05 N, rise: 4 s}"
    unloaded = BALL.replace("{kind: step, force: 0.05 N}", load)
    elastic = re.sub(
        r"law: creep-series.*?times[^\n]*\n  data: deviatoric",
        "law: elastic\n  shear_modulus: 1 MPa",
        BALL,
        flags=re.DOTALL,
    )
    for text in (unloaded, elastic):
        assert designed(tmp_path, text).over_a_year() == {}


@pytest.mark.slow
def test_a_contact_that_outgrows_the_grid_within_a_year_is_named(tmp_path: Path) -> None:
    small = BALL.replace("size: [2.6 mm, 2.6 mm]", "size: [0.79 mm, 0.79 mm]")
    found = designed(tmp_path, small)
    years = found.over_a_year()
    assert isinstance(years["case"], str)
    assert "the contact reaches the edge of the grid" in years["case"]
    found.report(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "The run of the case stopped: " in page
