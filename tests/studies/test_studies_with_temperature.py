"""Sweeps, sensitivity, designs and fits of cases under a temperature over time."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.studies.design.profiles.loaded_roller import LoadedRoller
from viscontact.studies.sweep.axes import coordinate

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

CASE = """
indenter: {shape: sphere, radius: 40 mm}
material: {law: zener, shear_modulus: 1 MPa, delayed_modulus: 0.5 MPa, viscosity: 1e4 MPa s,
  poisson_ratio: 0.49,
  shift: {kind: wlf, reference_temperature: 20 degC, c1: 8.86, c2: 101.6 K}}
load: {kind: step, force: 50 N}
temperature: {kind: harmonic, mean: 20 degC, amplitude: 10 K, period: 4 h, cycles: 1}
time: {end: 4 h, steps: 8}
grid: {shape: [16, 16], size: [32 mm, 32 mm]}
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.yaml"
    path.write_text(CASE, encoding="utf-8")
    return path


def grown(path: Path, *settings: str) -> float:
    """Growth of the approach by the law: w ∝ J^(2/3) under a held force (Lee & Radok 1960)."""
    found = read_case(path, settings)
    assert isinstance(found.material, vc.Material)
    reduced = float(found.clocks[0].reduced(np.array(found.end)))
    return float((found.material.law(reduced) / found.material.law(0.0)) ** (2 / 3))


def test_fit_finds_the_temperature_of_a_record(case: Path) -> None:
    # Without the temperature of the case in its runs, no value would fit better than another.
    given = read_case(case, ["temperature.mean=24 degC"])
    ds = vc.simulate(
        *(given.indenter, given.material, given.load, given.grid, np.linspace(0.0, 14400.0, 5)),
        temperature=given.temperature,
        fields="none",
        errors=False,
    )
    record = vc.ContactRecord(ds.time.values, force=ds.force.values, approach=ds.approach.values)
    change = {"temperature.mean": ("15 degC", "35 degC")}
    found = vc.fit_case(case, record, change, drive="case", runs=4, workers=1)
    assert found.parameters["temperature.mean"] == close_to(297.15, rel=2e-4)


@pytest.mark.slow
def test_design_and_sensitivity_see_the_temperature(case: Path, tmp_path: Path) -> None:
    best = vc.design(
        *(case, {"temperature.mean": ("0 degC", "20 degC")}),
        maximise="approach",
        at="end",
        runs=8,
        workers=1,
        directory=tmp_path / "design",
    )
    assert float(best.best["temperature.mean"]) == close_to(293.15)
    found = vc.sensitivity(
        *(case, "approach"),
        change=["temperature.amplitude", "material.shift.c2"],
        at="end",
        workers=1,
        directory=tmp_path / "sensitivity",
    )
    # About the reference temperature a_T follows from (T - T_r)/C_2 alone.
    values = found.table["elasticity"].values.ravel()
    assert values[0] == close_to(-values[1], rel=1e-3)


def test_sweep_varies_the_temperature(case: Path) -> None:
    runs = vc.vary(
        case, {"temperature.amplitude": ["1 K", "10 K"]}, settings={"output.errors": False}
    )
    # As they arrive in other processes.
    found = [pickle.loads(pickle.dumps(run))() for run in runs]
    ratio = [float(ds.approach[-1] / ds.approach[0]) for ds in found]
    expected = [grown(case, f"temperature.amplitude={each}") for each in ("1 K", "10 K")]
    np.testing.assert_allclose(ratio, expected, rtol=2e-2)
    assert ratio[1] > 1.05 * ratio[0]


def test_amplitudes_are_differences_and_temperatures_absolute() -> None:
    swings = coordinate("temperature.amplitude", "run", ["5 degC", "10 K"])
    assert swings.values.tolist() == [5.0, 10.0]
    means = coordinate("temperature.mean", "run", ["5 degC", "280 K"])
    assert means.values.tolist() == close_to([278.15, 280.0])
    forces = coordinate("load.amplitude", "run", ["5 N", "10 N"])
    assert forces.attrs["units"] == "N"


def test_free_profiles_are_designed_at_the_temperature_of_the_case(tmp_path: Path) -> None:
    text = CASE.replace(
        "{shape: sphere, radius: 40 mm}", "{shape: roller, radius: 5 mm, length: 20 mm}"
    )
    path = tmp_path / "roller.yaml"
    path.write_text(text, encoding="utf-8")
    given = read_case(path)
    assert LoadedRoller("", given).arguments()["temperature"] == given.temperature
