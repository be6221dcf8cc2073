"""`run --array` and `run --task`: the runs of a sweep as the tasks of a batch system."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
import threading
import time as clock
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
import xarray as xr

from viscontact.cli import main
from viscontact.results.run_files import (
    FAILURE_NAME,
    MANIFEST_NAME,
    PROGRESS_NAME,
    RESULT_NAME,
    STOP_NAME,
)
from viscontact.runs.directory.lock import locked
from viscontact.studies.sweep import job_array
from viscontact.studies.sweep.job_array import JobArray, pbs_script, slurm_script

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 1 MPa, delayed_modulus: 1 MPa, viscosity: 1 MPa s,
  poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 1 s, steps: 3}
grid: {shape: [24, 24], size: [5 mm, 5 mm]}
output: {errors: false}
"""
WORDS = ["run", "my ball.yaml", "--vary", "load.force=0.2 N,0.4 N,9 N", "-q"]
# Runs the tasks of an array one after another, as `sbatch` and `qsub` submit them.
BATCH = """\
import os, re, subprocess, sys
text = open(sys.argv[1], encoding="utf-8").read()
tasks = re.search(r"^#(?:SBATCH --array=|PBS -J )([0-9,-]+)", text, re.MULTILINE)
for part in (tasks[1] if tasks else "0").split(","):
    first, _, last = part.partition("-")
    for number in range(int(first), int(last or first) + 1):
        index = {"SLURM_ARRAY_TASK_ID": str(number), "PBS_ARRAY_INDEX": str(number)}
        subprocess.run(["bash", sys.argv[1]], env=os.environ | index)
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working directory with a space in its name, and programs that submit job arrays."""
    here, programs = tmp_path / "my runs", tmp_path / "bin"
    here.mkdir()
    programs.mkdir()
    (here / "my ball.yaml").write_text(CASE, encoding="utf-8")
    (programs / "batch.py").write_text(BATCH, encoding="utf-8")
    python = shlex.quote(sys.executable)
    batch = shlex.quote(str(programs / "batch.py"))
    for name, text in {
        "sbatch": f'{python} {batch} "$@"',
        "qsub": f'{python} {batch} "$@"',
        "viscontact": f'exec {python} -m viscontact "$@"',
    }.items():
        program = programs / name
        program.write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
        program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.chdir(here)
    return here


def contents(directory: str) -> dict[str, bytes]:
    with xr.open_dataset(Path(directory) / RESULT_NAME) as ds:
        return {str(name): ds[name].values.tobytes() for name in ds.variables}


def forward_commands(folder: Path) -> None:
    """Let tasks write down their commands, which `submitted` gives to this process."""
    program = folder.parent / "bin" / "viscontact"
    program.write_text('#!/bin/bash\nprintf "%q " "$@" >>commands\necho >>commands\n', "utf-8")


def submitted(command: str) -> None:
    """Submit the script of a job array, all tasks of which have ended then."""
    subprocess.run(command, shell=True, check=True, capture_output=True)
    commands = Path("commands")
    if commands.exists():
        for line in commands.read_text(encoding="utf-8").splitlines():
            main(shlex.split(line))
        commands.unlink()


def array(count: int, **others: object) -> JobArray:
    given = {"manifest": Path("/s/out/runs.jsonl"), "left": range(count), "memory": 3e8}
    return JobArray(runs=count, **{**given, "seconds": 400.0, "logs": Path("/s/logs"), **others})  # type: ignore[arg-type]


