"""Figures of leakage against the flow that they draw."""

from __future__ import annotations

import numpy as np
import pytest

import synthetic_results
import viscontact as vc
from closeness import close_to
from viscontact.drawing.content.given_pressure import pressure_panels
from viscontact.drawing.content.leak import leak_map, leak_panels, shown_leakage

# Few cells are enough here.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def test_map_shows_contact_flow_and_constriction_in_their_places() -> None:
    ds = synthetic_results.ellipse()
    shown = leak_map(ds, None, "y", "leak-channel")
    last = ds.isel({str(ds.pressure.dims[0]): -1})
    np.testing.assert_array_equal(shown.touched, last.pressure.values > 0)
    assert np.isnan(shown.flow[shown.touched]).all()
    assert np.nanmax(shown.flow) == close_to(1.0)
    assert shown.constriction is not None
    i, j = (
        np.abs(shown.x - shown.constriction[0]).argmin(),
        np.abs(shown.y - shown.constriction[1]).argmin(),
    )
    assert not shown.touched[i, j]
    assert "flow along y" in shown.heading


def test_given_pressure_is_drawn_through_its_largest_value() -> None:
    body, grid = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5), vc.Grid((6, 8), (3e-3, 2e-3))
    pressure = np.arange(48.0).reshape(6, 8)
    ds = vc.under_pressure(pressure, body, grid, [0.0, 1.0, 2.0])
    above, below = pressure_panels(ds, [2.0], "y", "given-pressure")
    np.testing.assert_array_equal(above.curves[0].y, pressure[5])
    np.testing.assert_array_equal(below.curves[0].y, ds.displacement[2, 5])
    assert below.y.is_reversed
    with pytest.raises(ValueError, match="along must be"):
        vc.plot.given_pressure(ds, along="z")
    with pytest.raises(ValueError, match="give a result of"):
        vc.plot.given_pressure(ds[["force"]])


def test_map_of_several_instants_is_refused() -> None:
    ds = synthetic_results.ellipse()
    with pytest.raises(ValueError, match="shows one"):
        vc.plot.leak_channel(ds, times=[0.0, 1.0])
    with pytest.raises(ValueError, match="along must be"):
        vc.plot.leak_channel(ds, along="z")


def test_panels_show_rate_error_and_the_instant_of_closing() -> None:
    grid = vc.Grid((6, 32), (1e-4, 1e-4), periodic=True)
    steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
    load, waves = vc.ramp(2e9 * grid.area, 1.0), vc.Waviness(1e-6, wavelength_y=1e-4)
    ds = vc.simulate(waves, steel, load, grid, [0.0, 0.25, 0.5], errors=False)
    leak = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e5, along="both")
    rate, gaps = leak_panels(leak, "x")
    np.testing.assert_allclose(rate.curves[0].y, leak.leak_rate.sel(direction="x"))
    assert [curve.name for curve in gaps.curves] == ["critical gap", "effective gap", "mean gap"]
    across, _ = leak_panels(leak, "y")
    assert [mark.text for mark in across.marks] == ["closed"]
    assert across.marks[0].place == 0.25


def test_rate_over_force_and_over_area_has_the_values_over_time() -> None:
    leak = vc.leakage(synthetic_results.ellipse(), viscosity=1.0, along="y")
    leak = leak.assign(force=("time", np.arange(1.0, leak.sizes["time"] + 1)))
    for over, name in (("force", "force"), ("area", "area_fraction")):
        rate, gaps = leak_panels(leak, "y", over)
        np.testing.assert_array_equal(rate.curves[0].x, leak[name])
        np.testing.assert_allclose(rate.curves[0].y, leak.transmissivity)
        np.testing.assert_array_equal(gaps.curves[0].x, leak[name])
    with pytest.raises(ValueError, match="over must be"):
        leak_panels(leak, "y", "place")


def test_rate_of_a_result_is_that_of_its_leakage() -> None:
    ds = synthetic_results.ellipse()
    of_result = shown_leakage(ds, None, "y", "leak-rate")
    found = vc.leakage(ds, viscosity=1.0, along="y")
    np.testing.assert_array_equal(of_result.transmissivity, found.transmissivity)
    last = float(found.time[-1])
    assert shown_leakage(ds, [last], "y", "leak-rate").time.values.tolist() == [last]
    assert shown_leakage(found, [last], "y", "leak-rate").time.values.tolist() == [last]
    with pytest.raises(ValueError, match="along must be"):
        shown_leakage(ds, None, "z", "leak-rate")


def test_pressure_of_the_fluid_falls_along_the_flow() -> None:
    ds = synthetic_results.ellipse()
    shown = leak_map(ds, None, "y", "fluid-pressure")
    along = np.nanmean(shown.pressure, axis=0)
    assert along[0] > 0.9
    assert along[-1] < 0.1
    assert shown.difference is None
    assert np.isnan(shown.pressure[shown.touched]).all()
    panel, scale = vc.plot.fluid_pressure(ds, along="y").axes
    assert scale.get_ylabel() == "Fluid pressure over its difference [-]"
    assert "flow along y" in panel.get_title(loc="left")


def test_result_with_scalars_of_its_leakage_is_drawn_from_its_gap() -> None:
    ds = synthetic_results.ellipse()
    stored = ds.assign(transmissivity=("time", np.ones(ds.sizes["time"])))
    of_result = shown_leakage(stored, None, "y", "leak-rate")
    np.testing.assert_array_equal(
        of_result.transmissivity, shown_leakage(ds, None, "y", "leak-rate").transmissivity
    )
