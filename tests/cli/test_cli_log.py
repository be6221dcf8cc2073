"""The log of a run: nothing unless it is asked for, on the command line or in Python."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest
import xarray as xr

import viscontact as vc
from interrupted_runs import folder, kill, whole
from viscontact.cli import main

__all__ = ["folder", "whole"]  # fixtures

BALL = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 1 s, steps: 3}
grid: {tolerance: 10 %}
output: {errors: false}
"""


def test_a_run_prints_its_grid_and_its_steps_where_it_is_asked_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "ball.yaml"
    case.write_text(BALL, encoding="utf-8")
    words = ["run", str(case), "--overwrite", "-q"]
    assert main(words) == 0
    assert capsys.readouterr().err == ""
    assert main([*words, "-v"]) == 0
    lines = capsys.readouterr().err.splitlines()
    with xr.open_dataset(tmp_path / "ball" / "result.nc") as ds:
        cells = f"automatic grid: {ds.sizes['x']} x {ds.sizes['y']} cells over "
        iterations = ds["iterations"].values.tolist()
    assert all(line.startswith("automatic grid: ") for line in lines)
    assert lines[-1].startswith(cells)
    assert "expected errors: " in lines[-1]
    assert main([*words, "-vv"]) == 0
    steps = [line for line in capsys.readouterr().err.splitlines() if line.startswith("step to")]
    assert [int(line.split(": ")[1].split(" ")[0]) for line in steps] == iterations
    assert logging.getLogger("viscontact").handlers == []
    assert main(["check", str(case), "-v"]) == 0
    assert cells in capsys.readouterr().err


def test_a_resumed_run_is_in_the_log(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume", "-v", "-q"]) == 0
    assert "case: resumed after 4 states" in capsys.readouterr().err.splitlines()


def test_a_program_that_sets_the_level_hears_of_trial_grids_and_steps(
    caplog: pytest.LogCaptureFixture,
) -> None:
    caplog.set_level(logging.DEBUG, logger="viscontact")
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), times=[0.0, 1.0], errors=False)
    said = [record.getMessage() for record in caplog.records]
    assert {record.name for record in caplog.records} == {"viscontact"}
    assert any(line.startswith("trial grid: ") for line in said)
    assert sum(line.startswith("step to t = ") for line in said) == 2