@pytest.mark.skipif(os.name == "nt", reason="batch systems run on Unix")
@pytest.mark.parametrize(
    ("script", "forwarded"),
    [
        ("all of it.sbatch", True),
        *(
            pytest.param(script, False, marks=pytest.mark.slow)
            for script in ("all of it.sbatch", "all.pbs")
        ),
    ],
)
def test_a_job_array_ends_in_the_bits_of_the_sweep_computed_here(
    folder: Path,
    script: str,
    forwarded: bool,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if forwarded:
        forward_commands(folder)
    if script.endswith("pbs"):  # which takes no blanks in the path of the logs
        monkeypatch.chdir(folder.rename(folder.with_name("runs")))
    sweep = ["run", "my ball.yaml", "--vary", "load.force=0.2 N,9 N", "-q"]
    assert main([*sweep, "-o", "here"]) == 1  # 9 N reach the border of the grid
    assert main([*sweep, "-o", "out", "--array", script, "-j", "2"]) == 0
    submit = capsys.readouterr().out.strip()
    assert submit == f"{'qsub' if script.endswith('pbs') else 'sbatch'} {shlex.quote(script)}"
    assert [path.name for path in Path("out").iterdir()] == [MANIFEST_NAME]  # nothing has begun
    assert "-1%2\n" in Path(script).read_text(encoding="utf-8")
    submitted(submit)
    capsys.readouterr()  # what the tasks have printed, if here
    assert contents("out/my ball_force=0.2N") == contents("here/my ball_force=0.2N")
    failure, here = (
        json.loads((Path(place) / "my ball_force=9N" / FAILURE_NAME).read_text(encoding="utf-8"))
        for place in ("out", "here")
    )
    assert failure["outcome"] == here["outcome"] == "stopped"
    assert failure["message"][0].endswith(here["message"][0])  # the path may be a whole one
    # What is left of it, as another array.
    words = [*sweep, "-o", "out", "--resume", "-j", "2", "--array"]
    assert main([*words, script]) == 2  # the script of all runs is kept
    left = f"left{Path(script).suffix}"
    assert main([*words, left]) == 0
    submit = capsys.readouterr().out.strip()
    Path("out/my ball_force=9N", FAILURE_NAME).unlink()
    result = Path("out/my ball_force=0.2N", RESULT_NAME)
    before = result.stat().st_mtime_ns
    submitted(submit)
    assert Path("out/my ball_force=9N", FAILURE_NAME).exists()
    assert result.stat().st_mtime_ns == before
    text = Path(left).read_text(encoding="utf-8")
    if script.endswith("pbs"):  # it has no lists of tasks, and no arrays of one
        assert "#PBS -J" not in text
        assert "runs=(1)\n" in text
    else:
        assert "#SBATCH --array=1%2\n" in text


def test_a_task_resumes_its_run_and_leaves_a_finished_one_alone(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*WORDS, "-o", "out", "--array", "a.sbatch"]) == 0
    task = ["run", "--task", "1", "out/runs.jsonl"]
    Path("out/my ball_force=0.4N").mkdir()
    with locked(Path("out/my ball_force=0.4N")):
        assert main(task) == 2
    assert "another run" in capsys.readouterr().err
    assert not Path("out/my ball_force=0.4N", FAILURE_NAME).exists()
    assert main([*task, "-q"]) == 0
    result = Path("out/my ball_force=0.4N", RESULT_NAME)
    before = result.stat().st_mtime_ns
    assert main([*task, "--resume"]) == 0
    assert "is finished already" in capsys.readouterr().err
    assert main(["run", "out", "--task", "1"]) == 0  # the directory of the sweep
    assert result.stat().st_mtime_ns == before
    assert main([*task, "--overwrite", "-q"]) == 0
    assert result.stat().st_mtime_ns != before
    # A refused run is listed as failed, unless it has a result.
    text = CASE.replace("viscosity: 1 MPa s", "viscosity: 1 kg")
    Path("my ball.yaml").write_text(text, encoding="utf-8")
    for number, is_failed in ((0, True), (1, False)):
        assert main(["run", "--task", str(number), "out"]) == 2
        place = Path("out", f"my ball_force=0.{2 + 2 * number}N", FAILURE_NAME)
        assert place.exists() is is_failed


def test_a_file_stops_tasks_until_the_next_array_is_written(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*WORDS, "--set", "time.steps=2000", "-o", "out", "--array"]
    assert main([*words, "a.sbatch"]) == 0
    run, stop = Path("out/my ball_force=0.2N"), Path("out", STOP_NAME)

    def ask() -> None:
        while not (run / PROGRESS_NAME).exists():
            clock.sleep(0.01)
        stop.touch()

    asking = threading.Thread(target=ask)
    asking.start()
    assert main(["run", "--task", "0", "out", "-q"]) == 130
    asking.join()
    with xr.open_dataset(run / RESULT_NAME) as ds:
        assert 0 < ds.sizes["time"] < 2001
    assert "continue with: viscontact run" in capsys.readouterr().err
    assert main(["run", "--task", "1", "out"]) == 130
    assert f"{stop} asks the runs of this sweep to stop; remove it" in capsys.readouterr().err
    assert not Path("out/my ball_force=0.4N").exists()
    assert main([*words, "b.sbatch", "--resume"]) == 0
    assert not stop.exists()
    assert not list(Path("out").rglob(FAILURE_NAME))


