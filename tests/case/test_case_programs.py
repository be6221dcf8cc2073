"""Load programs in case files: what sentences mean, and every mistake at its key."""

import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import CaseError, read_case
from viscontact.results.descriptions import describe, rebuild
from viscontact.runs.preparation import prepared

CASE = """\
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material: {law: zener, shear_modulus: 1 MPa, delayed_modulus: 1 MPa, viscosity: 1 MPa s,
           poisson_ratio: 0.5}
load:
  kind: program
  sentences:
    - move at 0.1 mm/s until force reaches 50 mN
    - hold height for 0.1 s, then hold force for 0.1 s
    - retract at 0.2 mm/s until contact is lost
    - stop when contact_area exceeds 2 mm2
  tilt_x: 0
  tilt_y: 0
time: {end: 2 s, steps: 40}
grid: {shape: [33, 33], size: [1.8 mm, 1.8 mm]}
output: {fields: [0 s, 0.15 s, 1.5 s], errors: false}
"""
SEGMENTS = (
    vc.Segment(1e-4, until=vc.Condition("force", 0.05)),
    vc.Segment(duration=0.1),
    vc.Segment(control="force", duration=0.1),
    vc.Segment(-2e-4, until=vc.Condition("contact")),
)


def written(folder, text=CASE):
    path = folder / "case.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def problem(folder, *settings):
    with pytest.raises(CaseError) as refusal:
        prepared(read_case(written(folder), settings))
    [line] = refusal.value.problems
    return line


def test_sentences_of_a_case_are_those_of_python(tmp_path):
    program = read_case(written(tmp_path)).load.program
    assert program.segments == SEGMENTS
    assert program.stop == (vc.Condition("contact_area", 2e-6),)
    as_text = read_case(written(tmp_path), ["load.sentences=hold height for 1 s"]).load.program
    assert as_text.segments == (vc.Segment(duration=1.0),)


def test_a_program_is_described_completely(tmp_path):
    load = prepared(read_case(written(tmp_path)), roughly=True).case.load
    assert rebuild(describe(load)) == load
    assert [event.segment for event in load.events] == [1, 4]


def test_a_forecast_finds_the_events_roughly(tmp_path):
    path = written(tmp_path)
    rough, exact = (prepared(read_case(path), roughly=each).case for each in (True, False))
    for one, other in zip(rough.load.events, exact.load.events, strict=True):
        assert one.condition == other.condition
        assert one.time == close_to(other.time, rel=0.02)
    # Fields after the end become those of the end.
    assert exact.fields == (0.0, 0.15, exact.end)


@pytest.mark.parametrize(
    ("setting", "why"),
    [
        ("load.sentences[1]=wobble", "load.sentences[1]: cannot read sentence 'wobble'"),
        ("load.sentences[3]=retract at 2 N/mm until contact is lost", "load.sentences[3]"),
        ("load.eccentricity_x=1 mm", "load.eccentricity_x: goes with a free tilt"),
        ("load.sentences[4]=hold height until force reaches 5 N", "segment 5, 'hold height until"),
        ("grid.periodic=true", "leave periodic out"),
        ("grid.size=[0.6 mm, 0.6 mm]", "the contact reaches the edge of the grid"),
    ],
)
def test_what_cannot_be_carried_out_is_refused_at_its_key(tmp_path, setting, why):
    told = problem(tmp_path, setting)
    assert why in told
    assert told.startswith(("--set load", "--set grid", f"{tmp_path / 'case.yaml'}"))


def test_a_moving_body_is_refused(tmp_path):
    motion = "motion: {kind: reciprocating, amplitude: 1 mm, period: 1 s, cycles: 1, along: x}\n"
    with pytest.raises(CaseError, match="leave motion out"):
        prepared(read_case(written(tmp_path, CASE + motion)))
