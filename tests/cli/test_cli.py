"""The command line end to end: exit codes, messages, files, and nothing left behind."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.backend.errors import ConvergenceError
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.cli.results import figures
from viscontact.cli.run import execution
from viscontact.cli.terminal import progress
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress
from viscontact.mechanics.problem.problem import Problem
from viscontact.results.formatting import format_percent
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.preparation import prepared
from viscontact.runs.processes.request import RunRequest
from viscontact.simulation.transient import frictionless
from viscontact.units.formatting import format_quantity

SPHERE = """\
title: Zener sphere
indenter:
  shape: sphere
  radius: 10 mm
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load:
  kind: step
  force: 4 N
time:
  end: 5 s
  steps: 6
grid:
  shape: [32, 32]
  size: [3 mm, 3 mm]
output:
  errors: false
"""
ERRORS = ["--set", "output.errors=true"]
COMMANDS = (
    *("run", "check", "show", "export", "plot", "compare", "schema", "example", "demo"),
    *("fit", "material", "report", "verify", "doctor", "cite"),
)


class Terminal(io.StringIO):
    """What is written to a terminal."""

    def isatty(self) -> bool:
        """Yes."""
        return True


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory whose name has a space, with a case in it."""
    here = tmp_path / "my runs"
    here.mkdir()
    (here / "case.yaml").write_text(SPHERE, encoding="utf-8")
    monkeypatch.chdir(here)
    return here


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of a finished run."""
    here = tmp_path_factory.mktemp("finished")
    (here / "case.yaml").write_text(SPHERE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q", *ERRORS]) == 0
    return here / "case"


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


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["indenter.raduis=5 mm"], "indenter.raduis: unknown key; did you mean 'radius'?"),
        (["indenter.radius=5"], "indenter.radius: 5 has no unit"),
        (["load.force=10 MPa"], "load.force: cannot read '10 MPa' as a force"),
        (["indenter.radius=-5 mm"], "indenter.radius: must be more than zero"),
        (["load.eccentricity_x=20 mm"], "load.eccentricity_x: the force acts at 20 mm"),
        (["load.force=-1 N"], "load.force: must be zero or more"),
        (["load.force=nan N"], "load.force: 'nan N' is not a finite number"),
        (["material.viscosity=0 Pa s"], "material.viscosity: must be more than zero"),
        (["time.steps=0"], "time.steps: must be greater than or equal to 1"),
        (["time.steps=1.5"], "time.steps: must be a whole number"),
        (["grid.shape=[1000000, 1000000]"], "grid.shape: 1000000 x 1000000 cells need about"),
        (
            [
                "material={law: creep-series, instant: 0 / MPa, amplitudes: [1 / MPa], "
                "times: [1 s], data: deviatoric, poisson_ratio: 0.5}"
            ],
            "load: the load jumps at t = 0 s",
        ),
        (["load.approach=1 mm"], "load.force: force and approach exclude each other"),
        (["grid.size=[1 nm, 1 nm]", "output.fields=[9 s]"], "output.fields: the instant 9 s"),
    ],
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_bad_case_is_refused_and_nothing_is_created(
    command: str,
    settings: list[str],
    said: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    options = [word for setting in settings for word in ("--set", setting)]
    assert main([command, "case.yaml", *options]) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert len(printed.err.splitlines()) == 1
    assert printed.out == ""
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n\x00\xff", b"load: [1", b"- 1\n"])
def test_broken_file_is_refused_and_nothing_is_created(
    content: bytes, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("case.yaml").write_bytes(content)
    assert main(["run", "case.yaml"]) == 2
    message = capsys.readouterr().err
    assert message.startswith("case.yaml:")
    assert len(message.splitlines()) == 1
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_line_of_the_file_stands_in_front(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("case.yaml").write_text(SPHERE.replace("4 N", "10 MPa"), encoding="utf-8")
    assert main(["run", "case.yaml"]) == 2
    assert capsys.readouterr().err == (
        "case.yaml:13: load.force: cannot read '10 MPa' as a force (got a pressure); "
        "write e.g. '10 kN'\n"
    )


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


def _in_third_step(monkeypatch: pytest.MonkeyPatch, act: Callable[[], None]) -> None:
    """Do something while the third step of a run is being solved."""
    solve, solved = frictionless.solve_contact, []

    def solving(*arguments: Any, **options: Any) -> Any:
        solved.append(1)
        if len(solved) == 3:
            act()
        return solve(*arguments, **options)

    monkeypatch.setattr(frictionless, "solve_contact", solving)


def _presses(times: int) -> None:
    for _ in range(times):
        signal.raise_signal(signal.SIGINT)


def _at_instant(
    monkeypatch: pytest.MonkeyPatch, wanted: Callable[[vc.ContactState, int], bool]
) -> None:
    """Press Ctrl-C when an instant is being reported."""

    @contextmanager
    def shown(*arguments: Any, **options: Any) -> Iterator[Any]:
        def report(state: vc.ContactState, done: int, total: int) -> None:
            if wanted(state, done):
                _presses(1)

        yield report

    monkeypatch.setattr(execution, "shown_progress", shown)


@pytest.mark.parametrize(("presses", "kept"), [(1, 3), (2, 2)])
def test_interruption_keeps_the_completed_steps(
    presses: int,
    kept: int,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # Once during the third step: it is finished. Twice: it is given up.
    _in_third_step(monkeypatch, lambda: _presses(presses))
    handler = signal.getsignal(signal.SIGINT)
    assert main(["run", "case.yaml", "-q"]) == 130
    assert signal.getsignal(signal.SIGINT) is handler
    message = capsys.readouterr().err
    assert f"keeps {kept} of 7 instants" in message
    assert "--resume" in message
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == kept
    assert main(["show", "case"]) == 0
    assert f"the run stopped at {kept} of 7 instants" in capsys.readouterr().out
    assert main(["plot", "case", "history"]) == 0
    assert f"the run stopped at {kept} of 7 instants" in capsys.readouterr().err


ADAPTIVE = ["--set", "time={end: 5 s, spacing: adaptive, tolerance: 0.01}"]


def test_adaptive_run_keeps_every_step_and_goes_to_the_end(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = ["--set", "output.fields=[1 s, 5 s]"]
    assert main(["run", "case.yaml", *ADAPTIVE, *kept, *ERRORS]) == 0
    printed = capsys.readouterr()
    lines = printed.err.splitlines()
    # totals are estimates until the end
    assert lines[0].startswith("step 1 of about ")
    with vc.open_results("case") as ds:
        count = ds.sizes["time"]
        assert lines[-2].startswith(f"step {count}/{count}, ")
        assert lines[-1].startswith("estimating errors")
        assert ds.field_time.values.tolist() == [1.0, 5.0]
        assert ds.time[-1] == 5.0
        assert 5 < count < 60
        largest = float(ds.time_error.max())
    assert 0 < largest <= 0.01
    sentence = f"error due to the time steps: at most {format_percent(largest)} of the pressure"
    assert sentence in printed.out
    assert main(["show", "case"]) == 0
    shown = capsys.readouterr().out
    assert sentence in shown
    assert "stopped" not in shown
    assert (
        main(["run", "case.yaml", "-q", "-o", "all", *ADAPTIVE, "--set", "output.fields=all"]) == 0
    )
    with vc.open_results("all") as ds:
        assert ds.pressure.dims[0] == "time"


def test_interrupted_adaptive_run_says_how_far_it_came_in_time(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _at_instant(monkeypatch, lambda state, done: done == 3)
    # more steps are done by then than instants were asked for
    kept = ["--set", "output.fields=[0 s, 5 s]"]
    assert main(["run", "case.yaml", "-q", *ADAPTIVE, *kept]) == 130
    message = capsys.readouterr().err
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == 3
        reached = f"3 instants, up to t = {format_quantity(float(ds.time[-1]), 's')} of 5 s"
    assert f"case keeps {reached}" in message
    assert main(["show", "case"]) == 0
    assert f"the run stopped at {reached}" in capsys.readouterr().out


def test_interruption_in_the_last_step_of_an_adaptive_run_is_too_late(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _at_instant(monkeypatch, lambda state, done: state.time == 5.0)
    # Nothing comes after the last step where errors are not estimated.
    assert main(["run", "case.yaml", "-q", *ADAPTIVE]) == 0


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


def test_check_predicts_grid_steps_memory_time_and_contact(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml"]) == 0
    printed = capsys.readouterr().out
    for expected in ("32 x 32 cells on 3 mm x 3 mm", "6, up to t = 5 s", "GB free", "run time"):
        assert expected in printed
    # Hertz with Phi(5 s): a^3 = 3 R W Phi / 8 (eq. 16 of Spinu & Cerlinca 2018), a = 1.143 mm,
    # peak pressure 3 W / (2 pi a^2) = 1.46 MPa; the estimate is good to a few per cent.
    assert "2.28 mm long, 2.28 mm wide" in printed
    assert "1.46 MPa" in printed
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


@pytest.mark.parametrize(
    ("load", "when"),
    [
        ("{kind: step, force: 4 N}", "at the largest load\n"),
        ("{kind: ramp, force: 4 N, duration: 1 s}", "at the largest load (t = 1 s to 5 s);\n"),
        pytest.param(
            "{kind: harmonic, mean: 3 N, amplitude: 1 N, period: 2 s, cycles: 2}",
            "at the largest load (first at t = 500 ms);\n",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_check_says_when_the_error_of_an_automatic_grid_is_so_small(
    folder: Path, capsys: pytest.CaptureFixture[str], load: str, when: str
) -> None:
    settings = ["--set", f"load={load}", "--set", "grid={tolerance: 5 %}"]
    assert main(["check", "case.yaml", *settings]) == 0
    printed = capsys.readouterr().out
    # Of all three quantities, in one line: no number is torn from its unit.
    assert re.search(r"grid error .*pressure [\d.]+ %, .*area [\d.]+ %, approach [\d.]+ %", printed)
    assert when in re.sub(r" +\n", "\n", printed)
    assert ("more at smaller loads" in printed) == ("step" not in load)
    assert max(len(line.rstrip()) for line in printed.splitlines()) <= 80


def test_check_predicts_an_approach_and_adaptive_steps(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    load = ["--set", "load={kind: ramp, approach: 100 um, duration: 1 s}"]
    assert main(["check", "case.yaml", *ADAPTIVE, *load]) == 0
    printed = capsys.readouterr().out
    assert "as needed for an error of 1 %, up to t = 5 s" in printed
    assert "largest approach, before any creep" in printed
    # Hertz, E* = 4 G: F = (4/3) E* sqrt(R) delta^(3/2) = 5.33 N, a = sqrt(R delta) = 1 mm,
    # p = (2/pi) E* sqrt(delta/R) = 2.55 MPa; the estimate is good to a few per cent.
    found = dict(re.findall(r"(force|peak pressure|contact) +([\d.]+)", printed))
    assert float(found["force"]) == close_to(5.33, rel=0.03)
    assert float(found["peak pressure"]) == close_to(2.55, rel=0.03)
    assert float(found["contact"]) == close_to(2.0, rel=0.03)
    assert "approach   " not in printed


def test_forecast_counts_the_steps_within_swings_and_at_kinks() -> None:
    material, times = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5), [0.0, 10.0]
    grid = vc.Grid((32, 32), (3e-3, 3e-3))

    def steps(load: vc.LoadHistory, times: Any = times) -> float:
        return Problem(vc.Sphere(0.01), material, load, grid, times).step_count

    assert steps(vc.step(0.1)) == 2
    assert steps(vc.triangle(0.1, 1.0)) == 4
    assert steps(vc.harmonic(0.1, 0.05, 1.0, cycles=10)) == 1281
    adaptive = [vc.adaptive_times(10.0, tolerance=tolerance) for tolerance in (1e-3, 1e-4)]
    rough, fine = (steps(vc.step(0.1), each) for each in adaptive)
    assert rough < fine < 3 * rough
    for wanted, guess in zip(adaptive, (rough, fine), strict=True):
        taken = len(list(vc.march(vc.Sphere(0.01), material, vc.step(0.1), grid, wanted)))
        assert guess / 2.5 < taken < guess * 2.5


def test_check_warns_of_a_grid_that_the_contact_will_overrun(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml", "--set", "grid.size=[2.1 mm, 2.1 mm]"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("case.yaml: can be read, but:\n")
    assert "will probably overrun the grid" in printed
    assert main(["check", "case.yaml", "--set", "grid.size=[30 mm, 30 mm]"]) == 0
    assert "fewer than 10 cells across" in capsys.readouterr().out


@pytest.mark.slow
def test_contact_far_from_the_origin_is_checked_and_run_on_a_grid_around_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, _, _ = SPHERE.partition("grid:")
    (folder / "far.yaml").write_text(f"{text}grid: {{tolerance: 20 %}}\n", encoding="utf-8")
    far = ["--set", "indenter.offset_x=8 mm", "--set", "load.force=1 uN"]
    level = ["--set", "load.tilt_x=0 rad", "--set", "load.tilt_y=0 rad"]
    assert main(["check", "far.yaml", *far, *level]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "around x = 8 mm, y = 0 m (automatic)" in printed
    (expected,) = re.findall(r"cells in it \d+ along, (\d+) across", printed)
    quick = ["--set", "time.steps=1", "--set", "output.errors=false"]
    assert main(["run", "far.yaml", *far, *level, *quick, "-q"]) == 0
    ds = vc.open_results("far/result.nc")
    assert float(ds.x.mean()) == close_to(8e-3, rel=1e-6)
    assert int(ds.cells_across.max()) == close_to(int(expected), rel=0.1)
    assert ds.eccentricity_x.values[ds.force > 0] == close_to(8e-3, rel=1e-4)


def test_check_warns_of_a_contact_too_large_for_small_strains(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # Hertz with Phi(5 s): a = 1.143 mm of a radius of 10 mm at 4 N, and a grows with W^(1/3):
    # 4.0 mm at 172 N, of which a sphere's circular section takes 2%. The approach is a^2/R.
    heavy = ["--set", "load.force=172 N", "--set", "grid.size=[12 mm, 12 mm]"]
    assert main(["check", "case.yaml"]) == 0
    assert capsys.readouterr().out.startswith("case.yaml: no problems found\n")
    assert main(["check", "case.yaml", *heavy]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert printed.startswith("case.yaml: can be read, but: warning: ")
    assert "half width will be about 0.39 of the indenter's radius" in printed
    assert "approach will be about 0.1" in printed


def test_a_warning_that_names_its_instant_is_printed_without_it_in_front(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "creep.csv").write_text("time [s], D [1/GPa]\n1, 2\n10, 3\n", encoding="utf-8")
    table = "material={law: table, file: creep.csv, poisson_ratio: 0.4, warning: the data scatter}"
    wide = ["--set", "load.force=2 kN", "--set", "grid.size=[8 mm, 8 mm]"]
    assert main(["run", "case.yaml", "--set", table, *wide]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "warning: at t = 0 s 100% of the load has come within less than 1 s" in printed
    assert re.search(r"warning: t = [\d.]+ s: the approach is", printed)
    assert "warning: the data scatter" in printed  # of the whole run, so without an instant


def test_grid_is_measured_against_the_memory_that_is_free(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run = prepared(read_case(Path("case.yaml"))).run
    needed = run.memory
    monkeypatch.setattr("viscontact.runs.preparation.available_memory", lambda: needed + 1)
    assert main(["run", "case.yaml", "-q", "-o", "fits"]) == 0
    monkeypatch.setattr("viscontact.runs.preparation.available_memory", lambda: needed - 1)
    assert main(["run", "case.yaml", "-q", "-o", "too large"]) == 2
    assert "GB are free; use fewer cells" in capsys.readouterr().err
    assert not Path("too large").exists()


def test_show_prints_the_history_thinned_or_whole(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", str(finished)]) == 0
    printed = capsys.readouterr().out
    assert "approach" in printed
    assert "[µm]" in printed
    assert main(["show", str(finished / "result.nc"), "--all"]) == 0
    assert capsys.readouterr().out == printed  # seven instants fit anyway


def test_a_workbook_has_the_numbers_of_the_csv_file(finished: Path, tmp_path: Path) -> None:
    table, book = tmp_path / "history.csv", tmp_path / "history.xlsx"
    for file in (table, book):
        assert main(["export", str(finished), "-o", str(file)]) == 0
    sheet = openpyxl.load_workbook(book).active
    assert sheet is not None
    with table.open(encoding="utf-8", newline="") as lines:
        texts = list(csv.reader(lines))
    assert len(texts) > 2
    for cells, row in zip(sheet.values, texts, strict=True):
        for cell, text in zip(cells, row, strict=True):
            assert text == (cell or "") if isinstance(cell, str | None) else float(text) == cell


def test_export_holds_every_scalar_to_the_last_digit(finished: Path, tmp_path: Path) -> None:
    file = tmp_path / "history.csv"
    assert main(["export", str(finished), "-o", str(file)]) == 0
    with file.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    with vc.open_results(finished) as ds:
        assert [float(row["contact_area [m^2]"]) for row in rows] == ds.contact_area.values.tolist()
        assert [float(row["time [s]"]) for row in rows] == ds.time.values.tolist()
        scalars = {name for name in ds.data_vars if ds[name].dims == ("time",)}
        assert len(rows[0]) == len(scalars) + 1
    assert {row["outcome"] for row in rows} == {"converged"}


def test_show_prints_the_loss_per_cycle_and_an_inexact_memory(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    swing = "load={kind: harmonic, mean: 2 N, amplitude: 1 N, period: 1 s, cycles: 2}"
    assert main(["run", "case.yaml", "--set", swing, "--set", "grid.shape=[16, 16]"]) == 0
    summary = capsys.readouterr().out
    assert re.search(r"loss per cycle \[µJ\] +- +[\d.]+ ", summary)
    assert main(["show", "case"]) == 0
    printed = capsys.readouterr().out
    with vc.open_results("case") as ds:
        # 6 steps of 5 s do not end with a cycle; the last whole one stands until the next is over
        first, last = (format_quantity(float(ds.loss_per_cycle[k]), "J") for k in (2, -1))
        assert ds.attrs["memory"].startswith("recursion, exact")
    assert f"loss per cycle: {first} in the first cycle, {last} in the last" in printed
    assert "memory" not in printed
    with vc.open_results("case") as ds:
        altered = ds.load().assign_attrs(memory="sum over all earlier steps", inversion_error=1e-7)
    altered.to_netcdf("altered.nc")
    assert main(["show", "altered.nc"]) == 0
    printed = capsys.readouterr().out
    assert "memory: sum over all earlier steps" in printed
    assert "the law was converted numerically; error: below 0.01 % (estimated)" in printed


@pytest.mark.slow
def test_approach_control_is_shown_and_drawn_like_any_run(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = "press to 90 um in 1 s; withdraw to -50 um in 1 s"
    load = f"load={{kind: history, sentences: {said}, tilt_x: 2 mrad}}"
    coarse = ["--set", "grid.shape=[24, 24]"]
    assert main(["run", "case.yaml", "-q", *ADAPTIVE, *coarse, "--set", load]) == 0
    for figure in ("history", "hysteresis", "pressure-profile", "pressure-map"):
        assert main(["plot", "case", figure]) == 0
    assert main(["show", "case"]) == 0
    shown = capsys.readouterr().out
    assert "tilt x" in shown
    assert "…" not in shown  # eighty characters hold nine columns
    with vc.open_results("case") as ds:
        assert ds.approach[-1] == -50e-6
        assert ds.force[-1] == 0.0
        assert ds.outcome[-1] == vc.Outcome.NO_CONTACT


def test_plot_draws_a_figure_into_the_run_or_a_given_file(finished: Path, tmp_path: Path) -> None:
    assert main(["plot", str(finished), "history"]) == 0
    assert (finished / "history.png").read_bytes().startswith(b"\x89PNG")
    file = tmp_path / "map.svg"
    times = ["--time", "0 s", "--time", "5 s"]
    assert main(["plot", str(finished / "result.nc"), "pressure-map", *times, "-o", str(file)]) == 0
    assert "<svg" in file.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "figure", [pytest.param("stress-section", marks=pytest.mark.slow), "von-mises"]
)
def test_figure_of_stresses_counts_their_depths_on_a_terminal(
    figure: str, finished: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    assert main(["plot", str(finished), figure, "-o", str(tmp_path / "stress.png")]) == 0
    assert "depth" in terminal.getvalue()


def test_interrupted_figure_of_stresses_ends_quietly_and_leaves_no_file(
    finished: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def interrupted(*given: object) -> np.ndarray:
        signal.raise_signal(signal.SIGINT)
        raise AssertionError("not interrupted")

    monkeypatch.setattr(HalfSpaceStress, "coefficients", interrupted)
    file = tmp_path / "stress.png"
    assert main(["plot", str(finished), "stress-section", "-o", str(file)]) == 130
    assert not file.exists()
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["presure-map"], "did you mean pressure-map?"),
        (["animation", "-o", "film.png"], "must end in .gif or .mp4"),
        (["history", "--time", "3"], "--time: 3 has no unit"),
        (["pressure-map", "--time", "6 s"], "--time: 6 s lies outside the run"),
        (["history", "--time", "0 s", "--time", "-1 s"], "which goes from 0 s to 5 s"),
        (["history", "-o", "figure.xyz"], "figure.xyz"),
        (["history", "-o", "nowhere/figure.png"], "figure.png"),
    ],
)
def test_figure_that_cannot_be_drawn_is_refused_in_one_line(
    words: list[str], said: str, finished: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", str(finished), *words]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert len(message.splitlines()) == 1


def test_instant_that_is_not_stored_is_drawn_nearby_and_said(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = ["--set", "output.fields=[0 s, 5 s]"]
    assert main(["run", "case.yaml", "-q", *kept]) == 0
    times = ["--time", "0 s", "--time", "4 s"]
    assert main(["plot", "case", "pressure-profile", *times]) == 0
    assert capsys.readouterr().err == "4 s is not stored; drew 5 s\n"
    assert main(["plot", "case", "history", *times]) == 0  # a span, which has no such instants
    assert capsys.readouterr().err == ""


def test_without_matplotlib_a_line_says_what_to_install(
    finished: Path,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in [name for name in sys.modules if name.startswith("viscontact.drawing.matplotlib")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr("viscontact.drawing.matplotlib", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    for command in (["plot", str(finished), "history"], ["demo"]):
        assert main(command) == 2
        message = capsys.readouterr().err
        assert "pip install 'viscontact[plot]'" in message
        assert len(message.splitlines()) == 1
    assert not (folder / "viscontact-demo").exists()  # refused before the run


def test_compare_overlays_runs_and_refuses_a_single_one(
    finished: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml", "-q", "-o", "heavier", "--set", "load.force=5 N"]) == 0
    assert main(["compare", str(finished), "heavier", "-o", "runs.png"]) == 0
    assert Path("runs.png").read_bytes().startswith(b"\x89PNG")
    assert main(["compare", "heavier"]) == 2
    assert main(["compare", "heavier", str(finished), "--figure", "histroy"]) == 2
    assert "did you mean history?" in capsys.readouterr().err
    assert main(["compare", "heavier", "heavier"]) == 2
    assert "got one of them twice" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["show"], ["export"], ["plot", "history"]])
def test_directory_without_a_result_is_refused_in_one_line(
    words: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command, *rest = words
    assert main([command, "nothing", *rest]) == 2
    assert "nothing: no result there" in capsys.readouterr().err
    assert main([command, "case.yaml", *rest]) == 2
    said = "case.yaml is neither a run directory nor a netCDF file\n"
    assert capsys.readouterr().err == said


def test_schema_is_json_schema(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert schema["$schema"].startswith("https://json-schema.org/")


def test_example_is_copied_with_the_schema_that_editors_need(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["example"]) == 0
    names = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert {"roller-as-printed", "roller-dogbone", "sphere-maxwell", "sphere-zener"} <= set(names)
    assert main(["example", "sphere-zener", "-o", "my.yaml"]) == 0
    assert main(["example", "sphere-zener"]) == 0
    assert Path("my.yaml").read_text(encoding="utf-8") in capsys.readouterr().out
    assert json.loads(Path("viscontact.schema.json").read_text(encoding="utf-8"))
    assert main(["check", "my.yaml"]) == 0
    assert main(["example", "sphere-zener", "-o", "my.yaml"]) == 2
    assert main(["example", "sphere-zenr", "-o", "new.yaml"]) == 2
    assert "did you mean sphere-zener?" in capsys.readouterr().err


@pytest.mark.slow  # 121 instants of 65536 cells
def test_demo_runs_the_shipped_case_to_pictures(folder: Path) -> None:
    # as a process of its own, where NumPy is set to leave short inner products to one thread
    demo = [sys.executable, "-m", "viscontact", "demo", "-q"]
    done = subprocess.run(demo, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    kept = {path.name for path in Path("viscontact-demo").iterdir()}
    assert {"result.nc", "case.yaml", "pressure-map.png", "history.png"} <= kept
    with vc.open_results("viscontact-demo") as ds:
        assert ds.sizes["time"] == 121
        assert ds.sizes["x"] * ds.sizes["y"] == 2**16
        assert (ds.residual <= 1e-6).all()
    assert main(["example", "roller-dogbone-e05", "-o", "my.yaml"]) == 0
    copied = Path("my.yaml").read_bytes()
    assert copied == Path("viscontact-demo/case.yaml").read_bytes()


@pytest.mark.slow
def test_second_demo_replaces_the_first(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = execution.execute

    def coarse(request: RunRequest) -> Path:
        settings = ("grid.shape=[32, 16]", "time.steps=1", "output.errors=false")
        return whole(replace(request, settings=settings))

    monkeypatch.setattr(execution, "execute", coarse)
    two = ("pressure-map", "history")
    monkeypatch.setattr("viscontact.cli.commands.cases.DEMO_FIGURES", two)
    assert main(["demo", "-q"]) == 0
    kept = {path.name for path in Path("viscontact-demo").iterdir()}
    assert {"result.nc", "case.yaml", "pressure-map.png", "history.png"} <= kept
    monkeypatch.setattr("viscontact.cli.commands.cases.DEMO_FIGURES", ())
    assert main(["demo", "-q"]) == 0


def test_demo_names_a_command_that_the_shell_finds(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """After `./go demo` the environment's commands are not on the path."""
    monkeypatch.setattr(execution, "execute", lambda *_, **__: None)
    monkeypatch.setattr("viscontact.cli.commands.cases.DEMO_FIGURES", ())
    monkeypatch.setenv("PATH", str(folder))
    assert main(["demo"]) == 0
    typed = capsys.readouterr().out.splitlines()[-1].partition(": ")[2]
    assert subprocess.run(typed.split(), check=False).returncode == 0
    assert Path("my.yaml").exists()


