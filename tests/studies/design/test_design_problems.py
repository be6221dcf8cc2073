"""Optima of designs against scans of runs: a sample of `benchmarks/designs.py`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from campaigns import tried
from closeness import close_to
from design_problems import PROBLEMS, Problem
from viscontact.studies.case_values import result_with

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
BY_NAME = {problem.name: problem for problem in PROBLEMS}
#: A crown and a straight part are scanned in `test_design.py`.
SAMPLE = ("cover and ball", "rolling ball", "crown, elastic", "two radii")[: tried(2, 4)]

BALL = """
indenter: {shape: sphere, radius: 5 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [24, 24], size: [1.6 mm, 1.6 mm]}
"""
BOUNDED = Problem(
    *("ball", BALL, {"load.force": ("0.01 N", "0.5 N", "log")}, "contact_area", (41,)),
    constraints=("peak_pressure<=0.25 MPa",),
    least=False,
    runs=12,
)


def test_the_largest_contact_under_a_bounded_pressure_is_that_of_hertz(tmp_path: Path) -> None:
    found = BOUNDED.designed(tmp_path, workers=1)
    # p0 = 2 E* a / (pi R) (Hertz), with E* = 4 G.
    radius = np.pi * 5e-3 * 0.25e6 / (2 * 4e6)
    area, error = BOUNDED.found(found)
    assert area == close_to(np.pi * radius**2, rel=0.01)
    assert abs(area - np.pi * radius**2) < error + found.remaining_gain
    assert found.runs <= 12
    assert str(found).startswith("largest contact_area: ")


@pytest.mark.slow
@pytest.mark.parametrize("name", SAMPLE)
def test_an_optimum_is_that_of_a_scan(name: str, tmp_path: Path) -> None:
    problem = BY_NAME[name]
    best = problem.scanned(tmp_path)
    found = problem.designed(tmp_path, workers=1)
    value, error = problem.found(found)
    shortfall = problem.shortfall(value, best)
    assert shortfall < 0.01
    assert shortfall <= (error + found.remaining_gain) / value
    # The table has the same remaining gain, and the best trial keeps the constraints.
    assert found.table.attrs["remaining_gain"] == found.remaining_gain
    assert bool(found.best.feasible)


@pytest.mark.slow
def test_a_crown_between_a_bound_and_sharp_ends_is_found_in_fourteen_runs(tmp_path: Path) -> None:
    problem = BY_NAME["crown, POM, 30 d"]
    found = problem.designed(tmp_path, workers=2)
    # The runs at 30 mm, a bound, and at 44 mm have limits, those from 58 mm on have none.
    known = _peak(problem, tmp_path, "44 mm")
    assert known == close_to(159.8e6, rel=0.01)
    assert float(found.best.peak_pressure) < 1.002 * known
    assert found.runs <= 14
    assert not any("bound" in note for note in found.notes)
    assert any("reaches a sharp end" in note for note in found.notes)


def _peak(problem: Problem, folder: Path, radius: str) -> float:
    settings = {"indenter.crown_radius": radius, "output.fields": "none"}
    result: xr.Dataset = result_with(problem.written(folder), settings)
    assert np.isfinite(result.peak_pressure_error).all()
    return float(result.peak_pressure.max())


@pytest.mark.slow
def test_a_design_clear_of_the_ends_leaves_out_contacts_at_them(tmp_path: Path) -> None:
    problem = BY_NAME["crown, elastic"]
    path, change = problem.written(tmp_path), dict(problem.change)
    clear, any_one = (
        vc.design(path, change, minimise="peak_pressure", clear_of_ends=each, workers=1)
        for each in (True, False)
    )
    # The roller is 30 mm long, and its cells 0.52 mm.
    lengths = [
        float(result_with(path, each.settings).contact_length[0]) for each in (clear, any_one)
    ]
    assert lengths[0] < 29.5e-3 < lengths[1]
    assert float(any_one.best.peak_pressure) < float(clear.best.peak_pressure)
    assert not any("reaches a sharp end" in note for note in clear.notes)
