"""Runs that were killed and resumed end in the bits of uninterrupted ones."""

from __future__ import annotations

from pathlib import Path

import pytest
import xarray as xr
from ruamel.yaml import YAML

from interrupted_runs import CASE, WITH_ERRORS, contents, folder, kill, same_bits, whole
from viscontact.case.yaml_source import write
from viscontact.cli import main

__all__ = ["folder", "whole"]  # fixtures


def test_resumed_run_ends_in_the_bits_of_an_uninterrupted_one(
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    printed = capsys.readouterr()
    assert printed.err.startswith("case: continuing after 4 of 7 instants, t = 1.5 s\n")
    assert "step 5/7" in printed.err
    # the summary is of all instants, those of the first process too
    assert "7 instants in" in printed.out
    assert f"{int(whole.iterations.sum())} iterations" in printed.out
    assert same_bits("case", whole)
    assert sorted(contents("case")) == ["case.yaml", "progress.jsonl", "result.nc"]


def test_resumed_periodic_run_ends_in_the_same_bits(folder: Path) -> None:
    """The sphere becomes one of a square array, which creeps over the border of its period."""
    text = WITH_ERRORS.replace("size: [3 mm, 3 mm]", "size: [0.9 mm, 0.9 mm], periodic: true")
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert at_once.pressure.values[-1, 0].any()
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


def test_resumed_run_on_a_body_that_ends_ends_in_the_same_bits(folder: Path) -> None:
    """The contact reaches the free end at -x, beside a sphere that is pressed off the middle."""
    ends = "poisson_ratio: 0.5\n  length: 4 mm\n  centre: 1.75 mm\n  ends: [free, null]\n"
    text = WITH_ERRORS.replace("poisson_ratio: 0.5\n", ends)
    text = text.replace("duration: 1 s}", "duration: 1 s, tilt_x: 0 deg}").replace("4 N", "2 N")
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert at_once.pressure.values[-1, 10].any()
    assert not at_once.pressure.values[-1, :10].any()
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


@pytest.mark.slow
def test_resumed_run_on_layers_ends_in_the_same_bits(folder: Path) -> None:
    """Two terms, each with its own internal variables: a cover that creeps on an elastic core."""
    data = YAML(typ="safe", pure=True).load(CASE)
    core = {"law": "elastic", "shear_modulus": "100 MPa", "poisson_ratio": 0.3}
    data["material"] = {"layers": [{"thickness": "0.3 mm", **data["material"]}], "base": core}
    (folder / "case.yaml").write_text(write(data), encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert at_once.attrs["splitting_error"] > 0
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


def test_resumed_moving_run_ends_in_the_same_bits(folder: Path) -> None:
    text = CASE.replace("size: [3 mm, 3 mm]", "size: [3 mm, 3 mm], centre: [0 mm, 0.3 mm]")
    moved = "motion: {kind: travel, points: [[0 s, 0 mm], [2 s, 0.6 mm]]}\n"
    text = text.replace("force: 4 N,", "force: 2 N, tilt_x: 0, tilt_y: 0,")
    (folder / "case.yaml").write_text(text + moved, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert float(at_once.resistance_y[4]) > 0
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)