@pytest.mark.parametrize("words", [["rnu"], ["run"], ["run", "case.yaml", "--threads", "0"]])
def test_wrong_use_exits_with_2(words: list[str], folder: Path) -> None:
    assert main(words) == 2


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command_ends_with_an_example(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--help"]) == 0
    lines = capsys.readouterr().out.strip().splitlines()
    assert "Example:" in " ".join(lines[-3:])
    assert f"viscontact {command}" in " ".join(lines[-3:])


def test_terminal_without_superscripts_still_gets_its_table(finished: Path) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    show = [sys.executable, "-m", "viscontact", "show", str(finished)]
    done = subprocess.run(show, capture_output=True, env=environment)
    assert done.returncode == 0
    assert b"approach" in done.stdout


def test_command_is_installed_and_works_as_a_module() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "viscontact", "--version"], capture_output=True, text=True
    )
    assert (done.returncode, done.stdout) == (0, f"viscontact {vc.__version__}\n")


def test_two_runs_of_one_name_are_distinguished() -> None:
    same = [Path("a/case"), Path("b/case")]
    assert figures._labels(same) == [str(path) for path in same]
    assert figures._labels([Path("a"), Path("b")]) == ["a", "b"]


def test_result_is_not_overwritten_by_its_own_export(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (finished / "result.nc").read_bytes()
    assert main(["export", str(finished), "-o", str(finished / "result.nc")]) == 2
    assert "name a CSV or an XLSX file" in capsys.readouterr().err
    assert (finished / "result.nc").read_bytes() == before


def test_directory_that_no_system_can_name_is_refused_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "case.yaml", "-q", "-o", "a" * 300]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


