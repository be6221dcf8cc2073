"""Going on with a run at the command line: whether it may, and what is said."""

from __future__ import annotations

import os
import shlex
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

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
from viscontact.cli import main
from viscontact.runs.directory import recorder
from viscontact.runs.directory.lock import locked
from viscontact.runs.directory.recorder import Recorder

__all__ = ["folder", "whole"]  # fixtures


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
