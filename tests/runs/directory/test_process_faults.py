"""Runs whose process or directory meets with something: they end in words, and continue."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time as clock
from collections.abc import Callable
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("Windows has other signals, and no fork", allow_module_level=True)

import xarray as xr
from tests.runs.directory.test_kill import RUBBER, SWING, ZENER
from tests.studies.calibration.experiments import ELASTIC_BALL, hertz_depth

from killed_run import complete, differing
from viscontact.cli import main

HERE = Path(__file__).parents[2]
STEPS = 80
CASE = RUBBER + ZENER + SWING + f"time: {{end: 6 s, steps: {STEPS}}}\noutput: {{errors: false}}\n"
LOG = "progress.jsonl"


class Started:
    """A command in a process of its own, with what it writes in a file."""

    def __init__(self, *words: str) -> None:
        self.said = Path("said.txt").absolute()
        self.pid = os.fork()
        if not self.pid:
            code = 70
            try:
                for number in (1, 2):
                    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
                    os.dup2(os.open(self.said, flags), number)
                sys.stdout, sys.stderr = (os.fdopen(n, "w", buffering=1) for n in (1, 2))
                code = main(list(words))
            finally:
                os._exit(code)

    def wait_for(self, path: Path, lines: int) -> None:
        """Wait until a file has some lines; a process that ends before fails."""
        while not path.exists() or path.read_bytes().count(b"\n") < lines:
            assert os.waitpid(self.pid, os.WNOHANG) == (0, 0), self.said.read_text()
            clock.sleep(0.002)

    def send(self, number: int) -> None:
        """Send a signal."""
        os.kill(self.pid, number)

    def ended(self) -> tuple[int, str]:
        """Wait for the end; exit code and what was written."""
        _, status = os.waitpid(self.pid, 0)
        return os.waitstatus_to_exitcode(status), self.said.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """The result without a fault."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(folder / "case.yaml"), "-o", str(folder / "run"), "-q"]) == 0
    with xr.open_dataset(folder / "run" / "result.nc") as ds:
        return ds.load()


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


RUN = ("run", "case.yaml", "-o", "run", "-q")


def in_words(said: str) -> bool:
    return 0 < len(said.splitlines()) <= 4 and "Traceback" not in said and "fault of" not in said


@pytest.mark.slow
def test_run_that_is_suspended_ends_in_the_same_bits(reference: xr.Dataset) -> None:
    run, chance = Started(*RUN), random.Random(1)
    for lines in (3, 20, 40, 60):
        run.wait_for(Path("run") / LOG, lines)
        run.send(signal.SIGSTOP)
        clock.sleep(0.1 * chance.random())
        assert differing(Path("run/result.nc"), reference) == []
        run.send(signal.SIGCONT)
    assert run.ended()[0] == 0
    assert complete(Path("run"), reference) == []


@pytest.mark.slow
def test_run_whose_session_ends_is_saved_and_resumed(reference: xr.Dataset) -> None:
    for lines in (5, 40):
        run = Started(*RUN, "--resume")
        run.wait_for(Path("run") / LOG, lines)
        run.send(signal.SIGHUP)
        code, said = run.ended()
        assert code == 130
        assert "--resume" in said
    assert main([*RUN, "--resume"]) == 0
    assert complete(Path("run"), reference) == []


@pytest.mark.slow
@pytest.mark.parametrize("lines", [2, 50])
def test_run_whose_directory_is_moved_continues_where_it_is_now(
    lines: int, reference: xr.Dataset
) -> None:
    run = Started(*RUN)
    run.wait_for(Path("run") / LOG, lines)
    Path("run").rename("moved")
    code, said = run.ended()
    assert code == 1
    assert in_words(said), said
    assert differing(Path("moved/result.nc"), reference) == []
    assert main(["run", "case.yaml", "-o", "moved", "-q", "--resume"]) == 0
    assert complete(Path("moved"), reference) == []


