"""`viscontact leakage`: table, files, and what it refuses."""

from __future__ import annotations

import csv
import warnings
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.cli import main

# Few cells are enough here.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

SEAL = ("--viscosity", "1 mPa s", "--pressure-difference", "1 bar")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Waves that are pressed by a force that rises, saved."""
    grid = vc.Grid((6, 32), (1e-4, 1e-4), periodic=True)
    steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
    load = vc.ramp(1e9 * grid.area, 1.0)
    waves = vc.Waviness(1e-6, wavelength_y=1e-4)
    path = tmp_path_factory.mktemp("seal") / "waves.nc"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        vc.save(vc.simulate(waves, steel, load, grid, [0.0, 0.5, 1.0], errors=False), path)
    return path


def test_table_names_gaps_and_what_leaks(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["leakage", str(run), *SEAL, "--along", "both"]) == 0
    said = capsys.readouterr()
    assert "critical gap" in said.out
    assert "leak rate" in said.out
    # The strip of contact along x opens valleys along it, and closes those across.
    rows = [line.split() for line in said.out.splitlines() if line.startswith((" 0.5 s", " 1 s"))]
    assert [("closed" in row) for row in rows] == [False, True, False, True]


def test_csv_has_the_numbers_of_python(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "leak.csv"
    more = ("--length", "2 mm", "--width", "30 cm", "--gas", "1 bar", "-o", str(out))
    assert main(["leakage", str(run), *SEAL, *more]) == 0
    with out.open(encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    with vc.open_results(run) as ds:
        found = vc.leakage(
            ds, viscosity=1e-3, pressure_difference=1e5, length=2e-3, width=0.3, gas=1e5
        )
    assert float(rows[2]["leak_rate"]) == close_to(float(found.leak_rate[2]))
    assert float(rows[2]["time"]) == 1.0


def test_without_a_pressure_difference_the_rate_is_left_out(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "leak.png"
    assert main(["leakage", str(run), "--viscosity", "1 mPa s", "-o", str(out)]) == 0
    said = capsys.readouterr().out
    assert "leak rate [" not in said
    assert "--pressure-difference" in said
    assert out.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--viscosity", "1"], "--viscosity: 1 has no unit"),
        (["--viscosity", "1 mm"], "--viscosity: "),
        ([*SEAL, "--along", "z"], "--along must be"),
        ([*SEAL, "--ends", "open"], "--ends must be"),
        (["--viscosity", "1 mPa s", "--gas", "1 bar"], "--gas: needs"),
        ([*SEAL, "--length", "0 mm"], "--length must be"),
        ([*SEAL, "-o", "leak.xyz"], "leak.xyz"),
    ],
)
def test_bad_options_are_refused_in_one_line(
    options: list[str], message: str, run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["leakage", str(run), *options]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert "Traceback" not in said


def test_run_without_fields_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    body, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((16, 16), (2.4e-3, 2.4e-3))
    ds = vc.simulate(vc.Sphere(0.01), body, vc.step(0.05), grid, [0.0], fields="none", errors=False)
    vc.save(ds, tmp_path / "bare.nc")
    assert main(["leakage", str(tmp_path / "bare.nc"), *SEAL]) == 2
    assert "output: fields" in capsys.readouterr().err
    assert np.isfinite(ds.force.values).all()
