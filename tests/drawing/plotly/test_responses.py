"""Figures of a sweep: largest values over a key, with errors and the allowable limit."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go
import pytest
import xarray as xr

from closeness import close_to
from synthetic_sweeps import hertz_sweep, listed
from viscontact.drawing.plotly.responses import responses

FORCES = [1e3, 8e3, 2e3]


def figure(ds: xr.Dataset, name: str) -> go.Figure:
    return next(each for each in responses(ds) if each.layout.meta["name"] == f"response-{name}")


def test_a_curve_goes_over_the_key_in_its_order_with_its_errors() -> None:
    found = figure(hertz_sweep(load__force=(FORCES, "N")), "approach")
    (curve,) = found.data
    assert curve.x.tolist() == [1.0, 2.0, 8.0]  # kN
    exact = np.array([1e3, 2e3, 8e3]) ** (2 / 3)  # the approach is F**(2/3) µm
    np.testing.assert_allclose(curve.y, exact, rtol=1e-6)
    np.testing.assert_allclose(curve.error_y.array, 0.1 * exact, rtol=1e-6)
    assert found.layout.meta["title"] == "Approach [µm]"
    assert found.layout.xaxis.title.text == "Load force [kN]"
    assert [text.split(":")[0] for text in curve.text] == ["run 0", "run 2", "run 1"]


def test_a_second_key_has_a_curve_for_each_of_its_values() -> None:
    ds = hertz_sweep(load__force=(FORCES, "N"), indenter__radius=([0.01, 0.08], "m"))
    found = figure(ds, "approach")
    assert [curve.name for curve in found.data] == ["10 mm", "80 mm"]
    assert found.layout.showlegend
    ratio = np.asarray(found.data[0].y) / np.asarray(found.data[1].y)
    np.testing.assert_allclose(ratio, 2.0, rtol=1e-6)  # R**(-1/3)


def test_runs_that_are_no_grid_are_points_over_each_key() -> None:
    ds = listed(hertz_sweep(load__force=(FORCES, "N"), indenter__radius=([0.01, 0.08], "m")))
    names = [each.layout.meta["name"] for each in responses(ds)]
    assert names[:2] == ["response-approach-0", "response-approach-1"]
    assert {each.data[0].mode for each in responses(ds)} == {"markers"}


def test_the_allowable_value_is_a_line_and_what_exceeds_it_is_red() -> None:
    ds = hertz_sweep(load__force=(FORCES, "N"))
    # Peaks of 10, 12.6 and 20 MPa with errors of a tenth: 18 MPa is the least of the last one.
    for limit, red in ((17.9e6, [[8.0]]), (18.1e6, [])):
        ds.attrs["allowable"] = f'{{"peak_pressure": {{"limit": {limit}}}}}'
        found = figure(ds, "peak_pressure")
        (line,) = found.layout.shapes
        assert line.y0 == line.y1 == close_to(limit / 1e6)
        (words,) = found.layout.annotations
        assert words.text == f"allowable {limit / 1e6:g} MPa"
        _, *over = found.data
        assert [each.x.tolist() for each in over] == red
        assert not figure(ds, "approach").layout.shapes
    ds.attrs["allowable"] = '{"peak_pressure": {"limit": 1e9}}'
    far = figure(ds, "peak_pressure").layout
    assert not far.shapes
    assert far.meta["note"] == "allowable 1 GPa: beyond the figure"


def test_values_on_the_mesh_are_hollow_and_runs_without_a_result_crosses() -> None:
    ds = hertz_sweep(load__force=(FORCES, "N"))
    ds["peak_pressure_error"][0] = np.inf
    ds["state"] = "load.force", ["done", "failed", "done"]
    for name in ("approach", "contact_area", "peak_pressure", "force"):
        ds[name][1] = np.nan
    curve, hollow, cross = figure(ds, "peak_pressure").data
    assert np.isfinite(curve.y).tolist() == [False, True, False]
    assert (hollow.marker.symbol, hollow.x.tolist()) == ("circle-open", [1.0])
    assert (cross.marker.symbol, cross.x.tolist(), cross.yaxis) == ("x-thin-open", [8.0], "y2")
    assert cross.text == ("run 1: no result",)


def test_names_of_runs_and_values_cannot_carry_markup() -> None:
    ds = hertz_sweep(material=(["<b>one", "two"], ""), load__force=([1e3, 2e3], "N"))
    assert {curve.name for curve in responses(ds)[0].data} == {"&lt;b&gt;one", "two"}


def test_a_sweep_without_response_is_refused() -> None:
    with pytest.raises(ValueError, match="no key is varied"):
        responses(hertz_sweep(load__force=([8e3], "N")))
