"""Three-dimensional figures: heights, rims, indenters."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from returned import some
from synthetic_results import (
    ELLIPSE_AXES,
    ELLIPSE_MIDDLE,
    ellipse,
    ellipse_growth,
    maxwell_sphere,
    roller,
)
from viscontact.drawing.matplotlib.layout import lit_surface, style
from viscontact.plot import COMPARISONS, FIGURES, save_figure

FloatArray = NDArray[np.float64]
TIMES = [0.0, 300.0]


class Caught:
    """What was handed to matplotlib as surfaces."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.corners: list[FloatArray] = []
        drawn = lit_surface.Poly3DCollection

        def catch(corners: FloatArray, **how: object) -> object:
            self.corners.append(np.asarray(corners))
            return drawn(corners, **how)

        monkeypatch.setattr(lit_surface, "Poly3DCollection", catch)


@pytest.fixture
def caught(monkeypatch: pytest.MonkeyPatch) -> Caught:
    return Caught(monkeypatch)


def with_dent(results: xr.Dataset) -> xr.Dataset:
    """A bowl 40 µm deep at first, deeper later."""
    shape = np.exp(-((results.x / 4e-4) ** 2) - (results.y / 3e-4) ** 2)
    depth = (40e-6 * (1 + results.time / 300) * shape).transpose("time", "x", "y")
    return results.assign(displacement=depth)


def drawn(at: xr.DataArray, label: str) -> FloatArray:
    """Coordinates in the unit that a label names."""
    return at.values / {"mm": 1e-3, "µm": 1e-6}[label[-3:-1]]


def heights_at_cells(corners: FloatArray, x: FloatArray, y: FloatArray) -> dict[tuple, float]:
    """Heights of those corners that lie at cell centres, by the cell's numbers; x, y as drawn."""
    points = corners.reshape(-1, 3)
    i = np.rint(np.interp(points[:, 0], x, np.arange(x.size))).astype(int)
    j = np.rint(np.interp(points[:, 1], y, np.arange(y.size))).astype(int)
    there = np.isclose(points[:, 0], x[i], atol=1e-9) & np.isclose(points[:, 1], y[j], atol=1e-9)
    cells = zip(i[there].tolist(), j[there].tolist(), strict=True)
    return dict(zip(cells, points[there, 2].tolist(), strict=True))


@pytest.mark.parametrize(
    "results",
    [
        pytest.param(maxwell_sphere(cells=24), id="sphere", marks=pytest.mark.slow),
        pytest.param(roller(shape=(48, 16)), id="roller"),
        pytest.param(ellipse(), id="ellipse", marks=pytest.mark.slow),
        pytest.param(ellipse(transposed=True), id="transposed ellipse"),
    ],
)
def test_height_of_the_pressure_surface_is_the_pressure(results: xr.Dataset, caught: Caught):
    last = float(results.time[-1])
    axes = FIGURES["pressure-3d"](results, times=[0.0, last]).axes[0]
    for corners, instant in zip(caught.corners, (0.0, last), strict=True):
        pressure = results["pressure"].sel(time=instant).values / 1e6
        found = heights_at_cells(
            corners, drawn(results.x, axes.get_xlabel()), drawn(results.y, axes.get_ylabel())
        )
        pressed = {
            tuple(cell): pressure[tuple(cell)] for cell in np.argwhere(pressure > 0).tolist()
        }
        assert pressed.keys() <= found.keys()
        for cell, value in pressed.items():
            assert found[cell] == close_to(value, rel=1e-9)
        # Between the cells nothing rises above them.
        assert corners[..., 2].max() == close_to(pressure.max(), rel=1e-9)


def test_foot_of_the_pressure_surface_is_the_rim_of_a_hertz_contact(caught: Caught):
    results = maxwell_sphere(cells=40)
    axes = FIGURES["pressure-3d"](results, times=[0.0]).axes[0]
    points = caught.corners[0].reshape(-1, 3)
    foot = points[points[:, 2] == 0]
    radius = np.hypot(foot[:, 0], foot[:, 1])
    exact = drawn(results.contact_length[0], axes.get_xlabel()) / 2
    cell = np.diff(drawn(results.x, axes.get_xlabel()))[0]
    # The grid alone would place it to half a cell; a few points in the corners of the rim's
    # staircase see less of its slope.
    error = np.abs(radius - exact) / cell
    assert np.quantile(error, 0.9) < 0.05
    assert error.max() < 0.3
    assert foot.shape[0] > 100


