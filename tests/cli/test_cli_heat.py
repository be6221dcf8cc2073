"""`viscontact heat`: what it prints, writes and refuses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from rolling_curves import rolling_curve
from viscontact.cli import main
from viscontact.results.variables import REQUIRED, scalars_of

AIR = ["--cooling", "10 W/m2/K", "--ambient", "60 degC"]


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    curve = rolling_curve()
    needed = [name for name in REQUIRED if name in scalars_of(over="speed")]
    zeros = {name: ("speed", np.zeros(curve.sizes["speed"])) for name in needed}
    vc.save(curve.assign(zeros), tmp_path / "curve.nc")
    return tmp_path / "curve.nc"


def test_balances_of_a_run_are_printed_and_written(stored: Path, capsys) -> None:
    figure, page = stored.with_name("heat.png"), stored.with_name("heat.html")
    options = ["--speed", "0.1 m/s", "--conductivity", "0.2 W/m/K", "-o", str(figure)]
    assert main(["heat", str(stored), *AIR, *options, "--report", str(page)]) == 0
    out = capsys.readouterr().out
    for text in ("100 mm/s", "stable", "°C", "hot spot", "surface", "no runaway on the curve"):
        assert text in out
    assert figure.stat().st_size > 1000
    assert "Heat balance" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--cooling", "10 W", "--ambient", "23 degC"], "--cooling: cannot read '10 W' as a heat"),
        (["--cooling", "10 W/m2/K", "--ambient", "23"], "--ambient: 23 has no unit"),
        ([*AIR, "--speed", "3 kg"], "--speed: cannot read '3 kg' as a speed"),
        ([*AIR, "--core-temperature", "40 degC"], "--core-temperature: needs the conductivity"),
        ([*AIR, "--density", "1150 kg/m3"], "--density: the heating over time needs heat_capacity"),
        ([*AIR, "--area", "-1 m2"], "--area must be a positive finite number"),
        ([*AIR, "--speed", "90 km/s"], "DIR: reaches no balance at any speed"),
    ],
)
def test_bad_options_are_refused_by_name(stored: Path, capsys, options, said) -> None:
    assert main(["heat", str(stored), *options]) == 2
    assert said in " ".join(capsys.readouterr().err.split())
    assert [path.name for path in stored.parent.iterdir()] == ["curve.nc"]
