"""`viscontact theory`: numbers of Python, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from viscontact.cli import main

BODY = ("--material", "epdm-70-25c", "--pressure", "0.3 MPa")


@pytest.fixture
def road(tmp_path: Path) -> str:
    """Waves along both axes, in a file."""
    phase = 2 * np.pi * np.arange(32) / 32
    height = 2e-6 * (np.cos(phase)[:, None] + np.sin(phase))
    np.savez(tmp_path / "road.npz", height=height, spacing=1e-6, unit="m", periodic=True)
    return str(tmp_path / "road.npz")


def test_area_is_that_of_python(road: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["theory", road, *BODY, "--time", "1 h"]) == 0
    surface = vc.read_surface(road)
    found = vc.surfaces.persson_area(surface, vc.shipped_material("epdm-70-25c"), 3e5, 3600.0)
    assert f"{found:.3g}" in capsys.readouterr().out


def test_friction_is_printed_and_drawn(
    road: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "road.png"
    speeds = ("--speed", "1 mm/s", "--speed", "1 m/s")
    assert main(["theory", road, *BODY, *speeds, "-o", str(picture)]) == 0
    said = capsys.readouterr().out
    assert "friction coefficient" in said
    assert " to " in said
    assert picture.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--material", "epdm-70-25c", "--pressure", "3"], "--pressure: 3 has no unit"),
        (BODY, "--time: the material creeps"),
        ([*BODY, "--speed", "1 mm"], "--speed: "),
        ([*BODY, "--speed", "1 m/s", "--along", "z"], "--along must be"),
        ([*BODY, "--time", "1 s", "-o", "road.png"], "-o: the figure is over speed"),
        (["--material", "epdm", "--pressure", "1 MPa"], "epdm"),
    ],
)
def test_bad_options_are_refused_in_one_line(
    options: list[str], message: str, road: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["theory", road, *options]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert "Traceback" not in said


def test_missing_file_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["theory", "nowhere.npz", *BODY]) == 2
    assert "nowhere.npz" in capsys.readouterr().err
