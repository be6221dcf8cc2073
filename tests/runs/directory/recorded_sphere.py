"""A recorded run of a sphere, marched so far or to its end."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.simulation.transient.setup import RunSetup, prepare_run

COUNT = 12
#: Fields of the first and the last instant.
ENDS = KeptFields([0.0, 1.0])


def sphere_run(force: float = 0.1, count: int = COUNT, kept: KeptFields = ENDS) -> RunSetup:
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    grid, times = vc.Grid((24, 24), (2.4e-3, 2.4e-3)), np.linspace(0.0, 1.0, count)
    return prepare_run(Problem(vc.Sphere(0.01), rubber, vc.step(force), grid, times, kept=kept))


def sphere(directory: Path, run: RunSetup | None = None) -> Recorded:
    """A recorded run without error bars."""
    return Recorded(directory, OverTime(run or sphere_run(), errors=False))


@pytest.fixture
def recorded(tmp_path: Path) -> Recorded:
    """A run of a sphere, and an empty directory for it."""
    return sphere(tmp_path)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of the same run, uninterrupted."""
    directory = tmp_path_factory.mktemp("whole")
    finish(Recorder(sphere(directory)))
    return directory


def finish(record: Recorder) -> None:
    for _ in record.steps():
        pass
    record.finish()


def stop_after(record: Recorder, instants: int) -> None:
    """March so far, then leave everything as a process that is killed would."""
    for number, _ in enumerate(record.steps(), record.resumed.rows + 1):
        if number == instants:
            break
    record.close()


def same_bits(one: Path, other: Path) -> bool:
    with xr.open_dataset(one / "result.nc") as a, xr.open_dataset(other / "result.nc") as b:
        same = a.sizes == b.sizes and set(a.variables) == set(b.variables)
        return same and all(a[v].values.tobytes() == b[v].values.tobytes() for v in a.variables)


def contents(directory: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in directory.iterdir()}
