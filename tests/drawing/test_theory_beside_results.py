"""Persson's theory in figures of results: the numbers of Python, and what has no theory."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.drawing.content.contact_area import area_panel, pressure_panel, spots_panel
from viscontact.drawing.content.friction import friction_panel

# Few cells are enough here.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

GRID = vc.Grid((16, 16), (1e-3, 1e-3), periodic=True)
PHASE = 2 * np.pi * np.arange(16) / 16
MAP = vc.Surface(2e-6 * (np.cos(PHASE)[:, None] + np.sin(PHASE)), 1e-3 / 16, periodic=True)
STEEL = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
RUBBER = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)


@cache
def pressed(body: vc.Material = STEEL, held: bool = False) -> xr.Dataset:
    load = vc.step(0.02) if held else vc.ramp(0.02, 1.0)
    return vc.simulate(MAP, body, load, GRID, [0.0, 0.5, 1.0, 2.0], errors=False)


def test_area_is_that_of_the_theory_of_the_map() -> None:
    run = pressed()
    panel = pressure_panel(run, None, "area-pressure", theory=True)
    theory, computed = panel.curves
    pressures = np.array([0.01, 0.02]) / GRID.area
    expected = vc.surfaces.persson_area(MAP, STEEL, pressures)
    np.testing.assert_allclose(theory.y, [0.0, *expected, expected[1]], rtol=1e-6)
    np.testing.assert_allclose(computed.y, run.contact_area / GRID.area)
    assert len(pressure_panel(run, None, "area-pressure", theory=False).curves) == 1
    over_time = area_panel(run, [0.4, 1.1], "contact-area", theory=True).curves[1]
    np.testing.assert_allclose(over_time.y, expected * GRID.area, rtol=1e-6)
    names = [curve.name for curve in spots_panel(run, [1.0], "contact-spots", theory=True).curves]
    assert f"(theory {100 * expected[1]:.3g}" in names[0]


def test_force_that_is_held_has_the_modulus_of_its_time() -> None:
    theory, _ = pressure_panel(pressed(RUBBER, True), None, "area-pressure", theory=True).curves
    last = vc.surfaces.persson_area(MAP, RUBBER, 0.02 / GRID.area, 2.0)
    np.testing.assert_allclose(theory.y.max(), last, rtol=1e-6)


def test_friction_has_the_band_of_the_theory() -> None:
    load, speeds = vc.step(0.02, tilt_x=0.0, tilt_y=0.0), [1e-3, 0.1]
    run = vc.steady(MAP, RUBBER, load, speeds, grid=GRID, errors=False)
    (band,) = friction_panel(run, theory=True).bands
    expected = vc.surfaces.persson_sliding(MAP, RUBBER, 0.02 / GRID.area, speeds)
    np.testing.assert_allclose(band.low, expected.friction_coefficient, rtol=1e-5)
    np.testing.assert_allclose(band.high, expected.friction_coefficient_upper, rtol=1e-5)
    assert not friction_panel(run).bands


def test_what_has_no_theory_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match="the material creeps"):
        area_panel(pressed(RUBBER), None, "contact-area", theory=True)
    ball = vc.simulate(
        *(vc.Sphere(0.01), STEEL, vc.ramp(0.1, 1.0), vc.Grid((16, 16), (2e-3, 2e-3))),
        *([0.0, 0.5, 1.0],),
        errors=False,
    )
    with pytest.raises(ValueError, match="periodic along both axes"):
        vc.plot.area_pressure(ball)
    layered = vc.Layered([vc.Layer(1e-3, STEEL)], base="rigid")
    with pytest.raises(ValueError, match="theory is of half-spaces"):
        vc.plot.contact_spots(
            vc.simulate(MAP, layered, vc.step(0.02), GRID, [0.0], errors=False), theory=True
        )
