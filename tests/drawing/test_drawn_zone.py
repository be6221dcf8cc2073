"""The cohesive zone of bodies that adhere, in pressure maps."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text

import viscontact as vc
from closeness import close_to
from viscontact.drawing.content.map import maps_over
from viscontact.results.snapshots import take_snapshots


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    """A sphere at no load, of a Tabor number of 1."""
    gel, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((48, 48), (24e-6, 24e-6))
    adhesion = vc.Adhesion(0.02, range=2e-7)
    return vc.simulate(
        *(vc.Sphere(2e-5), gel, vc.ApproachHistory([0.0, 1.0], [0.0, 0.0]), grid, [0.0, 1.0]),
        adhesion=adhesion,
        errors=False,
    )


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_zone_is_where_more_than_a_hundredth_of_the_strength_pulls(ds: xr.Dataset) -> None:
    """An exponential law: its strength is work over range, 100 kPa."""
    [shown] = take_snapshots(ds, [1.0], "map")
    pulls = ~shown.in_contact & (shown.pressure < -0.01 * 0.02 / 2e-7)
    np.testing.assert_array_equal(shown.in_zone, pulls)
    assert shown.in_zone.sum() * shown.grid.cell_area == close_to(float(ds.tensile_area[-1]))


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_maps_show_all_of_the_zone_and_say_what_it_is(ds: xr.Dataset) -> None:
    maps = maps_over(ds)
    x_low, x_high, *_ = maps.snapshots[-1].extent()
    assert x_high - x_low > 1.5 * float(ds.contact_length[-1])
    assert maps.window.x[0] < x_low
    assert "cohesive zone" in maps.zone_note
    shown = maps.snapshots[-1].in_contact | maps.snapshots[-1].in_zone
    assert np.isfinite(maps.cells(-1, 100)).sum() == shown.sum()
    figure = vc.plot.pressure_map(ds)
    assert maps.zone_note in [text.get_text() for text in figure.findobj(Text)]


def test_bodies_that_do_not_adhere_have_no_zone() -> None:
    gel, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((24, 24), (2e-3, 2e-3))
    ds = vc.simulate(vc.Sphere(0.01), gel, vc.step(0.1), grid, [1.0], errors=False)
    maps = maps_over(ds)
    assert not maps.snapshots[0].in_zone.any()
    assert maps.zone_note == ""