def test_task_of_a_case_that_was_edited_is_refused_until_that_is_meant(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*WORDS, "-o", "out", "--array", "a.sbatch"]) == 0
    case, task = Path("my ball.yaml"), ["run", "-q", "--task"]
    case.write_text(f"# a comment\n{CASE}", encoding="utf-8")
    assert main([*task, "0", "out"]) == 0
    case.write_text(CASE.replace("end: 1 s", "end: 2 s"), encoding="utf-8")
    capsys.readouterr()
    assert main([*task, "1", "out"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"my ball.yaml: has changed since {Path('out/runs.jsonl')} was written:")
    assert "time; compute the changed case in a new directory, or" in line
    place = Path("out/my ball_force=0.4N")
    assert "has changed" in (place / FAILURE_NAME).read_text(encoding="utf-8")
    assert main([*WORDS, "-o", "out", "--array", "b.sbatch"]) == 2
    assert "out: holds runs of the case my ball.yaml before it changed: time; " in (
        capsys.readouterr().err
    )
    assert main([*task, "1", "out", "--resume"]) == 0
    with xr.open_dataset(place / RESULT_NAME) as ds:
        assert float(ds.time[-1]) == 2.0


def test_too_little_memory_warns_where_the_array_is_written_and_refuses_where_it_runs(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("runs.preparation", "studies.sweep.common_cells", "cli.sweep.jobs"):
        monkeypatch.setattr(f"viscontact.{module}.available_memory", lambda: 1e8)
    assert main([*WORDS[:-1], "-o", "out", "--array", "a.sbatch"]) == 0
    warning = "a run needs about 0.150 GB of memory, this machine has 0.100 GB free"
    assert f"warning: {warning}; the machine" in capsys.readouterr().err
    assert main(["run", "--task", "0", "out"]) == 2
    assert "need about 0.150 GB of memory, 0.100 GB are free" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--task", "3", "out/runs.jsonl"], "--task 3: out/runs.jsonl has the runs 0 to 2"),
        (["--task", "-1", "out/runs.jsonl"], "--task -1: out/runs.jsonl has the runs 0 to 2"),
        (["--task", "0", "none.jsonl"], "none.jsonl: no such file; --task needs the manifest"),
        (["--task", "0", "my ball.yaml"], "my ball.yaml is not the manifest of a sweep; give DIR/"),
        (["--task", "0", "out", "out"], "--task 0: takes the manifest of a sweep, which names"),
        (["--task", "0", "out", "-o", "x"], "--task 0: takes the manifest of a sweep, which"),
        (["--task", "0", "out", "--set", "a=1"], "--set a: unknown key"),
        (["--task", "0", "out", "--vary", "a=1"], "--task 0: takes the manifest of a sweep"),
        (["--task", "0", "out", "--array", "a.pbs"], "--task 0: takes the manifest of a sweep"),
        (["--task", "0", "out", "--scheduler", "local"], "--array and --task do not go with it"),
        ([*WORDS[1:], "--array", "b.pbs", "--scheduler", "local"], "--scheduler computes the runs"),
        (["--task", "0", "out", "--resume", "--overwrite"], "give one of them"),
        (["out/runs.jsonl"], "out/runs.jsonl: is a manifest of runs; compute one of them with"),
        ([*WORDS[1:], "--array", "a.sbatch"], "--array: name a directory for the runs, with -o"),
        ([*WORDS[1:], "-o", "new", "--array", "a.txt"], "--array a.txt: name it FILE.sbatch"),
        ([*WORDS[1:], "-o", "out", "--overwrite", "--array", "b.pbs"], "choose another -o DIR"),
        ([*WORDS[1:], "-o", "new", "--array", "a.sbatch"], "a.sbatch: exists already; submit it"),
    ],
)
def test_what_is_no_task_or_array_is_refused_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert main([*WORDS, "-o", "out", "--array", "a.sbatch"]) == 0
    capsys.readouterr()
    assert main(["run", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said.replace("/", os.sep) in line
    assert not Path("new").exists()


def test_scripts_request_what_the_runs_need() -> None:
    text = slurm_script(array(10, threads=4))
    assert "#SBATCH --array=0-9\n" in text
    assert "#SBATCH --cpus-per-task=4\n" in text
    assert "#SBATCH --job-name=viscontact-out\n" in text
    assert "#PBS -N viscontact-my-r\n" in pbs_script(array(2, manifest=Path("/my runs/runs.jsonl")))
    assert "#SBATCH --mem=500M\n" in text  # 1.5 * 300 MB, in steps of 100 MB
    assert "#SBATCH --time=00:20:00\n" in text  # 3 * 400 s
    assert "exec viscontact run --task $SLURM_ARRAY_TASK_ID /s/out/runs.jsonl --threads 4" in text
    assert "#SBATCH --time=00:10:00\n" in slurm_script(array(10, seconds=1.0))
    assert "#SBATCH --time=30:00:00\n" in slurm_script(array(10, seconds=36e3))
    assert "#PBS -l select=1:ncpus=1:mem=500mb\n" in pbs_script(array(10))
    assert "#PBS -J" not in pbs_script(array(1))
    assert "#PBS -J 0-2%3\n" in pbs_script(array(10, left=[4, 7, 8], at_once=3))


@pytest.mark.skipif(os.name == "nt", reason="batch systems run on Unix")
@pytest.mark.parametrize("script", [slurm_script, pbs_script])
@pytest.mark.parametrize(
    "left", [range(3), range(9), range(10), [10], [0, 1, 6], [1, 2, 3, 5, 7, 8, 9, 10]]
)
def test_tasks_of_a_long_array_compute_each_run_once(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    left: Sequence[int],
    script: Callable[[JobArray], str],
) -> None:
    monkeypatch.setattr(job_array, "MOST_TASKS", 4)
    program = f"echo >> {shlex.quote(str(tmp_path / 'ran'))}"
    text = script(array(11, left=left, program=program))
    (tmp_path / "script").write_text(text, encoding="utf-8")
    (tmp_path / "batch.py").write_text(BATCH, encoding="utf-8")
    subprocess.run([sys.executable, tmp_path / "batch.py", tmp_path / "script"], check=True)
    ran = (tmp_path / "ran").read_text(encoding="utf-8").splitlines()
    assert [int(line.split()[2]) for line in ran] == list(left)
    numbers = re.search(r"(?:--array=|-J )0-(\d+)\n", text)
    assert numbers is None or int(numbers[1]) < 4


RUN = """\
import signal, sys, time

def say(word):
    with open(__file__ + ".log", "a") as log:
        print(word, sys.argv[3], file=log)

def save(number, frame):
    say("saved")
    sys.exit(130)

signal.signal(signal.SIGTERM, save)
say("began")
if "--threads" in sys.argv:  # a long run
    time.sleep(60)
sys.exit(sys.argv[3] == "1")
"""


@pytest.fixture
def start_task(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str], subprocess.Popen[bytes]]:
    """Start the first of two tasks of a script for six runs of a program in place of ours."""
    monkeypatch.setattr(job_array, "MOST_TASKS", 2)
    (tmp_path / "run.py").write_text(RUN, encoding="utf-8")

    def start(script: str) -> subprocess.Popen[bytes]:
        program = f"{shlex.quote(sys.executable)} {shlex.quote(str(tmp_path / 'run.py'))}"
        (tmp_path / "script").write_text(script.replace("viscontact run", f"{program} run"))
        first = os.environ | {"SLURM_ARRAY_TASK_ID": "0", "PBS_ARRAY_INDEX": "0"}
        return subprocess.Popen(["bash", tmp_path / "script"], env=first)

    return start


@pytest.mark.skipif(os.name == "nt", reason="batch systems run on Unix")
@pytest.mark.parametrize("script", [slurm_script, pbs_script])
def test_signal_to_a_task_of_several_runs_reaches_its_run_and_no_other_begins(
    tmp_path: Path,
    start_task: Callable[[str], subprocess.Popen[bytes]],
    script: Callable[[JobArray], str],
) -> None:
    log = tmp_path / "run.py.log"
    with start_task(script(array(6, threads=2))) as task:
        while not log.exists() or not log.read_text(encoding="utf-8"):
            clock.sleep(0.01)
        task.terminate()  # bash only, as `sbatch --signal=B:TERM` does
        assert task.wait(20) == 130
    assert log.read_text(encoding="utf-8") == "began 0\nsaved 0\n"


@pytest.mark.skipif(os.name == "nt", reason="batch systems run on Unix")
def test_task_of_several_runs_continues_after_a_failure_and_exits_with_it(
    tmp_path: Path, start_task: Callable[[str], subprocess.Popen[bytes]]
) -> None:
    with start_task(slurm_script(array(6))) as task:
        assert task.wait(20) == 1  # of run 1
    log = (tmp_path / "run.py.log").read_text(encoding="utf-8")
    assert log == "began 0\nbegan 1\nbegan 2\n"


@pytest.mark.parametrize(
    "name", ["a\nrm x.sbatch", "a\r.sbatch", 'a".sbatch', "a\x1b.sbatch", "a:b.pbs"]
)
def test_names_that_would_end_a_comment_of_the_script_are_refused(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["my ball.yaml", "--vary", "load.force=1N,2N", "-o", "out", "--array", name]
    assert main(["run", *words]) == 2
    assert "choose another name" in capsys.readouterr().err
    assert not Path("out").exists()
