"""Runs at the command line: their result, what they replace, and what stops them."""

from __future__ import annotations

import json
import time as clock
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from cli.sphere_runs import SPHERE, Terminal, folder
from viscontact.backend.errors import ConvergenceError
from viscontact.cli import main
from viscontact.cli.results import figures
from viscontact.cli.terminal import progress
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.simulation.transient import frictionless

__all__ = ["folder"]  # a fixture


@pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning")
def test_run_writes_a_result_that_is_the_simulation(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml"]) == 0
    kept = sorted(path.name for path in Path("case").iterdir())
    assert kept == ["case.yaml", "progress.jsonl", "result.nc"]
    assert Path("case/case.yaml").read_text(encoding="utf-8") == SPHERE
    material = vc.Material(vc.Zener(10e6, 10e6, 10e6), 0.5)
    grid, times = vc.Grid((32, 32), (3e-3, 3e-3)), vc.uniform_times(5.0, 6)
    expected = vc.simulate(vc.Sphere(0.01), material, vc.step(4.0), grid, times)
    with vc.open_results("case") as ds:
        np.testing.assert_array_equal(ds.time, times)
        # the same numbers: both march the same problem on one thread
        np.testing.assert_array_equal(ds.approach, expected.approach)
        np.testing.assert_array_equal(ds.pressure[-1], expected.pressure[-1].astype("f4"))
        assert ds.attrs["title"] == "Zener sphere"
        assert json.loads(ds.attrs["case"])["indenter"]["type"] == "Sphere"
    printed = capsys.readouterr()
    assert "peak pressure [MPa]" in printed.out
    assert "step 7/7" in printed.err  # plain lines: no terminal here
    assert "\x1b" not in printed.err + printed.out


def test_settings_change_the_run_and_are_kept_with_it(folder: Path) -> None:
    settings = ["--set", "load.force=2N", "--set", "output.fields=[0 s, 5 s]"]
    assert main(["run", "case.yaml", "-o", "other dir", "-q", *settings]) == 0
    assert "force: 2N" in Path("other dir/case.yaml").read_text(encoding="utf-8")
    with vc.open_results("other dir") as ds:
        # balanced to the case's default tolerance
        np.testing.assert_allclose(ds.force, 2.0, rtol=1e-6)
        assert ds.field_time.values.tolist() == [0.0, 5.0]


def test_result_is_replaced_only_when_asked(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml", "-q"]) == 0
    before = Path("case/result.nc").read_bytes()
    assert main(["run", "case.yaml", "-q", "--set", "load.force=3 N"]) == 2
    message = capsys.readouterr().err
    assert "--resume" in message
    assert "--overwrite" in message
    assert Path("case/result.nc").read_bytes() == before
    assert main(["run", "case.yaml", "-q", "--overwrite", "--set", "load.force=3 N"]) == 0
    with vc.open_results("case") as ds:
        np.testing.assert_allclose(ds.force, 3.0, rtol=1e-6)


def test_run_does_not_write_over_the_users_own_files(folder: Path) -> None:
    assert main(["run", "case.yaml", "-o", ".", "--set", "load.force=3 N"]) == 2
    assert main(["run", "case.yaml", "-o", ".", "--overwrite"]) == 2
    assert Path("case.yaml").read_text(encoding="utf-8") == SPHERE
    Path("notes").mkdir()
    Path("notes/case.yaml").write_text("mine", encoding="utf-8")
    assert main(["run", "case.yaml", "-o", "notes"]) == 2
    assert Path("notes/case.yaml").read_text(encoding="utf-8") == "mine"
    assert main(["run", "case.yaml", "-o", "case.yaml"]) == 2
    assert [path.name for path in sorted(folder.iterdir())] == ["case.yaml", "notes"]


def test_contact_that_overruns_the_grid_stops_the_run_and_keeps_its_steps(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # 0.91 mm at the start fit into half of 2.1 mm, 1.14 mm at the end do not.
    assert main(["run", "case.yaml", "-q", "--set", "grid.size=[2.1 mm, 2.1 mm]"]) == 1
    message = capsys.readouterr().err
    assert "case.yaml" in message or "--set grid" in message
    assert "edge of the grid" in message
    assert "keeps" in message
    with vc.open_results("case") as ds:
        assert 1 <= ds.sizes["time"] < 7
        assert np.isfinite(ds.pressure).all()


def test_run_without_contact_is_a_result(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    load = "load={kind: triangle, force: 4 N, rise: 1 s}"
    assert main(["run", "case.yaml", "--set", load]) == 0
    assert capsys.readouterr().err.splitlines()[0].endswith("0 iterations, no contact")
    with vc.open_results("case") as ds:
        assert ds.contact_area[0] == 0.0
        assert ds.outcome[0] == vc.Outcome.NO_CONTACT


def test_run_without_grid_chooses_one(folder: Path) -> None:
    Path("case.yaml").write_text(SPHERE[: SPHERE.index("grid:")], encoding="utf-8")
    assert main(["run", "case.yaml", "-q"]) == 0
    with vc.open_results("case") as ds:
        assert ds.cells_across.max() >= 20


def test_bar_follows_a_total_that_changes(monkeypatch: pytest.MonkeyPatch) -> None:
    material = vc.Material(vc.Elastic(1e6), 0.5)
    grid = vc.Grid((32, 32), (2.4e-3, 2.4e-3))
    [state] = vc.march(vc.Sphere(0.01), material, vc.step(0.1), grid, [0.0])
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    with progress.shown_progress(None, quiet=False) as report:
        for done, total in ((1, 40), (2, 30), (3, 3)):
            report(state, done, total)
            clock.sleep(0.15)  # the bar is drawn ten times a second
    written = terminal.getvalue()
    for shown in ("1/40", "2/30", "3/3"):
        assert shown in written


def test_full_disk_stops_the_run_in_one_message(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(*arguments: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(ProgressLog, "append", full)
    assert main(["run", "case.yaml", "-q"]) == 1
    first, *rest = capsys.readouterr().err.splitlines()
    assert "No space left on device" in first
    # not even the first step could be kept: the same command again is all there is to do
    assert rest == [
        "case keeps nothing yet: no instant was finished",
        "after correcting that: viscontact run case.yaml --quiet",
    ]


def test_run_without_a_single_instant_does_not_block_its_directory(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def hopeless(*arguments: Any, **options: Any) -> None:
        raise ConvergenceError("no equilibrium")

    Path("mine").mkdir()
    Path("mine/notes.txt").write_text("keep", encoding="utf-8")
    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", hopeless)
        assert main(["run", "case.yaml", "-q", "-o", "mine"]) == 1
        assert "mine keeps nothing yet: no instant was finished" in capsys.readouterr().err
    assert main(["run", "case.yaml", "-q", "-o", "mine"]) == 0
    assert Path("mine/notes.txt").read_text(encoding="utf-8") == "keep"
    assert main(["run", "case.yaml", "-q", "-o", "mine"]) == 2


def test_fault_of_ours_is_a_line_and_not_a_traceback(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def faulty(*arguments: Any, **options: Any) -> None:
        raise ZeroDivisionError("so it goes")

    monkeypatch.setattr(frictionless, "solve_contact", faulty)
    assert main(["run", "case.yaml", "-q"]) == 1
    message = capsys.readouterr().err
    assert "unexpected ZeroDivisionError: so it goes" in message
    assert "Traceback" not in message


@pytest.mark.slow
def test_load_file_travels_with_the_run(folder: Path) -> None:
    Path("tables").mkdir()
    Path("tables/load.csv").write_text("time [s], force [N]\n0, 4\n", encoding="utf-8")
    load = "load={kind: history, file: tables/load.csv}"
    assert main(["run", "case.yaml", "-q", "-o", "first", "--set", load]) == 0
    # the run's own case runs again from where it lies
    assert main(["run", "first/case.yaml", "-q", "-o", "second"]) == 0
    with vc.open_results("first") as first, vc.open_results("second") as second:
        np.testing.assert_array_equal(first.approach, second.approach)


def test_two_runs_of_one_name_are_distinguished() -> None:
    same = [Path("a/case"), Path("b/case")]
    assert figures._labels(same) == [str(path) for path in same]
    assert figures._labels([Path("a"), Path("b")]) == ["a", "b"]
