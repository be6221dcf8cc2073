"""Section `adhesion` of cases, forces that pull, and springs of stages."""

import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import CaseError, read_case

CASE = """\
indenter: {shape: sphere, radius: 1 um}
material: {law: elastic, youngs_modulus: 1 MPa, poisson_ratio: 0.5}
load: %s
time: {end: 2 s, steps: 20}
grid: {shape: [64, 64], size: [4 um, 4 um]}
"""
PULL = "{kind: history, points: [[0 s, 0 nN], [2 s, -100 nN]]}"


def read(tmp_path, *lines, load=PULL):
    path = tmp_path / "case.yaml"
    path.write_text("".join([CASE % load, *(f"{line}\n" for line in lines)]), encoding="utf-8")
    return read_case(path)


@pytest.mark.parametrize(
    ("section", "adhesion"),
    [
        ("{work: 50 mJ/m2, range: 2 nm}", vc.Adhesion(0.05, range=2e-9)),
        ("{work: 0.05 J/m^2, strength: 25 MPa}", vc.Adhesion(0.05, strength=25e6)),
        (
            "{work: 50 mN/m, range: 2 nm, law: dugdale}",
            vc.Adhesion(0.05, range=2e-9, law="dugdale"),
        ),
        ("{work: 50 mJ/m2}", vc.Adhesion(0.05)),
    ],
)
def test_adhesion_is_that_made_by_hand(section, adhesion, tmp_path):
    found = read(tmp_path, f"adhesion: {section}").adhesion
    assert (found.law, found.strength is None) == (adhesion.law, adhesion.strength is None)
    for name in ("work", "range", "strength"):
        expected = getattr(adhesion, name)
        assert expected is None or getattr(found, name) == close_to(expected, rel=1e-12)


def test_stage_on_a_spring_is_read(tmp_path):
    load = "{kind: triangle, approach: 200 nm, rise: 1 s, stage_stiffness: 0.2 N/m}"
    assert read(tmp_path, load=load).load == vc.triangle(
        approach=2e-7, rise=1.0, stage_stiffness=0.2
    )


@pytest.mark.parametrize(
    ("load", "key"),
    [
        (PULL, "load.points[2]: must be zero or more without adhesion, got -100 nN"),
        ("{kind: step, force: -1 nN}", "load.force: must be zero or more without adhesion"),
        (
            "{kind: history, sentences: [hold for 1 s, ramp to -5 nN in 1 s]}",
            "load.sentences[2]: sentence 2, 'ramp to -5 nN in 1 s': the force would fall to -5 nN",
        ),
    ],
)
def test_force_that_pulls_needs_adhesion(load, key, tmp_path):
    assert read(tmp_path, "adhesion: {work: 50 mJ/m2, range: 2 nm}", load=load).adhesion
    with pytest.raises(CaseError) as refused:
        read(tmp_path, load=load)
    assert key in str(refused.value)
    assert "adhesion: {work: 50 mJ/m2, range: 2 nm}" in str(refused.value)


@pytest.mark.parametrize(
    ("section", "message"),
    [
        ("{work: 0 mJ/m2}", "adhesion.work: must be more than zero"),
        ("{work: 50 mJ}", "adhesion.work"),
        ("{work: 50 mJ/m2, range: 2 nm, strength: 1 MPa}", "range or strength, not both"),
        ("{work: 50 mJ/m2, law: jkr}", "adhesion.law"),
        ("{range: 2 nm}", "adhesion.work: is missing"),
    ],
)
def test_bad_adhesion_is_one_line(section, message, tmp_path):
    with pytest.raises(CaseError) as refused:
        read(tmp_path, f"adhesion: {section}")
    assert message in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1
