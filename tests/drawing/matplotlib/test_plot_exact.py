"""Figure of a sphere with the exact solution, and its refusals."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from synthetic_results import FORCE, RADIUS, SHEAR_MODULUS, VISCOSITY, maxwell_sphere, roller
from viscontact import reference
from viscontact.plot import FIGURES
from viscontact.results.descriptions import describe

TAU = VISCOSITY / SHEAR_MODULUS
MODULUS = 4 * SHEAR_MODULUS  # E* = 2G/(1 - nu), nu = 1/2
TIMES = (0.0, 20.0, 50.0, 90.0, 120.0, 160.0)


def with_case(results: xr.Dataset, **parts: Any) -> xr.Dataset:
    case = json.loads(results.attrs["case"]) | {k: describe(v) for k, v in parts.items()}
    return results.assign_attrs(case=json.dumps(case))


def computed(radius: np.ndarray, times: tuple[float, ...] = TIMES, **parts: Any) -> xr.Dataset:
    """A run whose contact radius is given, and whose approach is a²/R."""
    run = maxwell_sphere(times, cells=8, fields=False)
    run["contact_area"][:] = np.pi * radius**2
    run["approach"][:] = radius**2 / RADIUS
    return with_case(run, **parts)


def lines(results: xr.Dataset, panel: int) -> list[np.ndarray]:
    """Curves of a panel, in the unit of its axis: those of theory first."""
    axes = FIGURES["exact"](results).axes[panel]
    return [np.asarray(line.get_ydata()) for line in axes.get_lines()]


def legend(results: xr.Dataset) -> list[str]:
    [key] = FIGURES["exact"](results).legends
    return [text.get_text() for text in key.get_texts()]


@pytest.mark.slow
def test_elastic_sphere_is_compared_with_hertz_under_any_load() -> None:
    load = vc.triangle(FORCE, 100.0, 100.0)
    force = load.force_at(TIMES)
    radius = np.cbrt(3 * RADIUS * force / (4 * MODULUS))  # Johnson, eq. 4.22
    body = vc.Material(vc.Elastic(SHEAR_MODULUS), 0.5)
    run = computed(radius, load=load, material=body)
    theory, ours = lines(run, 0)
    np.testing.assert_allclose(theory, ours, rtol=1e-5, atol=1e-9)
    with np.errstate(divide="ignore", invalid="ignore"):
        peak = np.where(force > 0, 3 * force / (2 * np.pi * radius**2), 0.0)
    np.testing.assert_allclose(lines(run, 2)[0] * 1e6, peak, rtol=1e-4)
    assert legend(run)[0] == "paraboloid (Hertz)"


def test_unloaded_creeping_sphere_is_compared_with_ting() -> None:
    load = vc.triangle(FORCE, 80.0, 80.0)
    theory = reference.ting_force_triangle(FORCE, 80.0, RADIUS, MODULUS, TAU)
    run = computed(np.asarray(theory.contact_radius(np.array(TIMES))), load=load)
    run["approach"][:] = theory.approach(np.array(TIMES))
    for panel, unit in ((0, "[µm]"), (1, "[µm]")):
        drawn, ours = lines(run, panel)
        # The reference's own steps; the paths into and out of contact are roots of time.
        np.testing.assert_allclose(drawn, ours, atol=2e-4 * ours.max())
        assert unit in FIGURES["exact"](run).axes[panel].get_ylabel()
    assert legend(run)[0] == "paraboloid (Ting)"


def test_difference_is_given_in_percent_of_the_largest() -> None:
    times = (0.0, 10.0, 100.0, 300.0)
    growth = np.cbrt(1 + np.array(times) / TAU)
    radius = np.cbrt(3 * RADIUS * FORCE / (4 * MODULUS)) * growth
    run = computed(1.01 * radius, times)
    run["approach"][:] = radius**2 / RADIUS
    differences = lines(run, 3)
    np.testing.assert_allclose(differences[0], growth / growth[-1], rtol=1e-6)
    np.testing.assert_allclose(differences[1], 0.0, atol=1e-8)
    assert legend(run)[0] == "paraboloid (Lee–Radok)"


def test_force_is_compared_where_the_approach_is_given() -> None:
    load = vc.ApproachHistory([0.0, 100.0, 200.0], [0.0, 1e-5, 0.0])
    body = vc.Material(vc.Elastic(SHEAR_MODULUS), 0.5)
    depth = load.approach_at(TIMES)
    run = computed(np.sqrt(RADIUS * depth), load=load, material=body)
    run["force"][:] = 4 / 3 * MODULUS * np.sqrt(RADIUS) * depth**1.5
    theory, ours = lines(run, 1)
    np.testing.assert_allclose(theory, ours, rtol=1e-5, atol=1e-9)
    assert legend(run)[2] == "force"


def test_case_without_exact_solution_is_refused_with_another_figure() -> None:
    sphere = maxwell_sphere(cells=8)
    swing = vc.harmonic(10.0, 5.0, 10.0, 3)
    beside = vc.step(FORCE, eccentricity_x=1e-4)
    for run, said in (
        (roller(), "a sphere or a round paraboloid, .* got a Roller"),
        (with_case(sphere, load=swing), "straight pieces, .* got a HarmonicHistory"),
        (with_case(sphere, load=beside), "load on the axis, got eccentricity x"),
        (with_case(sphere, indenter=vc.Paraboloid(1e-2, 2e-2)), "got a Paraboloid"),
    ):
        with pytest.raises(ValueError, match=f"^exact: needs .*{said}.*; draw history instead"):
            FIGURES["exact"](run)
