"""Runs on a Dask cluster whose workers, scheduler and client are killed, and under MPI."""

from __future__ import annotations

import os
import random
import subprocess
import sys
import time as clock
from collections.abc import Callable, Iterator
from pathlib import Path

import psutil
import pytest

import viscontact as vc
from studies.executors.test_local import CASE, contents, lines
from studies.executors.test_recorded_many import runs
from viscontact.cli import main
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME

distributed = pytest.importorskip("distributed")
pytestmark = [
    pytest.mark.slow,  # a scheduler, workers and commands as processes of their own
    pytest.mark.skipif(os.name == "nt", reason="without SIGKILL"),
]

FORCES = [f"{2 + n / 4:g}N" for n in range(6)]
SWEEP = ["run", "case.yaml", "--vary", f"load.force={','.join(FORCES)}", "-q"]
SWEEP += ["--set", "time.steps=250"]  # about a second each
#: Longest time of a test [s], far above the usual one.
PATIENCE = 100.0


class Cluster:
    """A scheduler and its workers, each a process that can be killed."""

    def __init__(self, folder: Path, count: int) -> None:
        self._file = folder / "scheduler.json"
        self._file.unlink(missing_ok=True)
        self.scheduler = self._start("dask_scheduler", "--port", "0", "--no-dashboard")
        until(self._file.exists)
        self.workers = [self.worker() for _ in range(count)]

    def worker(self, *options: str) -> subprocess.Popen[bytes]:
        return self._start(
            "dask_worker", "--nthreads", "1", "--no-nanny", "--no-dashboard", *options
        )

    def _start(self, name: str, *options: str) -> subprocess.Popen[bytes]:
        words = ["-m", f"distributed.cli.{name}", "--scheduler-file", str(self._file), *options]
        quiet = subprocess.DEVNULL
        return subprocess.Popen([sys.executable, *words], stdout=quiet, stderr=quiet)

    def close(self) -> None:
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same sweep, uninterrupted, by the workers of this machine."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "case.yaml").write_text(CASE, encoding="utf-8")
    before = Path.cwd()
    os.chdir(folder)
    try:
        assert main([*SWEEP, "-j", "2", "-o", "sweep"]) == 0
    finally:
        os.chdir(before)
    return folder / "sweep"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    return tmp_path


@pytest.fixture
def clusters() -> Iterator[list[Cluster]]:
    found: list[Cluster] = []
    yield found
    for each in found:
        each.close()


def command(*options: str) -> subprocess.Popen[str]:
    words = [*SWEEP, "-o", "sweep", "--scheduler", "scheduler.json", *options]
    return subprocess.Popen(
        [sys.executable, "-m", "viscontact", *words], stderr=subprocess.PIPE, text=True
    )


def until(holds: Callable[[], object]) -> None:
    give_up = clock.monotonic() + PATIENCE
    while not holds():
        assert clock.monotonic() < give_up
        clock.sleep(0.01)


def instants(sweep: Path) -> int:
    return sum(lines(each / PROGRESS_NAME) for each in sweep.glob("case_*"))


def finished(sweep: Path) -> dict[str, int]:
    """Instants at which the results of the finished runs were written [ns]."""
    return {
        each.name: (each / RESULT_NAME).stat().st_mtime_ns
        for each in sweep.glob("case_*")
        if (each / RESULT_NAME).exists() and not (each / STATE_NAME).exists()
    }


def same_bits(sweep: Path, whole: Path) -> bool:
    names = sorted(each.name for each in whole.glob("case_*"))
    assert len(names) == len(FORCES)
    return all(contents(sweep / name) == contents(whole / name) for name in names)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_client_computes_nine_of_ten_runs_within_the_memory_that_its_workers_declare(
    tmp_path: Path,
) -> None:
    forces = [0.05 + 0.01 * n for n in range(10)]
    forces[6] = 50.0  # its contact comes to the rim
    options = {"n_workers": 2, "threads_per_worker": 2, "dashboard_address": "127.0.0.1:0"}
    with (
        distributed.LocalCluster(resources={"MEMORY": 4e8}, **options) as cluster,
        distributed.Client(cluster) as client,
    ):
        ds = vc.simulate_many(
            runs(*forces), client=client, directory=tmp_path / "sweep", return_exceptions=True
        )
        executor = client.get_executor(pure=False)
        began = clock.perf_counter()
        assert sum(executor.map(abs, range(1000))) == 499500
        assert clock.perf_counter() - began < 20
        found = vc.simulate_many(runs(0.05), client=client)
    assert ds.state.values.tolist() == ["done"] * 6 + ["failed"] + ["done"] * 3
    assert found[0].approach.values.tobytes() == ds.approach[0].values.tobytes()


