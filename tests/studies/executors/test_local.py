"""Warm workers: one that is killed takes no other run with it, and its run is resumed."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import threading
import time as clock
from concurrent.futures import BrokenExecutor
from dataclasses import replace
from pathlib import Path

import pytest
import xarray as xr

from interrupted_runs import BODIES
from viscontact.cli import main
from viscontact.results.run_files import FAILURE_NAME, PROGRESS_NAME, RESULT_NAME
from viscontact.runs.execution.case_digests import digests_of
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.executors import task as tasks
from viscontact.studies.executors.driver import drive
from viscontact.studies.executors.local import LocalTasks, LocalWorkers
from viscontact.studies.executors.task import Task, TaskEnd, perform
from viscontact.studies.executors.worker import WorkerRequests, perform_in_worker

CASE = (
    BODIES
    + """\
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 40}
grid: {shape: [24, 24], size: [3 mm, 3 mm]}
output: {fields: [0 s, 5 s]}
"""
)


@pytest.fixture
def case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    return tmp_path / "case.yaml"


def job(case: Path, name: str, *settings: str, **options: bool) -> Job:
    directory = case.parent / name
    request = RunRequest(case, directory, settings=settings, **options)
    return Job(request, directory, name, RunStage.NEW, 41, 5.0, 1.0, 1e8)


def contents(directory: Path) -> dict[str, bytes]:
    with xr.open_dataset(directory / RESULT_NAME) as ds:
        return {str(name): ds[name].values.tobytes() for name in ds.variables}


def lines(path: Path) -> int:
    return path.read_bytes().count(b"\n") if path.exists() else 0


class Ends:
    """A display that notes the ends of runs."""

    def __init__(self) -> None:
        self.words: list[str] = []

    def update(self, active: object) -> None:
        pass

    def end(self, ended: Ended) -> None:
        self.words.append(ended.outcome)


def die(marks: Path, attempts: int) -> int:
    """Kill the process in the first attempts."""
    mark = marks / f"{len(list(marks.iterdir()))}"
    mark.touch()
    if int(mark.name) < attempts:
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid()


@pytest.mark.skipif(os.name == "nt", reason="without SIGKILL")
def test_killed_worker_is_replaced_and_its_call_repeated_once(tmp_path: Path) -> None:
    once, twice = tmp_path / "once", tmp_path / "twice"
    once.mkdir()
    twice.mkdir()
    with LocalWorkers(2) as workers:
        others = [workers.submit(abs, -number) for number in range(20)]
        repeated = workers.submit(die, once, 1)
        broken = workers.submit(die, twice, 2)
        later = [workers.submit(abs, -number) for number in range(20)]
        assert repeated.result(60) != os.getpid()
        with pytest.raises(BrokenExecutor):
            broken.result(60)
        assert [each.result(60) for each in (*others, *later)] == [*range(20), *range(20)]
    assert len(list(twice.iterdir())) == 2


@pytest.mark.parametrize("wait", [True, False])
def test_shut_down_workers_finish_all_calls_before(wait: bool) -> None:
    workers = LocalWorkers(1)
    found = [workers.submit(abs, -number) for number in range(5)]
    workers.shutdown(wait)
    with pytest.raises(RuntimeError, match="after shutdown"):
        workers.submit(abs, -1)
    assert not wait or all(each.done() for each in found)
    assert [each.result(60) for each in found] == [0, 1, 2, 3, 4]
    cancelled = LocalWorkers(1)
    first, *others = (cancelled.submit(abs, -number) for number in range(4))
    cancelled.shutdown(wait, cancel_futures=True)
    assert first.result(60) == 0
    assert all(each.cancelled() for each in others)


def test_worker_that_starts_after_the_request_to_stop_begins_no_run(case: Path) -> None:
    with LocalWorkers(1) as workers:
        workers.ask_to_stop()
        task = Task(RunRequest(case), case.parent / "a", "")
        assert workers.submit(clock.sleep, 0.5).result(60) is None  # the request arrives
        assert workers.submit(perform_in_worker, task).result(60).word == "not begun"
    assert not (case.parent / "a").exists()


def test_signal_to_all_processes_and_the_request_that_follows_let_the_step_be_finished(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    requests, cut_off = WorkerRequests(), []
    monkeypatch.setattr("_thread.interrupt_main", lambda: cut_off.append(True))
    requests.begin()
    requests.interrupt(signal.SIGTERM, None)  # as batch systems and `timeout` send it
    assert requests.requested
    requests.ask()
    assert not cut_off
    requests.ask()
    assert cut_off
    with pytest.raises(KeyboardInterrupt):
        requests.interrupt(signal.SIGINT, None)


def test_second_request_before_a_run_begins_leaves_the_worker_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    requests = WorkerRequests()
    monkeypatch.setattr("_thread.interrupt_main", lambda: requests.interrupt(signal.SIGINT, None))
    requests.ask()
    requests.ask()
    assert requests.requested


@pytest.mark.skipif(os.name == "nt", reason="without SIGKILL")
def test_killed_workers_end_all_calls() -> None:
    workers = LocalWorkers(1)
    found = [workers.submit(clock.sleep, 100), *(workers.submit(abs, -1) for _ in range(3))]
    began = clock.perf_counter()
    workers.kill()
    workers.shutdown()
    assert clock.perf_counter() - began < 20
    assert all(isinstance(each.exception(0), BrokenExecutor) for each in found)


def test_a_thousand_empty_calls_take_seconds() -> None:
    with LocalWorkers(2) as workers:
        workers.submit(abs, -1).result()
        began = clock.perf_counter()
        assert sum(each.result() for each in [workers.submit(abs, -1) for _ in range(1000)]) == 1000
        assert clock.perf_counter() - began < 10


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="without SIGKILL")
def test_runs_whose_workers_are_killed_at_random_end_in_the_bits_of_runs_alone(case: Path) -> None:
    chance, over = random.Random(20261123), threading.Event()
    jobs = [job(case, f"run{n}", f"load.force={3 + n / 10} N") for n in range(6)]
    workers = LocalWorkers(2)
    killed: list[str] = []

    def kill() -> None:
        """Kill the worker of each of the first runs once, at a random instant of its progress."""
        for each in jobs[:4]:
            wanted = chance.randint(1, 35)
            path = each.directory / PROGRESS_NAME
            while not over.is_set():
                if lines(path) >= wanted:
                    owner = each.directory / ".lock"
                    if owner.exists():
                        os.kill(int(owner.read_text().split()[0]), signal.SIGKILL)
                        killed.append(each.name)
                    break
                clock.sleep(0.001)

    killer = threading.Thread(target=kill)
    killer.start()
    shown = Ends()
    ended = drive(jobs, LocalTasks(workers, 2), StopRequests(), shown)
    over.set()
    killer.join()
    workers.shutdown()
    assert killed
    assert [each.outcome for each in ended] == shown.words == ["done"] * 6
    for each in jobs:
        alone = f"alone-{each.name}"
        assert main(["run", "case.yaml", "--set", *each.request.settings, "-o", alone, "-q"]) == 0
        assert contents(each.directory) == contents(Path(alone))
        left = {path.name for path in each.directory.iterdir()}
        assert left == {"case.yaml", "progress.jsonl", "result.nc"}


@pytest.mark.slow
def test_a_bad_case_among_five_fails_alone_and_is_repeated_when_it_is_corrected(case: Path) -> None:
    # At the small grid the contact comes to the rim.
    size = ["3 mm"] * 5
    size[3] = "0.8 mm"
    jobs = [
        job(case, f"run{n}", f"grid.size=[{s}, {s}]", "time.steps=3") for n, s in enumerate(size)
    ]
    workers = LocalWorkers(2)
    ended = drive(jobs, LocalTasks(workers, 2), StopRequests(), Ends())
    workers.shutdown()
    ends = {each.job.name: each for each in ended}
    assert [ends[f"run{n}"].outcome == "done" for n in range(5)] == [n != 3 for n in range(5)]
    failure = json.loads((case.parent / "run3" / FAILURE_NAME).read_text(encoding="utf-8"))
    assert (failure["outcome"], failure["code"]) == ("stopped", 1)
    assert failure["message"] == list(ends["run3"].lines)
    assert "edge of the grid" in failure["message"][0]
    again = replace(jobs[0], request=replace(jobs[0].request, output=case.parent / "run3"))
    corrected = Task(again.request, case.parent / "run3", "another command")
    assert perform(corrected).word == "done"
    assert not (case.parent / "run3" / FAILURE_NAME).exists()


def test_task_resumes_what_a_killed_attempt_of_the_same_command_has_left(
    case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    request = RunRequest(case, settings=("time.steps=3",))
    assert perform(Task(request, case.parent / "a", "one")).word == "done"
    # Another command is refused as at the command line; the same one finds its own result.
    outcome = perform(Task(request, case.parent / "a", "two"))
    assert (outcome.word, outcome.code) == ("refused", 1)
    assert "holds a result already" in outcome.lines[0]
    before = (case.parent / "a" / RESULT_NAME).stat().st_mtime_ns
    (case.parent / "a" / ".attempt").write_text("one", encoding="utf-8")
    assert perform(Task(request, case.parent / "a", "one")).word == "done"
    assert (case.parent / "a" / RESULT_NAME).stat().st_mtime_ns == before
    # Killed before it had replaced a result of another case, it begins.
    (case.parent / "a" / ".attempt").write_text("three", encoding="utf-8")
    other = replace(request, settings=("time.steps=4",), overwrite=True)
    assert perform(Task(other, case.parent / "a", "three")).word == "done"
    assert (case.parent / "a" / RESULT_NAME).stat().st_mtime_ns != before


def test_task_whose_case_has_been_edited_is_refused(case: Path) -> None:
    digests = digests_of(case)({"load.force": "1 N"})
    request = RunRequest(case, case.parent / "a", settings=("load.force=1 N",))
    case.write_text(CASE.replace("end: 5 s", "end: 6 s"), encoding="utf-8")
    task = Task(request, case.parent / "a", "", digests=digests)
    outcome = perform(task)
    assert (outcome.word, outcome.code) == ("refused", 1)
    assert outcome.lines[0].startswith(f"{case}: has changed since the first run began: time; ")
    case.write_text(CASE.replace("force: 4 N", "force: 5 N"), encoding="utf-8")
    assert perform(task).word == "done"  # the value of the run is another one in any case


@pytest.mark.slow  # starts a worker
def test_run_of_a_sweep_whose_case_is_edited_meanwhile_is_refused(
    case: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = (case.parent / "sweep" / f"case_force={force}N" for force in (1, 2))

    def edit() -> None:
        while not (first / PROGRESS_NAME).exists():
            clock.sleep(0.005)
        case.write_text(CASE.replace("end: 5 s", "end: 6 s"), encoding="utf-8")

    editing = threading.Thread(target=edit)
    editing.start()
    # One after the other: the second begins after the case has been edited.
    words = ["run", str(case), "--vary", "load.force=1N,2N", "-o", str(first.parent), "-q"]
    words += ["-j", "1"]
    assert main(words) == 1
    editing.join()
    assert (first / RESULT_NAME).exists()
    assert not (second / RESULT_NAME).exists()
    assert f"{case}: has changed since the first run began: time; " in capsys.readouterr().err


def test_sweep_whose_directory_is_removed_is_not_begun_again_without_its_manifest(
    case: Path,
) -> None:
    sweep = case.parent / "removed"
    for resume in (False, True):
        request = RunRequest(case, settings=("time.steps=3",), resume=resume)
        outcome = perform(Task(request, sweep / "a", "one"))
        assert (outcome.word, outcome.code) == ("refused", 1)
        assert "removed has been removed meanwhile" in outcome.lines[0]
    assert not sweep.exists()


@pytest.mark.slow
def test_long_run_is_a_process_of_its_own_and_ends_in_the_same_bits(
    case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    request = RunRequest(case, settings=("time.steps=3",))
    assert perform(Task(request, case.parent / "warm", "")).word == "done"
    started: list[Job] = []

    class Counted(tasks.Child):
        def __init__(self, job: Job) -> None:
            started.append(job)
            super().__init__(job)

    monkeypatch.setattr(tasks, "LONGEST_WARM", 0.0)
    monkeypatch.setattr(tasks, "Child", Counted)
    assert perform(Task(request, case.parent / "child", "")).word == "done"
    assert len(started) == 1
    assert contents(case.parent / "child") == contents(case.parent / "warm")


@pytest.mark.parametrize(
    "longest_warm",
    [pytest.param(0.0, id="process", marks=pytest.mark.slow), pytest.param(1e9, id="warm")],
)
def test_file_requests_a_task_to_stop_and_no_further_one_begins(
    case: Path, longest_warm: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "LONGEST_WARM", longest_warm)
    request, stop = RunRequest(case, settings=("time.steps=4000",)), case.parent / ".stop"
    log = case.parent / "a" / PROGRESS_NAME

    def ask() -> None:
        while lines(log) < 3:
            clock.sleep(0.01)
        stop.touch()

    threading.Thread(target=ask, daemon=True).start()
    outcome = perform(Task(request, case.parent / "a", "", stop))
    assert outcome == TaskEnd("interrupted", 130)
    with xr.open_dataset(case.parent / "a" / RESULT_NAME) as ds:
        assert 2 < ds.sizes["time"] == lines(log) < 4001
    assert perform(Task(request, case.parent / "b", "", stop)) == TaskEnd("not begun", 130)
    assert not (case.parent / "b").exists()
    assert not (case.parent / "a" / FAILURE_NAME).exists()


UNGUARDED = """\
import viscontact as vc

