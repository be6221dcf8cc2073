"""Figures of moving contacts: direction of the motion, leading and trailing edge."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex
from matplotlib.text import Annotation

import viscontact as vc
from closeness import close_to
from viscontact.drawing.matplotlib.pressure.contact_curves import pressure_profile
from viscontact.drawing.matplotlib.pressure.pressure_map import pressure_map
from viscontact.plot import animation

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


@pytest.fixture(scope="module")
def moved() -> xr.Dataset:
    """A ball that moves against y, and is at rest at last."""
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e6), poisson_ratio=0.5)
    load = vc.step(0.2, tilt_x=0.0, tilt_y=0.0)
    grid = vc.Grid((16, 24), (1.6e-3, 2.4e-3), centre=(0.0, -3e-4))
    path = vc.Travel([0.0, 0.6], y=[0.0, -6e-4])
    ball = vc.Paraboloid(0.01, 0.01)
    times = [0.0, 0.3, 0.6, 0.9]
    return vc.simulate(ball, rubber, load, grid, times, motion=path, errors=False)


def test_profile_marks_the_leading_edge_in_the_direction_of_motion(moved: xr.Dataset) -> None:
    axes = pressure_profile(moved, times=[0.3]).axes[0]
    assert axes.get_xlabel() == "y [µm]"
    leading, trailing = axes.get_lines()[1:]
    ahead, behind = (np.asarray(each.get_xdata())[0] for each in (leading, trailing))
    pressed = moved.y.values[(moved.pressure.sel(time=0.3).values > 0).any(axis=0)] * 1e6
    assert ahead == close_to(pressed.min() - 50)
    assert behind == close_to(pressed.max() + 50)
    faces = [to_hex(each.get_markerfacecolor()) for each in (leading, trailing)]
    assert faces[1] == "#ffffff" != faces[0]


def test_body_at_rest_has_no_edges_marked(moved: xr.Dataset) -> None:
    assert len(pressure_profile(moved, times=[0.9]).axes[0].get_lines()) == 1
    assert len(pressure_profile(moved, times=[0.3], along="x").axes[0].get_lines()) == 1


def test_map_has_an_arrow_along_the_motion(moved: xr.Dataset) -> None:
    going, resting, _ = pressure_map(moved, times=[0.3, 0.9]).axes
    (arrow,) = (each for each in going.texts if isinstance(each, Annotation) and each.arrow_patch)
    # From the axis, which is at y = -0.3 mm.
    tail, head = going.transData.transform(arrow.xyann), arrow.xycoords.transform(arrow.xy)
    assert arrow.xyann == close_to((0.0, -0.3), abs=1e-9)
    assert head[0] == close_to(tail[0])
    assert head[1] < tail[1]
    assert not [each for each in resting.texts if getattr(each, "arrow_patch", None)]


def test_film_follows_the_body_and_marks_its_edges(moved: xr.Dataset) -> None:
    film = animation(moved, seconds=1.0, fps=4.0)
    surface = next(axes for axes in film.figure.axes if axes.get_ylabel() == "y [mm]")
    section = next(axes for axes in film.figure.axes if axes.get_xlabel() == "y [mm]")
    low, high = surface.get_ylim()
    for time, place in ((0.0, 0.0), (0.3, -0.3), (0.9, -0.6)):
        film.show(time)
        (cross,) = (line for line in surface.lines if line.get_marker() == "+")
        assert cross.get_ydata()[0] == close_to(place, abs=1e-9)
        assert low < place < high
        arrows = [each for each in surface.texts if getattr(each, "arrow_patch", None)]
        assert len(arrows) == (time < 0.9)  # at rest there is none
        _, leading, trailing = section.lines
        if time == 0.3:
            assert leading.get_xdata()[0] < place < trailing.get_xdata()[0]
        if time == 0.9:
            assert np.isnan(leading.get_xdata()[0])
