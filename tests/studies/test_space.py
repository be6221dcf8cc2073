"""Ranges, choices and scatter of values, and keys that are given twice."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from closeness import close_to
from viscontact.studies.calibration.unknowns import Unknown
from viscontact.studies.case_values import refuse_repeated
from viscontact.studies.space import Choice, Range, Scatter, Space, given_scatter


def test_point_of_a_logarithmic_range_is_a_quantity_with_its_digits() -> None:
    assert Range("load.force", 1.0, 100.0, "kN", logarithmic=True).value(0.5) == "10 kN"
    found = Range("indenter.crown_radius", 20.0, 2000.0, "mm", logarithmic=True, digits=5).value(
        0.4
    )
    assert found == "126.19 mm"


def test_bounds_of_a_range_keep_all_their_digits() -> None:
    found = Range("indenter.radius", 1.2345678, 2.3456789, "mm", digits=5)
    assert found.value(0.0) == "1.2345678 mm"
    assert found.value(1.0) == "2.3456789 mm"
    assert found.value(0.5) == "1.7901 mm"


@pytest.mark.parametrize("part", [0.0, 0.3, 1.0])
def test_value_of_a_range_is_at_its_own_part_in_any_unit(part: float) -> None:
    force = Range("load.force", 1.0, 100.0, "kN", logarithmic=True)
    assert force.part_of(force.value(part)) == close_to(part, abs=1e-11)
    assert force.part_of("10000 N") == close_to(0.5, rel=1e-12)
    assert force.part_of("200 kN") is None
    assert force.part_of("10 mm") is None
    material = Choice("material", ("a", "b"))
    assert Space((force, material)).point({"load.force": "1 kN", "material": "b"}) == (0.0, 0.75)
    assert Space((force, material)).point({"load.force": "1 kN"}) is None


def test_point_of_a_choice_is_one_of_its_names() -> None:
    assert Choice("material", ("pmma-paper", "epdm-70-25c")).value(0.5) == "epdm-70-25c"


def test_scatter_is_uniform_logarithmic_or_normal_with_95_percent_between_its_bounds() -> None:
    middle = Scatter(Range("load.force", 1.0, 4.0, "kN"), "uniform")
    assert middle.value(0.5) == "2.5 kN"
    assert replace(middle, shape="log").value(0.5) == "2 kN"
    assert replace(middle, shape="normal").value(0.025) == "1 kN"  # 95 % lie between the bounds


def test_middle_of_a_logarithmic_space_is_the_geometric_mean() -> None:
    space = Space((Range("indenter.radius", 1.0, 4.0, "mm", logarithmic=True),))
    assert space.settings([0.5]) == {"indenter.radius": "2 mm"}


def test_tolerance_of_a_number_gives_two_bounds() -> None:
    found = str(given_scatter("scatter", "indenter.radius", "12 mm ± 0.02 mm", is_sampled=False))
    assert found == "11.98 mm to 12.02 mm"


def test_key_in_two_arguments_is_refused_with_both_names() -> None:
    expected = "load.force: is given twice, in change or settings; give it once"
    with pytest.raises(ValueError, match=f"^{re.escape(expected)}$"):
        refuse_repeated(change=["load.force"], settings=["load.force"])


def test_unknown_value_is_a_text_and_a_number_in_si() -> None:
    modulus = Unknown(Range("material.shear_modulus", 1.0, 100.0, "MPa", logarithmic=True), 0.5)
    assert modulus.text(0.5) == "10 MPa"
    assert modulus.si(0.5) == 10000000.0