def test_foot_of_the_pressure_surface_is_the_rim_of_an_ellipse_on_unequal_cells(caught: Caught):
    axes = FIGURES["pressure-3d"](ellipse(), times=[2.0]).axes[0]
    points = caught.corners[0].reshape(-1, 3)
    unit = {"mm": 1e-3, "µm": 1e-6}[axes.get_xlabel()[-3:-1]]
    foot = points[points[:, 2] == 0, :2] * unit
    semi_axes = ellipse_growth(2.0) * np.array(ELLIPSE_AXES)
    error = np.abs(np.linalg.norm((foot - ELLIPSE_MIDDLE) / semi_axes, axis=1) - 1)
    # A cell is a twelfth and a fifteenth of the semi-axes.
    assert np.median(error) < 0.025 / 12
    assert error.max() < 0.5 / 12
    assert foot.shape[0] > 100


@pytest.mark.slow
def test_of_very_many_cells_the_largest_pressure_is_drawn(caught: Caught):
    results = roller(shape=(640, 32))
    single = int(np.flatnonzero(results.pressure[0, :, 16].values > 0)[157])
    results["pressure"][0, single, 16] = 900e6
    FIGURES["pressure-3d"](results, times=[0.0])
    assert caught.corners[0][..., 2].max() == close_to(900.0)


def test_depth_of_the_deformed_surface_is_the_displacement(caught: Caught):
    results = with_dent(maxwell_sphere(cells=40))
    results["displacement"][0, :3] = np.nan  # beyond an earlier, smaller grid
    figure = FIGURES["surface-3d"](results, times=TIMES)
    for number, instant in enumerate(TIMES):
        depth = results["displacement"].sel(time=instant).values * 1e6
        label = figure.axes[0].get_xlabel()
        found = heights_at_cells(
            caught.corners[number], drawn(results.x, label), drawn(results.y, label)
        )
        known = np.argwhere(np.isfinite(depth))
        assert len(found) == len(known)
        for cell in map(tuple, known.tolist()):
            assert found[cell] == close_to(depth[cell], rel=1e-9)
    bar = figure.axes[-1]
    assert bar.get_ylabel() == "Displacement [µm]"
    low, high = sorted(bar.get_ylim())
    np.testing.assert_allclose(high, 80.0, rtol=2e-2)
    assert bar.yaxis_inverted()
    assert 0 <= low < 10


@pytest.mark.parametrize("transposed", [pytest.param(False, marks=pytest.mark.slow), True])
def test_depth_on_unequal_cells_is_that_of_its_place_and_instant(transposed: bool, caught: Caught):
    results = ellipse(transposed=transposed).assign_coords(time=[0.0, 120.0, 300.0])
    figure = FIGURES["surface-3d"](with_dent(results), times=[120.0])
    label = figure.axes[0].get_xlabel()
    found = heights_at_cells(caught.corners[0], drawn(results.x, label), drawn(results.y, label))
    # The formula of the dent, at the instant drawn.
    x, y = results.x.values[:, None], results.y.values
    depth = 40 * (1 + 120 / 300) * np.exp(-((x / 4e-4) ** 2) - (y / 3e-4) ** 2)
    assert len(found) > 1000
    for cell, value in found.items():
        assert value == close_to(depth[cell], rel=1e-9)


def test_indenter_lies_on_the_surface_where_they_touch_and_above_it_elsewhere():
    results = with_dent(maxwell_sphere(cells=41))
    axes = FIGURES["surface-3d"](results, times=[0.0]).axes[0]
    *_, along, across = axes.get_lines()
    for line, row in ((along, results.isel(y=20)), (across, results.isel(x=20))):
        x, y, depth = line.get_data_3d()
        at, coordinate = (x, row.x) if "x" in row.dims else (y, row.y)
        cell = np.rint(np.interp(at, drawn(coordinate, axes.get_xlabel()), np.arange(41)))
        row = row.isel({coordinate.name: cell.astype(int)})
        surface = row["displacement"][0].values * 1e6
        shown = np.isfinite(depth)
        touching = (row["pressure"][0] > 0).values
        assert touching.sum() > 15
        np.testing.assert_allclose(depth[touching], surface[touching], rtol=1e-9)
        beside = shown & ~touching
        assert np.all(depth[beside] < surface[beside])


