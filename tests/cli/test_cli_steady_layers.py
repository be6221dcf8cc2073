"""Cases of rolls with a cover that creeps: checked, run, resumed, shown, drawn, varied, in time."""

import json
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from interrupted_runs import same_bits, stopped_after
from viscontact.cli import main

CASE = """\
title: Ball with a rubber cover
indenter: {shape: paraboloid, radius_x: 100 mm, radius_y: 100 mm}
material: {law: elastic, shear_modulus: 80 GPa, poisson_ratio: 0.3}
indenter_material:
  layers:
    - {thickness: 5 mm, law: zener, shear_modulus: 9 MPa, delayed_modulus: 1 MPa, \
viscosity: 10 kPa s, poisson_ratio: 0.45}
  base: {law: elastic, shear_modulus: 50 MPa, poisson_ratio: 0.3}
load: {kind: step, force: 20 N, tilt_x: 0 rad, tilt_y: 0 rad}
motion: {kind: steady, speed: [10 m/s, 1 m/s, 0.1 m/s], along: y, rolling: true}
grid: {shape: [32, 32], size: [18 mm, 18 mm]}
output: {errors: false}
"""


def problem():
    """Arguments of `steady` for the case."""
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.45)
    core, steel = (vc.Material(vc.Elastic(shear), poisson_ratio=0.3) for shear in (50e6, 80e9))
    covered = vc.Layered([vc.Layer(5e-3, rubber)], base=core)
    options = {"indenter_material": covered, "rolling": True, "along": "y"}
    load = vc.step(20.0, tilt_x=0.0, tilt_y=0.0)
    return (vc.Paraboloid(0.1, 0.1), steel, load), options


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run."""
    here = tmp_path_factory.mktemp("covered")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    return here / "case"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
def test_result_is_that_of_steady(finished: Path) -> None:
    bodies, options = problem()
    with vc.open_results(finished) as ds:
        grid = vc.Grid((32, 32), (18e-3, 18e-3))
        whole = vc.steady(*bodies, ds.speed.values, grid=grid, errors=False, **options)
        for name in ("friction_coefficient", "peak_pressure", "contact_width", "approach"):
            assert np.array_equal(ds[name], whole[name]), name
        assert ds.attrs["splitting_error"] == whole.attrs["splitting_error"] > 0
        assert json.loads(ds.attrs["case"])["indenter_material"]["type"] == "Layered"


@pytest.mark.slow
def test_run_stopped_after_a_speed_is_resumed_to_the_same_bits(
    folder: Path, finished: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with stopped_after(monkeypatch):
        assert main(["run", "case.yaml", "-q"]) == 130
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    with vc.open_results(finished) as whole:
        assert same_bits("case", whole.load())


def test_check_predicts_the_contact_and_the_strain_of_the_cover(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "speeds 3, from 100 mm/s to 10 m/s" in said
    assert "of the thickness of the layers" not in said
    deep = ["--set", "load.force=200 N", "--set", "grid.size=[40 mm, 40 mm]"]
    assert main(["check", "case.yaml", *deep]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "the approach will be about" in said
    assert "of the thickness of the layers, 5 mm" in said
    deep += ["--set", "motion.speed=0.1 m/s", "--set", "output.fields=none"]
    assert main(["run", "case.yaml", "-q", *deep]) == 0
    with vc.open_results("case") as ds:
        assert "of the thickness of the layers, 5 mm" in ds.attrs["warnings"]


@pytest.mark.slow
def test_figures_report_and_tables(
    finished: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for figure in ("friction", "pressure-profile", "pressure-map"):
        out = tmp_path / f"{figure}.png"
        assert main(["plot", str(finished), figure, "-o", str(out)]) == 0
        assert out.stat().st_size > 5000
    assert main(["report", str(finished), "-o", str(tmp_path / "report.html")]) == 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "friction coefficient" in page
    assert "5 mm" in page  # the cover
    capsys.readouterr()
    assert main(["show", str(finished)]) == 0
    assert "error of the layers' creep by its separation" in capsys.readouterr().out


def test_the_thickness_of_a_cover_is_varied(folder: Path) -> None:
    vary = ["--vary", "indenter_material.layers[1].thickness=5 mm,2 mm"]
    off = ["--set", "motion.speed=[1 m/s]", "--set", "output={fields: none, errors: false}"]
    assert main(["run", "case.yaml", "-q", *vary, *off, "-o", "two", "-j", "1"]) == 0
    ds = vc.open_many("two")
    thick, thin = ds.peak_pressure.isel(speed=0).values
    assert thin > 1.2 * thick


def test_a_case_moves_over_layers_in_time_as_in_python(folder: Path) -> None:
    travel = "{kind: travel, points: [[0 s, 0 mm], [2 ms, 1.6 mm]], along: y, rolling: true}"
    words = ["--set", f"motion={travel}", "--set", "time={end: 2 ms, steps: 4}"]
    assert main(["run", "case.yaml", "-q", *words]) == 0
    bodies, options = problem()
    motion = vc.Travel([0.0, 2e-3], y=[0.0, 1.6e-3], rolling=True)
    whole = vc.simulate(
        *bodies,
        vc.Grid((32, 32), (18e-3, 18e-3)),
        vc.uniform_times(2e-3, 4),
        motion=motion,
        indenter_material=options["indenter_material"],
        errors=False,
    )
    with vc.open_results("case") as ds:
        for name in ("friction_coefficient", "peak_pressure", "dissipation", "heat"):
            assert np.array_equal(ds[name], whole[name], equal_nan=True), name
        assert float(ds.heat[-1]) > 0
