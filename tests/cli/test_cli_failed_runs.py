"""Runs that fail, or whose clock or directory changes: what is said, and what remains."""

from __future__ import annotations

import shutil
import time as clock
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import viscontact as vc
from cli.stopped_runs import said_in_lines, stopped, stopped_once
from interrupted_runs import folder, same_bits, whole
from viscontact.cli import main
from viscontact.simulation.transient import frictionless

__all__ = ["folder", "stopped", "stopped_once", "whole"]  # fixtures


def test_contact_at_the_rim_advises_no_resumption(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    small = ["--set", "grid.size=[2.1 mm, 2.1 mm]", "-q"]
    assert main(["run", "case.yaml", *small]) == 1
    why, kept, remedy = said_in_lines(capsys)
    assert "enlarge grid.size" in why
    number = int(kept.removeprefix("case keeps ").split()[0])
    assert remedy == "with that changed, run it again with --overwrite"
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == number > 1
    # who tries all the same gets the same
    assert main(["run", "case.yaml", *small, "--resume"]) == 1
    assert said_in_lines(capsys) == [why, kept, remedy]


def test_failed_step_stands_at_the_end_of_the_result(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    solve = frictionless.solve_contact

    def failing(problem: Any, *arguments: Any, **options: Any) -> Any:
        solution = solve(problem, *arguments, **options)
        failing.count = getattr(failing, "count", 0) + 1
        done = failing.count < 4
        return solution if done else type(solution)(**{**vars(solution), "converged": False})

    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", failing)
        assert main(["run", "case.yaml", "-q"]) == 1
    why, kept, remedy = said_in_lines(capsys)
    assert "short of the tolerance" in why
    assert kept == "case keeps 4 of 7 instants"
    assert "--resume" not in remedy
    with vc.open_results("case") as ds:
        assert ds.outcome.values.tolist()[-2:] == [vc.Outcome.CONVERGED, vc.Outcome.NOT_CONVERGED]
        assert ds.sizes["time"] == 5


def test_memory_that_runs_out_stops_the_run_in_one_message(
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    solve, count = frictionless.solve_contact, 0

    def solving(*arguments: Any, **options: Any) -> Any:
        nonlocal count
        count += 1
        if count == 4:
            raise MemoryError
        return solve(*arguments, **options)

    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", solving)
        assert main(["run", "case.yaml", "-q"]) == 1
    assert said_in_lines(capsys)[0] == "case: the run stopped: MemoryError"
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


def test_clock_that_is_set_back_makes_no_duration_negative(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    shown = iter(range(2 * 10**9, 0, -3600))
    with monkeypatch.context() as patched:
        patched.setattr(clock, "time", lambda: float(next(shown)))
        assert main(["run", "case.yaml"]) == 0
    with vc.open_results("case") as ds:
        assert 0 < ds.attrs["wall_time"] < 60
    times_left = [line.split("about")[1] for line in said_in_lines(capsys) if "about" in line]
    assert times_left
    assert "-" not in "".join(times_left)


def test_moved_directory_continues_where_it_is(
    stopped: Path,
    whole: xr.Dataset,
) -> None:
    shutil.move(stopped, "elsewhere")
    assert main(["run", "case.yaml", "-o", "elsewhere", "-q", "--resume"]) == 0
    assert same_bits("elsewhere", whole)
