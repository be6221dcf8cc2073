"""Cases of steady motion at the command line: run, interrupted, resumed, shown, drawn, varied."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from campaigns import tried
from closeness import close_to
from interrupted_runs import same_bits, stopped_after
from killed_run import lines_of
from viscontact.cli import main

SPEEDS = [0.01, 0.1, 1.0]
CASE = """\
title: Ball that slides on rubber
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material: {law: zener, shear_modulus: 9 MPa, delayed_modulus: 1 MPa, viscosity: 10 kPa s, \
poisson_ratio: 0.5}
load: {kind: step, force: 1 N, tilt_x: 0 rad, tilt_y: 0 rad}
motion: {kind: steady, speed: {from: 10 mm/s, to: 1 m/s, count: 3}, along: x}
grid: {tolerance: 0.1}
"""


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run."""
    here = tmp_path_factory.mktemp("steady")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    return here / "case"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_result_is_that_of_steady(finished: Path) -> None:
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    with vc.open_results(finished) as ds:
        speeds = ds.speed.values
        whole = vc.steady(
            ball, rubber, load, speeds, along="x", grid=vc.AutomaticGrid(tolerance=0.1)
        )
        assert speeds == close_to(SPEEDS)
        assert set(ds.data_vars) == set(whole.data_vars)
        for name in ds.data_vars:
            # Fields are stored in single precision where the tolerance permits it.
            exact = ds[name].dtype == np.float64
            np.testing.assert_allclose(ds[name], whole[name], rtol=0 if exact else 1e-6, atol=0)
            assert ds[name].dims == whole[name].dims
        assert json.loads(ds.attrs["case"])["motion"]["kind"] == "steady"
    lines = (finished / "progress.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line)["speed"] for line in lines] == speeds.tolist()
    assert json.loads(lines[-1])["complete"]


@pytest.mark.parametrize("errors", ["true", pytest.param("false", marks=pytest.mark.slow)])
def test_run_stopped_after_a_speed_is_resumed_to_the_same_bits(
    errors: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # On a given grid, without errors, the guess is the contact at the last speed.
    speeds = "[200 mm/s, 100 mm/s, 50 mm/s]"
    grid = "grid={shape: [32, 32], size: [4.4 mm, 4.4 mm]}"
    words = ["run", "case.yaml", "-q", "--set", f"output.errors={errors}"]
    words += ["--set", f"motion.speed={speeds}", "--set", grid]
    assert main([*words, "-o", "whole"]) == 0
    with xr.open_dataset("whole/result.nc") as ds:
        whole = ds.load()
    with stopped_after(monkeypatch, 2):
        assert main(words) == 130
    assert "case keeps 2 of 3 speeds" in capsys.readouterr().err
    with vc.open_results("case") as part:
        assert part.speed.values.tolist() == [0.2, 0.1]
    assert main(["show", "case"]) == 0
    assert "the run stopped at 2 of 3 speeds" in " ".join(capsys.readouterr().out.split())
    assert main([each for each in words if each != "-q"] + ["--resume"]) == 0
    assert "continuing after 2 of 3 speeds, 100 mm/s" in capsys.readouterr().err
    assert same_bits("case", whole)


@pytest.mark.parametrize(
    "law",
    [
        "power-law, compliance: 1e-6 / Pa, exponent: 0.3, reference_time: 1 s, "
        "instant: 1e-7 / Pa, data: shear",
        "maxwell, shear_modulus: 9 MPa, viscosity: 10 kPa s",
    ],
)
def test_check_needs_no_time_at_which_creep_is_over(
    folder: Path, capsys: pytest.CaptureFixture[str], law: str
) -> None:
    begin, _, end = CASE.partition("zener, shear_modulus: 9 MPa, delayed_modulus: 1 MPa, ")
    end = end.removeprefix("viscosity: 10 kPa s")
    (folder / "case.yaml").write_text(f"{begin}{law}{end}", encoding="utf-8")
    assert main(["check", "case.yaml"]) == 0
    assert "peak pressure" in capsys.readouterr().out


@pytest.mark.slow
def test_killed_run_is_resumed_to_the_same_bits(folder: Path, finished: Path) -> None:
    command = [sys.executable, "-m", "viscontact", "run", "case.yaml", "-q", "--resume"]
    process = subprocess.Popen(command)
    lines = Path("case/progress.jsonl")
    while process.poll() is None and not (lines.exists() and lines.stat().st_size):
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert main(command[3:]) == 0
    with xr.open_dataset(finished / "result.nc") as whole:
        assert same_bits("case", whole.load())
    assert lines_of(Path("case")) == lines_of(finished)


@pytest.mark.slow
def test_runs_killed_at_lines_spread_over_the_recording_are_resumed(tmp_path: Path) -> None:
    grid = "grid: {shape: [24, 24], size: [4.4 mm, 4.4 mm]}"  # the lines are those of any grid
    case = CASE.replace("grid: {tolerance: 0.1}", grid)
    (tmp_path / "case.yaml").write_text(case, encoding="utf-8")
    program = Path(__file__).parents[1] / "killed_run.py"
    command = [sys.executable, str(program), "lines", str(tmp_path), "1"]
    found = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    assert found["faults"] == []
    assert found["killed"] > tried(15, 30)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["plot", "history"], "history: shows a run over time"),
        (["plot", "hysteresis"], "hysteresis: shows a run over time"),
        (["plot", "contact-area"], "contact-area: shows a run over time"),
        (["plot", "exact"], "exact: shows a run over time"),
        (["plot", "von-mises"], "von-mises: shows a run over time"),
        (["plot", "animation"], "animation: shows a run over time"),
        (["plot", "pressure-map", "--time", "1 s"], "give --speed in its place"),
        (["plot", "pressure-map", "--speed", "5 m/s"], "lies outside the run"),
        (["plot", "friction", "--speed", "1 m/s"], "--speed: does not apply"),
    ],
)
def test_what_belongs_to_runs_over_time_is_refused(
    words: list[str], message: str, finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([words[0], str(finished), *words[1:]]) == 2
    assert message in " ".join(capsys.readouterr().err.split())


@pytest.mark.slow
def test_tables_and_sweeps(
    folder: Path, finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml"]) == 0
    assert "speeds 3, from 10 mm/s to 1 m/s" in " ".join(capsys.readouterr().out.split())
    assert main(["show", str(finished)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "friction" in said
    assert "force: 1 N at each speed" in said
    assert main(["export", str(finished)]) == 0
    assert capsys.readouterr().out.startswith("speed [m/s],force [N]")
    vary = ["--vary", "load.force=1 N,2 N", "--set", "motion.speed=[0.1 m/s, 1 m/s]"]
    off = ["--set", "output={fields: none, errors: false}"]
    assert main(["run", "case.yaml", "-q", *vary, *off, "-o", "two", "-j", "1"]) == 0
    ds = vc.open_many("two")
    assert ds.friction_coefficient.dims == ("load.force", "speed")
    assert ds.force.values == close_to(np.array([[1.0, 1.0], [2.0, 2.0]]))
