"""Inputs and sensitivity of cases under friction."""

from __future__ import annotations

from pathlib import Path

import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.studies.sensitivity.inputs import input_of, inputs_of

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

CASE = """
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, youngs_modulus: 3 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 N}
friction: {coefficient: 0.3, coupling: true}
tangential: {kind: history, times: [0 s, 1 s, 2 s], force_x: [0 N, 0 N, 0.2 N]}
time: {end: 2 s, steps: 2}
grid: {shape: [32, 32], size: [4 mm, 4 mm]}
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.yaml"
    path.write_text(CASE, encoding="utf-8")
    return path


def test_numbers_of_friction_are_inputs_but_points_of_a_history(case: Path) -> None:
    found = {each.key: each.value for each in inputs_of(read_case(case))}
    assert found["friction.coefficient"] == 0.3
    assert not any(key.startswith("tangential") for key in found)
    assert input_of(read_case(case), "tangential.force_x[3]").value == close_to(0.2)


@pytest.mark.slow
def test_the_shift_depends_on_friction_and_force_as_mindlin_found(case: Path) -> None:
    """δ ∝ μ [1 - (1 - x)^(2/3)] with x = Q/(μ W) (Mindlin 1949), so the elasticity by Q is e =
    2/3 x (1 - x)^(-1/3)/[1 - (1 - x)^(2/3)], and that by μ is 1 - e."""
    keys = ["friction.coefficient", "tangential.force_x[3]"]
    of = "tangential_displacement_x"
    found = vc.sensitivity(case, of, change=keys, at="end", step=0.05, workers=1)
    x = 0.2 / 0.3
    exact = 2 / 3 * x * (1 - x) ** (-1 / 3) / (1 - (1 - x) ** (2 / 3))
    values = found.table.elasticity.values.ravel()
    by = dict(zip(found.table.input.values.tolist(), values, strict=True))
    # The steps of the stick zone by whole cells remain.
    assert by[keys[1]] == close_to(exact, rel=0.03)
    assert by[keys[0]] == close_to(1 - exact, abs=0.03)
