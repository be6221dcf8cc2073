"""`check` predicts the warnings of a run, and warns of nothing in a sound case."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from simulation.checks.guarded_runs import END
from viscontact.cli import main

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 10 MPa, delayed_modulus: 10 MPa, viscosity: 10 MPa s,
  poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 30}
grid: {shape: [32, 32], size: [3 mm, 3 mm]}
output: {fields: none, errors: false}
"""
ROLLER = "indenter={shape: roller, radius: 10 mm, half_length: 2 mm}"
SLOW, WIDE_GRID = "load={kind: ramp, force: 4 N, duration: 2 s}", "grid.size=[4 mm, 4 mm]"
TABLED = (
    "material={law: table, file: creep.csv, quantity: creep_compliance, data: deviatoric, "
    "poisson_ratio: 0.5}"
)
OFF, OFF_AT_ONCE = (
    f"load={{kind: history, points: [[0 s, 4 N], [3 s, 4 N], [{end} s, 0 N]]}}" for end in (4, 3)
)
# Contact radius after 5 s, with J = (1 - nu)/G: a = (3 * 4 N * 10 mm/(40 MPa))^(1/3) = 1.14 mm.
EXPECTED = {
    "rim": (
        ["grid.size=[2.1 mm, 2.1 mm]"],
        "will probably overrun the grid",
        "the contact reaches the edge of the grid",
    ),
    "cells": (["grid.shape=[10, 10]"], "fewer than 10 cells across", "only 8 cells lie across"),
    "thickness of the half-space": (["material.thickness=5 mm"], "of the body's thickness"),
    "thickness of the indenter": (
        [
            "indenter_material={law: elastic, shear_modulus: 10 GPa, poisson_ratio: 0.3, "
            "thickness: 5 mm}"
        ],
        "of the body's thickness",
    ),
    "slope": (["indenter={shape: cone, half_angle: 65 deg}", WIDE_GRID], "the indenter's slope"),
    "end": ([ROLLER, "grid.size=[5 mm, 3 mm]"], END),
    "end face": (
        [
            ROLLER,
            "grid.size=[5 mm, 3 mm]",
            "indenter_material={law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}",
        ],
        "the indenter ends within a half width",
    ),
    "width": (["load.force=172 N", "grid.size=[12 mm, 12 mm]"], "half width"),
    "approach": (["load.force=172 N", "grid.size=[12 mm, 12 mm]"], "the approach"),
    "data": (["material.measured_until=4 s"], "the material's data end"),
    "early": ([TABLED], "where the material's data begin"),
    "touch": ([SLOW, "time.steps=2"], "grows from nothing to 100% of its largest"),
    "release": ([OFF, "time.steps=5"], "the load falls by 100% of its largest in a single"),
}
#: Warned of where another of the same kind is: of either body, of the same contact.
SIBLINGS = {"thickness of the indenter", "approach"}


@pytest.fixture
def case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A case without any warning, and a table beside it."""
    monkeypatch.chdir(tmp_path)
    times = np.geomspace(1, 100, 21)
    rows = "".join(f"{t!r}; {0.05 * t**0.05!r}\n" for t in times.tolist())
    text = "time [s]; creep_compliance [1/MPa]\n" + rows
    (tmp_path / "creep.csv").write_text(text, encoding="utf-8")
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    return tmp_path / "case.yaml"


def checked(capsys: pytest.CaptureFixture[str], *settings: str) -> str:
    assert main(["check", "case.yaml", *(f"--set={each}" for each in settings)]) == 0
    return " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(
    "settings",
    [
        ["output.errors=true"],
        pytest.param(["material.thickness=6 mm"], marks=pytest.mark.slow),  # 1.14 mm is 0.19 of it
        pytest.param([SLOW], marks=pytest.mark.slow),
        [TABLED, "load={kind: ramp, force: 4 N, duration: 5 s}", "grid.size=[2 mm, 2 mm]"],
        pytest.param(["material.measured_until=5 s"], marks=pytest.mark.slow),
        # A crown ends the contact before the roller ends.
        [
            "indenter={shape: roller, radius: 10 mm, half_length: 1 mm, crown_radius: 20 mm}",
            "grid.size=[6 mm, 3 mm]",
        ],
    ],
)
@pytest.mark.usefixtures("case")
def test_check_and_run_warn_of_nothing_in_a_sound_case(
    settings: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert "case.yaml: no problems found" in checked(capsys, *settings)
    assert warned(capsys, settings) == ""


def warned(capsys: pytest.CaptureFixture[str], settings: list[str]) -> str:
    """Everything that a run of the case says against itself."""
    chosen = [f"--set={each}" for each in settings]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        code = main(["run", "case.yaml", "-q", "-o", "out", *chosen])
    return capsys.readouterr().err if code else vc.open_results("out").attrs["warnings"]


@pytest.mark.parametrize(
    "expected",
    [
        pytest.param(each, id=name, marks=[pytest.mark.slow] if name in SIBLINGS else [])
        for name, each in EXPECTED.items()
    ],
)
@pytest.mark.usefixtures("case")
def test_check_predicts_the_warnings_of_the_run(
    expected: tuple[Any, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    settings, words, *others = expected
    printed = checked(capsys, *settings)
    assert "can be read, but:" in printed
    assert words in printed
    assert (others[0] if others else words) in warned(capsys, settings)


@pytest.mark.usefixtures("case")
@pytest.mark.parametrize("settings", [[OFF], [OFF_AT_ONCE, "time.steps=5"]], ids=["steps", "jump"])
def test_load_taken_off_as_it_should_be_is_no_release_in_one_step(
    settings: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert "the contact is lost as" not in checked(capsys, *settings)
    assert "the contact is lost as" not in warned(capsys, settings)
