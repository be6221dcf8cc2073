"""Several runs by one command: each the same as alone, checked together, stopped together."""

from __future__ import annotations

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time as clock
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

import numpy as np
import psutil
import pytest
import xarray as xr

import viscontact as vc
from interrupted_runs import BODIES
from viscontact.cli import main
from viscontact.cli.sweep import execution, jobs
from viscontact.cli.sweep.plan_options import PlanOptions
from viscontact.cli.sweep.request import ManyRequest
from viscontact.results.formatting import format_percent
from viscontact.results.stated_errors import largest_error
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.executors import executor_choice
from viscontact.studies.sweep import many

PAGE = (Path(__file__).parents[3] / "docs" / "many-runs.md").read_text(encoding="utf-8")
CASE = (
    BODIES
    + """\
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 4}
grid: {shape: [24, 24], size: [4 mm, 4 mm]}
output: {fields: [0 s, 5 s]}
"""
)
RUBBER = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory whose name has a space, with two cases in it."""
    here = tmp_path / "my runs"
    here.mkdir()
    (here / "zener.yaml").write_text(CASE, encoding="utf-8")
    maxwell = CASE.replace("zener", "maxwell").replace("  delayed_modulus: 10 MPa\n", "")
    (here / "maxwell.yaml").write_text(maxwell, encoding="utf-8")
    monkeypatch.chdir(here)
    return here


def contents(directory: str) -> dict[str, bytes]:
    with xr.open_dataset(Path(directory) / "result.nc") as ds:
        return {str(name): ds[name].values.tobytes() for name in ds.variables}


def command(heading: str = "") -> list[str]:
    """The words of the page's first command below a heading."""
    part = PAGE.partition(heading)[2]
    return shlex.split(re.findall(r"```(?:sh)?\nviscontact (.*)\n```", part)[0])


