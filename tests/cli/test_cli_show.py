"""What is read from finished runs: tables, exports, figures and comparisons."""

from __future__ import annotations

import csv
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import openpyxl
import pytest

import viscontact as vc
from cli.sphere_runs import ADAPTIVE, Terminal, finished, folder
from viscontact.cli import main
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress
from viscontact.units.formatting import format_quantity

__all__ = ["finished", "folder"]  # fixtures


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


def test_terminal_without_superscripts_still_gets_its_table(finished: Path) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    show = [sys.executable, "-m", "viscontact", "show", str(finished)]
    done = subprocess.run(show, capture_output=True, env=environment)
    assert done.returncode == 0
    assert b"approach" in done.stdout


def test_result_is_not_overwritten_by_its_own_export(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (finished / "result.nc").read_bytes()
    assert main(["export", str(finished), "-o", str(finished / "result.nc")]) == 2
    assert "name a CSV or an XLSX file" in capsys.readouterr().err
    assert (finished / "result.nc").read_bytes() == before
