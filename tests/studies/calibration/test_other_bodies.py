"""Laws recovered from records of layers and of wavy surfaces, which finer runs have made."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.studies.calibration.experiments import OF_ZENER, ZENER, noise, triangle, written

import viscontact as vc

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning"),  # of correlations
]

LAW = "law: zener, shear_modulus: 4 MPa, delayed_modulus: 2 MPa, viscosity: 1 MPa s"


def require_recovered(found: vc.CaseFit) -> None:
    """Require the true values within intervals and discretisation errors."""
    assert {key.rpartition(".")[2] for key in found.intervals} == set(ZENER)
    for key, (low, high) in found.intervals.items():
        error = found.discretisation_errors[key]
        value = ZENER[key.rpartition(".")[2]]
        assert low - error < value < high + error, key


def test_layer_is_recovered_on_an_automatic_grid(tmp_path: Path) -> None:
    case = written(
        tmp_path,
        f"""
indenter: {{shape: sphere, radius: 5 mm}}
material: {{layers: [{{thickness: 0.5 mm, {LAW}, poisson_ratio: 0.45}}], base: rigid}}
load: {{kind: step, force: 1 N}}
time: {{end: 4 s, steps: 20}}
grid: {{tolerance: 5 %}}
""",
    )
    times, force = triangle(4.0, peak=1.0)
    rubber = vc.Material(vc.Zener(**ZENER), poisson_ratio=0.45)
    fine = np.linspace(0.0, 4.0, 81)
    run = vc.simulate(
        vc.Sphere(5e-3),
        vc.Layered([vc.Layer(0.5e-3, rubber)], base="rigid"),
        vc.triangle(1.0, rise=2.0),
        vc.Grid((72, 72), (2.2e-3, 2.2e-3)),
        fine,
        fields="none",
        errors=False,
    )
    approach = run.approach.values[::4]
    record = vc.ContactRecord(times, force, approach + noise(5, approach))
    change = {key.replace("material", "material.layers[1]"): v for key, v in OF_ZENER.items()}
    require_recovered(vc.fit_case(case, record, change))


def test_wavy_ball_is_recovered_under_a_prescribed_approach(tmp_path: Path) -> None:
    case = written(
        tmp_path,
        f"""
indenter:
  - {{shape: sphere, radius: 5 mm}}
  - {{shape: waviness, amplitude: 3 um, wavelength_x: 0.4 mm, wavelength_y: 0.4 mm}}
material: {{{LAW}, poisson_ratio: 0.45}}
load: {{kind: step, approach: 40 um}}
time: {{end: 4 s, steps: 20}}
grid: {{shape: [48, 48], size: [1.6 mm, 1.6 mm]}}
""",
    )
    fine = np.linspace(0.0, 4.0, 81)
    run = vc.simulate(
        vc.Sphere(5e-3) + vc.Waviness(3e-6, 0.4e-3, 0.4e-3),
        vc.Material(vc.Zener(**ZENER), poisson_ratio=0.45),
        vc.ApproachHistory([0.0, 1.0, 4.0], [0.0, 40e-6, 40e-6]),
        vc.Grid((96, 96), (1.6e-3, 1.6e-3)),
        fine,
        fields="none",
        errors=False,
    )
    times, force = fine[::4], run.force.values[::4]
    approach = 40e-6 * np.minimum(times, 1.0)
    record = vc.ContactRecord(times, force + noise(6, force), approach)
    require_recovered(vc.fit_case(case, record, OF_ZENER))
