"""Figures of contacts under friction: stick and slip, tractions, loops, slip over time."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.quiver import Quiver

import viscontact as vc
from closeness import close_to
from synthetic_results import CYCLE_HEAT, GRIP, STICK, gripping_sphere, maxwell_sphere
from viscontact import plot
from viscontact.report.slip_chapter import sliding_text, slip_facts
from viscontact.results.fretting import archard_wear, fretting_cycles, sliding_begins


@pytest.fixture(scope="module")
def sphere() -> xr.Dataset:
    return gripping_sphere()


def test_the_map_shows_ring_and_tractions(sphere: xr.Dataset) -> None:
    """At the largest force cells beyond the stick radius slip, and arrows have its direction."""
    figure = plot.stick_map(sphere, times=[2.0])
    (axes,) = figure.axes
    cells, arrows = axes.collections
    drawn = np.ma.filled(cells.get_array(), 0)
    state = sphere.slip_state.sel(time=2.0).values
    np.testing.assert_array_equal(drawn, state.T)
    share = float((state == 1).sum() / (state > 0).sum())
    assert share == close_to(STICK**2, abs=0.02)
    assert isinstance(arrows, Quiver)
    assert arrows.N > 100
    assert (arrows.U > 0).all()
    assert not arrows.V.any()
    # In the unit of the axes, where the tractions are those of the cells there.
    x, y = arrows.XY.T * 1e-6
    assert axes.get_xlabel() == "x [µm]"
    there = sphere.traction_x.sel(time=2.0).sel(
        x=xr.DataArray(x), y=xr.DataArray(y), method="nearest"
    )
    np.testing.assert_allclose(arrows.U, there)


def test_by_default_a_cycle_is_shown(sphere: xr.Dataset) -> None:
    figure = plot.stick_map(sphere)
    assert [axes.get_title(loc="left").split("\n")[-1] for axes in figure.axes] == [
        f"t = {each} s" for each in (2, 3, 4, 5)
    ]


def test_the_profile_stays_between_friction_times_pressure(sphere: xr.Dataset) -> None:
    axes = plot.traction_profile(sphere, times=[2.0, 4.0], at=0.0).axes[0]
    lines = axes.get_lines()
    assert len(lines) == 6
    for traction, upper, lower in (lines[:3], lines[3:]):
        inside = np.isfinite(traction.get_ydata())
        values, most = (np.asarray(each.get_ydata())[inside] for each in (traction, upper))
        np.testing.assert_allclose(np.asarray(lower.get_ydata())[inside], -most)
        assert (np.abs(values) <= most * (1 + 1e-9)).all()
        assert np.abs(values).max() == close_to(most[np.abs(values).argmax()], rel=1e-9)
    pressure = sphere.pressure.sel(time=2.0).values
    assert np.nanmax(lines[1].get_ydata()) == close_to(GRIP * pressure.max() * 1e-6, rel=2e-3)
    assert axes.get_ylabel() == "Traction along x [MPa]"


def test_loops_are_named_by_their_heat(sphere: xr.Dataset) -> None:
    """One cycle from 2 s, where the force turns back first, to 6 s."""
    (cycle,) = fretting_cycles(sphere, "test")
    assert (cycle.begin, cycle.end) == (2.0, 6.0)
    assert cycle.heat == close_to(CYCLE_HEAT, rel=1e-9)
    figure = plot.fretting_loop(sphere)
    whole, loop = figure.axes[0].get_lines()
    assert len(whole.get_xdata()) == sphere.sizes["time"]
    np.testing.assert_allclose(loop.get_xdata(), [976, 0, -976, 0, 976], atol=1e-12)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["cycle 1: 4 µJ"]


def test_slip_over_time_is_the_largest_of_the_cells(sphere: xr.Dataset) -> None:
    fraction, slip = plot.slip_history(sphere).axes
    np.testing.assert_allclose(
        fraction.get_lines()[0].get_ydata(), 100 * sphere.slip_fraction.values
    )
    largest = np.abs(sphere.slip_x).max(("x", "y"))
    np.testing.assert_allclose(slip.get_lines()[0].get_ydata(), 1e9 * largest)
    assert slip.get_ylabel() == "Slip [nm]"
    without = plot.slip_history(gripping_sphere(fields=False))
    assert len(without.axes) == 1


@pytest.mark.parametrize("name", ["stick-map", "traction-profile", "fretting-loop", "slip-history"])
def test_runs_without_friction_are_refused(name: str) -> None:
    with pytest.raises(ValueError, match=f"{name}: needs a run under friction, got one without"):
        plot.FIGURES[name](maxwell_sphere(cells=8))


def test_a_map_without_fields_says_how_to_store_them() -> None:
    with pytest.raises(ValueError, match="run again with fields stored"):
        plot.stick_map(gripping_sphere(cells=8, fields=False))


def test_the_report_states_sliding_heat_slip_and_wear(sphere: xr.Dataset) -> None:
    """Archard: k ∫ p ds, so k/μ of the work of friction."""
    assert sliding_text(sphere) == (
        "The contact never slides as a whole: at most 0.36 of it slips, at t = 2 s."
    )
    facts = dict(slip_facts(sphere))
    assert facts["Heat of friction"] == "8 µJ"
    assert facts["Heat of cycle 1, the last"] == "4 µJ"
    assert facts["Largest slip of a cell"].endswith("nm at t = 2 s")
    wear = archard_wear(sphere, "test")
    assert wear is not None
    assert wear.depth is not None
    assert wear.volume == close_to(3e-15 / GRIP * 2 * CYCLE_HEAT, rel=1e-12)
    assert facts["Worn volume (Archard)"] == "0.08 µm³"
    last = float(sphere.friction_work.isel(time=-1).max())
    assert wear.depth == close_to(3e-15 / GRIP * last, rel=1e-12)


def test_the_report_states_when_all_slides(sphere: xr.Dataset) -> None:
    slides = sphere.copy()
    slides["slip_fraction"] = sphere.slip_fraction.where(sphere.time < 4, 1.0)
    assert sliding_begins(slides) == 4.0
    assert sliding_text(slides) == "The whole contact slides, first at t = 4 s."


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_a_roller_with_a_creepage_has_its_stick_map_and_report():
    """It has no tangential load, whose cycles these show."""
    rubber, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((12, 16), (3e-3, 4e-3))
    ds = vc.simulate(
        vc.Paraboloid(0.01, 0.01),
        rubber,
        vc.step(0.05, tilt_x=0.0, tilt_y=0.0),
        grid,
        [0.0, 0.5, 1.0],
        friction=0.3,
        motion=vc.Travel([0.0, 1.0], y=[0.0, 5e-4], creepage=0.02),
        errors=False,
    )
    assert fretting_cycles(ds, "stick-map") == ()
    shown = vc.plot.stick_map(ds)
    assert len(shown.axes) == 2  # the instants under traction


@pytest.fixture(scope="module")
def rolling() -> xr.Dataset:
    """A ball at two speeds under three creepages, the last of which makes it slide."""
    ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    return vc.steady(
        *(ball, vc.Material(vc.Elastic(1e6), 0.5), load, [0.01, 0.1]),
        grid=vc.Grid((24, 24), (3.4e-3, 3.4e-3)),
        friction=0.5,
        creepage=[0.2, -0.02, 0.05],
        errors=False,
    )


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_steady_motion_is_shown_under_its_creepages(rolling: xr.Dataset) -> None:
    """In order at one speed; of several speeds and of a chosen creepage one each."""
    figure = plot.stick_map(rolling)
    assert [axes.get_title(loc="left").split("\n")[-1] for axes in figure.axes] == [
        f"100 mm/s, creepage {each} %" for each in (-2, 5, 20)
    ]
    for axes, creepage in zip(figure.axes, (-0.02, 0.05, 0.2), strict=True):
        state = rolling.slip_state.sel(speed=0.1, creepage=creepage).values
        np.testing.assert_array_equal(np.ma.filled(axes.collections[0].get_array(), 0), state.T)
        # A body that brakes is pulled back by the surface, towards its motion along +y.
        assert (np.sign(axes.collections[1].V) == -np.sign(creepage)).all()
    lines = plot.traction_profile(rolling, at=0.0).axes[0].get_lines()
    assert [each.get_label() for each in lines[::3]] == [
        f"100 mm/s, {each} %" for each in (-2, 5, 20)
    ]
    slides, low = (np.asarray(each.get_ydata()) for each in (lines[6], lines[8]))
    # Beside the middle tractions turn a little to the side.
    np.testing.assert_allclose(slides, low, rtol=1e-4)
    assert len(plot.stick_map(rolling, times=[0.01, 0.1]).axes) == 2
    chosen = plot.stick_map(rolling.sel(creepage=0.05), times=[0.01])
    (axes,) = chosen.axes
    assert axes.get_title(loc="left").endswith("10 mm/s, creepage 5 %")


def test_figures_over_time_name_those_of_steady_motion(rolling: xr.Dataset) -> None:
    for draw in (plot.fretting_loop, plot.slip_history):
        with pytest.raises(ValueError, match=r"steady motion.*draw traction-creepage, stick-map"):
            draw(rolling)
    free = rolling.drop_vars("slip_fraction")
    with pytest.raises(ValueError, match="give friction and creepages of the motion"):
        plot.stick_map(free)
