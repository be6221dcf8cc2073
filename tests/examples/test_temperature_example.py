"""The shipped case with sun and frost: run as a user does, against the law on its clock."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main

COARSE = ["--set", "grid.tolerance=10 %", "--set", "time.steps=12", "--set", "output.errors=false"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sun and frost")
    assert main(["example", "sun-and-frost", "-o", str(folder / "day.yaml")]) == 0
    assert main(["run", str(folder / "day.yaml"), "--quiet", *COARSE]) == 0
    return folder


def test_approach_is_that_of_the_law_over_the_reduced_time(folder: Path) -> None:
    case = read_case(folder / "day.yaml")
    assert isinstance(case.material, vc.Material)
    assert case.material.shift is not None
    assert case.temperature is not None
    fine = np.linspace(0.0, case.end, 100_001)
    reduced = np.trapezoid(1 / case.material.shift.factor(case.temperature.at(fine)), fine)
    with vc.open_results(folder / "day") as ds:
        assert float(ds.reduced_time[-1]) == close_to(float(reduced), rel=1e-7)
        assert ds.temperature.values[[0, -1]].tolist() == close_to([263.15, 263.15])
        # Lee & Radok 1960: under a held force w ∝ J^(2/3); the rest is due to the coarse cells.
        grown = float(ds.approach[-1] / ds.approach[0])
        law = case.material.law
        assert grown == close_to(float((law(reduced) / law(0.0)) ** (2 / 3)), rel=1e-2)
        assert ds.attrs["warnings"] == ""


def test_temperature_of_a_run_is_kept_and_another_one_is_another_case(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, directory = str(folder / "day.yaml"), str(folder / "day")
    kept = read_case(folder / "day" / "case.yaml").temperature
    assert kept == read_case(case).temperature
    changed = [*COARSE, "--set", "temperature.mean=12 degC"]
    assert main(["run", case, "-o", directory, "--resume", "--quiet", *changed]) != 0
    assert "temperature" in capsys.readouterr().err
    assert main(["material", case, "--temperature", "30 degC"]) == 0
    assert "30 °C; times shift by WLF" in capsys.readouterr().out
    assert main(["material", case, "--temperature", "30 mm"]) != 0
    assert "--temperature: cannot read '30 mm' as a temperature" in capsys.readouterr().err