@pytest.mark.slow
def test_runs_at_once_end_in_the_bits_of_runs_alone(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(command("# Many runs")) == 0
    printed = capsys.readouterr()
    assert re.search(r"^zener +done", printed.out, re.MULTILINE)
    assert "2 of 2 runs done" in printed.err
    assert "line" not in printed.out  # the line load of balls is of no use
    for name in ("zener", "maxwell"):
        assert main(["run", f"{name}.yaml", "-o", "alone", "--overwrite", "-q"]) == 0
        assert contents("alone") == contents(name)
        with vc.open_results(name) as ds:  # the table shows what the result holds
            assert f"{float(ds.peak_pressure.max()) / 1e6:.3f}" in printed.out
            scalars = ("force", "approach", "contact_area", "peak_pressure")
            parts = [found.part for each in scalars if (found := largest_error(ds, each))]
            assert format_percent(max(parts)) in printed.out
    # what is finished is not run again
    assert command("## Errors and interruptions") == [
        *command("## Parameter variation"),
        "--resume",
    ]
    times = {name: Path(name, "result.nc").stat().st_mtime_ns for name in ("zener", "maxwell")}
    assert main([*command("# Many runs"), "--resume"]) == 0
    assert re.search(r"^zener +done", capsys.readouterr().out, re.MULTILINE)
    assert times == {name: Path(name, "result.nc").stat().st_mtime_ns for name in times}


@pytest.mark.slow
def test_varied_values_have_directories_of_their_own_and_the_rim_stops_only_one(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*command("## Parameter variation"), "--vary", "grid.size=[3mm,3mm],[1 mm, 1 mm]", "-q"]
    assert main(words) == 1
    names = [f"zener_force={force}_size=3mm-3mm" for force in ("2N", "4N")]
    # those that stop in their first instant leave only the reason
    failed = [Path("forces", name.replace("3mm-3mm", "1mm-1mm")) for name in names]
    assert set(Path("forces").iterdir()) == {
        *(Path("forces", each) for each in ("runs.jsonl", *names)),
        *failed,
    }
    for directory in failed:
        assert [path.name for path in directory.iterdir()] == ["failure.json"]
        failure = json.loads((directory / "failure.json").read_text(encoding="utf-8"))
        assert (failure["outcome"], failure["code"]) == ("stopped", 1)
        assert "the contact reaches the edge of the grid" in failure["message"][0]
    said = capsys.readouterr().err
    assert "--vary grid: the contact reaches the edge of the grid" in said
    assert "2 of 4 runs failed: zener_force=2N_size=1mm-1mm, zener_force=4N_size=1mm-1mm" in said
    for name, force in zip(names, (2.0, 4.0), strict=True):
        with vc.open_results(Path("forces") / name) as ds:
            np.testing.assert_allclose(ds.force, force, rtol=1e-5)  # the run's tolerance, 1e-6
            assert float(ds.time[-1]) == 5.0


def test_one_case_that_is_refused_keeps_all_from_beginning(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = CASE.replace("viscosity: 10 MPa s", "viscosity: 10 kg")
    Path("broken.yaml").write_text(broken, encoding="utf-8")
    before = sorted(folder.iterdir())
    words = ["run", "zener.yaml", "broken.yaml", "maxwell.yaml", "-j", "2"]
    assert main([*words, "--vary", "load.force=2N,10 MPa,3N"]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2  # each once, whatever the number of runs that have it
    assert lines[0].startswith("--vary load.force: cannot read '10 MPa' as a force")
    assert lines[1].startswith("broken.yaml:7: material.viscosity: cannot read '10 kg'")
    assert sorted(folder.iterdir()) == before


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--vary", "load.force"], "--vary load.force: write KEY=VALUE,VALUE,..."),
        (["--vary", "load.force=2N,,3N"], "--vary load.force=2N,,3N: write KEY=VALUE,VALUE,..."),
        (["--vary", "load.force=2N", "--vary", "load.force=3N"], "load.force: is given twice"),
        (["--vary", "load.force=2N", "--set", "load.force=3N"], "load.force: is given twice"),
        (["--vary", "load.force=2N,2 N"], "force=2N and load.force=2 N are equal"),
        # one name where the case of letters does not count
        (["--vary", "load.force=2mN,2MN"], "2 of the runs would go there"),
        (["--vary", "load.force=2N,3N", "--resume", "--overwrite"], "give one of them"),
    ],
)
def test_what_cannot_be_varied_is_refused_in_one_line(
    folder: Path, words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = sorted(folder.iterdir())
    assert main(["run", "zener.yaml", *words]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert len(message.splitlines()) == 1
    assert sorted(folder.iterdir()) == before


def test_names_of_variations_may_stand_in_any_path() -> None:
    values = ("1e-3 / MPa", '"x, y"', "-5 µm", "5%", "C:\\x")
    texts = [*(f"a.b={value}" for value in values), "a[2].b=../.."]
    case = Path("a.yaml")
    names = [PlanOptions((text,)).design(case).name(0) for text in texts]
    assert names == ["b=1e-3-MPa", "b=x-y", "b=-5µm", "b=5%", "b=C-x", "b="]
    # two keys that end in the same are distinguished by all of their names
    both = PlanOptions(("load.force=1 N", "other.force=2 N")).design(case)
    assert both.name(0) == "load.force=1N_other.force=2N"


def test_runs_that_do_not_fit_into_memory_wait_for_one_another(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(jobs, "usable_cores", lambda: 2)
    monkeypatch.setattr(jobs, "available_memory", lambda: 3e8)
    found = [job(f"{n}", memory) for n, memory in enumerate((1e8, 2e8, 1.5e8))]
    # the two largest together are too many, whichever of them meet
    assert jobs.fitting(found) == 1
    said = jobs.resource_warnings(found, wanted=3, at_once=1, threads=1)
    assert said == [
        "-j 3: these runs at once would need about 0.450 GB of memory, 0.300 GB are free; "
        "1 at a time"
    ]
    assert jobs.fitting(found[:1] + found[2:]) == 2
    (crowded,) = jobs.resource_warnings(found[:1] + found[2:], wanted=2, at_once=2, threads=2)
    assert "2 runs of 2 threads each at once share 2 cores" in crowded


@pytest.mark.parametrize(("typed", "at_once"), [(None, 4), (1, 1), (6, 5)])
def test_as_many_runs_as_there_are_cores_for_their_threads_are_computed_by_default(
    typed: int | None, at_once: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []

    def pool(count: int) -> None:
        asked.append(count)
        raise InterruptedError

    monkeypatch.setattr(execution, "LocalWorkers", pool)
    monkeypatch.setattr(execution, "number_of_workers", lambda workers: 8)
    common = RunRequest(Path("a.yaml"), threads=2, quiet=True)
    request = ManyRequest((Path("a.yaml"),), common, jobs=typed)
    found = [job(f"{n}", 1e6) for n in range(5)]
    with pytest.raises(InterruptedError), execution._workers(request, found, None):  # type: ignore[arg-type]
        pass
    assert asked == [at_once]


def job(name: str, memory: float) -> Job:
    request = RunRequest(Path(f"{name}.yaml"))
    return Job(request, Path(name), name, RunStage.NEW, 5, 1.0, 1.0, memory)


#: The program, whose runs wait for each other after their first steps, and are slow then.
MEETING = """\
import sys
import time
from pathlib import Path
from viscontact.cli import main
from viscontact.runs.directory.recorder import Recorder

steps = Recorder.steps

def meeting(self, *given):
    for number, state in enumerate(steps(self, *given)):
        yield state
        while number == 5 and len(list(Path("f").glob("*/progress.jsonl"))) < 2:
            time.sleep(0.01)
        time.sleep(0.05 if number > 4 else 0.0)

Recorder.steps = meeting
if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.slow  # processes begun, stopped and begun again
@pytest.mark.skipif(os.name == "nt", reason="there, only the console asks processes to stop")
def test_runs_are_stopped_together_and_resumed_to_the_same_bits(
    folder: Path, tmp_path: Path
) -> None:
    words = ["run", "zener.yaml", "--vary", "load.force=2N,3N,4N", "-j", "2", "-o", "f"]
    words += ["--set", "time.steps=200"]
    both = [Path(f"f/zener_force={force}N") for force in (2, 3)]
    program = tmp_path / "program.py"
    program.write_text(MEETING, encoding="utf-8")
    process = subprocess.Popen(
        [sys.executable, str(program), *words], stderr=subprocess.PIPE, text=True
    )
    until(lambda: process.poll() is not None or all(steps_logged(run) > 3 for run in both))
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=100)
    assert process.returncode == 130, said
    assert not Path("f/zener_force=4N").exists()
    for run in both:
        with vc.open_results(run) as ds:
            assert 3 < ds.sizes["time"] == steps_logged(run) < 201
    resuming = shlex.split(said.splitlines()[-1].removeprefix("continue with: viscontact "))
    assert resuming == [*words[:2], *words[6:8], *words[8:], *words[2:6], "--resume"]
    assert main([*resuming, "-q"]) == 0
    assert main(["run", "zener.yaml", "--set", "load.force=3N", *words[8:], "-q"]) == 0
    assert contents("zener") == contents(str(both[1]))


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="not tried there")
def test_runs_whose_command_is_killed_save_and_end(folder: Path) -> None:
    words = ["run", "zener.yaml", "--vary", "load.force=2N,3N", "--set", "time.steps=8000"]
    runs = [Path(f"zener_force={force}N") for force in (2, 3)]
    process = subprocess.Popen([sys.executable, "-m", "viscontact", *words, "-j", "2"])
    until(lambda: all(steps_logged(run) > 3 for run in runs))
    process.kill()
    process.wait()
    until(lambda: not any(is_at_work(run) for run in runs))
    for run in runs:
        with vc.open_results(run) as ds:  # published with all that was logged
            assert 3 < ds.sizes["time"] == steps_logged(run) < 8001


def until(holds: Callable[[], bool]) -> None:
    give_up = clock.monotonic() + 60
    while not holds():
        assert clock.monotonic() < give_up
        clock.sleep(0.01)


def steps_logged(run: Path) -> int:
    log = run / "progress.jsonl"
    return log.read_bytes().count(b"\n") if log.exists() else 0


def is_at_work(run: Path) -> bool:
    try:
        with locked(run):
            return False
    except DirectoryInUse:
        return True


def test_simulations_in_processes_are_the_simulations_in_order() -> None:
    grid = vc.Grid((16, 16), (3e-3, 3e-3))
    given = {"indenter": vc.Sphere(0.01), "material": RUBBER, "grid": grid, "times": [0.0]}
    runs = [{**given, "load": vc.step(force)} for force in (0.1, 0.05)]
    rim = {**given, "load": vc.step(10.0)}
    with pytest.warns(vc.AccuracyWarning) as warned:
        *found, failed = vc.simulate_many(
            [runs[0], partial(vc.simulate, **runs[1]), rim], workers=2, return_exceptions=True
        )
    assert {str(each.message).partition(":")[0] for each in warned} == {"run 1 of 3", "run 2 of 3"}
    for run, ds in zip(runs, found, strict=True):
        with pytest.warns(vc.AccuracyWarning):
            alone = vc.simulate(**run)
        assert ds.pressure.values.tobytes() == alone.pressure.values.tobytes()
    assert isinstance(failed, vc.DomainError)
    assert failed.__notes__ == ["in run 3 of 3 of simulate_many"]


@pytest.mark.parametrize(("free", "at_once"), [(2.3e9, 4), (1.9e9, 2), (1.5e9, 1), (5e8, 1)])
def test_simulations_that_do_not_fit_into_memory_wait_for_one_another(
    free: float, at_once: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []

    def pool(count: int) -> None:
        asked.append(count)
        raise InterruptedError

    # of an elastic body: 0.15 GB, 20 numbers of 8 bytes a cell, and 0.13 GB on 2000 x 2000 cells
    given = {"indenter": vc.Sphere(0.01), "material": RUBBER, "load": vc.step(0.1)}
    sizes = {n: {**given, "grid": vc.Grid((n, n), (1.0, 1.0))} for n in (100, 2000)}
    monkeypatch.setattr(executor_choice, "LocalWorkers", pool)
    monkeypatch.setattr(many, "available_memory", lambda: free)
    with warnings.catch_warnings(record=True) as warned, pytest.raises(InterruptedError):
        vc.simulate_many([sizes[n] for n in (100, 2000, 100, 2000)], workers=4)
    assert asked == [at_once]
    said = f"about 2.15 GB of memory, {free / 1e9:.3g} GB are free; {at_once} at a time"
    assert [said in str(each.message) for each in warned] == [True] * (at_once < 4)


def test_number_of_workers_is_checked() -> None:
    with pytest.raises(ValueError, match="workers must be a whole number"):
        vc.simulate_many([], workers=0)


ORPHANS = """\
import sys
import time
import viscontact as vc

def wait():
    # One write: print writes the end of its line apart, between which another may write.
    sys.stdout.write("begun\\n")
    sys.stdout.flush()
    time.sleep(1000)

if __name__ == "__main__":
    vc.simulate_many([wait, wait], workers=2)
"""


@pytest.mark.skipif(os.name == "nt", reason="not tried there")
@pytest.mark.slow  # three processes that import everything
def test_simulations_whose_script_is_killed_end_with_it(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(ORPHANS, encoding="utf-8")
    with (tmp_path / "errors.txt").open("w+", encoding="utf-8") as errors:
        process = subprocess.Popen(
            [sys.executable, str(script)],
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            start_new_session=True,
        )
        assert process.stdout is not None
        begun = [process.stdout.readline() for _ in range(2)]
        process.kill()
        # Their output ends when the last of those that write to it has ended.
        try:
            rest, _ = process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            rest = "\n".join(ended_survivors(process.pid))
        errors.seek(0)
        assert (begun, rest) == (["begun\n"] * 2, ""), errors.read()


def ended_survivors(session: int) -> list[str]:
    """End the processes of a session; return what they were and where they waited."""
    found = []
    for each in psutil.process_iter():
        with suppress(psutil.Error, OSError):
            if os.getsid(each.pid) == session:
                place = Path(f"/proc/{each.pid}/wchan")
                channel = place.read_text(encoding="ascii") if place.exists() else "?"
                found.append(f"{each.pid} {each.status()} in {channel}: {each.cmdline()}")
                each.kill()
    return found


@pytest.mark.slow  # three processes that import everything
def test_python_example_of_the_page_prints_what_it_says(tmp_path: Path) -> None:
    script = tmp_path / "example.py"
    part = PAGE.partition("## From Python")[2]
    script.write_text(re.findall(r"```python\n(.*?)```", part, re.DOTALL)[0], encoding="utf-8")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True)
    assert (done.stdout, done.returncode) == ("4.0\n", 0), done.stderr