def test_scheduler_that_does_not_answer_and_missing_dask_are_refused(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.cli.sweep.cluster._PATIENCE", 1)
    assert main([*SWEEP, "--scheduler", "tcp://127.0.0.1:9", "-o", "sweep"]) == 2
    assert "tcp://127.0.0.1:9: no scheduler answers: " in capsys.readouterr().err
    assert main([*SWEEP, "--scheduler", "local", "--array", "a.sbatch", "-o", "sweep"]) == 2
    assert "--array and --task do not go with it" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main([*SWEEP, "--scheduler", "local", "-o", "sweep"]) == 2
    assert "pip install 'viscontact[cluster]'" in capsys.readouterr().err
    assert not (folder / "sweep").exists()


def test_killed_workers_are_replaced_and_the_sweep_ends_in_the_same_bits(
    folder: Path, whole: Path, clusters: list[Cluster]
) -> None:
    chance = random.Random(1)
    clusters.append(cluster := Cluster(folder, 2))
    process, sweep = command(), folder / "sweep"
    for number in range(3):
        wanted = 400 * number + chance.randint(20, 350)
        until(lambda wanted=wanted: instants(sweep) > wanted)  # type: ignore[misc]
        victim = chance.randrange(2)
        cluster.workers[victim].kill()
        cluster.workers[victim].wait()
        cluster.workers[victim] = cluster.worker()
    _, said = process.communicate(timeout=PATIENCE)
    assert (process.returncode, said) == (0, "")
    assert same_bits(sweep, whole)
    assert {path.name for path in sweep.iterdir() if path.is_file()} == {"runs.jsonl"}


def test_killed_scheduler_and_client_leave_a_sweep_that_is_resumed_to_the_same_bits(
    folder: Path, whole: Path, clusters: list[Cluster]
) -> None:
    chance, sweep = random.Random(2), folder / "sweep"
    clusters.append(first := Cluster(folder, 2))
    process = command()
    wanted = chance.randint(550, 800)
    until(lambda: instants(sweep) > wanted and finished(sweep))
    first.scheduler.kill()
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1, said
    assert "--resume" in said
    before = finished(sweep)
    clusters.append(Cluster(folder, 2))
    process = command("--resume")
    until(lambda: instants(sweep) > wanted + chance.randint(100, 300))
    process.kill()
    process.communicate()
    process = command("--resume")
    _, said = process.communicate(timeout=PATIENCE)
    assert (process.returncode, said) == (0, "")
    assert same_bits(sweep, whole)
    assert before
    assert {name: finished(sweep)[name] for name in before} == before  # nothing was repeated


def killed_at_its_start(folder: Path, moment: float) -> tuple[int, str]:
    """Kill a worker of this machine at a moment after it began [s]; return the end and messages."""
    process = command("--scheduler", "local", "-j", "2")  # the last option counts
    above = psutil.Process(process.pid)

    def workers() -> list[psutil.Process]:
        return [each for each in above.children() if "spawn_main" in " ".join(each.cmdline())]

    until(lambda: workers() or process.poll() is not None)
    clock.sleep(moment)
    for each in workers()[:1]:
        each.kill()
    _, said = process.communicate(timeout=PATIENCE)
    return process.returncode, said


@pytest.mark.parametrize("moment", [0.0, 0.5])
def test_worker_that_is_killed_while_it_starts_is_replaced_or_named(
    folder: Path, whole: Path, moment: float
) -> None:
    code, said = killed_at_its_start(folder, moment)
    assert "fault of viscontact" not in said
    assert "Traceback" not in said
    if code == 0:
        assert same_bits(folder / "sweep", whole)
    else:
        assert code == 1
        assert "a worker ended while it started" in said
        assert not (folder / "sweep").exists()


def test_scheduler_that_is_killed_while_its_first_worker_is_awaited_is_named(
    folder: Path, clusters: list[Cluster], monkeypatch: pytest.MonkeyPatch
) -> None:
    # So long Dask tries to reach the scheduler again; otherwise 30 s.
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT", "4 s")
    clusters.append(cluster := Cluster(folder, 0))
    process = command("-v")
    assert process.stderr is not None
    clock.sleep(3)
    cluster.scheduler.kill()
    _, said = process.communicate(timeout=PATIENCE)
    assert "fault of viscontact" not in said
    assert process.returncode in (1, 2)
    assert "its scheduler has ended" in said or "no scheduler answers" in said
    assert not (folder / "sweep").exists()
