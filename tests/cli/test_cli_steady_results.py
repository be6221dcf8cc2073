"""Results of steady motion on the command line: their figures, and what is refused."""

import shutil
from pathlib import Path

import pytest

import viscontact as vc
from viscontact.cli import main


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    rubber = vc.Material(vc.CreepSeries(1 / 1000, [9 / 1000], [10.0]), poisson_ratio=0.5)
    ball, load = vc.Paraboloid(10.0, 10.0), vc.step(10.0, tilt_x=0.0, tilt_y=0.0)
    grid = vc.AutomaticGrid(tolerance=0.1)
    ds = vc.steady(ball, rubber, load, [0.1, 1.0], grid=grid, errors=False)
    vc.save(ds, tmp_path / "curve.nc")
    return tmp_path / "curve.nc"


@pytest.mark.parametrize(
    "figure", ["friction", pytest.param("motion-profile", marks=pytest.mark.slow)]
)
def test_figures_of_steady_motion_are_drawn(stored: Path, figure: str) -> None:
    assert main(["plot", str(stored), figure]) == 0
    assert stored.with_name(f"{figure}.png").stat().st_size > 1000


def test_what_belongs_to_runs_over_time_is_refused(
    stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for arguments, message in (
        (["plot", str(stored), "history"], "draw friction, motion-profile, pressure-map"),
        (["plot", str(stored), "friction", "--time", "1 s"], "--time: does not apply"),
    ):
        assert main(arguments) == 2
        assert message in " ".join(capsys.readouterr().err.split())


def test_frictions_of_several_runs_are_compared_by_default(
    stored: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(stored.parent)
    shutil.copy(stored, "other.nc")
    assert main(["compare", "curve.nc", "other.nc"]) == 0
    assert Path("compare-friction.png").stat().st_size > 1000
