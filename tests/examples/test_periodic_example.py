"""A periodic case from the file to the figures, and what a case file may say of one."""

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact import surfaces
from viscontact.case import CaseError, read_case
from viscontact.cli import main
from viscontact.reference import full_contact_pressure

CASE = """
indenter: {shape: waviness, amplitude: 1 um, wavelength_x: 1 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, mean_pressure: 2 kPa}
time: {end: 1 s, steps: 1}
grid: {shape: [64, 8], size: [1 mm, 0.5 mm], periodic: true}
"""
BY_FORCE = CASE.replace("mean_pressure: 2 kPa", "force: 1 mN")


@pytest.fixture(autouse=True)
def _few_dots(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)


def read(folder: Path, text: str) -> vc.LoadHistory:
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    return read_case(folder / "case.yaml")


def test_waves_creep_to_nearly_full_contact(tmp_path, capsys):
    """Under p̄ = 1.2 MPa; p* = sqrt(2) π E* Δ/λ, E* of J's last value: 1.2342 MPa.

    Near full contact the open share is 3/(2π) (1 - p̄/p*) (Johnson, Greenwood, Higginson 1985).
    """
    case, directory = tmp_path / "my.yaml", tmp_path / "my"
    assert main(["example", "wavy-creep", "-o", str(case)]) == 0
    assert main(["check", str(case)]) == 0
    said = capsys.readouterr().out
    assert "no problems found" in said
    assert "periodic" in said
    assert "1 mm long, 1 mm wide" in said  # on the period itself, nearly full
    assert main(["run", str(case), "--quiet", "--set", "output.errors=false"]) == 0
    for figure in ("contact-outline", "stress-section"):
        assert main(["plot", str(directory), figure]) == 0
    with vc.open_results(directory) as results:
        ds = results.load()
    modulus = 1 / (0.6 * (1 / 500e6 + (1 - np.exp(-10.0)) / 250e6))
    flat = full_contact_pressure(1e-6, modulus, wavelength_x=1e-3, wavelength_y=1e-3)
    assert ds.force.values == close_to(1.2, rel=1e-9)  # on 1 mm²
    share = 1 - ds.contact_area.values[-1] / 1e-6
    assert share == close_to(1.5 / np.pi * (1 - 1.2e6 / flat), rel=0.1)
    assert (np.diff(ds.contact_area.values) > -1e-12).all()


@pytest.mark.parametrize(
    ("load", "force"),
    [
        ("{kind: step, mean_pressure: 2 kPa}", [1e-3, 1e-3, 1e-3]),
        ("{kind: ramp, mean_pressure: 2 kPa, duration: 1 s}", [0.0, 5e-4, 1e-3]),
        ("{kind: triangle, mean_pressure: 2 kPa, rise: 1 s}", [0.0, 5e-4, 1e-3]),
        ("{kind: history, mean_pressure: [[0 s, 0 Pa], [1 s, 2 kPa]]}", [0.0, 5e-4, 1e-3]),
    ],
)
def test_mean_pressure_acts_on_the_area_of_the_period(tmp_path, load, force):
    """2 kPa on 1 mm x 0.5 mm are 1 mN."""
    case = read(tmp_path, CASE.replace("{kind: step, mean_pressure: 2 kPa}", load))
    assert case.load.level_at([0.0, 0.5, 1.0]) == close_to(force, rel=1e-12)
    assert case.grid == vc.Grid((64, 8), (1e-3, 0.5e-3), periodic=True)


def test_mean_pressure_and_force_are_the_same_run(tmp_path):
    assert read(tmp_path, CASE).load == read(tmp_path, BY_FORCE).load


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        (", periodic: true", "", r"case.yaml:4: load.mean_pressure: it goes with a periodic grid"),
        ("grid:", "output: {fields: none}\n#", r"load.mean_pressure: it goes with a periodic grid"),
        ("2 kPa", "2 kN", r"case.yaml:4: load.mean_pressure: cannot read '2 kN' as a pressure"),
        ("2 kPa", "2 kPa, force: 1 N", r"mean_pressure and force exclude each other"),
        ("2 kPa", "2 kPa, approach: 1 um", r"mean_pressure and approach exclude each other"),
        ("shape: [64, 8], size: [1 mm, 0.5 mm], ", "", r"grid.periodic: goes with shape and size"),
        ("periodic: true", "periodic: maybe", r"case.yaml:6: grid.periodic: must be"),
        (
            "step, mean_pressure: 2 kPa",
            "history, mean_pressure: []",
            r"load.mean_pressure: is empty",
        ),
    ],
)
def test_case_is_refused_in_a_line(tmp_path, old, new, why):
    assert old in CASE
    with pytest.raises(CaseError, match=why):
        read(tmp_path, CASE.replace(old, new))


def test_result_remembers_its_period(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", "case.yaml", "--quiet"]) == 0
    with vc.open_results("case") as results:
        stresses = vc.section_stresses(results, [0.0, 1e-3])
        assert stresses.stress_zz.mean("x").values == close_to(-2e3, rel=1e-6)


def test_periodic_map_is_levelled_by_its_mean():
    """A saw tooth has a fitting plane, but what repeats itself has no tilt."""
    heights = np.tile(np.array([0.0, 1.0, 2.0, 3.0])[:, None] * 1e-6, 4)
    surface = surfaces.Surface(heights, 1e-5, periodic=True)
    assert surfaces.levelled(surface).heights == close_to(heights - 1.5e-6, abs=1e-18)
    with pytest.raises(ValueError, match="level: surface is periodic"):
        surfaces.levelled(surface, "quadratic")
