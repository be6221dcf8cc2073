"""Results of runs under a temperature: recorded laws, exact solutions and stresses on the clock."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.clock import TIME, ReducedTime
from viscontact.drawing.content.exact_history import exact_history, exact_panels
from viscontact.results.recorded_objects import (
    recorded_clock,
    recorded_object,
    recorded_temperature,
)

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

BALL, GRID = vc.Sphere(0.01), vc.Grid((32, 32), (4e-3, 4e-3))
WLF = vc.WLF(293.15, 8.86, 101.6)
RUBBER = vc.Material(vc.Zener(1e6, 3e5, 1e6), 0.5, shift=WLF)
WARMING = vc.TemperatureHistory([0.0, 10.0], [293.15, 313.15])


def run(material: Any, temperature: Any, times: Any, **others: Any) -> xr.Dataset:
    load = others.pop("load", vc.step(0.1))
    options = {"errors": False, "fields": "none", "temperature": temperature, **others}
    return vc.simulate(BALL, material, load, GRID, times, **options)


def test_recorded_law_is_that_of_the_run() -> None:
    warm = run(RUBBER, 313.15, [0.0, 1.0])
    assert recorded_object(warm, "material", "creep") == RUBBER.at(313.15)
    assert recorded_temperature(warm) == vc.TemperatureHistory([0.0], 313.15)
    assert recorded_clock(warm, "material", "creep") is TIME
    varied = run(RUBBER, WARMING, [0.0, 1.0])
    assert recorded_object(varied, "material", "creep") == RUBBER
    assert recorded_clock(varied, "material", "creep") == ReducedTime(WARMING, WLF)
    plain = run(RUBBER, None, [0.0, 1.0])
    assert recorded_temperature(plain) is None
    assert recorded_clock(plain, "material", "creep") is TIME


@pytest.mark.parametrize("load", [vc.step(0.1), vc.ramp(0.1, 5.0), vc.step(approach=1e-4)])
def test_exact_history_follows_the_clock(load: vc.LoadHistory) -> None:
    ds = run(RUBBER, WARMING, vc.uniform_times(10.0, 40), load=load)
    exact = exact_history(ds, "exact")
    grown = np.sqrt(ds.contact_area.values[1:] / np.pi)
    np.testing.assert_allclose(exact.contact_radius[1:], grown, rtol=0.03)
    forces = exact.force, ds.force.values
    np.testing.assert_allclose(forces[0][1:], forces[1][1:], rtol=0.03)
    # Without the clock it would be off by far more than cells and steps are.
    if isinstance(load, vc.ForceHistory):
        at_once = exact.approach[1:] / exact.approach[-1]
        np.testing.assert_allclose(at_once, ds.approach[1:] / ds.approach[-1], atol=5e-3)
    assert exact_panels(ds, None)


def test_exact_history_needs_one_clock() -> None:
    other = vc.Material(RUBBER.law, 0.5, shift=vc.Arrhenius(293.15, 80e3))
    ds = run(RUBBER, WARMING, [0.0, 1.0], indenter_material=other)
    with pytest.raises(ValueError, match="needs bodies whose creep follows one clock"):
        exact_history(ds, "exact")


def test_stresses_of_layers_follow_the_clock() -> None:
    steel = vc.Material(vc.Elastic(5e6), 0.3)
    cover = vc.Layered([vc.Layer(1e-3, RUBBER)], steel)
    times = np.array([0.0, 2.0, 5.0, 10.0])
    warm = run(cover, WARMING, times, fields="all", tolerance=1e-9)
    plain = vc.Material(RUBBER.law, 0.5)
    reduced = ReducedTime(WARMING, WLF).reduced(times)
    at = run(vc.Layered([vc.Layer(1e-3, plain)], steel), None, reduced, fields="all")
    found, expected = (vc.interface_stresses(ds) for ds in (warm, at))
    for name in ("largest_interface_shear_stress", "interface_normal_stress"):
        if name in found:
            scale = float(np.abs(expected[name]).max())
            difference = np.abs(found[name].values - expected[name].values).max() / scale
            assert difference == close_to(0.0, abs=0.01)
    assert "interface_normal_stress" in found
