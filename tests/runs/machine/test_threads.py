"""Threads of linear algebra in workers."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor

import pytest
import scipy.linalg  # loads a second library of linear algebra
import xarray as xr
from threadpoolctl import threadpool_info, threadpool_limits

from viscontact.backend.threads import limit_threads


def threads() -> set[int]:
    assert scipy.linalg
    return {library["num_threads"] for library in threadpool_info()}


def test_limit_of_a_block_ends_with_it() -> None:
    with threadpool_limits(2):
        with limit_threads():
            assert threads() == {1}
        assert threads() == {2}


@pytest.mark.parametrize(
    ("initializer", "expected"),
    [pytest.param(None, {2}, marks=pytest.mark.slow), (limit_threads, {1})],
)
def test_worker_uses_one_thread_whatever_the_environment_says(
    initializer: Callable[[], object] | None, expected: set[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "2")
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn, initializer=initializer) as pool:
        assert pool.submit(threads).result() == expected


@pytest.mark.slow
def test_worker_of_simulate_many_uses_one_thread_and_leaves_the_environment_alone() -> None:
    program = (
        "import os\n"
        "import viscontact as vc\n"
        "from runs.machine.test_threads import result_with_threads\n"
        "if __name__ == '__main__':\n"
        "    before = dict(os.environ)\n"
        "    [ds] = vc.simulate_many([result_with_threads], workers=1)\n"
        "    assert dict(os.environ) == before\n"
        "    print(ds.attrs['threads'])\n"
    )
    paths = os.pathsep.join(sys.path)
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "2", "PYTHONPATH": paths}
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
    assert done.stdout == "{1}\n"


def result_with_threads() -> xr.Dataset:
    """An empty result that tells the threads of its process."""
    return xr.Dataset(attrs={"threads": str(threads())})
