"""Grids of case files: asked for in words, around a centre, or half given."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pydantic import ValidationError

import viscontact as vc
from case.written_cases import SPHERE, problems, written
from viscontact.case import read_case
from viscontact.case.time_grid_output import Cells


@pytest.mark.parametrize(
    ("grid", "wish"),
    [
        ({"tolerance": "0.5 %", "quantities": ["approach"]}, (0.005, ["approach"])),
        ({"quantities": ["contact_width", "tilt_x"]}, (0.01, ["contact_width", "tilt_x"])),
        ({"tolerance": 0.03}, (0.03, vc.AutomaticGrid().quantities)),
        ({}, (0.01, vc.AutomaticGrid().quantities)),
    ],
)
def test_an_automatic_grid_is_asked_for_in_words(grid, wish):
    assert Cells(**grid).build() == vc.AutomaticGrid(*wish)


def test_a_grid_lies_around_the_centre_that_the_case_gives(tmp_path: Path) -> None:
    place = "grid: {shape: [8, 4], size: [2 mm, 1 mm], centre: [-7 mm, 40 um]}\n"
    assert read_case(written(tmp_path, SPHERE + place)).grid == vc.Grid(
        (8, 4), (2e-3, 1e-3), centre=(-7e-3, 4e-5)
    )
    (found,) = problems(tmp_path, SPHERE + place.replace("40 um", "40"))
    assert found.startswith("case.yaml:5: grid.centre[2]: 40 has no unit; a length is expected")


@pytest.mark.parametrize(
    ("grid", "complaint"),
    [
        ({"tolerance": "2 mm"}, "cannot read '2 mm' as a share; write e.g. '0.5 %'"),
        ({"tolerance": "90 %"}, "less than or equal to 0.5"),
        ({"tolerance": 0.01, "shape": [64, 64]}, "tolerance goes with an automatic grid"),
        ({"shape": [64, 64]}, "size is missing"),
        ({"quantities": []}, "must name some of peak_pressure"),
        ({"centre": ["1 mm", "0 mm"]}, "centre goes with shape and size"),
        ({"centre": ["1 mm", "2 N"]}, "cannot read '2 N' as a length"),
        ({"centre": ["1 mm"]}, "Field required"),
    ],
)
def test_grids_that_are_half_given_are_refused(grid, complaint):
    with pytest.raises(ValidationError, match=re.escape(complaint)):
        Cells(**grid)
