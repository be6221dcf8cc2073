"""Sections `friction` and `tangential` of a case file."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from viscontact.case import CaseError, read_case

CASE = """
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, youngs_modulus: 3 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 N}
friction: {coefficient: 0.3}
tangential: {kind: step, force_x: 0.2 N}
time: {end: 1 s, steps: 4}
grid: {shape: [32, 32], size: [5 mm, 5 mm]}
"""


def read(tmp_path: Path, *overrides: str, text: str = CASE) -> Any:
    path = tmp_path / "case.yaml"
    path.write_text(text, encoding="utf-8")
    return read_case(path, overrides)


@pytest.mark.parametrize(
    ("section", "expected"),
    [
        ("{kind: step, torque: 2 N mm}", vc.tangential_step(torque=2e-3)),
        (
            "{kind: ramp, displacement_x: 5 um, duration: 2 s}",
            vc.tangential_ramp(displacement_x=5e-6, duration=2.0),
        ),
        (
            "{kind: harmonic, force_y: -1 N, period: 1 s, cycles: 3, phase: 90 deg}",
            vc.tangential_harmonic(force_y=-1.0, period=1.0, cycles=3, phase=1.5707963267948966),
        ),
        (
            "{kind: history, times: [0 s, 1 s], rotation: [0 rad, 2 mrad]}",
            vc.TangentialHistory([0, 1], rotation=[0, 2e-3]),
        ),
    ],
)
def test_each_kind_is_the_load_of_its_function(section, expected, tmp_path):
    text = CASE.replace("{kind: step, force_x: 0.2 N}", section)
    found = read(tmp_path, text=text).tangential
    assert found.kinks.tolist() == expected.kinks.tolist()
    for time in (0.0, 0.3, 1.0):
        assert found.at(time) == expected.at(time)


def test_friction_is_uncoupled_where_the_case_says_so(tmp_path):
    assert read(tmp_path).friction == vc.Friction(0.3)
    assert read(tmp_path, "friction.coupling=false").friction == vc.Friction(0.3, coupling=False)
    worn = read(tmp_path, "friction.wear=1e-7 mm^3/(N m)").friction
    assert worn == vc.Friction(0.3, wear=1e-16)


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("friction.coefficient=30 %", "friction.coefficient"),
        ("friction.coefficient=30", "friction.coefficient"),
        ("friction.coefficient=-0.1", "friction.coefficient"),
        ("friction.mu=0.3", "write 'friction: {coefficient: 0.3}'"),
        ("tangential.force_x=0.2", "0.2 has no unit; a force is expected"),
        ("tangential.force=1 N", "tangential.force: unknown key. Allowed: displacement_x"),
        ("tangential.kind=sine", "unknown value 'sine'"),
        ("tangential.displacement_x=1 um", "displacement_x and force_x contradict each other"),
        ("allowable.heat=1 J", "only a moving contact has it"),
    ],
)
def test_bad_values_are_refused_at_their_keys(override, said, tmp_path):
    with pytest.raises(CaseError, match=said.replace("{", r"\{").replace("}", r"\}")):
        read(tmp_path, override)


def test_limits_of_friction_go_with_friction(tmp_path):
    assert read(tmp_path, "allowable.friction_heat=1 J").allowable == {"friction_heat": 1.0}
    text = CASE.replace("friction: {coefficient: 0.3}\n", "").replace(
        "tangential: {kind: step, force_x: 0.2 N}\n", ""
    )
    with pytest.raises(CaseError, match="only a contact under friction has it"):
        read(tmp_path, "allowable.friction_heat=1 J", text=text)


def test_tangential_load_in_steady_motion_is_refused(tmp_path):
    text = CASE.replace("time: {end: 1 s, steps: 4}\n", "")
    steady = text + "motion: {kind: steady, along: y, speed: 1 mm/s, creepage: 1 %}\n"
    with pytest.raises(CaseError, match="tangential: a body in steady motion rolls under friction"):
        read(tmp_path, text=steady)


TABLE = "time [s];force_x [mN];torque [N mm]\n0;0;0\n1;20;0,1\n2;-20;0,1\n"


def with_table(tmp_path, table, more=""):
    """The case with a tangential load from a table."""
    (tmp_path / "shaken.csv").write_text(table, encoding="utf-8")
    section = f"tangential:\n  kind: history\n  file: shaken.csv\n{more}"
    return read(tmp_path, text=CASE.replace("tangential: {kind: step, force_x: 0.2 N}\n", section))


@pytest.mark.parametrize(
    ("table", "more"),
    [
        (TABLE, ""),
        (TABLE.partition("\n")[2], "  columns: time [s]; force_x [mN]; torque [N mm]\n"),
    ],
)
def test_a_table_is_a_tangential_history(tmp_path, table, more):
    case = with_table(tmp_path, table, more)
    found = case.tangential
    assert found.times.tolist() == [0, 1, 2]
    np.testing.assert_allclose(found.force_x, [0, 0.02, -0.02])
    np.testing.assert_allclose(found.torque, [0, 1e-4, 1e-4])
    assert case.files["tangential", "file"].name == "shaken.csv"


@pytest.mark.parametrize(
    ("table", "more", "said"),
    [
        (TABLE.replace("2;-20", "0,5;-20"), "", "shaken.csv:4: time must not decrease"),
        (TABLE.replace("torque [N mm]", "force [N]"), "", "cannot read the column name 'force"),
        (TABLE.replace("torque [N mm]", "displacement_x [um]"), "", "contradict each other"),
        (TABLE.replace("[mN]", "[mm]"), "", "cannot read 'mm' as a force"),
        ("time [s]\n0\n1\n", "", "has no load"),
        ("time [s];force_x [N]\n0;1\nx;2\n", "", "shaken.csv:3"),
        (TABLE, "  times: [0 s, 1 s]\n", "times: goes without file"),
        (TABLE, "  force_y: [0 N, 1 N]\n", "force_y: goes without file"),
    ],
)
def test_a_wrong_table_is_refused_with_its_line(tmp_path, table, more, said):
    with pytest.raises(CaseError, match=re.escape(said)):
        with_table(tmp_path, table, more)
