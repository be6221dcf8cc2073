"""`simulate_many` with executors of all kinds, and with a directory that keeps the runs."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import (
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from multiprocessing import current_process, get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from interrupted_runs import WITH_ERRORS
from viscontact.cli import main
from viscontact.results.run_files import FAILURE_NAME, MANIFEST_NAME, RESULT_NAME
from viscontact.studies.sweep.manifest import read_manifest

AUTOMATIC = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 1 s, steps: 1}
output: {errors: false, fields: none}
"""
RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
SMALL = vc.Grid((24, 24), (3e-3, 3e-3))


def runs(*forces: float) -> list[dict[str, Any]]:
    given = {"indenter": vc.Sphere(0.01), "material": RUBBER, "grid": SMALL, "errors": False}
    times, fields = vc.uniform_times(1.0, 4), [1.0]
    return [{**given, "load": vc.step(force), "times": times, "fields": fields} for force in forces]


class Broken(Executor):
    """Executor whose processes end at once."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return a call without an answer."""
        future: Future[Any] = Future()
        future.set_exception(BrokenExecutor("gone"))
        return future


class Editing(Executor):
    """Executor that computes each call at once, and then edits a case."""

    def __init__(self, case: Path) -> None:
        self._case = case

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return a call that is finished."""
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        text = self._case.read_text(encoding="utf-8")
        self._case.write_text(text.replace("end: 1 s", "end: 2 s"), encoding="utf-8")
        return future


def loky_executor() -> Executor:
    return pytest.importorskip("loky").ProcessPoolExecutor(1)


def processes() -> Executor:
    return ProcessPoolExecutor(1, mp_context=get_context("spawn"))


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize(
    "executor",
    [
        lambda: ThreadPoolExecutor(2),
        pytest.param(processes, marks=pytest.mark.slow),
        pytest.param(loky_executor, marks=pytest.mark.slow),
    ],
    ids=["threads", "processes", "loky"],
)
def test_any_executor_computes_the_bits_of_simulate(
    executor: Callable[[], Executor], tmp_path: Path
) -> None:
    given = runs(0.05, 0.1, 0.15)
    reported: list[tuple[int, int, int]] = []
    with executor() as pool:
        found = vc.simulate_many(
            given, executor=pool, progress=lambda *numbers: reported.append(numbers)
        )
        joint = vc.simulate_many(given, executor=pool, directory=tmp_path / "sweep")
    assert [done for _, done, _ in reported] == [1, 2, 3]
    assert {run for run, _, _ in reported} == {0, 1, 2}
    for number, run in enumerate(given):
        alone = vc.simulate(**run)
        assert found[number].pressure.values.tobytes() == alone.pressure.values.tobytes()
        with vc.open_results(tmp_path / "sweep" / f"run{number}") as ds:
            assert ds.approach.values.tobytes() == alone.approach.values.tobytes()
            # fields are stored as floats of four bytes
            np.testing.assert_allclose(ds.pressure, alone.pressure, rtol=1e-7)
        np.testing.assert_array_equal(joint.approach[number], alone.approach)
    assert joint.state.values.tolist() == ["done"] * 3
    assert not (tmp_path / "sweep" / ".stop").exists()


def test_recorded_runs_are_not_repeated_and_a_failed_one_is_not_a_number(tmp_path: Path) -> None:
    given = runs(0.05, 0.1, 50.0)  # the contact of the last comes to the rim
    sweep = tmp_path / "sweep"
    with ThreadPoolExecutor(1) as pool:
        with pytest.raises(RuntimeError, match=r"1 of 3 runs failed\nrun2: .*edge of the grid"):
            vc.simulate_many(given, executor=pool, directory=sweep)
        failure = json.loads((sweep / "run2" / FAILURE_NAME).read_text(encoding="utf-8"))
        assert (failure["outcome"], failure["code"]) == ("stopped", 1)
        before = [(sweep / f"run{n}" / RESULT_NAME).stat().st_mtime_ns for n in range(2)]
        ds = vc.simulate_many(given, executor=pool, directory=sweep, return_exceptions=True)
        assert before == [(sweep / f"run{n}" / RESULT_NAME).stat().st_mtime_ns for n in range(2)]
        assert ds.state.values.tolist() == ["done", "done", "failed"]
        assert "edge of the grid" in str(ds.message[2].values)
        assert np.isnan(ds.approach[2]).all()
        assert np.isfinite(ds.approach[:2]).all()
        with pytest.raises(ValueError, match="run1 has results, and is none of these"):
            vc.simulate_many(given[:1], executor=pool, directory=sweep)


def test_other_mappings_in_a_directory_are_refused_before_any_run_begins(tmp_path: Path) -> None:
    sweep, given = tmp_path / "sweep", runs(0.05, 0.1)
    softer = vc.Material(vc.Zener(1e6, 1e6, 2e6), poisson_ratio=0.5)
    with ThreadPoolExecutor(1) as pool:
        vc.simulate_many(given, executor=pool, directory=sweep)
        before = {path: path.stat().st_mtime_ns for path in sweep.rglob("*")}
        for others, said in (
            (given[::-1], r"its run0 has results of other arguments: load.*was 0\.05, is now 0\.1"),
            (
                [*runs(0.02), *given],
                "its run0 has results of other arguments: .*known by their pos",
            ),
            ([{**each, "material": softer} for each in given], "material.*was 1000000.0, is now 2"),
            ([given[0], {**given[1], "tolerance": -1.0}], r"^runs\[1\]: tolerance"),
        ):
            with pytest.raises(ValueError, match=said):
                vc.simulate_many(others, executor=Broken(), directory=sweep)
        assert before == {path: path.stat().st_mtime_ns for path in sweep.rglob("*")}
        ds = vc.simulate_many([*given, *runs(0.02)], executor=pool, directory=sweep)
    assert ds.state.values.tolist() == ["done"] * 3


def test_what_is_no_run_and_no_executor_is_refused(tmp_path: Path) -> None:
    (given,) = runs(0.1)
    few = {key: value for key, value in given.items() if key != "material"}
    for recipes, options, said in (
        ([given], {"executor": "x"}, r"executor: must have a method submit, .* got 'x'"),
        ([given], {"client": "tcp://a"}, r"client: must be a Client .*, got 'tcp://a'"),
        ([few], {}, r"runs\[0\]: missing a required argument: 'material', as of simulate"),
        ([given, {**given, "lod": 1}], {}, r"runs\[1\]: got an unexpected keyword argument 'lod'"),
        (
            ["ball.yaml"],
            {},
            r"runs\[0\]: must be the arguments of simulate by name, .* 'ball.yaml'",
        ),
        (given, {}, r"runs: must be a list of runs, .* write \[run\]"),
    ):
        for place in ({}, {"directory": tmp_path / "sweep"}):
            with pytest.raises(TypeError, match=said):
                vc.simulate_many(recipes, **options, **place)  # type: ignore[call-overload]
    with ThreadPoolExecutor(1) as pool:
        with pytest.raises(ValueError, match=r"runs\[0\]: a run in a directory"):
            vc.simulate_many([dict], executor=pool, directory=tmp_path / "sweep")
        with pytest.raises(ValueError, match="there are none to record"):
            vc.simulate_many([], executor=pool, directory=tmp_path / "sweep")
        with pytest.raises(ValueError, match="executor and client are given together"):
            vc.simulate_many([], executor=pool, client=object())
        with pytest.raises(ValueError, match="executor and workers are given together"):
            vc.simulate_many([], executor=pool, workers=2)
        (tmp_path / "ball.yaml").touch()
        with pytest.raises(ValueError, match=r"directory: .*ball.yaml is a file; name a directory"):
            vc.simulate_many([given], executor=pool, directory=tmp_path / "ball.yaml")
    assert [path.name for path in tmp_path.iterdir()] == ["ball.yaml"]


def test_a_script_without_a_guard_is_told_so_by_its_processes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(current_process(), "_inheriting", True, raising=False)
    with pytest.raises(SystemExit):
        vc.simulate_many(runs(0.1), directory=tmp_path / "sweep")
    monkeypatch.undo()
    with pytest.raises(RuntimeError, match=r"was killed: gone; in a script, make this call"):
        vc.simulate_many(runs(0.1), executor=Broken(), directory=tmp_path / "sweep")


def test_runs_of_a_case_are_recorded_as_at_the_command_line(tmp_path: Path) -> None:
    case = tmp_path / "case.yaml"
    case.write_text(WITH_ERRORS, encoding="utf-8")
    given = vc.vary(case, {"load.force": ["2 N", "4 N"]})
    with ThreadPoolExecutor(1) as pool:
        ds = vc.simulate_many(given, executor=pool, directory=tmp_path / "api")
    assert ds["load.force"].values.tolist() == [2.0, 4.0]
    assert main(["run", str(case), "--vary", "load.force=2 N,4 N", "-o", f"{tmp_path}/cli"]) == 0
    at_command = vc.open_many(tmp_path / "cli")
    for name in ("approach", "peak_pressure_error", "pressure"):
        assert ds[name].values.tobytes() == at_command[name].values.tobytes()
    names = {path.name for path in (tmp_path / "api" / "case_force=2N").iterdir()}
    assert names == {"case.yaml", "progress.jsonl", "result.nc"}


@pytest.mark.slow
def test_further_runs_of_a_case_are_added_on_the_same_cells(tmp_path: Path) -> None:
    case = tmp_path / "case.yaml"
    case.write_text(AUTOMATIC, encoding="utf-8")
    sweep = tmp_path / "sweep"

    def compute(*forces: str, **settings: object) -> list[float]:
        given = vc.vary(case, {"load.force": list(forces)}, settings=settings)
        with ThreadPoolExecutor(1) as pool:
            ds = vc.simulate_many(given, executor=pool, directory=sweep)
        assert ds.state.values.tolist() == ["done"] * len(forces)
        return [float(force) for force in ds["load.force"]]

    assert compute("0.2 N", "0.4 N") == [0.2, 0.4]
    done = [path.stat().st_mtime_ns for path in sorted(sweep.rglob(RESULT_NAME))]
    # A smaller force alone would have smaller cells.
    assert compute("0.05 N", "200mN", "0.4N") == [0.05, 0.2, 0.4]
    cells = {run.settings["grid.largest_cell"] for run in read_manifest(sweep / MANIFEST_NAME)}
    assert len(cells) == 1
    written = {path: path.stat().st_mtime_ns for path in sweep.rglob(RESULT_NAME)}
    assert len(written) == 3
    assert set(done) < set(written.values())
    with pytest.raises(ValueError, match=r"has results with the time\.end of its case, not 2 s"):
        compute("0.05 N", "200mN", "0.4N", **{"time.end": "2 s"})
    with pytest.raises(ValueError, match=r"=0.4 N and load.force=400 mN are equal; give each once"):
        compute("0.05 N", "0.2 N", "0.4 N", "400 mN")
    given = vc.vary(case, {"load.force": ["0.05 N", "0.2 N", "0.4 N"]})
    with pytest.raises(ValueError, match=r"0.4N: 2 of the runs would go there; .* each value once"):
        vc.simulate_many([*given, given[-1]], workers=1, directory=sweep)


MPI = """\
import sys, time
import viscontact as vc
from mpi4py.futures import MPIPoolExecutor

