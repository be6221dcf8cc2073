"""Numbers of a case file with the tolerance of a drawing."""

from __future__ import annotations

from pathlib import Path

import pytest

import viscontact as vc
from viscontact.case import CaseError, read_case
from viscontact.case.tolerances import nominal
from viscontact.runs.execution.checked_run import filed_case

BALL = """
title: 12 mm ± 0.02 mm
indenter: {shape: sphere, diameter: 24 mm ± 0.04 mm}
material: {law: elastic, shear_modulus: 4 MPa +- 5 %, poisson_ratio: 0.45 ± 0.02}
load: {kind: step, force: 2 ± 0.1 N}
time: {end: 1 s, steps: 1}
"""


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    path = tmp_path / "ball.yaml"
    path.write_text(BALL, encoding="utf-8")
    return path


def test_a_run_takes_the_nominal_values(ball: Path) -> None:
    case = read_case(ball)
    assert case.title == "12 mm ± 0.02 mm"
    assert case.indenter.radius == 0.012  # type: ignore[union-attr]
    assert case.material.poisson_ratio == 0.45  # type: ignore[union-attr]
    assert case.load.force_at(0.0) == 2.0  # type: ignore[union-attr]
    assert case.document.tolerances == {
        ("indenter", "diameter"): "24 mm ± 0.04 mm",
        ("material", "shear_modulus"): "4 MPa +- 5 %",
        ("material", "poisson_ratio"): "0.45 ± 0.02",
        ("load", "force"): "2 ± 0.1 N",
    }
    typed = filed_case(case).case_as_typed
    assert typed["indenter"]["diameter"] == "24 mm ± 0.04 mm"


def test_a_setting_replaces_value_and_tolerance(ball: Path) -> None:
    case = read_case(ball, ["indenter.radius=11 mm", "load={kind: step, force: 3 N ± 1 N}"])
    assert case.indenter.radius == 0.011  # type: ignore[union-attr]
    assert case.load.force_at(0.0) == 3.0  # type: ignore[union-attr]
    assert case.document.tolerances == {
        ("material", "shear_modulus"): "4 MPa +- 5 %",
        ("material", "poisson_ratio"): "0.45 ± 0.02",
        ("load", "force"): "3 N ± 1 N",
    }


def test_a_tolerance_that_cannot_be_read_names_its_line(ball: Path) -> None:
    ball.write_text(BALL.replace("± 0.1 N", "± 0.1 mm ").replace("± 0.04 mm", "± 0 mm"), "utf-8")
    with pytest.raises(CaseError) as refusal:
        read_case(ball)
    by_value, by_tolerance = refusal.value.problems
    # The unit of a tolerance is that of a number without one.
    assert "ball.yaml:5: load.force: cannot read '2 mm' as a force" in by_value
    assert "ball.yaml:3: indenter.diameter: the tolerance in '24 mm ± 0 mm' must" in by_tolerance


def test_a_table_of_points_may_have_tolerances(ball: Path) -> None:
    points = "load: {kind: history, points: [[0 s, 0 N], [1 s, 2 N ± 0.1 N]]}"
    ball.write_text(BALL.replace("load: {kind: step, force: 2 ± 0.1 N}", points), "utf-8")
    case = read_case(ball)
    assert case.load.force_at(1.0) == 2.0  # type: ignore[union-attr]
    assert case.document.tolerances[("load", "points", 1, 1)] == "2 N ± 0.1 N"


def test_both_bodies_and_the_motion_may_have_tolerances(ball: Path) -> None:
    steel = "{law: elastic, shear_modulus: 80 GPa ± 2 GPa, poisson_ratio: 0.3}"
    path = "{kind: travel, points: [[0 s, 0 mm], [1 s, 1 mm ± 0.1 mm]]}"
    more = f"indenter_material: {steel}\nmotion: {path}\n"
    more += "grid: {shape: [16, 24], size: [3 mm, 5 mm]}\n"
    ball.write_text(BALL + more, encoding="utf-8")
    case = read_case(ball)
    assert case.indenter_material == vc.Material(vc.Elastic(80e9), 0.3)
    assert case.motion.position_at(1.0).tolist() == [0.0, 1e-3]
    written = case.document.tolerances
    assert written[("indenter_material", "shear_modulus")] == "80 GPa ± 2 GPa"
    assert written[("motion", "points", 1, 1)] == "1 mm ± 0.1 mm"


def test_the_name_of_a_file_has_no_tolerance() -> None:
    section = {"file": "23 +- 2 C.csv", "poisson_ratio": "0.4 +- 0.02"}
    found = nominal({"material": section})
    assert found.problems == ()
    assert found.data == {"material": {**section, "poisson_ratio": 0.4}}
    assert found.tolerances == {("material", "poisson_ratio"): "0.4 +- 0.02"}
