"""Runs of one sweep have common cells, so that their results can be compared."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.case.document import read_document
from viscontact.cli import main
from viscontact.cli.sweep.common_cells import with_common_cells
from viscontact.cli.sweep.plan_options import PlanOptions
from viscontact.cli.sweep.request import ManyRequest
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.sweep import common_cells
from viscontact.units.formatting import format_quantity

ROLLER = """\
indenter: {shape: roller, radius: 5 mm, half_length: 8 mm, profile: cylindrical}
material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.4}
load: {kind: step, force: 200 N}
time: {end: 1 s, steps: 1}
output: {fields: none, errors: false}
"""
FORCES = (150, 200, 300, 400)


@pytest.fixture
def roller(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("roller.yaml").write_text(ROLLER, encoding="utf-8")
    return Path("roller.yaml")


def sweep(case: Path, *, text: str, resume: bool = False) -> list[RunRequest]:
    """The runs of a `--vary`, with what they share."""
    common = RunRequest(case, Path("all"), resume=resume)
    planned = ManyRequest((case,), common, PlanOptions((text,))).planned()
    return with_common_cells(planned, "--vary")


def added(runs: list[RunRequest]) -> set[tuple[str, ...]]:
    """Settings other than the varied value, of all runs."""
    return {each.settings[1:] for each in runs}


def result(force: int) -> xr.Dataset:
    with vc.open_results(f"all/roller_force={force}N") as ds:
        return ds.load()


@pytest.mark.slow
def test_peaks_of_a_sharp_roller_vary_smoothly_with_the_load(
    roller: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The peak grows like a power of the load between those of a line contact and of a punch.

    Hertz's line contact has 1/2, a punch of fixed width 1 (Johnson 1985, Contact Mechanics, eqs.
    4.45 and 2.64). Grids of their own differ across the roller.
    """
    body, pmma = vc.Roller(5e-3, 8e-3), vc.Material(vc.Elastic(1e9), 0.4)
    own = [vc.auto_grid(body, pmma, vc.step(F), end=1.0).cell_size for F in FORCES]
    assert len({round(dy, 9) for _, dy in own}) > 1  # or the test says nothing
    smallest = np.min(own, axis=0)
    forces = ",".join(f"{force}N" for force in FORCES)
    words = ["run", str(roller), "--vary", f"load.force={forces}", "-o", "all", "-j", "2"]
    assert main(words) == 0
    shown = " x ".join(format_quantity(length, "m", 3) for length in smallest)
    assert f"--vary: common cells of {shown} in all runs of roller.yaml" in capsys.readouterr().err
    runs = [result(force) for force in FORCES]
    cells = [[float(ds[axis][1] - ds[axis][0]) for axis in "xy"] for ds in runs]
    np.testing.assert_allclose(cells, [smallest] * len(runs), rtol=1e-8)
    peaks = [float(ds.peak_pressure[0]) for ds in runs]
    powers = np.diff(np.log(peaks)) / np.diff(np.log(FORCES))
    assert ((powers > 0.5) & (powers < 1)).all()
    assert np.abs(np.diff(powers)).max() < 0.02
    # The choice is recorded in each case, which gives the same run alone.
    alone = Path("all", "roller_force=150N")
    kept = read_document(alone / "case.yaml").data["grid"]["largest_cell"]
    np.testing.assert_allclose(
        [float(each.split()[0]) for each in kept], np.multiply(cells[0], 1e6)
    )
    assert main(["run", str(alone / "case.yaml"), "-o", "again", "-q"]) == 0
    with vc.open_results("again") as ds:
        assert float(ds.peak_pressure[0]) == peaks[0]
    # A run that is begun again, and a later value, get the same cells.
    shutil.rmtree(alone)
    words[3] += ",500N"
    assert main([*words, "--resume", "-q"]) == 0
    assert float(result(150).peak_pressure[0]) == peaks[0]
    np.testing.assert_allclose(
        [float(result(500)[axis][1] - result(500)[axis][0]) for axis in "xy"], cells[0], rtol=1e-8
    )


def test_runs_begun_on_cells_of_their_own_are_resumed_on_them(roller: Path) -> None:
    assert main(["run", str(roller), "--set", "load.force=75N", "-o", "all/roller_force=75N"]) == 0
    assert added(sweep(roller, text="load.force=75N,200N", resume=True)) == {()}
    assert added(sweep(roller, text="load.force=75N,200N")) != {()}


@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("", "grid.tolerance=5%,1%"),
        ("", "grid={tolerance: 5%},{tolerance: 1%}"),
        ("", "load.force=75N"),
        ("grid: {shape: [40, 40], size: [20 mm, 1 mm]}", "load.force=75N,200N"),
        ("grid: {largest_cell: [0.2 mm, 5 um]}", "load.force=75N,200N"),
        ("", "load.force=75N,200 MPa"),
    ],
)
def test_runs_without_a_common_choice_keep_their_cells(roller: Path, line: str, text: str) -> None:
    roller.write_text(ROLLER + line, encoding="utf-8")
    assert added(sweep(roller, text=text)) == {()}


@pytest.mark.slow
@pytest.mark.parametrize("line", ["", "grid:", "grid: {tolerance: 1%}"])
def test_runs_of_other_cases_do_not_count(roller: Path, line: str) -> None:
    roller.write_text(ROLLER + line, encoding="utf-8")
    Path("short.yaml").write_text(ROLLER.replace("8 mm", "3 mm"), encoding="utf-8")
    common = RunRequest(roller, Path("all"))
    options = PlanOptions(("load.force=75N,200N",))
    both = ManyRequest((roller, Path("short.yaml")), common, options).planned()
    runs = with_common_cells(both, "--vary")
    assert runs[:2] == sweep(roller, text="load.force=75N,200N")
    assert runs[2:] == sweep(Path("short.yaml"), text="load.force=75N,200N")
    assert len(added(runs)) == 2


@pytest.mark.parametrize(
    ("name", "value"), [("MOST_CELLS", 1000), ("available_memory", lambda: 1.501e8)]
)
def test_common_cells_that_are_too_many_are_reported(
    roller: Path,
    name: str,
    value: object,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(common_cells, name, value)
    assert added(sweep(roller, text="load.force=75N,200N")) == {()}
    assert "cannot be compared" in capsys.readouterr().err
