"""Maps and outlines of any contact: across a period's border, with holes, whole, in many spots."""

from __future__ import annotations

import json
from functools import cache
from itertools import combinations

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from closeness import close_to
from synthetic_results import maxwell_sphere
from viscontact.plot import FIGURES

FloatArray = NDArray[np.float64]

CELLS = 48
#: Half the extent of the grid, in millimetres as in the drawings.
HALF = 5.0
AT = (2 * np.arange(CELLS) - (CELLS - 1)) * (HALF / CELLS)
X, Y = np.meshgrid(AT, AT, indexing="ij")


def _waves() -> FloatArray:
    """Crossed waves whose crests are at the middle and at the corners of the period."""
    return np.cos(np.pi * (X + Y) / HALF) + np.cos(np.pi * (X - Y) / HALF)


def _rough(periodic: bool) -> FloatArray:
    """Smooth random heights, seeded, without end or falling off to the border."""
    random = np.random.default_rng(5)
    heights = np.zeros_like(X)
    for along_x in range(-3, 4):
        for along_y in range(4):
            phase = random.uniform(0, 2 * np.pi)
            heights += np.cos(np.pi * (along_x * X + along_y * Y) / HALF + phase)
    return heights if periodic else heights - 20 * (np.hypot(X, Y) / HALF) ** 6


def _level(height: FloatArray, share: float) -> FloatArray:
    return height - (np.quantile(height, 1 - share) if share < 1 else height.min() - 0.3)


def _result(height: FloatArray, share: float, periodic: bool | list[bool]) -> xr.Dataset:
    """What is highest is in contact; at its rim pressure and gap rise as at any smooth one."""
    level = _level(height, share)
    results = maxwell_sphere([0.0], cells=CELLS)
    results = results.assign_coords(x=AT * 1e-3, y=AT * 1e-3)
    results["pressure"][0] = 1e6 * np.sqrt(np.maximum(level, 0.0))
    results["gap"][0] = 1e-6 * np.maximum(-level, 0.0) ** 1.5
    case = json.loads(results.attrs["case"])
    case["grid"] = {
        "type": "Grid",
        "shape": [CELLS, CELLS],
        "size": [2e-3 * HALF] * 2,
        "periodic": periodic,
    }
    return results.assign_attrs(case=json.dumps(case))


ALONG = [True, False]  # periodic along x only
CONTACTS = {
    "waves, 54 %": (_waves(), 0.54, True),
    "waves, 87 %": (_waves(), 0.87, True),
    "waves, full": (_waves(), 1.0, True),
    "waves upside down, 30 %": (-_waves(), 0.3, True),
    "rough, without end": (_rough(periodic=True), 0.35, True),
    "band across the border": (np.cos(np.pi * (X - HALF) / HALF), 0.4, True),
    "row of bumps across the border of x": (np.cos(np.pi * (X - HALF) / HALF) - Y**2, 0.3, ALONG),
    "sphere": (-np.hypot(X, Y), 0.3, False),
    "ring": (-np.abs(np.hypot(X, Y) - 3.0), 0.4, False),
    "rough": (_rough(periodic=False), 0.25, False),
    "up to the border, where the body ends": (-np.abs(X), 0.5, False),
}


def _painted(figure: Figure, axes: Axes, points: FloatArray) -> NDArray[np.bool_]:
    """Whether the pixels at these points [mm] are not white."""
    figure.set_dpi(200)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[::-1]
    column, row = axes.transData.transform(points).astype(int).T
    return np.asarray((pixels[row, column, :3] < 250).any(axis=-1), dtype=np.bool_)


def _steepest(height: FloatArray) -> float:
    """The largest slope, as difference in a cell's width."""
    return float(np.hypot(*np.gradient(height)).max())


def _far_from_rim(height: FloatArray, share: float) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Points in every cell a good part of a cell from the rim, and whether they are pressed.

    The outer cells' lie almost on the border.
    """
    level = _level(height, share)
    clear = np.abs(level) > _steepest(height)
    at = AT.copy()
    at[[0, -1]] = -HALF + 0.06, HALF - 0.06
    points = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1)[clear]
    return points, (level > 0)[clear]


def _shown(axes: Axes, points: FloatArray) -> NDArray[np.bool_]:
    """Which points lie within the panel, beside its frame's lines."""
    frame = 0.03
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    x, y = points.T
    inside = (left + frame < x) & (x < right - frame) & (low + frame < y) & (y < high - frame)
    return np.asarray(inside, dtype=np.bool_)


@cache
def _map(contact: str) -> Figure:
    return FIGURES["pressure-map"](_result(*CONTACTS[contact]))


#: Those that another one is like.
ALIKE = {
    *("waves, 87 %", "waves, full", "waves upside down, 30 %"),
    *("band across the border", "sphere", "rough"),
}
EACH = [pytest.param(name, marks=pytest.mark.slow) if name in ALIKE else name for name in CONTACTS]


@pytest.mark.parametrize("contact", EACH)
def test_map_is_coloured_where_the_surface_is_pressed_and_nowhere_else(contact: str) -> None:
    figure = _map(contact)
    axes = figure.axes[0]
    assert axes.get_xlabel() == "x [mm]"
    points, pressed = _far_from_rim(*CONTACTS[contact][:2])
    shown = _shown(axes, points)
    assert not np.any(pressed & ~shown)
    painted = _painted(figure, axes, points[shown])
    np.testing.assert_array_equal(painted, pressed[shown])


