"""Arguments of a design that are refused, with the reason."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.scenarios import scenarios_of

BALL = """
indenter: {shape: sphere, radius: 5 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [32, 32], size: [2.4 mm, 2.4 mm]}
output: {errors: false}
"""
FORCE = {"load.force": ("0.01 N", "0.1 N")}


LINE = """
indenter: {shape: cylinder, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, line_load: 100 N/m, tilt_y: 0 rad}
motion: {kind: steady, speed: 0.1 m/s, along: y}
grid: {shape: [1, 128], size: [1 m, 2.4 mm], periodic: [true, false]}
output: {errors: false}
"""


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    path = tmp_path / "ball.yaml"
    path.write_text(BALL)
    return path


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no parameter": ({"change": {}}, "change: name a key"),
    "no tuple": (
        {"change": {"load.force": "1 N"}},
        "change: load.force: must be two bounds, as ('9 kN'",
    ),
    "reversed": ({"change": {"load.force": ("2 N", "1 N")}}, "the lower bound comes first"),
    "log from zero": (
        {"change": {"load.force": ("0 N", "1 N", "log")}},
        "a logarithmic range needs bounds above zero",
    ),
    "one choice": ({"change": {"load.force": ["1 N"]}}, "must list two values or more"),
    "cells": ({"change": {"grid.tolerance": ("1 %", "2 %")}}, "no parameters of a design"),
    "unknown key": ({"change": {"load.farce": ("1 N", "2 N")}}, "farce"),
    "wrong unit": ({"change": {"load.force": ("1 mm", "2 mm")}}, "cannot read"),
    "body of no sense": (
        {"change": {"material.poisson_ratio": ("0.3", "0.7")}},
        "material.poisson_ratio",
    ),
    "no goal": ({"minimise": None}, "give minimise or maximise"),
    "a goal twice": ({"maximise": "approach"}, "approach: is given twice, in minimise or maximise"),
    "four goals": (
        {"maximise": ["force", "work", "contact_area"]},
        "minimise, maximise: 3 scalars at most, got 4",
    ),
    "unknown scalar": ({"minimise": "peak_presure"}, "did you mean peak_pressure?"),
    "no constraint": ({"constraints": ["contact_width=1mm"]}, "write SCALAR<=VALUE"),
    "text": ({"constraints": "contact_width<=1mm"}, "must be a list"),
    "unit": ({"constraints": ["contact_width<=1kN"]}, "must have a unit of [m]"),
    "contradiction": (
        {"constraints": ["contact_width<=1mm", "contact_width>=2mm"]},
        "contact_width <= 1 mm and contact_width >= 2 mm contradict each other",
    ),
    "a key that is not changed": (
        {"minimise": "indenter.radius"},
        "minimise: indenter.radius: is a key that is not changed",
    ),
    "a parameter without a bound": (
        {"minimise": "load.force"},
        "minimise: load.force: is a parameter, and nothing but its range bounds it",
    ),
    "an instant of a parameter": (
        {"minimise": "load.force", "at": "end", "constraints": ["contact_width<=1mm"]},
        "at: is the place of a scalar",
    ),
    "least of words": (
        {"change": {"material": ["pmma-paper", "epdm-70-25c"]}, "minimise": "material"},
        "minimise: material: its values are no quantities",
    ),
    "a key without its section": (
        {"change": {"radius": ("1 mm", "2 mm")}},
        "radius",
    ),
    "instant": ({"at": 0.3}, "at: 300 ms is no instant of the case; the nearest one is 0 s"),
    "word": ({"at": "begin"}, "at: must be 'worst', 'end' or a time"),
    "scenarios": ({"over": {"load.force": ["1 N", "2 N"]}}, "load.force: is given twice"),
    "equal scenarios": (
        {"over": {"indenter.radius": ["5 mm", "0.5 cm"]}},
        "are equal",
    ),
    "no list": ({"over": {"indenter.radius": "5 mm"}}, "must be a list of values"),
    "scatter of no sense": (
        {"scatter": {"load.force": "1 N"}},
        "scatter: load.force: must be two bounds, as ('9 kN', '11 kN'), or a number with its tol",
    ),
    "scatter of one bound": (
        {"scatter": {"load.force": ("1 N",)}},
        "scatter: load.force: must be two bounds, as ('9 kN', '11 kN'), or a number with its tol",
    ),
    "reversed scatter": (
        {"scatter": {"material.poisson_ratio": ("0.4", "0.3")}},
        "scatter: material.poisson_ratio: the lower bound comes first",
    ),
    "values in place of deviations": (
        {"scatter": {"load.force": ("0.04 N", "0.06 N")}},
        "scatter: load.force: is changed, so that its scatter is a deviation",
    ),
    "deviation beyond all sense": (
        {"scatter": {"load.force": ("-0.05 N", "0.05 N")}},
        "load.force: must be zero or more without adhesion, got -40 mN",
    ),
    "scattered choice": (
        {
            "change": {"indenter.radius": ["4 mm", "5 mm"]},
            "scatter": {"indenter.radius": ("-1 mm", "1 mm")},
        },
        "scatter: indenter.radius: is a choice between values, which cannot deviate",
    ),
    "scattered scenario": (
        {
            "over": {"indenter.radius": ["5 mm", "6 mm"]},
            "scatter": {"indenter.radius": ("4 mm", "7 mm")},
        },
        "indenter.radius: is given twice",
    ),
    "unknown scatter": ({"scatter": {"load.farce": ("1 N", "2 N")}}, "farce"),
    "too few runs": (
        {"over": {"indenter.radius": ["5 mm", "6 mm"]}, "runs": 1},
        "runs: 1 are too few for 2 scenarios",
    ),
}


@pytest.mark.parametrize(("given", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_an_argument_that_does_not_fit_is_refused(
    ball: Path, given: dict[str, Any], message: str
) -> None:
    arguments = {"change": FORCE, "minimise": "approach", "workers": 1} | given
    with pytest.raises(ValueError, match=r"\w") as refusal:
        vc.design(ball, arguments.pop("change"), **arguments)
    assert message in str(refusal.value)
    assert "--set" not in str(refusal.value)


def test_a_tolerance_is_scatter_and_of_a_parameter_a_deviation() -> None:
    space = space_of(FORCE)
    own = {"load.force": "0.05 N", "indenter.radius": "5 mm"}
    for given, same in (
        ({"load.force": "± 1 mN"}, {"load.force": ("-1 mN", "1 mN")}),
        ({"load.force": "0.05 N ± 2 %"}, {"load.force": ("-0.001 N", "0.001 N")}),
        ({"indenter.radius": "5 mm ± 0.02 mm"}, {"indenter.radius": ("4.98 mm", "5.02 mm")}),
    ):
        assert scenarios_of(None, given, space, own) == scenarios_of(None, same, space, own)


def test_a_tolerance_of_the_case_that_does_not_scatter_is_noted(ball: Path) -> None:
    ball.write_text(BALL.replace("radius: 5 mm", "radius: 5 mm ± 0.1 mm"), "utf-8")
    known = {"minimise": "approach", "runs": 3, "workers": 1}
    (note,) = [n for n in vc.design(ball, FORCE, **known).notes if "tolerances" in n]
    assert "as 'indenter.radius=5 mm ± 0.1 mm'" in note
    scatter = {"indenter.radius": "5 mm ± 0.1 mm"}
    found = vc.design(ball, FORCE, scatter=scatter, **known | {"runs": 6})
    assert found.table.sizes["scenario"] == 3
    assert not any("tolerances" in note for note in found.notes)


STEADY = """
indenter: {shape: sphere, radius: 5 mm}
material: {law: zener, shear_modulus: 4 MPa, delayed_modulus: 2 MPa, viscosity: 1 MPa s,
  poisson_ratio: 0.45}
