"""A finished run whose errors are written down."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.cli import main
from viscontact.results.variables import SCALARS

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 1 MPa, delayed_modulus: 1 MPa, viscosity: 1 MPa s,
           poisson_ratio: 0.5}
load: {kind: triangle, force: 1 N, rise: 2 s}
time: {end: 5 s, steps: 20}
grid: {shape: [32, 32], size: [5 mm, 5 mm]}
output: {fields: [2 s]}
"""
#: Relative errors, no two alike.
PARTS = {
    "approach": 0.0123, "contact_area": 0.034, "contact_length": 0.0021, "contact_width": 0.0034,
    "peak_pressure": 0.056, "mean_pressure": 0.0078, "work": 0.009, "force": 0.0,
    "loss_per_cycle": 0.11,
}  # fmt: skip


@pytest.fixture(scope="module")
def directory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run."""
    here = tmp_path_factory.mktemp("stated")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    return here / "case"


@pytest.fixture(scope="module")
def bare(directory: Path) -> xr.Dataset:
    """Its result, as versions before this one wrote it."""
    with vc.open_results(directory) as ds:
        companions = [name for name in ds if str(name).removesuffix("_error") in SCALARS]
        return ds.load().drop_vars([name for name in companions if name not in SCALARS])


def with_errors(bare: xr.Dataset, **given: np.ndarray) -> xr.Dataset:
    """The result with errors of so many parts of each value, or with those given."""
    ds = bare.copy(deep=True)
    for name, part in PARTS.items():
        error = given.get(name, part * np.abs(ds[name].values))
        ds[f"{name}_error"] = ("time", error, {"units": SCALARS[name].units})
    return ds


@pytest.fixture
def ds(bare: xr.Dataset) -> xr.Dataset:
    return with_errors(bare)


@pytest.fixture
def singular(bare: xr.Dataset) -> xr.Dataset:
    """The same, as if its peak pressure were that of an edge."""
    peak = bare.peak_pressure.values
    return with_errors(bare, peak_pressure=np.where(peak > 0, np.inf, 0.0))


@pytest.fixture
def shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., str]:
    """What `show` prints of a dataset on eighty columns."""
    monkeypatch.setenv("COLUMNS", "80")

    def show(ds: xr.Dataset, *words: str) -> str:
        vc.save(ds, tmp_path / "result.nc")
        assert main(["show", str(tmp_path / "result.nc"), *words]) == 0
        return capsys.readouterr().out

    return show