RUN = {"indenter": vc.Sphere(0.01), "material": vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5),
       "load": vc.step(0.1), "grid": vc.Grid((16, 16), (3e-3, 3e-3)), "times": [0.0, 1.0]}
FORCE = {'load.force': ('1 N', '2 N')}
SPRING = {'material.shear_modulus': ('1 MPa', '9 MPa')}
RECORD = vc.ContactRecord(range(5), force=[4.0] * 5, approach=[1e-5, 2e-5, 3e-5, 4e-5, 5e-5])
"""


@pytest.mark.slow  # three processes that import everything
@pytest.mark.parametrize(
    "call",
    [
        "simulate_many([RUN] * 3, workers=2)",
        "simulate_many([RUN] * 3, workers=2, directory='many')",
        "sensitivity('case.yaml', 'approach', workers=2)",
        "design('case.yaml', FORCE, minimise='approach', workers=2)",
        "design_profile('roller.yaml', workers=2, runs=8)",
        "fit_case('case.yaml', [RECORD] * 2, SPRING, workers=2)",
    ],
)
def test_script_without_a_guard_ends_with_one_message(call: str, tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    roller = "{shape: roller, radius: 5 mm, half_length: 10 mm}"
    case = CASE.replace("{shape: sphere, radius: 10 mm}", roller)
    case = case.replace("[3 mm, 3 mm]", "[21.6 mm, 1.1 mm]").replace("4 N", "40 N")
    (tmp_path / "roller.yaml").write_text(case, encoding="utf-8")
    (tmp_path / "script.py").write_text(f"{UNGUARDED}vc.{call}", encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, timeout=100
    )
    assert ended.returncode == 1
    assert ended.stderr.count("Traceback") == 1
    assert 'make this call behind `if __name__ == "__main__":`' in ended.stderr
