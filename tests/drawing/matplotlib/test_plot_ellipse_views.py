"""Figures in space and sections of animations: an ellipse beside the centre."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex

from closeness import close_to
from drawing.matplotlib.test_plot_ellipse import each_way, factor, level
from drawing.matplotlib.test_plot_solid import Caught, caught, with_dent
from synthetic_results import (
    ELLIPSE_AXES,
    ELLIPSE_MIDDLE,
    ELLIPSE_TIMES,
    ellipse,
    ellipse_growth,
)
from viscontact.drawing.matplotlib.layout import style
from viscontact.plot import FIGURES, animation

assert caught  # a fixture


@pytest.fixture(
    scope="module",
    params=[
        pytest.param(False, id="long in y"),
        pytest.param(True, id="long in x", marks=pytest.mark.slow),
    ],
)
def transposed(request: pytest.FixtureRequest) -> bool:
    return bool(request.param)


@pytest.fixture(scope="module")
def results(transposed: bool) -> xr.Dataset:
    return ellipse(transposed=transposed)


@each_way
def test_section_of_an_animation_is_wide_enough_for_the_longer_extent(
    results: xr.Dataset, transposed: bool
) -> None:
    _, _, section, *_ = animation(results, seconds=1.0, fps=6.0).figure.axes
    low, high = np.array(section.get_xlim()) * factor(section.get_xlabel())
    half, margin = ellipse_growth(ELLIPSE_TIMES[-1]) * ELLIPSE_AXES[1], 0.3 * ELLIPSE_AXES[1]
    assert low == close_to(ELLIPSE_MIDDLE[1] - half, abs=margin)
    assert high == close_to(ELLIPSE_MIDDLE[1] + half, abs=margin)


@pytest.mark.parametrize("name", ["pressure-3d", "surface-3d"])
def test_rim_in_space_is_the_ellipse(name: str, results: xr.Dataset, transposed: bool) -> None:
    panels = FIGURES[name](with_dent(results), times=[0.0, 5.0]).axes[:2]
    for axes, t in zip(panels, (0.0, 5.0), strict=True):
        [rim] = [line for line in axes.get_lines() if to_hex(line.get_color()) == style.INK]
        points = np.stack(rim.get_data_3d()[:2], axis=1) * factor(axes.get_xlabel())
        found = np.sqrt(level(points, t, transposed))
        np.testing.assert_allclose(found, 1.0, atol=0.02)


def test_foot_of_the_pressure_surface_is_the_ellipse(
    results: xr.Dataset, transposed: bool, caught: Caught
) -> None:
    axes = FIGURES["pressure-3d"](results, times=[0.0]).axes[0]
    points = caught.corners[0].reshape(-1, 3)
    foot = points[points[:, 2] == 0][:, :2] * factor(axes.get_xlabel())
    assert len(foot) > 100
    error = np.abs(np.sqrt(level(foot, 0.0, transposed)) - 1)
    # A tenth of a cell of the least semi-axis is 0.01; a few points see less of the rim's slope.
    assert np.quantile(error, 0.9) < 0.01
    assert error.max() < 0.05


def test_indenter_in_space_is_drawn_on_the_rows_of_cells_beside_the_axes(
    results: xr.Dataset,
) -> None:
    axes = FIGURES["surface-3d"](with_dent(results), times=[0.0]).axes[0]
    *_, along, across = axes.get_lines()
    for line, moving, fixed in ((along, "x", "y"), (across, "y", "x")):
        drawn = line.get_data_3d()
        unit = factor(axes.get_xlabel())
        place = np.asarray(drawn["xy".index(fixed)]) * unit
        assert np.ptp(place) == 0.0
        assert abs(place[0]) == close_to(float(np.abs(results[fixed]).min()))
        position = np.asarray(drawn["xy".index(moving)]) * unit
        pressed = (results.pressure[0] > 0).any(fixed).values
        assert position.min() < results[moving].values[pressed].min()
        assert position.max() > results[moving].values[pressed].max()
