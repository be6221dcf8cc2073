"""A peak pressure that depends on the mesh has a > wherever it is printed.

A roller with sharp ends is computed once; every table, tile, sentence and file about it is read.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from drawing.plotly.figure_data import figures_in
from reports_without_pictures import without_pictures
from viscontact.cli import main
from viscontact.plot import FIGURES
from viscontact.report import report_page
from viscontact.results.summary import headline

__all__ = ["without_pictures"]  # a fixture

CASE = """\
indenter: {shape: roller, radius: 5 mm, half_length: 3 mm, profile: cylindrical}
material: {law: maxwell, shear_modulus: 1 GPa, viscosity: 100 GPa s, poisson_ratio: 0.4}
load: {kind: step, force: 200 N}
time: {end: 10 s, steps: 3}
grid: {shape: [72, 32], size: [8 mm, 1.2 mm]}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two finished runs of a roller with sharp ends, and what the command printed."""
    folder = tmp_path_factory.mktemp("sharp")
    (folder / "case.yaml").write_text(CASE, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def ds(folder: Path) -> xr.Dataset:
    assert main(["run", str(folder / "case.yaml"), "-q"]) == 0
    with vc.open_results(folder / "case") as ds:
        return ds.load()


@pytest.fixture(scope="module")
def peaks(ds: xr.Dataset) -> list[str]:
    """Peak pressures [MPa] as they are printed, with four digits."""
    assert np.isposinf(ds.peak_pressure_error).all()
    return [f"{value:.4g}" for value in ds.peak_pressure.values * 1e-6]


def test_the_warning_names_the_remedy_and_its_keys(ds: xr.Dataset) -> None:
    warning = ds.attrs["warnings"]
    assert "the peak pressure depends on the mesh" in warning
    assert "round or chamfer the ends: 'crown_radius' under indenter" in warning


@pytest.mark.parametrize("command", ["run", "show"])
def test_tables_of_a_run(
    command: str, folder: Path, peaks: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = {"run": ["run", str(folder / "case.yaml"), "--overwrite"]}
    assert main(arguments.get(command, [command, str(folder / "case")])) == 0
    printed = capsys.readouterr().out
    for peak in (peaks[0], peaks[-1]):
        assert re.findall(rf"(.){re.escape(peak)}\b", printed) == [">"] * printed.count(peak)
        assert f">{peak}" in printed


def test_check_and_the_table_of_several_runs(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = str(folder / "case.yaml")
    assert main(["check", case]) == 0
    [line] = re.findall(r"  peak pressure +(.*)", capsys.readouterr().out)
    assert re.fullmatch(r">[\d.]+ MPa on a coarse mesh \(depends on the mesh\)", line)
    varied = ["run", case, "--vary", "load.force=100N,200N", "-o", str(folder / "forces")]
    assert main([*varied, "-j", "1"]) == 0
    table = capsys.readouterr().out
    for run in ("force=100N", "force=200N"):
        with vc.open_results(folder / "forces" / f"case_{run}") as ds:
            peak = float(ds.peak_pressure.max()) * 1e-6
        row = " ".join(line for line in table.splitlines() if line.startswith(f"case_{run}"))
        assert f">{peak:.4g}" in row
        assert row.count(">") == 1
        assert "mesh" in row


@pytest.mark.usefixtures("without_pictures")
def test_sentence_tile_and_map_of_the_report(ds: xr.Dataset, peaks: list[str]) -> None:
    assert f"the peak pressure >{peaks[-1]} MPa (depends on the mesh). " in headline(ds)
    largest = f"largest at t = 0 s: >{peaks[0]} MPa (depends on the mesh)"
    assert headline(ds).endswith(f"{largest}.")
    page = report_page(ds).replace("\N{NO-BREAK SPACE}", " ")
    assert f"<dd>&gt;{peaks[-1]} MPa (depends on the mesh)<small" in page
    frames = figures_in(page)["map"]["frames"]
    notes = [frame["layout"]["meta"]["note"] for frame in frames]
    assert notes == [f"Largest pressure >{peak} MPa" for peak in peaks]


def test_representation_in_a_notebook(ds: xr.Dataset, peaks: list[str]) -> None:
    for text in (repr(ds.viscontact), str(ds.viscontact)):
        assert f">{peaks[0]} MPa (depends on the mesh)" in text
        assert f">{peaks[-1]} MPa (depends on the mesh)" in text
        assert f" {peaks[0]} MPa" not in text


def test_histories_state_that_the_peak_is_not_drawn(ds: xr.Dataset) -> None:
    drawn = {axes.get_ylabel(): axes for axes in FIGURES["history"](ds).axes}
    panel = drawn["Peak pressure [MPa]"]
    assert np.isnan(np.asarray(panel.get_lines()[0].get_ydata(), dtype=float)).all()
    assert [text.get_text() for text in panel.texts] == ["not drawn:\nsmaller cells give more"]
    # The largest line load has a limit, and a curve.
    panel = drawn["Peak line load [kN/m]"]
    assert np.isfinite(np.asarray(panel.get_lines()[0].get_ydata(), dtype=float)).all()
    vc.plot.animation(ds, seconds=1.0, fps=2.0).show(0.0)


def test_csv_files_have_the_number_with_an_infinite_error(
    ds: xr.Dataset, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Columns of numbers stay readable by programs: the error inf marks the peak."""
    assert main(["export", str(folder / "case"), "-o", str(folder / "history.csv")]) == 0
    with (folder / "history.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["peak_pressure [Pa]"]) for row in rows] == ds.peak_pressure.values.tolist()
    assert {row["peak_pressure_error [Pa]"] for row in rows} == {"inf"}
