"""Directories of odd names, and names that no system takes."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from cli.sphere_runs import folder
from viscontact.cli import main

__all__ = ["folder"]  # a fixture


def test_directory_that_no_system_can_name_is_refused_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml", "-q", "-o", "a" * 300]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


@pytest.mark.parametrize(
    "name",
    [
        *("~", " lead", "file:"),
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("~x", "trail ", "http:", "a:b", "#a", "é")
        ),
    ],
)
def test_directories_of_odd_names_hold_runs(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if os.name == "nt":
        pytest.skip("Windows has no such names")
    home = folder / "home"
    home.mkdir()
    monkeypatch.setenv("HOME", str(home))
    assert main(["run", "case.yaml", "-o", name, "--set", "time.steps=1"]) == 0
    assert main(["show", name]) == 0
    assert (folder / name / "result.nc").is_file()
    assert {path.name for path in folder.iterdir()} == {"case.yaml", "home", name}
    assert not any(home.iterdir())


@pytest.mark.parametrize("name", [b"x\\y", b"\\", b"a\xffb"])
def test_directories_that_netcdf_cannot_name_are_refused(
    name: bytes, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if os.name == "nt":
        pytest.skip("Windows has no such names")
    assert main(["run", "case.yaml", "-o", os.fsdecode(name)]) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert "netCDF" in line
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]
