"""Studies whose runs another executor computes."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.studies.calibration.experiments import ELASTIC_BALL, MODULUS, hertz_depth
from tests.studies.design.test_arguments import BALL

import viscontact as vc

FORCE = np.linspace(0.02, 0.1, 5)
RECORD = vc.ContactRecord(np.arange(5.0), FORCE, hertz_depth(FORCE))

Study = Callable[..., xr.Dataset]


def designed(folder: Path, **workers: Any) -> xr.Dataset:
    change = {"indenter.radius": ["4 mm", "6 mm"]}
    return vc.design(_written(folder, BALL), change, minimise="approach", **workers).table


def fitted(folder: Path, **workers: Any) -> xr.Dataset:
    return vc.fit_case(_written(folder, ELASTIC_BALL), RECORD, MODULUS, **workers).curves


def sensed(folder: Path, **workers: Any) -> xr.Dataset:
    path = _written(folder, BALL)
    return vc.sensitivity(path, "approach", change=["load.force"], **workers).table


def _written(folder: Path, text: str) -> Path:
    path = folder / "ball.yaml"
    path.write_text(text)
    return path


class Counting(Executor):
    """Executor of one thread that counts the calls."""

    def __init__(self) -> None:
        self.calls = 0
        self._pool = ThreadPoolExecutor(1)

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Submit a call."""
        self.calls += 1
        return self._pool.submit(fn, *args, **kwargs)


class Client:
    """Client of a cluster with one worker of one thread, as Dask has it."""

    def __init__(self) -> None:
        self.executor = Counting()

    def get_executor(self, **options: Any) -> Executor:
        """Return the executor."""
        return self.executor

    def nthreads(self) -> dict[str, int]:
        """Threads by worker."""
        return {"tcp://10.0.0.1:1": 1}

    def scheduler_info(self, **options: Any) -> dict[str, Any]:
        """Describe the workers."""
        return {"workers": {}}


@pytest.mark.parametrize("study", [designed, fitted, sensed])
def test_a_given_executor_computes_all_runs_with_the_same_result(
    study: Study, tmp_path: Path
) -> None:
    executor = Counting()
    xr.testing.assert_identical(study(tmp_path, executor=executor), study(tmp_path, workers=1))
    assert executor.calls >= 3


def test_the_workers_of_a_cluster_compute_a_design(tmp_path: Path) -> None:
    client = Client()
    xr.testing.assert_identical(designed(tmp_path, client=client), designed(tmp_path, workers=1))
    assert client.executor.calls == 3


@pytest.mark.parametrize("study", [designed, fitted, sensed])
def test_what_is_no_executor_is_refused_by_name(study: Study, tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="executor: must have a method submit"):
        study(tmp_path, executor=object())
    with pytest.raises(ValueError, match="executor and workers are given together"):
        study(tmp_path, executor=Counting(), workers=2)
