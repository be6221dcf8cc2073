"""Cases that the command line refuses: at their line, and nothing is created."""

from __future__ import annotations

from pathlib import Path

import pytest

import viscontact as vc
from cli.sphere_runs import SPHERE, finished, folder
from viscontact.cli import main

__all__ = ["finished", "folder"]  # fixtures


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["indenter.raduis=5 mm"], "indenter.raduis: unknown key; did you mean 'radius'?"),
        (["indenter.radius=5"], "indenter.radius: 5 has no unit"),
        (["load.force=10 MPa"], "load.force: cannot read '10 MPa' as a force"),
        (["indenter.radius=-5 mm"], "indenter.radius: must be more than zero"),
        (["load.eccentricity_x=20 mm"], "load.eccentricity_x: the force acts at 20 mm"),
        (["load.force=-1 N"], "load.force: must be zero or more"),
        (["load.force=nan N"], "load.force: 'nan N' is not a finite number"),
        (["material.viscosity=0 Pa s"], "material.viscosity: must be more than zero"),
        (["time.steps=0"], "time.steps: must be greater than or equal to 1"),
        (["time.steps=1.5"], "time.steps: must be a whole number"),
        (["grid.shape=[1000000, 1000000]"], "grid.shape: 1000000 x 1000000 cells need about"),
        (
            [
                "material={law: creep-series, instant: 0 / MPa, amplitudes: [1 / MPa], "
                "times: [1 s], data: deviatoric, poisson_ratio: 0.5}"
            ],
            "load: the load jumps at t = 0 s",
        ),
        (["load.approach=1 mm"], "load.force: force and approach exclude each other"),
        (["grid.size=[1 nm, 1 nm]", "output.fields=[9 s]"], "output.fields: the instant 9 s"),
    ],
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_bad_case_is_refused_and_nothing_is_created(
    command: str,
    settings: list[str],
    said: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    options = [word for setting in settings for word in ("--set", setting)]
    assert main([command, "case.yaml", *options]) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert len(printed.err.splitlines()) == 1
    assert printed.out == ""
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n\x00\xff", b"load: [1", b"- 1\n"])
def test_broken_file_is_refused_and_nothing_is_created(
    content: bytes, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("case.yaml").write_bytes(content)
    assert main(["run", "case.yaml"]) == 2
    message = capsys.readouterr().err
    assert message.startswith("case.yaml:")
    assert len(message.splitlines()) == 1
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_line_of_the_file_stands_in_front(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("case.yaml").write_text(SPHERE.replace("4 N", "10 MPa"), encoding="utf-8")
    assert main(["run", "case.yaml"]) == 2
    assert capsys.readouterr().err == (
        "case.yaml:13: load.force: cannot read '10 MPa' as a force (got a pressure); "
        "write e.g. '10 kN'\n"
    )


@pytest.mark.parametrize("words", [["show"], ["export"], ["plot", "history"]])
def test_directory_without_a_result_is_refused_in_one_line(
    words: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command, *rest = words
    assert main([command, "nothing", *rest]) == 2
    assert "nothing: no result there" in capsys.readouterr().err
    assert main([command, "case.yaml", *rest]) == 2
    said = "case.yaml is neither a run directory nor a netCDF file\n"
    assert capsys.readouterr().err == said


@pytest.mark.parametrize("words", [["rnu"], ["run"], ["run", "case.yaml", "--threads", "0"]])
def test_wrong_use_exits_with_2(words: list[str], folder: Path) -> None:
    assert main(words) == 2


@pytest.mark.parametrize("words", [["show"], ["export"], ["plot", "history"]])
def test_netcdf_of_something_else_is_refused_in_one_line(
    words: list[str], finished: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with vc.open_results(finished) as ds:
        ds = ds.drop_encoding()
        ds[["force"]].to_netcdf("less.nc")
        ds.isel(time=0, drop=True).assign(time=0.0).to_netcdf("still.nc")
    command, *rest = words
    for name in ("less.nc", "still.nc"):
        assert main([command, name, *rest]) == 2
        message = capsys.readouterr().err
        assert "not a result of viscontact" in message
        assert len(message.splitlines()) == 1
