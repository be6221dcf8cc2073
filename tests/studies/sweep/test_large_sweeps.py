"""Cost of reading sweeps of many runs: memory, files that are opened."""

from __future__ import annotations

import os
import sys
import tracemalloc
from pathlib import Path

import netCDF4
import pytest

import viscontact as vc
from swept_runs import sweep_of
from viscontact.results import stored_result
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.studies.sweep.collecting import write_joint_result
from viscontact.studies.sweep.joint_layout import JointLayout, joint_layout
from viscontact.studies.sweep.manifest import SweepRun, write_manifest
from viscontact.studies.sweep.states import State
from viscontact.studies.sweep.status import sweep_status


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run of 41 instants."""
    settings = {"time.steps": "40", "output.fields": "none"}
    return next(sweep_of(tmp_path_factory.mktemp("one"), [settings]).glob("steps*"))


def repeated(run: Path, folder: Path, count: int) -> Path:
    """A sweep of many runs whose files are those of one."""
    runs = []
    for number in range(count):
        place = folder / f"{number}"
        place.mkdir(parents=True)
        for file in run.iterdir():
            os.link(file, place / file.name)
        force = {"load.force": f"{number + 1} N"}
        runs.append(SweepRun(number, f"{number}", f"{number}", force, ("load.force",), "a", "grid"))
    write_manifest(folder, runs)
    assert (folder / MANIFEST_NAME).is_file()
    return folder


@pytest.mark.slow
@pytest.mark.skipif(sys.gettrace() is not None, reason="a tracer allocates memory")
def test_memory_of_collecting_does_not_grow_with_the_scalars(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(JointLayout.blocks, "__defaults__", (100_000,))

    def peak(count: int) -> int:
        layout = joint_layout(repeated(run, tmp_path / f"{count}", count))
        tracemalloc.start()
        write_joint_result(layout, tmp_path / "sweep.nc", lambda *n: None)
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    peak(5)  # the first call imports
    few, many = 20, 100
    scalars = 8 * 33 * 41  # [bytes a run]
    assert peak(many) - peak(few) < 0.2 * (many - few) * scalars


def test_no_result_file_is_opened_for_scalars_and_states(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sweep = repeated(run, tmp_path / "sweep", 30)

    def refuse(*words: object, **options: object) -> None:
        raise AssertionError(f"opened {words}")

    with monkeypatch.context() as patched:
        patched.setattr(netCDF4, "Dataset", refuse)
        patched.setattr(stored_result.netCDF4, "Dataset", refuse)
        ds = vc.open_many(sweep)
        assert sweep_status(sweep).counts[State.DONE] == 30
    with vc.open_results(run) as one:
        assert (ds.approach == one.approach).all()
        assert (ds.approach_error == one.approach_error).all()
