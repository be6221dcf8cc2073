"""Requests to stop a run: within a step, a checkpoint, before the first step and after the last."""

from __future__ import annotations

import dataclasses
import shlex
import signal
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import viscontact as vc
from interrupted_runs import at_instant, folder, same_bits, whole
from viscontact.cli import main
from viscontact.cli.run import summary
from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.runs.directory import recorded, recorder
from viscontact.runs.execution import checked_run
from viscontact.simulation.transient import frictionless

__all__ = ["folder", "whole"]  # fixtures


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
