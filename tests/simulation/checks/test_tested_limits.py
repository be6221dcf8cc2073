"""Warnings about strains, stresses, times and temperatures beyond those of a material's tests."""

from __future__ import annotations

import math
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.bodies.materials import library
from viscontact.case import read_material, shipped_material
from viscontact.cli import main
from viscontact.simulation.checks.tested_limits import (
    TABOR,
    Contact,
    limit_warnings,
    limited_bodies,
    loaded_since,
)

GRID = vc.Grid((32, 32), (2.4e-3, 2.4e-3))
LAW = vc.Zener(1e7, 1e7, 1e8)


def material(**limits: Any) -> vc.Material:
    return vc.Material(LAW, 0.4, measured_range=vc.MeasuredRange(**limits))


def said(body: vc.Material, force: float = 1.0, count: int = 2) -> str:
    times = np.linspace(0.0, 30.0, count)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ds = vc.simulate(vc.Sphere(0.01), body, vc.step(force), GRID, times)
    return str(ds.attrs["warnings"])


def test_the_measure_is_a_fifth_of_a_over_r_by_hertz():
    """Hertz 1882: p_m = (4/3π) E* a/R, so that 0.2 a/R = 0.15 π p_m/E*; Tabor 1951."""
    slope, modulus = 0.03, 1e7
    mean = 4 / (3 * np.pi) * modulus * slope
    assert TABOR * mean / modulus == close_to(0.2 * slope)


def test_a_contact_warns_from_the_strain_of_the_tests_on():
    """Under a constant force on a creeping body a³ = (3/4) R F J(t) (Lee and Radok 1960)."""
    compliance = vc.Material(LAW, 0.4).contact_compliance()
    strains = [0.2 * (0.75 * 0.01 * compliance(t)) ** (1 / 3) / 0.01 for t in (0.0, 30.0)]
    assert "strain" not in said(material(strain=1.03 * strains[1]))
    late = said(material(strain=0.5 * sum(strains)))
    assert "s the representative strain is about" in late
    assert "at t = 0 s" not in late
    early = said(material(strain=0.97 * strains[0]))
    assert "at t = 0 s the representative strain is about" in early
    # In shear √3 times as much, and the stress is that of E = E* (1 - ν²).
    assert "shear strain" not in said(material(shear_strain=1.03 * np.sqrt(3) * strains[1]))
    assert "shear strain" in said(material(shear_strain=0.97 * np.sqrt(3) * strains[1]))
    at_once = strains[0] / compliance(0.0) * (1 - 0.4**2)
    assert "stress" in said(material(stress=0.97 * at_once))
    assert "stress" not in said(material(stress=1.03 * at_once))


def test_a_contact_that_is_wide_on_its_layer_is_judged_by_the_approach():
    body = vc.Layered([vc.Layer(1e-3, material(strain=0.02))], base="rigid")
    [limited] = limited_bodies([body])
    wide = Contact(2e6, 5e-3, 1e-5, 0.0, "now")
    assert limit_warnings([limited], wide) == {}  # 1 % of the thickness
    narrow = Contact(2e6, 5e-4, 1e-5, 0.0, "now")
    assert "beyond the 2.0 %" in limit_warnings([limited], narrow)["tested strain of material"]
    unknown = Contact(2e6, 5e-3, math.nan, 0.0, "now")
    assert limit_warnings([limited], unknown) != {}


def test_each_body_is_compared_with_its_own_tests():
    both = limited_bodies([material(strain=1e-3), material(strain=2e-3)])
    found = limit_warnings(both, Contact(1e6, 1e-3, 1e-5, 0.0, "now"))
    assert sorted(found) == [
        "tested strain of half-space material",
        "tested strain of indenter material",
    ]
    assert limited_bodies([vc.Material(LAW, 0.4), material(first=1.0)]) == ()


@pytest.mark.parametrize(
    ("load", "begin"),
    [
        (vc.step(1.0), 0.0),
        (vc.ramp(1.0, 2.0), 0.0),
        (vc.ForceHistory([0, 3, 5, 9], [0, 0, 1, 1]), 3.0),
        (vc.ForceHistory([0, 3, 3, 9], [0, 0, 1, 1]), 3.0),
        (vc.harmonic(2.0, 1.0, 1.0, 3), 0.0),
    ],
)
def test_the_load_begins_where_it_rises_from_zero(load, begin):
    assert loaded_since(load) == close_to(begin, abs=1e-12)


