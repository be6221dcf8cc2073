"""Inputs of a case: which numbers they are, and their values nearby."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from tests.studies.sensitivity.cases import HERTZ, written

from closeness import close_to
from viscontact.case import read_case
from viscontact.studies.sensitivity.inputs import CaseNumber, input_of, inputs_of

CREEPING = """
indenter: {shape: sphere, diameter: 20 mm}
material:
  law: creep-series
  instant: 5.545e-4 / MPa
  amplitudes: [6.17e-5 / MPa, 8.38e-5 / MPa]
  times: [10 s, 133.87 s]
  data: deviatoric
  poisson_ratio: 0.38
load: {kind: history, points: [[0 s, 0 N], [1 s, 2 N]]}
time: {end: 1 s, steps: 1}
"""


def test_the_inputs_of_a_case_are_its_numbers_but_zeros_and_tables(tmp_path: Path) -> None:
    found = {each.key: each.value for each in inputs_of(read_case(written(tmp_path, CREEPING)))}
    assert found == {
        "indenter.radius": 0.01,
        "material.instant": close_to(5.545e-10),
        "material.amplitudes[1]": close_to(6.17e-11),
        "material.amplitudes[2]": close_to(8.38e-11),
        "material.times[1]": 10.0,
        "material.times[2]": 133.87,
        "material.poisson_ratio": 0.38,
    }


def test_a_number_of_a_table_and_an_alias_can_be_named(tmp_path: Path) -> None:
    case = read_case(written(tmp_path, CREEPING))
    assert input_of(case, "load.points[2][2]").value == 2.0
    assert input_of(case, "indenter.diameter").value == 0.02


@pytest.mark.parametrize(
    ("given", "number", "unit"),
    [
        (CaseNumber("a.force", "2 kN", 2000.0, "N"), 2.0, "kN"),
        (CaseNumber("a.instant", "5.545e-4 / MPa", 5.545e-10, "1/Pa"), 5.545e-4, "/ MPa"),
        (CaseNumber("a.poisson_ratio", "0.3", 0.3, "1"), 0.3, ""),
        # The logarithm of a temperature is that of the absolute one.
        (CaseNumber("a.temperature", "20 degC", 293.15, "K"), 293.15, "K"),
    ],
)
def test_a_step_changes_the_logarithm(given: CaseNumber, number: float, unit: str) -> None:
    first, _, rest = given.at(0.1).partition(" ")
    assert rest == unit
    assert float(first) == close_to(number * math.exp(0.1), rel=1e-11)


REFUSED = {
    "load.farce": "load.farce: the case has no such number; its inputs are indenter.radius_x",
    "material.law": "material.law: must be a number, the case has 'elastic'",
    "grid.size[1]": "grid.size[1]: cells, steps and output of a case are no inputs",
    "load.eccentricity_x": "load.eccentricity_x: is 0, which gives no scale",
}


@pytest.mark.parametrize(("key", "message"), REFUSED.items())
def test_a_key_that_is_no_number_of_the_case_is_refused(
    tmp_path: Path, key: str, message: str
) -> None:
    text = HERTZ.replace("force: 1 N", "force: 1 N, eccentricity_x: 0 mm")
    with pytest.raises(ValueError, match=r"\w") as refusal:
        input_of(read_case(written(tmp_path, text)), key)
    assert str(refusal.value).startswith(message)