def test_rim_of_a_punch_is_level():
    punch = vc.FlatPunch(5e-3)
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    grid = vc.Grid((24, 24), (20e-3, 20e-3))
    with pytest.warns(vc.AccuracyWarning, match="singular"):
        results = vc.simulate(punch, rubber, vc.step(1.0), grid, [0.0], errors=False)
    axes = FIGURES["surface-3d"](results).axes[0]
    rims = [line for line in axes.lines if to_hex(line.get_color()) == style.INK]
    depth = np.concatenate([line.get_data_3d()[2] for line in rims])
    # The surface falls beside it, by a tenth of the approach within a cell.
    approach = float(results["approach"][0])
    unit = approach / depth.mean()
    assert unit == close_to(10.0 ** round(np.log10(unit)), rel=1e-4)
    np.testing.assert_allclose(depth, depth.mean(), rtol=1e-4)


def test_numbers_at_the_short_side_of_a_slender_box_stay_apart():
    results = with_dent(roller(shape=(48, 16)))
    figure = FIGURES["surface-3d"](results, times=[0.0], width=0.085)
    figure.draw_without_rendering()
    axes = figure.axes[0]
    ticks = [*axes.xaxis.get_major_ticks(), *axes.yaxis.get_major_ticks()]
    texts = [tick.label1 for tick in ticks if tick.label1.get_text()]
    assert len(axes.get_yticks()) == 2
    boxes = [text.get_window_extent() for text in texts]
    assert len(boxes) > 4
    assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes, 2))


def test_noted_stretch_of_heights_is_the_drawn_one():
    results = with_dent(maxwell_sphere(cells=24))
    figure = FIGURES["surface-3d"](results, times=[0.0])
    noted = next(t.get_text() for t in figure.texts if "heights" in t.get_text())
    axes = figure.axes[0]
    # Looked at from the side, without perspective: lengths on paper are lengths in the box.
    axes.set_proj_type("ortho")
    axes.view_init(0, -90)
    projection = axes.get_proj()
    unit = {"[mm]": 1e-3, "[µm]": 1e-6}[axes.get_xlabel()[-4:]]
    x, z = np.array(axes.get_xlim()), np.array(axes.get_zlim())
    ends = [(x[0], 0, z[0], 1), (x[1], 0, z[0], 1), (x[0], 0, z[1], 1)]
    corner, along, up = (projection @ np.array(end) for end in ends)
    wide, tall = abs(along[0] - corner[0]), abs(up[1] - corner[1])
    drawn = (tall / (abs(z[1] - z[0]) * 1e-6)) / (wide / ((x[1] - x[0]) * unit))
    assert float(re.search(r"heights ([\d.]+)×", noted)[1]) == close_to(drawn, rel=0.05)


@pytest.mark.parametrize(
    ("width", "body", "name"),
    [
        ("single", "sphere", "pressure-3d"),
        pytest.param("single", "sphere", "surface-3d", marks=pytest.mark.slow),
        pytest.param(0.12, "roller", "pressure-3d", marks=pytest.mark.slow),
        (0.12, "roller", "surface-3d"),
    ],
)
def test_no_text_of_a_figure_in_space_is_cut_off(name: str, width: str | float, body: str):
    results = maxwell_sphere(cells=16) if body == "sphere" else roller(shape=(32, 12))
    figure = FIGURES[name](results, times=[0.0, 1000.0], width=width)
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in figure.texts]
    for axes in figure.axes:
        names = ("xaxis", "yaxis", "zaxis")
        boxes += [getattr(axes, name).get_tightbbox() for name in names if hasattr(axes, name)]
    for box in some(filter(None, boxes)):
        assert box.x0 >= 0
        assert box.y0 >= 0
        assert box.x1 <= figure.bbox.x1
        assert box.y1 <= figure.bbox.y1


def test_runs_stand_side_by_side_on_common_axes(caught: Caught):
    runs = {"straight": roller(), "tilted": roller(tilt=0.2)}
    figure = COMPARISONS["pressure-3d"](runs)
    panels = figure.axes[:2]
    assert len(caught.corners) == 2
    assert panels[0].get_zlim() == panels[1].get_zlim()
    assert panels[0].get_xlim() == panels[1].get_xlim()
    headings = [text.get_text() for text in figure.texts]
    assert headings[:2] == ["straight, t = 1000 s", "tilted, t = 1000 s"]


def test_facets_are_an_image_and_texts_are_text_in_a_pdf(tmp_path: Path):
    path = tmp_path / "surface.pdf"
    save_figure(FIGURES["pressure-3d"](maxwell_sphere(cells=16), times=[0.0]), path)
    assert path.stat().st_size < 600_000
    content = path.read_bytes()
    assert b"/FontFile2" in content
    assert b"/Subtype /Image" in content
