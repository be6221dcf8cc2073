"""The estimate of errors as a run's last stage: stopped in it, taken up, left out."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from interrupted_runs import CASE, COUNT, WITH_ERRORS, Killed, same_bits
from viscontact.cli import main
from viscontact.simulation import transient


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working directory with a case in it."""
    (tmp_path / "case.yaml").write_text(WITH_ERRORS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """The result of an uninterrupted run."""
    here = tmp_path_factory.mktemp("whole")
    (here / "case.yaml").write_text(WITH_ERRORS, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    with xr.open_dataset(here / "case" / "result.nc") as ds:
        return ds.load()


def within_the_stage(act: Callable[[], None]) -> Callable[[], None]:
    """Do something when the second companion begins; return what undoes that."""
    patched, begun = pytest.MonkeyPatch(), []
    original = transient.March

    def march(*arguments: Any, **options: Any) -> object:
        if not options.get("warns", True):  # a companion
            begun.append(1)
            if len(begun) == 2:
                act()
        return original(*arguments, **options)

    patched.setattr(transient, "March", march)
    return patched.undo


@pytest.mark.usefixtures("folder")
def test_request_within_the_estimate_keeps_all_steps_and_is_gone_on_from(
    whole: xr.Dataset, capsys: pytest.CaptureFixture[str]
) -> None:
    undo = within_the_stage(lambda: os.kill(os.getpid(), signal.SIGINT))
    assert main(["run", "case.yaml"]) == 130
    undo()
    said = capsys.readouterr().err
    assert "estimating errors" in said
    assert "--resume" in said
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == COUNT
        assert ds.attrs["complete"] == 0
        assert np.isnan(ds.approach_error).all()
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", whole)


@pytest.mark.usefixtures("folder")
def test_run_that_was_killed_within_the_estimate_ends_in_the_same_bits(whole: xr.Dataset) -> None:
    def die() -> None:
        raise Killed

    undo = within_the_stage(die)
    with pytest.raises(Killed):
        main(["run", "case.yaml", "-q"])
    undo()
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)
    with vc.open_results("case") as ds:
        assert ds.attrs["complete"] == 1
        assert np.isfinite(ds.approach_error).all()
        assert ds.approach.attrs["ancillary_variables"] == "approach_error"


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_errors_are_the_same_on_disk_as_in_memory(whole: xr.Dataset) -> None:
    material = vc.Material(vc.Zener(1e7, 1e7, 1e7), poisson_ratio=0.5)
    grid, times = vc.Grid((24, 24), (3e-3, 3e-3)), vc.uniform_times(3.0, 6)
    ds = vc.simulate(vc.Sphere(0.01), material, vc.ramp(4.0, 1.0), grid, times)
    for name in ("approach_error", "peak_pressure_error", "contact_area_error"):
        np.testing.assert_allclose(whole[name].values, ds[name].values, rtol=1e-12)


def test_errors_may_be_left_out(folder: Path) -> None:
    without = CASE.replace("fields: [0 s, 2 s, 3 s]", "fields: none")
    (folder / "case.yaml").write_text(without, encoding="utf-8")
    assert main(["run", "case.yaml", "-q"]) == 0
    with vc.open_results("case") as ds:
        assert not [name for name in ds.variables if name in ("force_error", "approach_error")]
        assert "ancillary_variables" not in ds.approach.attrs
    (folder / "case.yaml").write_text(WITH_ERRORS, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "--resume"]) == 2  # another run now