if __name__ == "__main__":
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    given = {"indenter": vc.Sphere(0.01), "material": rubber, "errors": False, "fields": "none",
             "grid": vc.Grid((24, 24), (3e-3, 3e-3)), "times": vc.uniform_times(1.0, 4)}
    forces = [0.05 + 0.01 * n for n in range(10)]
    forces[6] = 50.0
    runs = [{**given, "load": vc.step(force)} for force in forces]
    with MPIPoolExecutor() as executor:
        ds = vc.simulate_many(runs, executor=executor, directory="sweep", return_exceptions=True)
        began = time.perf_counter()
        assert sum(executor.map(abs, range(1000))) == 499500
        print(" ".join(ds.state.values.tolist()))
        print(time.perf_counter() - began)
"""


@pytest.mark.slow  # processes that import everything
def test_mpi_computes_nine_of_ten_runs_and_a_thousand_empty_tasks_in_seconds(
    tmp_path: Path,
) -> None:
    pytest.importorskip("mpi4py", exc_type=ImportError)
    command = shutil.which("mpiexec", path=f"{Path(sys.executable).parent}{os.pathsep}{os.defpath}")
    if command is None:
        pytest.skip("without mpiexec, which the package mpich brings on Linux")
    (tmp_path / "mpi.py").write_text(MPI, encoding="utf-8")
    words = [command, "-n", "2", sys.executable, "-m", "mpi4py.futures", "mpi.py"]
    done = subprocess.run(
        words, capture_output=True, text=True, cwd=tmp_path, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    states, seconds = done.stdout.splitlines()
    assert states.split() == ["done"] * 6 + ["failed"] + ["done"] * 3
    assert float(seconds) < 10
    alone = vc.simulate(**{**runs(0.14)[0], "fields": "none"})
    with vc.open_results(tmp_path / "sweep" / "run9") as ds:
        assert ds.approach.values.tobytes() == alone.approach.values.tobytes()


def test_case_that_is_edited_during_the_runs_is_refused(tmp_path: Path) -> None:
    case = tmp_path / "case.yaml"
    case.write_text(AUTOMATIC, encoding="utf-8")
    varied = vc.vary(case, {"load.force": ["0.1 N", "0.2 N"]})
    with pytest.raises(RuntimeError, match="has changed since the first run began: time; "):
        vc.simulate_many(varied, executor=Editing(case), directory=tmp_path / "sweep")
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "sweep").rglob("*")}
    with pytest.raises(ValueError, match=r"holds runs of the case case.yaml before it changed: ti"):
        vc.simulate_many(varied, executor=Broken(), directory=tmp_path / "sweep")
    assert before == {path: path.stat().st_mtime_ns for path in (tmp_path / "sweep").rglob("*")}
    case.write_text(AUTOMATIC, encoding="utf-8")
    with ThreadPoolExecutor(1) as executor:
        ds = vc.simulate_many(varied, executor=executor, directory=tmp_path / "sweep")
    assert ds.state.values.tolist() == ["done", "done"]


def test_directories_that_differ_only_in_the_case_of_letters_are_refused(tmp_path: Path) -> None:
    case = tmp_path / "case.yaml"
    case.write_text(AUTOMATIC + "grid: {shape: [8, 8], size: [3 mm, 3 mm]}\n", encoding="utf-8")
    varied = vc.vary(case, {"material.shear_modulus": ["1 mPa", "1 MPa"]})
    with pytest.raises(ValueError, match="shear_modulus=1mPa: 2 of the runs would go there"):
        vc.simulate_many(varied, workers=1, directory=tmp_path / "sweep")
    assert not (tmp_path / "sweep").exists()


def test_case_may_change_until_a_run_begins(tmp_path: Path) -> None:
    case, sweep = tmp_path / "case.yaml", tmp_path / "sweep"
    case.write_text(AUTOMATIC, encoding="utf-8")
    varied = vc.vary(case, {"load.force": ["0.1 N", "0.2 N"]})
    with pytest.raises(RuntimeError, match="2 of 2 runs failed"):
        vc.simulate_many(varied, executor=Broken(), directory=sweep)
    case.write_text(AUTOMATIC.replace("end: 1 s", "end: 2 s"), encoding="utf-8")
    for _ in range(2):  # the second call finds the case that the first one has computed
        with ThreadPoolExecutor(1) as executor:
            ds = vc.simulate_many(varied, executor=executor, directory=sweep)
        assert ds.state.values.tolist() == ["done", "done"]
        assert float(ds.time[-1]) == 2.0
