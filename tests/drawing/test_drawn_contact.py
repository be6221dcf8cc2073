"""Figures show the cells in contact as the result marks them, whatever the sign of the pressure."""

from __future__ import annotations

import numpy as np
import xarray as xr

from returned import some
from synthetic_results import ellipse
from viscontact.drawing.content.contact_area import area_panel
from viscontact.drawing.content.contact_curve import contact_panels, pressure_curve
from viscontact.drawing.content.history import drawn_scalars, response_names
from viscontact.drawing.content.map import maps_over
from viscontact.results.contact_spots import contact_spots


def adhering() -> xr.Dataset:
    """Elliptic contact whose outer part is in tension, as under adhesion."""
    ds = ellipse()
    touched = ds.pressure > 0
    pulled = ds.pressure.where(ds.pressure > 1.2e6, -0.3e6).where(touched, 0.0)
    return ds.assign(pressure=pulled, in_contact=touched.astype("i1"))


def test_counted_area_includes_cells_in_tension() -> None:
    ds = adhering()
    counted, _ = area_panel(ds, None, "contact-area").curves
    cell = float(ds.x[1] - ds.x[0]) * float(ds.y[1] - ds.y[0])
    np.testing.assert_allclose(counted.y, cell * ds.in_contact.sum(["x", "y"]))
    assert ((ds.pressure > 0).sum(["x", "y"]) < ds.in_contact.sum(["x", "y"])).all()


def test_outline_lies_around_the_cells_in_tension() -> None:
    both = zip(maps_over(adhering()).maps, maps_over(ellipse()).maps, strict=True)
    for pulled, pressed in some(both):
        [outline], [expected] = pulled.outline, pressed.outline
        np.testing.assert_array_equal(outline, expected)


def test_map_and_curves_show_contact_without_pressure() -> None:
    # Between pressure and tension a cell in contact may have none.
    ds = adhering()
    ds["pressure"][-1] = ds.pressure[-1].where(ds.pressure[-1] >= 0, 0.0)
    maps = maps_over(ds)
    (x, y), shown = maps.inside, np.isfinite(maps.cells(len(maps.maps) - 1, most=10**6))
    touched = maps.snapshots[-1].in_contact
    np.testing.assert_array_equal(shown, touched[x, y])
    curve = pressure_curve(ds, "x", None, "pressure-profile")
    (panel,) = contact_panels(ds, curve, [float(ds.time[-1])])
    positions, on_line = maps.snapshots[-1].contact_section("x")
    drawn = panel.curves[0].x[np.isfinite(panel.curves[0].y)]
    cell = positions[1] - positions[0]
    ends = positions[on_line][[0, -1]] + [-cell, cell]
    np.testing.assert_allclose(drawn[[0, -1]], ends)


def test_window_and_nominal_area_include_cells_in_tension() -> None:
    assert maps_over(adhering()).window == maps_over(ellipse()).window
    # The nominal area is not less than the real one, which is left out.
    pulled, pressed = (
        contact_spots(each.assign(contact_area=0 * each.contact_area))
        for each in (adhering(), ellipse())
    )
    assert (pulled.nominal_area > 0).all()
    xr.testing.assert_identical(pulled, pressed)


def test_area_is_drawn_between_the_given_instants() -> None:
    smooth, counted = area_panel(ellipse(), [0.0, 2.5], "contact-area").curves
    assert smooth.x.tolist() == counted.x.tolist() == [0.0, 2.0]


def test_rounding_of_a_resistance_across_the_motion_has_no_panel() -> None:
    # A force of 10 N, whose resistance along x is 1 N, and along y 5e-20 N.
    times = np.linspace(0.0, 1.0, 5)
    values = {"force": 10.0, "resistance_x": 1.0, "resistance_y": 5e-20, "position_x": times}
    run = xr.Dataset(
        {name: ("time", np.broadcast_to(value, 5) * times) for name, value in values.items()}
        | {name: ("time", np.zeros(5)) for name in ("position_y", "tilt_x", "tilt_y")}
        | {name: ("time", np.full(5, 1e-3)) for name in ("contact_length", "approach")},
        {"time": times},
    )
    printed = drawn_scalars({"": run})
    assert "resistance_x" in printed
    assert "resistance_y" not in printed
    assert "resistance_y" not in response_names(run)
