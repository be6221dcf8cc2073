"""What users rely on at the command line: options, exit codes and files."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from project.promised_run import BALL, CASE, GRID, RUBBER, check_variables
from viscontact.cli import main

# A handful of steps is enough here; that they are few is warned about, and tested elsewhere.
pytestmark = [
    pytest.mark.filterwarnings("ignore:the load grows from nothing:viscontact.AccuracyWarning"),
    pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning"),
]


OPTIONS = {
    "run": ("--output", "-o", "--resume", "--overwrite", "--set", "--threads", "--quiet"),
    "check": ("CASE.yaml",),
    "show": ("DIR",),
    "export": ("DIR", "--output", "-o"),
    "plot": ("DIR", "FIGURE", "--time", "--output", "-o"),
    "compare": ("DIR", "--figure", "--output", "-o"),
    **{"schema": (), "demo": ()},
    "example": ("-o",),
    "run ...": (
        *("--vary", "--zip", "--table", "--sample", "--range", "--seed", "-j"),
        *("--scheduler", "--array", "--task"),
    ),
    "fit": (
        *("FILE.csv", "--case", "--change", "--contact-point", "--machine-stiffness", "--drive"),
        *("-j", "-o", "--yaml", "--resume"),
    ),
    "design": (
        *("--change", "--minimise", "--maximise", "--at", "--over", "--constraint"),
        *("--runs", "-j", "-o", "--resume"),
    ),
    "sensitivity": ("--of", "--change", "--at", "-j", "-o", "--resume"),
    "heat": (
        *("DIR", "--cooling", "--ambient", "--area", "--conductivity", "--core-temperature"),
        *("--heat-capacity", "--density"),
    ),
    "leakage": ("DIR", "--viscosity", "--pressure-difference", "--along", "-o"),
    **{"status": ("DIR", "--watch"), "collect": ("DIR", "-o")},
    # promised, not built yet
    **{"report": ("DIR", "-o"), "material": (), "verify": ("--fast", "-o")},
}
FIGURES = (
    *("pressure-map", "pressure-profile", "pressure-radial", "contact-outline"),
    *("history", "hysteresis", "creep", "line-load"),
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A working directory with a case in it."""
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(json.dumps(CASE), encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("command", OPTIONS)
def test_command_has_its_options(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command.split()[0], "--help"]) == 0
    said = capsys.readouterr().out
    for option in OPTIONS[command]:
        assert option in said


def test_run_directory_holds_the_result_and_the_case(folder: Path) -> None:
    assert main(["run", "ball.yaml", "--quiet", "--threads", "1"]) == 0
    held = sorted(path.name for path in Path("ball").iterdir())
    assert held == ["case.yaml", "progress.jsonl", "result.nc"]
    with netCDF4.Dataset("ball/result.nc") as file:
        assert file.dimensions["time"].isunlimited()
    with vc.open_results("ball") as ds, xr.open_dataset("ball/result.nc") as plain:
        check_variables(ds, np.float32)
        xr.testing.assert_identical(ds, plain)
        again = vc.simulate(BALL, RUBBER, vc.step(0.1), GRID, vc.uniform_times(1.0, 2))
        np.testing.assert_array_equal(ds.pressure, again.pressure.astype(np.float32))
        assert ds.attrs["title"] == "Ball"
        assert {"version", "case", "wall_time", "tolerance", "warnings"} <= set(ds.attrs)


def test_every_command_works_on_a_directory_and_on_its_file(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "ball.yaml"]) == 0
    assert main(["run", "ball.yaml", "-q", "-o", "one"]) == 0
    assert main(["run", "ball.yaml", "-q", "-o", "two", "--set", "load.force=80mN"]) == 0
    for read in ("one", "one/result.nc"):
        assert main(["show", read]) == 0
        assert main(["export", read, "-o", "one.csv"]) == 0
    with Path("one.csv").open(encoding="utf-8") as lines:
        assert len(list(csv.DictReader(lines))) == 3
    assert main(["compare", "one", "two/result.nc", "--figure", "history", "-o", "both.png"]) == 0
    assert main(["schema"]) == 0
    assert main(["example", "sphere-zener", "-o", "example.yaml"]) == 0
    assert {path.name for path in folder.iterdir()} >= {"one.csv", "both.png", "example.yaml"}


def test_every_figure_is_drawn(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # No pixels are counted here.
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 30)
    assert main(["run", "ball.yaml", "-q"]) == 0
    for figure in FIGURES:
        assert main(["plot", "ball", figure, "-o", f"{figure}.png"]) == 0
        assert Path(f"{figure}.png").read_bytes().startswith(b"\x89PNG")


def test_exit_codes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # 2: refused before the first step, and nothing created
    assert main(["run", "ball.yaml", "--set", "load.force=10 MPa"]) == 2
    assert not Path("ball").exists()
    assert "load.force: cannot read '10 MPa' as a force" in capsys.readouterr().err
    # 1: stopped during the run, and the completed steps kept
    small = ["--set", "grid.size=[1.3 mm, 1.3 mm]", "--set", "time={end: 9 s, steps: 50}"]
    assert main(["run", "ball.yaml", "-q", *small]) == 1
    with vc.open_results("ball") as ds:
        assert 1 <= ds.sizes["time"] < 51
    # 2 again: a result is there, and both ways out are named
    capsys.readouterr()
    assert main(["run", "ball.yaml", "-q"]) == 2
    said = capsys.readouterr().err
    assert "--resume" in said
    assert "--overwrite" in said
    # 0: done, and finished already
    assert main(["run", "ball.yaml", "-q", "--overwrite"]) == 0
    assert main(["run", "ball.yaml", "--resume"]) == 0
    assert capsys.readouterr().err.count("\n") == 1


def test_sweep_has_a_manifest_and_a_dataset(folder: Path) -> None:
    varied = ["--vary", "load.force=80mN,0.1N", "-j", "1"]
    assert main(["run", "ball.yaml", "-q", *varied, "-o", "all"]) == 0
    lines = [json.loads(line) for line in Path("all/runs.jsonl").read_text().splitlines()]
    assert [line["run"] for line in lines] == [0, 1]
    assert set(lines[0]) >= {"run", "name", "directory", "settings"}
    assert all(Path("all", line["directory"], "result.nc").is_file() for line in lines)
    ds = vc.open_many("all")
    assert ds.approach.dims == ("load.force", "time")
    assert (ds["load.force"].values.tolist(), ds["load.force"].attrs["units"]) == ([0.08, 0.1], "N")
    assert main(["status", "all"]) == main(["collect", "all", "-o", "all.nc"]) == 0
    assert main(["report", "all"]) == 0
