"""Stiffness of the materials of case files by one number: a scale, or a hardness."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from closeness import close_to
from viscontact import Elastic, Layered, Material, MeasuredRange
from viscontact.case import CaseError, read_case
from viscontact.case.single_material import read_section
from viscontact.studies.sensitivity.sensitivity import sensitivity

SCALED = {
    "a law": "{law: zener, shear_modulus: 2 MPa, delayed_modulus: 1 MPa, viscosity: 1 MPa s, "
    "poisson_ratio: 0.5}",
    "a name": "epdm-70-25c",
    "a name with keys": "{material: pom-c-23c, poisson_ratio: 0.35}",
}


@pytest.mark.parametrize("material", SCALED.values(), ids=SCALED.keys())
def test_a_scale_divides_the_compliance_at_all_times(tmp_path: Path, material: str) -> None:
    path = tmp_path / "ball.yaml"
    path.write_text(
        "{indenter: {shape: sphere, radius: 5 mm}, load: {kind: step, force: 1 N}, "
        f"time: {{end: 1 s, steps: 1}}, material: {material}}}"
    )
    own, scaled = (read_case(path, given).material for given in ([], ["material.scale=1.5"]))
    assert isinstance(own, Material)
    assert isinstance(scaled, Material)
    times = np.array([0.01, 1.0, 1e3])
    np.testing.assert_allclose(scaled.law(times), own.law(times) / 1.5, rtol=1e-12)
    assert scaled.poisson_ratio == own.poisson_ratio
    assert scaled.measured_range == own.measured_range
    assert scaled.notes[-1] == "the moduli of the law are multiplied by 1.5"
    assert read_case(path, ["material.scale=1.5"]).text != path.read_text()


def test_the_scale_of_a_layer_is_its_own(tmp_path: Path) -> None:
    path = tmp_path / "ball.yaml"
    path.write_text(
        "{indenter: {shape: sphere, radius: 5 mm}, load: {kind: step, force: 1 N}, "
        "time: {end: 1 s, steps: 1}, material: {layers: [{thickness: 5 mm, material: epdm-70-25c}],"
        " base: steel}}"
    )
    settings = ["material.layers[1].scale=2", "material.base.scale=0.5"]
    own, scaled = (read_case(path, given).material for given in ([], settings))
    assert isinstance(own, Layered)
    assert isinstance(scaled, Layered)
    ratios = [a.law(1.0) / b.law(1.0) for a, b in zip(scaled.materials, own.materials, strict=True)]
    assert ratios == close_to([0.5, 2.0], rel=1e-12)


def test_the_stress_of_the_tests_is_less_with_a_softer_law_and_stays_with_a_stiffer_one() -> None:
    tested = MeasuredRange(strain=0.01, stress=5e6)
    material = Material(Elastic(1e6), 0.5, measured_range=tested)
    for factor, stress in ((0.5, 2.5e6), (2.0, 5e6)):
        found = material.scaled(factor).measured_range
        assert found == MeasuredRange(strain=0.01, stress=stress)


def test_a_hardness_in_a_case_is_an_estimate_that_is_warned_of() -> None:
    keys = {"law": "elastic", "shore_a": 70, "poisson_ratio": 0.49}
    material = read_section(keys, "typed").build()
    assert 2.98 * float(material.law.relaxation(0.0)) == close_to(7.47e6, rel=1e-3)
    assert material.warning is not None
    assert "estimated from 70 Shore A: E = 7.5 MPa, and may lie between 4.4 MPa" in material.warning
    for key, value in (("youngs_modulus", "2 MPa"), ("scale", 2), ("shore_d", 40)):
        with pytest.raises(CaseError, match=key):
            read_section(keys | {key: value}, "typed")


def test_the_peak_pressure_of_hertz_grows_as_the_scale_to_two_thirds(tmp_path: Path) -> None:
    path = tmp_path / "ball.yaml"
    path.write_text(
        "{indenter: {shape: sphere, radius: 5 mm}, load: {kind: step, force: 0.1 N}, "
        "time: {end: 1 s, steps: 1}, grid: {shape: [48, 48], size: [2.4 mm, 2.4 mm]}, "
        "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}}"
    )
    found = sensitivity(path, "peak_pressure", change=["material.scale"], workers=1)
    # p0 = (6 F E*^2 / (pi^3 R^2))^(1/3); nothing in the case has to name the scale.
    (exponent,) = found.table["elasticity"].values.ravel()
    assert exponent == close_to(2 / 3, rel=0.02)