def test_the_first_time_of_the_tests_and_a_temperature_beyond_them_are_warned_of():
    assert "where the material's data begin" in said(material(first=1.0))
    assert "measured" not in said(material(temperatures=(293.15, 313.15)))
    shift = vc.Arrhenius(293.15, 50e3)
    body = vc.Material(
        LAW,
        0.4,
        shift=shift,
        measured_range=vc.MeasuredRange(first=1.0, temperatures=(293.15, 313.15)),
    )
    assert body.at(303.15).measured_range.first == close_to(shift.factor(303.15))
    hot = said(body.at(333.15))
    assert "used at 60 °C, but was measured at 20 to 40 °C" in hot
    assert "used at" not in said(body.at(303.15))


def test_a_contact_in_steady_motion_is_compared_with_the_tests():
    body = material(strain=1e-4, first=10.0)
    with pytest.warns(vc.AccuracyWarning) as warned:
        vc.steady(vc.Sphere(0.01), body, vc.step(1.0), 0.01, grid=GRID, errors=False)
    texts = " ".join(str(each.message) for each in warned)
    assert "at 10 mm/s the representative strain is about" in texts
    assert "the contact is passed in" in texts


POM = """title: POM under a sphere
indenter: {shape: sphere, radius: 5 mm}
material: pom-c-23c
load: {kind: step, force: FORCE}
time: {end: 2 h, steps: 4, spacing: log, first: 1 h}
grid: {shape: [48, 48], size: [SIZE, SIZE]}
output: {errors: false, fields: none}
"""


@pytest.mark.parametrize(
    ("force", "size", "warns"), [("31.4 N", "1.2 mm", True), ("0.186 N", "0.2 mm", False)]
)
def test_pom_at_95_mpa_warns_in_run_check_and_result_and_at_a_fifth_of_it_does_not(
    force: str, size: str, warns: bool, tmp_path: Path, capsys: Any
) -> None:
    """A mean pressure of 94 MPa is a strain of 1.3 %; its tests end at 0.5 %, which is 36 MPa."""
    case = tmp_path / "pom.yaml"
    case.write_text(POM.replace("FORCE", force).replace("SIZE", size), encoding="utf-8")
    assert main(["check", str(case)]) == 0
    assert ("representative strain" in capsys.readouterr().out) == warns
    assert main(["run", str(case), "-o", str(tmp_path / "run"), "-q"]) == 0
    with vc.open_results(tmp_path / "run") as ds:
        assert float(ds.mean_pressure.max()) == close_to(94e6 if warns else 17e6, rel=0.05)
        assert ("beyond the 0.50 % of the tests" in ds.attrs["warnings"]) == warns


def test_entries_state_limits_that_their_own_words_state():
    """The strain in words is the number; an entry without words has none."""
    words = {"pom-c-23c": "at most 0.5 %", "pa66-conditioned-23c": "at most 0.5 %"}
    words |= {"epdm-70-25c": "a strain of 0.15 %", "polyisoprene-226k-25c": "(strain 3 %)"}
    for name in some(library.names()):
        entry = library.entry(name)
        text = f"{entry.test} {entry.checked} {entry.constants}"
        stated = entry.limits.get("strain") or entry.limits.get("shear_strain")
        assert (stated is not None) == (name in words)
        if stated is not None:
            assert words[name] in text
            assert stated in words[name]
        tested = shipped_material(name).measured_range
        ends = [end.removesuffix(" degC") for end in entry.limits.get("temperatures", [])]
        assert all(end in entry.temperature for end in ends)
        first = 0.0 if tested is None else tested.first
        assert first in (0.0, (entry.measured or (0.0,))[0])


def test_a_case_states_the_range_of_its_own_material(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.3, measured_range: "
        "{strain: 2 %, shear_strain: 0.03, stress: 5 MPa, first: 1 s, "
        "temperatures: [20 degC, 60 degC]}}\n",
        encoding="utf-8",
    )
    found = read_material(path).measured_range
    assert found == vc.MeasuredRange(0.02, 0.03, 5e6, 1.0, (293.15, 333.15))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"strain": -0.1}, "MeasuredRange: strain"),
        ({"first": -1.0}, "MeasuredRange: first"),
        ({"temperatures": (300.0, 290.0)}, "the lowest and the highest"),
    ],
)
def test_wrong_ranges_are_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        vc.MeasuredRange(**wrong)
    with pytest.raises(ValueError, match="must be a MeasuredRange"):
        vc.Material(LAW, 0.4, measured_range=0.005)