@pytest.mark.parametrize("words", [["show"], ["export"], ["plot", "history"]])
def test_netcdf_of_something_else_is_refused_in_one_line(
    words: list[str], finished: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with vc.open_results(finished) as ds:
        ds = ds.drop_encoding()
        ds[["force"]].to_netcdf("less.nc")
        ds.isel(time=0, drop=True).assign(time=0.0).to_netcdf("still.nc")
    command, *rest = words
    for name in ("less.nc", "still.nc"):
        assert main([command, name, *rest]) == 2
        message = capsys.readouterr().err
        assert "not a result of viscontact" in message
        assert len(message.splitlines()) == 1


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full device here")
def test_finished_run_whose_table_is_not_written_says_so(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as output, monkeypatch.context() as patched:
        patched.setattr("sys.stdout", output)
        assert main(["run", "case.yaml", *ERRORS]) == 0
    *_, step, stage, last = capsys.readouterr().err.splitlines()
    why = "No space left on device"
    assert last == f"case: the run is finished; its table cannot be printed: {why}"
    assert stage.startswith("estimating errors")
    assert "step" in step


def _shell(line: str) -> subprocess.CompletedProcess[str]:
    """What a shell makes of a line in which $V is the command."""
    if os.name == "nt":
        pytest.skip("needs a POSIX shell")
    environment = {**os.environ, "V": f"{sys.executable} -m viscontact"}
    return subprocess.run(["bash", "-c", line], capture_output=True, text=True, env=environment)


@pytest.mark.parametrize(
    "closed",
    [
        "<&- >&- 2>&-",
        *(pytest.param(c, marks=pytest.mark.slow) for c in (">&-", "2>&-", ">&- 2>&-")),
    ],
)
def test_run_needs_no_standard_streams(closed: str, folder: Path) -> None:
    assert _shell(f"$V run case.yaml {closed}").returncode == 0
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == 7
    # neither a message nor a table has got into a file of the run
    lines = Path("case/progress.jsonl").read_text(encoding="utf-8").splitlines()
    assert ["time" in json.loads(line) for line in lines] == [True] * 7


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full device here")
@pytest.mark.parametrize(
    ("reader", "buffered"),
    [
        ("| sleep 0; exit ${PIPESTATUS[0]}", "1"),
        *((">/dev/full", ""), (">/dev/full", "1")),
        ("| sleep 0; exit ${PIPESTATUS[0]}", ""),
    ],
)
def test_finished_run_whose_table_is_not_read_is_finished(
    reader: str, buffered: str, folder: Path
) -> None:
    words = " ".join(ERRORS)
    done = _shell(f"export PYTHONUNBUFFERED={buffered}; $V run case.yaml {words} {reader}")
    assert done.returncode == 0
    last = done.stderr.splitlines()[-1]
    assert last.startswith("case: the run is finished; its table cannot be printed: ")
    assert done.stderr.splitlines()[-2].startswith("estimating errors")
    assert "step" in done.stderr.splitlines()[-3]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full device here")
@pytest.mark.parametrize(
    "words",
    [
        "example",
        *(
            pytest.param(words, marks=pytest.mark.slow)
            for words in (
                *("--help", "--version", "run --help"),
                *("show finished", "check case.yaml", "schema"),
            )
        ),
    ],
)
def test_full_output_is_said_in_one_line(words: str, folder: Path, finished: Path) -> None:
    words = words.replace("finished", str(finished))
    for buffered in ("", "1"):
        done = _shell(f"export PYTHONUNBUFFERED={buffered}; $V {words} >/dev/full")
        assert done.returncode == 1
        assert done.stderr == (
            "viscontact: the output cannot be written: No space left on device\n"
        )
    # messages that cannot be written do not change how a run ends
    assert _shell(f"$V {words} 2>/dev/full").returncode == 0


@pytest.mark.parametrize(
    "name",
    [
        *("~", " lead", "file:"),
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("~x", "trail ", "http:", "a:b", "#a", "é")
        ),
    ],
)
def test_directories_of_odd_names_hold_runs(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if os.name == "nt":
        pytest.skip("Windows has no such names")
    home = folder / "home"
    home.mkdir()
    monkeypatch.setenv("HOME", str(home))
    assert main(["run", "case.yaml", "-o", name, "--set", "time.steps=1"]) == 0
    assert main(["show", name]) == 0
    assert (folder / name / "result.nc").is_file()
    assert {path.name for path in folder.iterdir()} == {"case.yaml", "home", name}
    assert not any(home.iterdir())


@pytest.mark.parametrize("name", [b"x\\y", b"\\", b"a\xffb"])
def test_directories_that_netcdf_cannot_name_are_refused(
    name: bytes, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if os.name == "nt":
        pytest.skip("Windows has no such names")
    assert main(["run", "case.yaml", "-o", os.fsdecode(name)]) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert "netCDF" in line
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


@pytest.mark.parametrize("kilobytes", [220_000, 250_000, 290_000])
def test_too_little_memory_for_the_libraries_is_said(kilobytes: int, folder: Path) -> None:
    done = _shell(f"ulimit -v {kilobytes} || exit 99; $V run case.yaml")
    if done.returncode == 99:
        pytest.skip("no limit of memory here")
    assert done.returncode == 1
    assert "too little memory" in done.stderr
    assert "fault of viscontact" not in done.stderr