@pytest.mark.parametrize("contact", EACH)
def test_outline_runs_along_the_rim_and_nowhere_else(contact: str) -> None:
    """Not along the border of a period, that is: contact runs on there."""
    height, share, periodic = CONTACTS[contact]
    figure = FIGURES["contact-outline"](_result(height, share, periodic))
    axes = figure.axes[0]
    level = _level(height, share)
    i, j = np.nonzero((level[1:] > 0) != (level[:-1] > 0))
    part = level[i, j] / (level[i, j] - level[i + 1, j])
    cell = 2 * HALF / CELLS
    crossings = np.stack([AT[i] + part * cell, AT[j]], axis=-1)
    # Within half a cell: where spots meet, the level bends within a cell.
    steps = np.linspace(-0.4, 0.4, 5)
    aside = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    near = (crossings[:, None] + cell * aside).reshape(-1, 2)
    assert np.all(_painted(figure, axes, near).reshape(-1, len(aside)).any(axis=1))
    points, _ = _far_from_rim(height, share)
    if periodic:
        assert not np.any(_painted(figure, axes, points[_shown(axes, points)]))


@pytest.mark.parametrize(
    "contact",
    [
        *("waves, 54 %", "rough, without end"),
        *(pytest.param(name, marks=pytest.mark.slow) for name in ("rough", "sphere")),
    ],
)
def test_labels_lie_in_the_contact_and_apart(contact: str) -> None:
    figure = _map(contact)
    figure.draw_without_rendering()
    axes = figure.axes[0]
    boxes = [text.get_window_extent() for text in axes.texts]
    assert boxes
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
    height, share, _ = CONTACTS[contact]
    level = RegularGridInterpolator((AT, AT), _level(height, share))
    for box in boxes:
        corners = axes.transData.inverted().transform(box.corners())
        # In the pressed cells, that is: a point of one is up to half its diagonal from the centre.
        assert np.all(level(np.clip(corners, AT[0], AT[-1])) > -_steepest(height) / np.sqrt(2))
        assert np.all(np.abs(corners) < HALF)


def test_full_contact_has_no_outline_with_a_note() -> None:
    axes = FIGURES["contact-outline"](_result(*CONTACTS["waves, full"])).axes[0]
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["0 s, full contact"]


def test_profile_of_a_period_reaches_its_border() -> None:
    results = _result(*CONTACTS["waves, full"])
    axes = FIGURES["pressure-profile"](results).axes[0]
    (line,) = axes.lines
    at, pressure = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    assert axes.get_xlim() == close_to((-HALF, HALF))
    assert at[0] < -HALF
    assert at[-1] > HALF
    # The waves fall to both borders alike: cells beside one have the pressure of the other's.
    np.testing.assert_allclose(pressure[:2], pressure[:-3:-1], rtol=1e-12)
    assert np.all(pressure > 0)


def test_stress_section_runs_through_the_middle_of_equal_crests() -> None:
    """The corners' crest is the higher by less than runs are solved to."""
    results = _result(*CONTACTS["waves, 54 %"])
    results["pressure"][0, 0, 0] *= 1 + 1e-6
    axes = FIGURES["stress-section"](results).axes[0]
    cross = axes.lines[0]
    assert abs(float(np.asarray(cross.get_xdata())[0])) < 2 * HALF / CELLS
    assert axes.get_ylim()[0] == close_to(HALF)  # half a period deep


def test_stress_section_is_as_deep_as_the_stress_below_small_spots() -> None:
    """Johnson (1985), eqs. 3.45 on the axis: for nu = 0.5 it is largest 0.55 a deep."""
    results = _result(*CONTACTS["waves, 54 %"])
    results["pressure"][0] = 0.0
    radius, middle = 0.8, 3.5 * HALF / 5  # far apart, one at each corner
    for x, y in [(-middle, -middle), (-middle, middle), (middle, -middle), (middle, middle)]:
        inside = np.maximum(1 - ((X - x) ** 2 + (Y - y) ** 2) / radius**2, 0.0)
        results["pressure"][0] += 1e6 * np.sqrt(inside)
    axes = FIGURES["stress-section"](results).axes[0]
    assert 1.5 * radius < axes.get_ylim()[0] < 4 * radius
    left, right = axes.get_xlim()
    (place,), (depth,) = (np.asarray(each) for each in axes.lines[0].get_data())
    assert left < abs(place) - radius or right > abs(place) + radius
    assert abs(place) == close_to(middle, abs=2 * HALF / CELLS)
    assert depth == close_to(0.55 * radius, abs=0.1 * radius)


def test_stress_sections_of_a_contact_that_has_grown_have_axes_of_their_own() -> None:
    results = maxwell_sphere([0.0, 1.0], cells=CELLS)
    pressure = results["pressure"].values[0]
    results["pressure"][0] = np.where(pressure > 0.97 * pressure.max(), pressure, 0.0)
    first, last = FIGURES["stress-section"](results).axes[:2]
    assert first.get_ylim()[0] < last.get_ylim()[0] / 2
    assert first.get_xlabel() == last.get_xlabel() != ""


def test_panels_have_one_scale_of_colours_or_one_each() -> None:
    ds = maxwell_sphere((0.0, 1.0, 10.0), cells=48)
    peaks = ds["pressure"].max(("x", "y")).values
    for scale, bars in (("all", 1), ("each", 3)):
        figure = FIGURES["pressure-map"](ds, scale=scale)
        labelled = [axes for axes in figure.axes if "Pressure" in axes.get_ylabel()]
        assert len(labelled) == bars
    highest = [axes.get_ylim()[1] for axes in labelled]
    unit = {"kPa": 1e3, "MPa": 1e6}[labelled[0].get_ylabel().split("[")[1][:-1]]
    # Levels are round, and the last one lies above the peak by a step at most.
    for top, peak in zip(highest, peaks, strict=True):
        assert 1.0 <= top * unit / peak < 1.3
    with pytest.raises(ValueError, match="scale must be 'all' or 'each', got 'own'"):
        FIGURES["pressure-map"](ds, scale="own")