@pytest.mark.slow
@pytest.mark.parametrize("lines", [2, 50])
def test_run_whose_directory_is_removed_ends_in_words(lines: int, reference: xr.Dataset) -> None:
    run = Started(*RUN)
    run.wait_for(Path("run") / LOG, lines)
    while Path("run").exists():  # a run may write a file while others are removed
        shutil.rmtree("run", ignore_errors=True)
    code, said = run.ended()
    assert code == 1
    assert in_words(said), said
    assert main([*RUN, "--resume"]) == 0
    assert complete(Path("run"), reference) == []


@pytest.mark.slow
@pytest.mark.parametrize("room", [0, 2**22])
def test_run_that_reaches_a_limit_of_memory_is_resumed(room: int, reference: xr.Dataset) -> None:
    resource = pytest.importorskip("resource")
    if not Path("/proc/self/statm").exists():
        pytest.skip("the size of a process is not known here")
    run = Started(*RUN)
    run.wait_for(Path("run") / LOG, 20)
    pages = int(Path(f"/proc/{run.pid}/statm").read_text().split()[0])
    size = pages * resource.getpagesize() + room
    resource.prlimit(run.pid, resource.RLIMIT_AS, (size, size))
    code, said = run.ended()
    if code == 0:
        assert complete(Path("run"), reference) == []
        return
    assert code == 1
    assert in_words(said), said
    assert main([*RUN, "--resume"]) == 0
    assert complete(Path("run"), reference) == []


@pytest.mark.slow
def test_fit_that_is_killed_and_resumed_finds_the_same_bits() -> None:
    Path("ball.yaml").write_text(ELASTIC_BALL)
    rows = [(t, 0.02 * t, float(hertz_depth(0.02 * t))) for t in range(7)]
    lines = [f"{time}, {force:.6g}, {depth:.6g}\n" for time, force, depth in rows]
    Path("a.csv").write_text("time [s], force [N], approach [m]\n" + "".join(lines))
    change = ("--change", "material.shear_modulus=0.5 MPa:9 MPa:log")
    fit = ("fit", "a.csv", "--case", "ball.yaml", *change, "-q")
    assert Started(*fit, "--yaml", "whole.yaml").ended()[0] == 0
    journal, killed = Path("a-fit.jsonl"), 0
    for lines_before_kill in (1, 3, 5):
        run = Started(*fit, "--yaml", "found.yaml", "--resume")
        try:
            run.wait_for(journal, lines_before_kill)
        except (AssertionError, ChildProcessError):
            break
        run.send(signal.SIGKILL)
        killed += run.ended()[0] == -signal.SIGKILL
    if not Path("found.yaml").exists():
        assert Started(*fit, "--yaml", "found.yaml", "--resume").ended()[0] == 0
    assert killed >= 2
    assert Path("found.yaml").read_bytes() == Path("whole.yaml").read_bytes()


@pytest.mark.slow
def test_disk_faults_stop_a_run_in_words_and_it_is_resumed(
    tmp_path: Path, campaign: Callable[[str], None]
) -> None:
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or sys.platform != "linux":
        pytest.skip("needs a C compiler and LD_PRELOAD")
    library, source = tmp_path / "faults.so", HERE / "disk_faults.c"
    build = [compiler, "-shared", "-fPIC", "-o", str(library), str(source), "-ldl"]
    subprocess.run(build, check=True)
    done = subprocess.run(
        [sys.executable, str(HERE / "disk_faults.py"), str(tmp_path), "80", "1"],
        env={**os.environ, "LD_PRELOAD": str(library)},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    found = json.loads(done.stdout.splitlines()[-1])
    tried = sum(each["tried"] for each in found["counts"].values())
    campaign(f"calls of the system that failed: {found['counts']}: faults {len(found['wrong'])}")
    assert found["wrong"] == []
    assert tried >= 25