load: {kind: step, force: 0.5 N, tilt_x: 0 rad, tilt_y: 0 rad}
motion: {kind: steady, speed: [0.01 m/s, 0.1 m/s], along: x, rolling: true}
grid: {shape: [32, 32], size: [3.2 mm, 3.2 mm]}
"""


def test_a_design_of_a_rolling_body_counts_the_resistance_at_a_speed(tmp_path: Path) -> None:
    path = tmp_path / "rolling.yaml"
    path.write_text(STEADY)
    change = {"indenter.radius": ["4 mm", "6 mm"]}
    found = vc.design(path, change, minimise="friction_coefficient", at=0.01, workers=1)
    case = read_case(path)
    contact = (vc.Sphere(6e-3), case.material, case.load, [0.01, 0.1])
    ds = vc.steady(*contact, along="x", rolling=True, grid=case.grid)  # type: ignore[arg-type]
    assert found.settings == {"indenter.radius": "6 mm"}
    assert float(found.best.friction_coefficient) == float(ds.friction_coefficient[0])
    with pytest.raises(ValueError, match="at: 500 mm/s is no speed of the case; the nearest one"):
        vc.design(path, change, minimise="friction_coefficient", at=0.5, workers=1)


def test_the_largest_line_load_within_a_pressure_is_that_of_hertz(tmp_path: Path) -> None:
    path = tmp_path / "line.yaml"
    path.write_text(LINE)
    found = vc.design(
        path,
        {"load.line_load": ("10 N/m", "5 kN/m", "log")},
        maximise="load.line_load",
        constraints=["peak_pressure<=0.2MPa"],
        workers=1,
    )
    # p0 = sqrt(F E* / (pi R)) of a line contact (Hertz), E* = 4 G at nu = 1/2, elastic in motion.
    exact = 0.2e6**2 * np.pi * 10e-3 / 4e6
    assert float(found.best["load.line_load"]) == close_to(exact, rel=0.01)
    assert found.remaining_gain < 2e-3 * exact
    assert found.runs <= 14
    assert "with peak_pressure" in str(found)


@pytest.mark.parametrize(
    "study",
    [
        lambda body: vc.design(body, FORCE, minimise="approach"),
        vc.design_profile,
        lambda body: vc.sensitivity(body, "approach"),
        lambda body: vc.fit_case(body, [], FORCE),
    ],
)
def test_objects_in_place_of_a_case_file_are_refused_by_name(study: Any) -> None:
    with pytest.raises(ValueError, match="case: must be the path of a case file") as refusal:
        study(vc.Sphere(0.01))
    assert "got Sphere; simulate_many takes runs of Python objects" in str(refusal.value)
