"""Going on with a run at the command line: where it stopped, whether it may, and what is said."""

from __future__ import annotations

import dataclasses
import os
import shlex
import signal
import subprocess
import sys
import time as clock
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from ruamel.yaml import YAML

import viscontact as vc
from interrupted_runs import (
    CASE,
    WITH_ERRORS,
    Killed,
    at_instant,
    contents,
    folder,
    kill,
    same_bits,
    whole,
)
from viscontact.case.yaml_source import write
from viscontact.cli import main
from viscontact.cli.run import summary
from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.runs.directory import recorded, recorder
from viscontact.runs.directory.lock import locked
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.execution import checked_run
from viscontact.simulation.transient import frictionless

__all__ = ["folder", "whole"]  # fixtures


def test_resumed_run_ends_in_the_bits_of_an_uninterrupted_one(
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    printed = capsys.readouterr()
    assert printed.err.startswith("case: continuing after 4 of 7 instants, t = 1.5 s\n")
    assert "step 5/7" in printed.err
    # the summary is of all instants, those of the first process too
    assert "7 instants in" in printed.out
    assert f"{int(whole.iterations.sum())} iterations" in printed.out
    assert same_bits("case", whole)
    assert sorted(contents("case")) == ["case.yaml", "progress.jsonl", "result.nc"]


def test_resumed_periodic_run_ends_in_the_same_bits(folder: Path) -> None:
    """The sphere becomes one of a square array, which creeps over the border of its period."""
    text = WITH_ERRORS.replace("size: [3 mm, 3 mm]", "size: [0.9 mm, 0.9 mm], periodic: true")
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert at_once.pressure.values[-1, 0].any()
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


def test_resumed_run_on_a_body_that_ends_ends_in_the_same_bits(folder: Path) -> None:
    """The contact reaches the free end at -x, beside a sphere that is pressed off the middle."""
    ends = "poisson_ratio: 0.5\n  length: 4 mm\n  centre: 1.75 mm\n  ends: [free, null]\n"
    text = WITH_ERRORS.replace("poisson_ratio: 0.5\n", ends)
    text = text.replace("duration: 1 s}", "duration: 1 s, tilt_x: 0 deg}").replace("4 N", "2 N")
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert at_once.pressure.values[-1, 10].any()
    assert not at_once.pressure.values[-1, :10].any()
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


@pytest.mark.slow
def test_resumed_run_on_layers_ends_in_the_same_bits(folder: Path) -> None:
    """Two terms, each with its own internal variables: a cover that creeps on an elastic core."""
    data = YAML(typ="safe", pure=True).load(CASE)
    core = {"law": "elastic", "shear_modulus": "100 MPa", "poisson_ratio": 0.3}
    data["material"] = {"layers": [{"thickness": "0.3 mm", **data["material"]}], "base": core}
    (folder / "case.yaml").write_text(write(data), encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert at_once.attrs["splitting_error"] > 0
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


def test_resumed_moving_run_ends_in_the_same_bits(folder: Path) -> None:
    text = CASE.replace("size: [3 mm, 3 mm]", "size: [3 mm, 3 mm], centre: [0 mm, 0.3 mm]")
    moved = "motion: {kind: travel, points: [[0 s, 0 mm], [2 s, 0.6 mm]]}\n"
    text = text.replace("force: 4 N,", "force: 2 N, tilt_x: 0, tilt_y: 0,")
    (folder / "case.yaml").write_text(text + moved, encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with xr.open_dataset(folder / "at once" / "result.nc") as ds:
        at_once = ds.load()
    assert float(at_once.resistance_y[4]) > 0
    kill(4, "-q")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert same_bits("case", at_once)


def test_resume_starts_where_nothing_is_saved(
    folder: Path, whole: xr.Dataset, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml", "--resume"]) == 0
    first, *_ = capsys.readouterr().err.splitlines()
    assert first == "case: nothing is saved there yet; starting at the beginning"
    assert same_bits("case", whole)


def test_finished_run_is_not_run_again(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "case.yaml", "-q"]) == 0
    before = contents("case")
    assert main(["run", "case.yaml", "--resume"]) == 0
    said = capsys.readouterr()
    assert said.out + said.err == (
        "case: is finished already, up to t = 3 s; --overwrite computes it again\n"
    )
    assert contents("case") == before


def test_run_that_was_killed_as_it_finished_is_finished(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def die(directory: Path) -> None:
        raise Killed

    with monkeypatch.context() as patched:
        patched.setattr(recorder, "remove_restart_files", die)
        with pytest.raises(Killed):
            main(["run", "case.yaml", "-q"])
    assert "state.npz" in contents("case")
    assert main(["run", "case.yaml", "--resume"]) == 0
    assert sorted(contents("case")) == ["case.yaml", "progress.jsonl", "result.nc"]


@pytest.mark.parametrize("stopped_at", [3, None])
def test_changed_case_is_refused_with_the_difference_in_its_own_words(
    stopped_at: int | None,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    if stopped_at is None:
        assert main(["run", "case.yaml", "-q"]) == 0
    else:
        kill(stopped_at, "-q")
    before = contents("case")
    changed = CASE.replace("4 N", "5 N").replace("1 s}", "1000 ms}").replace("title: Z", "title: z")
    Path("case.yaml").write_text(changed, encoding="utf-8")
    assert main(["run", "case.yaml", "--resume", "--set", "grid.shape=[24, 26]"]) == 2
    first, *rest = capsys.readouterr().err.splitlines()
    assert first.startswith("case: holds a run of another case; replace it with --overwrite")
    # neither the title nor the duration, which only looks different
    assert rest == [
        "  load.force: was 4 N, is now 5 N",
        "  grid.shape[2]: was 24, is now 26",
    ]
    assert contents("case") == before


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("4 N", "4000 mN"),
        pytest.param("  # then held", "  # and held", marks=pytest.mark.slow),
        pytest.param("Zener sphere", "A sphere", marks=pytest.mark.slow),
    ],
)
def test_what_changes_no_number_is_no_change(
    old: str, new: str, folder: Path, whole: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    kill(3, "-q")
    Path("case.yaml").write_text(CASE.replace(old, new), encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)
    assert new in Path("case/case.yaml").read_text(encoding="utf-8")


def test_changed_table_is_refused_in_si_units(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    table = "time [s], force [N]\n0, 0\n1, 4\n"
    Path("load.csv").write_text(table, encoding="utf-8")
    load = ["--set", "load={kind: history, file: load.csv}"]
    kill(3, "-q", *load)
    Path("load.csv").write_text(table.replace("4", "6"), encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "--resume", *load]) == 2
    assert capsys.readouterr().err.splitlines()[1:] == ["  load.force[2]: was 4.0, is now 6.0"]
    assert Path("case/load.csv").read_text(encoding="utf-8") == table
    # the run's own case has its own table
    assert main(["run", "case/case.yaml", "-o", "case", "-q", "--resume"]) == 0


def test_run_continues_from_its_own_directory(
    folder: Path, whole: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    kill(3, "-q", "-o", "other", "--set", "title=Another")
    before = Path("other/case.yaml").read_bytes()
    assert main(["run", "other/case.yaml", "-o", "other", "-q", "--resume"]) == 0
    assert Path("other/case.yaml").read_bytes() == before
    assert same_bits("other", whole)


def test_resume_and_overwrite_exclude_each_other(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml", "--resume", "--overwrite"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not Path("case").exists()


def test_unfinished_result_is_replaced_only_when_asked(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    kill(3, "-q")
    before = contents("case")
    assert main(["run", "case.yaml", "-q"]) == 2
    message = capsys.readouterr().err
    assert "--resume" in message
    assert "--overwrite" in message
    assert len(message.splitlines()) == 1
    assert contents("case") == before
    assert main(["run", "case.yaml", "-q", "--overwrite", "--set", "load.force=3 N"]) == 0
    with vc.open_results("case") as ds:
        np.testing.assert_allclose(ds.force[-1], 3.0, rtol=1e-6)


def test_earlier_result_stays_until_the_new_run_has_its_first_instant(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["run", "case.yaml", "-q"]) == 0
    before = contents("case")

    def die(*arguments: Any, **options: Any) -> None:
        raise Killed

    heavier = ["--set", "load={kind: step, force: 5 N}", "-q"]
    with monkeypatch.context() as patched:
        patched.setattr("viscontact.simulation.transient.frictionless.solve_contact", die)
        with pytest.raises(Killed):
            main(["run", "case.yaml", "--overwrite", *heavier])
    assert contents("case") == before
    # and what comes to be there first is not gone on with as the earlier run
    with monkeypatch.context() as patched:
        patched.setattr(Recorder, "_write", die)
        with pytest.raises(Killed):
            main(["run", "case.yaml", "--overwrite", *heavier])
    assert contents("case")["result.nc"] == before["result.nc"]
    assert main(["run", "case.yaml", "--resume", *heavier]) == 0
    with vc.open_results("case") as ds:
        np.testing.assert_allclose(ds.force, 5.0, rtol=1e-6)


def test_result_without_its_state_is_not_lost(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    kill(3, "-q")
    Path("case/state.npz").unlink()
    before = contents("case")
    assert main(["run", "case.yaml", "-q", "--resume"]) == 2
    message = capsys.readouterr().err
    assert "state.npz is not there" in message
    assert "--overwrite" in message
    assert contents("case") == before


# --- signals ----------------------------------------------------------------------------------


def test_printed_command_continues_the_run(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    given = ["-o", "a b", "--set", "load.force=5 N", "--set", "title=it's", "--threads", "2"]
    undo = at_instant(3, lambda: signal.raise_signal(signal.SIGTERM))
    assert main(["run", "case.yaml", *given]) == 130
    undo()
    *_, kept, advice = capsys.readouterr().err.splitlines()
    assert kept == "a b keeps 3 of 7 instants"
    words = shlex.split(advice.removeprefix("continue with: "))
    assert words == ["viscontact", "run", "case.yaml", *given, "--resume"]
    assert main(words[1:]) == 0
    assert "continuing after 3 of 7 instants" in capsys.readouterr().err


@pytest.mark.parametrize(
    "name",
    ["SIGHUP", *(pytest.param(name, marks=pytest.mark.slow) for name in ("SIGINT", "SIGTERM"))],
)
def test_first_request_lets_the_step_be_finished_and_saved(
    name: str, folder: Path, whole: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    number = getattr(signal, name, None)
    if number is None:
        pytest.skip(f"no {name} on this system")
    undo = at_instant(4, lambda: signal.raise_signal(number))
    assert main(["run", "case.yaml", "-q"]) == 130
    undo()
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == 4
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


def test_signal_that_arrives_twice_from_a_batch_system_is_one_request(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def twice() -> None:
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGTERM)

    solve, solved = frictionless.solve_contact, []

    def solving(*arguments: Any, **options: Any) -> Any:
        solved.append(1)
        if len(solved) == 3:
            twice()
        return solve(*arguments, **options)

    monkeypatch.setattr(frictionless, "solve_contact", solving)
    assert main(["run", "case.yaml", "-q"]) == 130
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == len(solved) + 1  # the first instant has no contact to be solved


def test_second_request_within_a_step_stops_at_once(
    folder: Path, whole: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    solve, solved = frictionless.solve_contact, []

    def solving(*arguments: Any, **options: Any) -> Any:
        if len(solved) == 3:
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
        solved.append(1)
        return solve(*arguments, **options)

    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", solving)
        assert main(["run", "case.yaml", "-q"]) == 130
    assert len(solved) == 3  # the step in progress was not solved
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == 4  # the first instant has no contact to be solved
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


def test_second_request_within_a_checkpoint_waits_for_its_end(
    folder: Path, whole: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    save, whole_ones = recorder.save_checkpoint, []

    def saving(path: Path, checkpoint: Any, *check: Any) -> None:
        if len(whole_ones) == 4:
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
        save(path, checkpoint, *check)
        whole_ones.append(checkpoint.lines)

    with monkeypatch.context() as patched:
        patched.setattr(recorder, "PAUSE", 0.0)
        patched.setattr(recorder, "SHARE", 0.0)
        patched.setattr(recorder, "save_checkpoint", saving)
        assert main(["run", "case.yaml", "-q"]) == 130
    assert len(whole_ones) == 5
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


def test_request_before_the_first_step_changes_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def preparing(*arguments: Any) -> None:
        signal.raise_signal(signal.SIGTERM)

    monkeypatch.setattr(checked_run, "prepare", preparing)
    assert main(["run", "case.yaml"]) == 130
    assert (
        capsys.readouterr().err == "interrupted before the first step; nothing has been changed\n"
    )
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_request_while_the_run_is_opened_leaves_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opening = recorded.ResultWriter

    def asked(*arguments: Any) -> Any:
        writer = opening(*arguments)
        signal.raise_signal(signal.SIGINT)
        return writer

    monkeypatch.setattr(recorded, "ResultWriter", asked)
    assert main(["run", "case.yaml"]) == 130
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_fault_that_comes_while_a_request_waits_is_reported(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    save, saved = recorder.save_checkpoint, []

    def failing(path: Path, checkpoint: Any, *check: Any) -> None:
        if len(saved) == 4:
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
            raise OSError("no room")
        save(path, checkpoint, *check)
        saved.append(checkpoint.lines)

    monkeypatch.setattr(recorder, "PAUSE", 0.0)
    monkeypatch.setattr(recorder, "SHARE", 0.0)
    monkeypatch.setattr(recorder, "save_checkpoint", failing)
    assert main(["run", "case.yaml", "-q"]) == 1
    assert "case: the run stopped: no room" in capsys.readouterr().err


@pytest.mark.parametrize("time", ["inner", pytest.param("asked", marks=pytest.mark.slow)])
def test_step_that_fails_is_not_gone_on_from_though_a_stop_is_asked_for_in_it(
    time: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # A kink of the load at 1.2 s makes a step that was not requested.
    load = "load={kind: history, points: [[0 s, 0 N], [1.2 s, 4 N], [5 s, 4 N]]}"
    command = ["run", "case.yaml", "-q", "--set", load]
    solve, solved = frictionless.solve_contact, []

    def failing(*arguments: Any, **options: Any) -> Any:
        solved.append(1)
        solution = solve(*arguments, **options)
        if len(solved) < (3 if time == "inner" else 4):
            return solution
        signal.raise_signal(signal.SIGTERM)
        return dataclasses.replace(solution, converged=False)

    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", failing)
        assert main(command) == 1
    assert "short of the tolerance" in capsys.readouterr().err
    assert main([*command, "--resume"]) == 0
    assert main([*command, "-o", "whole"]) == 0
    with xr.open_dataset("whole/result.nc") as ds:
        assert same_bits("case", ds)


def test_terminal_that_is_ignored_stays_ignored() -> None:
    if not hasattr(signal, "SIGHUP"):
        pytest.skip("no SIGHUP on this system")
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup leaves it
    try:
        with watched_interruption() as interruption, interruption.marching():
            signal.raise_signal(signal.SIGHUP)
            assert not interruption.requested
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.slow
def test_real_process_is_stopped_and_resumed(folder: Path) -> None:
    # more than a thousand steps, so that there is time to stop it
    command = [sys.executable, "-m", "viscontact", "run", "case.yaml", "--set", "time.steps=1200"]
    run = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    progress = Path("case/progress.jsonl")
    while not (progress.exists() and progress.read_text(encoding="utf-8").count("\n") > 3):
        assert run.poll() is None
        clock.sleep(0.01)
    # meanwhile no other process may write there
    other = subprocess.run([*command, "--resume"], capture_output=True, text=True)
    assert other.returncode == 2
    assert "in use by another run" in other.stderr
    assert len(other.stderr.splitlines()) == 1
    run.send_signal(signal.SIGTERM)
    _, said = run.communicate(timeout=60)
    assert run.returncode == 130
    kept = int(said.split("case keeps ")[1].split(" of 1201 instants")[0])
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == kept == len(progress.read_text(encoding="utf-8").splitlines())


def test_directory_in_use_is_refused_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("case").mkdir()
    with locked(Path("case")):
        assert main(["run", "case.yaml"]) == 2
    message = capsys.readouterr().err
    assert "in use by another run" in message
    assert len(message.splitlines()) == 1
    assert not contents("case")
    # the file that is locked does not make a directory look like a run's
    Path("case/.lock").write_text("", encoding="utf-8")
    assert main(["run", "case.yaml", "-q"]) == 0


def test_run_whose_terminal_is_closed_stops_in_order(folder: Path) -> None:
    pty = pytest.importorskip("pty", reason="no pseudo-terminals of this kind on Windows")
    command = [sys.executable, "-m", "viscontact", "run", "case.yaml", "--set", "time.steps=1200"]
    child, terminal = pty.fork()
    if not child:
        os.execv(sys.executable, command)
    progress = Path("case/progress.jsonl")
    shown = b""
    while not (progress.exists() and progress.read_text(encoding="utf-8").count("\n") > 3):
        shown += os.read(terminal, 4096)  # else the terminal is full, and the run waits
    os.close(terminal)
    _, status = os.waitpid(child, 0)
    assert b"step" in shown
    assert os.waitstatus_to_exitcode(status) == 130
    with vc.open_results("case") as ds:
        assert 3 < ds.sizes["time"] == len(progress.read_text(encoding="utf-8").splitlines()) < 1001


def test_show_and_plot_report_a_run_that_can_be_continued(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "case.yaml").write_text(WITH_ERRORS, encoding="utf-8")
    undo = at_instant(4, lambda: signal.raise_signal(signal.SIGTERM))
    assert main(["run", "case.yaml", "-q", "-o", "a b"]) == 130
    undo()
    capsys.readouterr()
    for words in (["show", "a b"], ["plot", "a b/result.nc", "history"]):
        assert main(words) == 0
        printed = capsys.readouterr()
        said = "the run stopped at 4 of 7 instants; continue with: "
        [line] = [line for line in (printed.out + printed.err).splitlines() if said in line]
    command = shlex.split(line.removeprefix(said))
    with locked(Path("a b")):
        assert main(["show", "a b"]) == 0
        summary = capsys.readouterr().out
        assert "the run is still active, at 4 of 7 instants" in summary
        assert "errors: not known yet; they are estimated once the run is over" in summary
        assert "largest error" not in summary
    assert main(command[1:]) == 0
    assert main(["show", "a b"]) == 0
    summary = capsys.readouterr().out
    assert "the run stopped" not in summary
    assert "the run is still" not in summary


#: A process in which signals come while something is imported, or at its very end.
ASKED = """\
import atexit, signal, sys
class Asking:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            for _ in range({times}):
                signal.raise_signal(signal.{name})
sys.meta_path.insert(0, Asking())
if {module!r} == "exit":
    atexit.register(signal.raise_signal, signal.{name})
sys.argv = ["viscontact", "run", "case.yaml", "-q"]
from viscontact.cli import main
sys.exit(main())
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
@pytest.mark.parametrize(
    ("name", "module"),
    [
        ("SIGINT", "viscontact.cli.plain_words"),
        pytest.param("SIGTERM", "numpy", marks=pytest.mark.slow),
        ("SIGHUP", "exit"),
        *(
            pytest.param(name, module, marks=pytest.mark.slow)
            for module, names in {
                "viscontact.cli.plain_words": ("SIGTERM", "SIGHUP"),
                "numpy": ("SIGINT", "SIGHUP"),
                "exit": ("SIGINT", "SIGTERM"),
            }.items()
            for name in names
        ),
    ],
)
def test_request_during_imports_or_after_the_end_is_met_in_order(
    name: str, module: str, folder: Path
) -> None:
    code = ASKED.format(name=name, module=module, times=2)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    if module == "exit":
        assert (done.returncode, done.stderr) == (0, "")
        assert Path("case/result.nc").exists()
    else:
        assert (done.returncode, done.stderr) == (130, "interrupted\n")
        assert not Path("case").exists()


def test_case_in_the_directory_of_its_run_continues_there(folder: Path, whole: xr.Dataset) -> None:
    kill(4, "-q", "-o", "runs/one")
    assert main(["run", "runs/one/case.yaml", "--resume", "-q"]) == 0
    assert same_bits("runs/one", whole)
    assert not Path("runs/one/case").exists()


def test_command_to_resume_names_files_that_look_like_options(
    folder: Path, whole: xr.Dataset, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("case.yaml").rename("-e.yaml")
    undo = at_instant(4, lambda: signal.raise_signal(signal.SIGTERM))
    assert main(["run", "-q", "--", "-e.yaml"]) == 130
    undo()
    *_, last = capsys.readouterr().err.splitlines()
    assert main(shlex.split(last.removeprefix("continue with: "))[1:]) == 0
    assert same_bits("./-e", whole)


@pytest.mark.skipif(os.name == "nt", reason="Windows removes no directory in use")
def test_directory_that_is_gone_is_not_said_to_keep_anything(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def moved_and_stopped() -> None:
        Path("case").rename("elsewhere")
        signal.raise_signal(signal.SIGTERM)

    undo = at_instant(4, moved_and_stopped)
    assert main(["run", "case.yaml", "-q"]) in (1, 130)
    undo()
    said = capsys.readouterr().err
    assert "case no longer exists" in said
    assert "keeps" not in said
    assert "--resume" not in said


def test_request_after_the_last_instant_is_saved_changes_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shown = summary.print_summary

    def asked(directory: Path) -> None:
        signal.raise_signal(signal.SIGTERM)
        shown(directory)

    monkeypatch.setattr(summary, "print_summary", asked)
    assert main(["run", "case.yaml"]) == 0
    assert "7 instants in" in capsys.readouterr().out
