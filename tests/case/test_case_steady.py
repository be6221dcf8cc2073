"""Cases of steady motion: their speeds and kept fields, and what they refuse."""

from pathlib import Path

import pytest

from closeness import close_to
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.case import CaseError, case_schema, read_case

CASE = """\
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material: {law: zener, shear_modulus: 9 MPa, delayed_modulus: 1 MPa, viscosity: 10 kPa s, \
poisson_ratio: 0.5}
load: {kind: step, force: 1 N, tilt_x: 0 rad, tilt_y: 0 rad}
motion: {kind: steady, speed: SPEED}
"""


def write(folder: Path, speed: str = "0.5 m/s", more: str = "") -> Path:
    path = folder / "case.yaml"
    path.write_text(CASE.replace("SPEED", speed) + more, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("speed", "speeds"),
    [
        ("0.5 m/s", [0.5]),
        ("[10 mm/s, 3.6 km/h]", [0.01, 1.0]),
        ("{from: 1 mm/s, to: 1 m/s, count: 4}", [0.001, 0.01, 0.1, 1.0]),
        ("{from: 1 m/s, to: 4 m/s, count: 4, spacing: uniform}", [1.0, 2.0, 3.0, 4.0]),
    ],
)
def test_speed_is_one_a_list_or_a_range(speed: str, speeds: list[float], tmp_path: Path) -> None:
    case = read_case(write(tmp_path, speed))
    assert isinstance(case.motion, SteadyMotion)
    assert case.motion.speeds == close_to(speeds)
    assert (case.motion.along, case.motion.rolling, case.motion.stands) == ("y", None, False)


def test_fields_are_kept_at_speeds(tmp_path: Path) -> None:
    speeds = "{from: 1 mm/s, to: 1 m/s, count: 4}"
    some = write(tmp_path, speeds, "output: {fields: [100 mm/s, 1 mm/s]}\n")
    assert read_case(some).fields == close_to([0.1, 0.001])
    assert read_case(write(tmp_path, speeds)).fields == "all"
    many = read_case(write(tmp_path, "{from: 1 mm/s, to: 1 m/s, count: 30}"))
    assert len(many.fields) == 10


@pytest.mark.parametrize(
    ("speed", "more", "message"),
    [
        ("0.5 m/s", "time: {end: 1 s, steps: 3}", ":5: time: a steady motion has no steps in time"),
        ("0.5", "", ":4: motion.speed: "),
        ("0.5 m", "", "a speed"),
        ("[1 m/s, 100 cm/s]", "", "each speed is needed once, got 1 m/s twice"),
        ("[]", "", "motion.speed: "),
        ("{from: 1 m/s, to: 2 m/s}", "", "motion.speed.count: is missing"),
        ("{to: 2 m/s, count: 3}", "", "motion.speed.from: is missing; write e.g. 'from: 0.5 m/s'"),
        ("{from: 1 m/s, to: 2 m/s, steps: 3}", "", "Allowed: count, from, spacing, to"),
        ("1 m/s", "output: {fields: [2 m/s]}", "fields: 2 m/s is not among the speeds"),
        ("1 m/s", "output: {fields: [2 s]}", "fields: a steady motion has no instants"),
    ],
)
def test_refused(speed: str, more: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(CaseError) as refused:
        read_case(write(tmp_path, speed, more))
    assert message in str(refused.value)


@pytest.mark.parametrize(
    ("load", "message"),
    [
        ("{kind: ramp, force: 1 N, duration: 1 s}", "load: a steady motion has a constant load"),
        ("{kind: step, force: 0 N}", "load: the force must be positive"),
    ],
)
def test_load_is_constant(load: str, message: str, tmp_path: Path) -> None:
    path = write(tmp_path)
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([*lines[:2], f"load: {load}", lines[3]]), encoding="utf-8")
    with pytest.raises(CaseError, match=message):
        read_case(path)


def test_time_is_required_of_other_cases(tmp_path: Path) -> None:
    path = write(tmp_path)
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(lines[:3]), encoding="utf-8")
    with pytest.raises(CaseError, match="time: is missing; instants of the run"):
        read_case(path)
    path.write_text(
        "\n".join([*lines[:3], "output: {fields: [1 m/s]}", "time: {end: 1 s, steps: 2}"])
    )
    with pytest.raises(CaseError, match="speeds go with a steady motion"):
        read_case(path)
    assert case_schema()["else"] == {"required": ["time"]}
