"""Figures of an ellipse beside the centre, on nx != ny cells of dx != dy, against closed forms.

A round contact in the middle of a square grid looks the same with x and y exchanged.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from returned import some
from synthetic_results import (
    ELLIPSE_AXES,
    ELLIPSE_CELLS,
    ELLIPSE_EDGES,
    ELLIPSE_MIDDLE,
    ELLIPSE_PEAK,
    ELLIPSE_TIMES,
    ellipse,
    ellipse_growth,
    ellipse_pressure,
)
from viscontact.cli import main
from viscontact.drawing import matplotlib as plot
from viscontact.plot import COMPARISONS, FIGURES

FloatArray = NDArray[np.float64]

FACTORS = {"mm": 1e-3, "µm": 1e-6, "mm²": 1e-6, "µm²": 1e-12, "MPa": 1e6, "kPa": 1e3, "Pa": 1.0}


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


#: For figures that choose the longer axis: both ways by default too.
each_way = pytest.mark.parametrize(
    "transposed", [False, True], ids=["long in y", "long in x"], indirect=True
)


def factor(label: str) -> float:
    """SI value of the unit of a label."""
    return FACTORS[re.search(r"\[(.*)\]$", label)[1]]


def in_metres(axes: Axes, points: Any) -> FloatArray:
    """Drawn points, shape (n, 2) [m]."""
    units = [factor(_label(axes, way)) for way in ("x", "y")]
    return np.asarray(points, dtype=np.float64) * units


def _label(axes: Axes, way: str) -> str:
    """Label of an axis, which panels may share."""
    labels = [getattr(each, f"get_{way}label")() for each in (axes, *axes.figure.axes)]
    return next(label for label in labels if label.startswith(way))


def level(points: FloatArray, t: float, transposed: bool) -> FloatArray:
    """(x - x0)²/a² + (y - y0)²/b² at points [m]: 1 on the rim."""
    ordered = points[:, ::-1] if transposed else points
    axes = ellipse_growth(t) * np.array(ELLIPSE_AXES)
    return np.asarray((((ordered - ELLIPSE_MIDDLE) / axes) ** 2).sum(axis=1))


def times_of(figure: Figure | Axes) -> list[float]:
    """Instants that headings or a legend name [s]."""
    if isinstance(figure, Axes):
        legend = figure.get_legend()
        assert legend is not None
        texts = [text.get_text() for text in legend.get_texts()]
    else:
        texts = [axes.get_title(loc="left") for axes in figure.axes]
    found = [re.search(r"(\d+) s\b", text) for text in texts]
    return [float(each[1]) for each in found if each]


def assert_is_rim(patch: PathPatch, axes: Axes, t: float, transposed: bool) -> None:
    corners = in_metres(axes, patch.get_path().vertices)
    # A tenth of a cell of the least semi-axis.
    np.testing.assert_allclose(np.sqrt(level(corners, t, transposed)), 1.0, atol=0.02)
    assert np.ptp(np.arctan2(*(corners - corners.mean(axis=0)).T)) > 6.2  # all around


@pytest.mark.parametrize("times", [None, [2.2], [5.0, 0.0]])
def test_outlines_are_the_ellipses_of_the_instants_named(
    results: xr.Dataset, transposed: bool, times: list[float] | None
) -> None:
    axes = FIGURES["contact-outline"](results, times=times).axes[0]
    named = times_of(axes)
    assert named == {None: [0.0, 2.0, 5.0], 1: [2.0], 2: [0.0, 5.0]}[times and len(times)]
    patches = [patch for patch in axes.patches if isinstance(patch, PathPatch)]
    for patch, t in zip(patches, named, strict=True):
        assert_is_rim(patch, axes, t, transposed)


@pytest.mark.parametrize(
    "times",
    [
        [2.2],
        pytest.param(None, marks=pytest.mark.slow),
        pytest.param([5.0, 0.0], marks=pytest.mark.slow),
    ],
)
def test_contours_of_the_map_are_ellipses_of_equal_pressure(
    results: xr.Dataset, transposed: bool, times: list[float] | None
) -> None:
    """On the contour of p the ellipse's level is 1 - (p/p0)²."""
    figure = FIGURES["pressure-map"](results, times=times)
    named = times_of(figure)
    assert named == {None: [0.0, 2.0, 5.0], 1: [2.0], 2: [0.0, 5.0]}[times and len(times)]
    for axes, t in zip(figure.axes, named, strict=False):
        assert_is_rim(axes.patches[0], axes, t, transposed)
        peak, drawn = ELLIPSE_PEAK * ellipse_growth(t), 0
        [lines] = [
            each
            for each in axes.collections
            if isinstance(each, QuadContourSet) and not each.filled
        ]
        for squared, path in zip(lines.levels, lines.get_paths(), strict=True):
            if len(path.vertices):
                found = level(in_metres(axes, path.vertices), t, transposed)
                exact = 1 - squared / peak**2
                np.testing.assert_allclose(found, exact, atol=0.05)  # at single corners
                assert np.median(found) == close_to(exact, abs=0.005)
                drawn += 1
        assert drawn >= 3


def section(along: str, at: float, t: float, transposed: bool) -> Callable[[Any], FloatArray]:
    """Pressure [Pa] over the position on a line [m]."""

    def pressure(position: FloatArray) -> FloatArray:
        x, y = (position, at) if along == "x" else (at, position)
        return ellipse_pressure(*((y, x) if transposed else (x, y)), t)

    return pressure


def assert_is_section(
    axes: Axes, line: int, along: str, at: float, t: float, transposed: bool
) -> None:
    """A drawn line is the section at an instant, linear between two rows of cells."""
    position = np.asarray(axes.get_lines()[line].get_xdata()) * factor(axes.get_xlabel())
    pressure = np.asarray(axes.get_lines()[line].get_ydata()) * factor(axes.get_ylabel())
    exact = section(along, at, t, transposed)
    pressed = np.nan_to_num(pressure) > 0
    inner = pressed & np.roll(pressed, 2) & np.roll(pressed, -2)
    assert np.count_nonzero(inner) >= 10
    # Between rows a tenth of a semi-axis apart, the circle's chord is 1/8 of their square lower.
    peak = ELLIPSE_PEAK * ellipse_growth(t)
    np.testing.assert_allclose(pressure[inner], exact(position[inner]), atol=0.02 * peak)
    assert not exact(position[~(pressed | np.roll(pressed, 1) | np.roll(pressed, -1))]).any()


#: Lines through the contact but not through its middle, so that each has a section of its own.
LINES = [("x", 0.1e-3), ("x", -0.02e-3), ("y", 0.05e-3), ("y", -0.02e-3)]


@pytest.mark.parametrize(("along", "at"), LINES)
def test_profile_is_the_section_at_the_place_and_instants_named(
    results: xr.Dataset, transposed: bool, along: str, at: float
) -> None:
    axes = FIGURES["pressure-profile"](results, along=along, at=at, times=[1.9, 5.0]).axes[0]
    assert axes.get_xlabel().startswith(along)
    assert times_of(axes) == [2.0, 5.0]
    for line, t in enumerate((2.0, 5.0)):
        assert_is_section(axes, line, along, at, t, transposed)


def test_profile_runs_through_the_origin_along_x_by_default(
    results: xr.Dataset, transposed: bool
) -> None:
    axes = FIGURES["pressure-profile"](results).axes[0]
    assert times_of(axes) == list(ELLIPSE_TIMES)
    for line, t in enumerate(ELLIPSE_TIMES):
        assert_is_section(axes, line, "x", 0.0, t, transposed)


def test_compared_profiles_are_those_of_the_place_and_instants_named(
    results: xr.Dataset, transposed: bool
) -> None:
    runs = {"one": results, "half": results.assign(pressure=results.pressure / 2)}
    draw = COMPARISONS["pressure-profile"]
    for times, named in (([2.0], [2.0]), ([4.4, 0.1], [0.0, 5.0]), (None, [0.0, 5.0])):
        figure = draw(runs, along="y", at=0.1e-3, times=times)
        assert times_of(figure) == named
        for axes, t in zip(figure.axes, named, strict=True):
            one, half = (np.asarray(line.get_ydata()) for line in axes.get_lines())
            np.testing.assert_allclose(half, one / 2)
            if axes is figure.axes[-1]:
                assert_is_section(axes, 0, "y", 0.1e-3, t, transposed)


@pytest.mark.parametrize("name", ["contact-outline", "pressure-map"])
@pytest.mark.parametrize(
    ("times", "named"),
    [
        (None, 5.0),
        ([2.2], 2.0),
        pytest.param([0.0], 0.0, marks=pytest.mark.slow),
    ],
)
def test_compared_rims_are_those_of_the_instant_named(
    name: str, times: list[float] | None, named: float, results: xr.Dataset, transposed: bool
) -> None:
    figure = COMPARISONS[name]({"one": results, "other": results}, times=times)
    texts = [axes.get_title(loc="left") for axes in figure.axes[:2]]
    if name == "contact-outline":
        keys = [text.get_text() for text in figure.legends[0].get_texts()]
        texts = [f"{key}, {texts[0]}" for key in keys]
    assert texts == [f"{run}, t = {named:g} s" for run in ("one", "other")]
    panels = [axes for axes in figure.axes if axes.patches and axes.get_label() != "<colorbar>"]
    patches = [(axes, each) for axes in panels for each in axes.patches]
    rims = [(axes, each) for axes, each in patches if isinstance(each, PathPatch)]
    assert len(rims) == 2
    for axes, rim in rims:
        assert_is_rim(rim, axes, named, transposed)


def test_counted_area_is_the_number_of_cells_times_their_own_area(results: xr.Dataset) -> None:
    axes = FIGURES["contact-area"](results).axes[0]
    counted, _ = axes.get_lines()
    areas = np.asarray(counted.get_ydata()) * factor(axes.get_ylabel())
    growth = np.array([ellipse_growth(t) for t in ELLIPSE_TIMES])
    exact = np.pi * np.prod(ELLIPSE_AXES) * growth**2
    # Gauss's circle: cells whose centres lie in an ellipse of 20 x 25 cells differ by a few.
    np.testing.assert_allclose(areas, exact, rtol=0.02)
    np.testing.assert_allclose(counted.get_xdata(), ELLIPSE_TIMES)


@pytest.mark.slow
@pytest.mark.parametrize(("times", "named"), [(None, 5.0), ([2.2], 2.0)])
def test_indenter_is_drawn_with_the_box_of_the_contact_of_the_instant_named(
    results: xr.Dataset, transposed: bool, times: list[float] | None, named: float
) -> None:
    figure = FIGURES["indenter"](results, times=times)
    along, across, plan, text = figure.axes
    assert f"contact at {named:g} s" in " ".join(text.texts[0].get_text().split())
    middle, extents = np.array(ELLIPSE_MIDDLE), 2 * ellipse_growth(named) * np.array(ELLIPSE_AXES)
    edges = np.array(ELLIPSE_EDGES)
    if transposed:
        middle, extents, edges = middle[::-1], extents[::-1], edges[::-1]
    box = next(patch for patch in plan.patches if isinstance(patch, Rectangle))
    for way, span in enumerate(
        ((box.get_x(), box.get_width()), (box.get_y(), box.get_height())),
    ):
        low, size = np.array(span) * factor(_label(plan, "xy"[way]))
        assert low + size / 2 == close_to(middle[way], abs=edges[way])
        assert size == close_to(extents[way], abs=2 * edges[way])
    for way, axes in enumerate((along, across)):
        assert axes.get_xlabel().startswith("xy"[way])
        shaded = next(patch for patch in axes.patches if isinstance(patch, Rectangle))
        middle_of = (shaded.get_x() + shaded.get_width() / 2) * factor(axes.get_xlabel())
        assert middle_of == close_to(middle[way], abs=edges[way])


@each_way
def test_each_frame_shows_the_rim_and_the_section_of_its_instant(
    results: xr.Dataset, transposed: bool
) -> None:
    film = plot.animation(results, seconds=1.0, fps=6.0)
    surface, _, below, *_ = film.figure.axes
    along = "x" if transposed else "y"  # the longer extent
    assert below.get_xlabel().startswith(along)
    for t in (5.0, 0.0, 2.0):
        film.show(t)
        assert times_of(film.figure)[0] == t
        assert_is_rim(surface.patches[0], surface, t, transposed)
        assert_is_section(below, 0, along, 0.0, t, transposed)


# --- stresses ---------------------------------------------------------------------------------


@each_way
def test_stress_section_crosses_the_shorter_extent_through_the_middle(
    results: xr.Dataset, transposed: bool
) -> None:
    figure = FIGURES["stress-section"](results, times=[2.0])
    axes = figure.axes[0]
    assert axes.get_xlabel().startswith("y" if transposed else "x")
    cross = axes.lines[0]
    place = float(np.asarray(cross.get_xdata())[0]) * factor(axes.get_xlabel())
    assert place == close_to(ELLIPSE_MIDDLE[0], abs=0.6 * ELLIPSE_EDGES[0])
    # As deep and as wide to each side as two of the shorter half widths, found to half a cell.
    half_width = ellipse_growth(2.0) * ELLIPSE_AXES[0]
    ends = [end * factor(axes.get_xlabel()) for end in axes.get_xlim()]
    border = (ELLIPSE_CELLS[0] - 1) / 2 * ELLIPSE_EDGES[0]
    left, right = (ELLIPSE_MIDDLE[0] + side * 2 * half_width for side in (-1, 1))
    assert ends == close_to([left, min(right, border)], abs=2.1 * ELLIPSE_EDGES[0])
    deepest = axes.get_ylim()[0] * factor(axes.get_ylabel())
    assert deepest == close_to(2 * half_width, abs=ELLIPSE_EDGES[0])
    # The plane stands in the heading, on the other axis.
    title = axes.get_title(loc="left").replace("−", "-")
    stated = re.match(r"t = 2 s, ([xy]) = (-?[\d.]+) (\w+)", title)
    assert stated is not None
    assert stated[1] == "xy"[1 - transposed]
    plane = float(stated[2]) * factor(f"[{stated[3]}]")
    assert plane == close_to(ELLIPSE_MIDDLE[1], abs=0.6 * ELLIPSE_EDGES[1])


def test_stresses_below_an_ellipse_are_those_of_the_table(
    results: xr.Dataset, transposed: bool
) -> None:
    """Johnson (1985), table 4.1, b/a = 0.4, nu = 0.3: 0.325 p0 of shear, 0.665 b deep."""
    short, middle = ELLIPSE_AXES[0], ELLIPSE_MIDDLE
    depths = np.linspace(0, 2 * short, 121)
    # On the plane across the contact, and on the one along it: both hold the axis of symmetry.
    for plane in (0, 1):
        name = "xy"[plane ^ transposed]
        found = vc.section_stresses(results, depths, times=[0.0], **{name: middle[plane]})
        shear = found.max_shear.values[0]
        assert found.max_shear.dims[-1] == "xy"[1 - (plane ^ transposed)]
        row, column = np.unravel_index(int(shear.argmax()), shear.shape)
        assert shear.max() / ELLIPSE_PEAK == close_to(0.325, abs=0.005)
        assert depths[row] / short == close_to(0.665, abs=0.03)
        place = found[found.max_shear.dims[-1]].values[column]
        assert place == close_to(middle[1 - plane], abs=0.6 * ELLIPSE_EDGES[1 - plane])


def test_stresses_reach_two_of_the_shorter_half_widths_deep_by_default(
    results: xr.Dataset,
) -> None:
    depths = vc.section_stresses(results).z.values
    shorter = ellipse_growth(ELLIPSE_TIMES[-1]) * min(ELLIPSE_AXES)
    assert (depths[0], depths[-1]) == (0.0, close_to(2 * shorter))


def test_stresses_do_not_depend_on_the_names_of_the_axes() -> None:
    both = [ellipse(), ellipse(transposed=True)]
    headings = [FIGURES["stress-section"](each).axes[0].get_title(loc="left") for each in both]
    assert headings[0].replace(" y = ", " x = ") == headings[1].replace(" y = ", " x = ")
    first, second = (FIGURES["von-mises"](each) for each in both)
    for one, other in some(zip(first.axes, second.axes, strict=True)):
        drawn = [np.asarray(axes.get_lines()[0].get_ydata()) for axes in (one, other)]
        np.testing.assert_allclose(drawn[0], drawn[1], rtol=1e-9)


# --- the command line -------------------------------------------------------------------------


@pytest.fixture
def drawn(
    results: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Figure]:
    """Figure that a command draws of the result, and of two of it."""
    monkeypatch.chdir(tmp_path)
    for name in ("one.nc", "two.nc"):
        vc.save(results, tmp_path / name)
    caught: list[Figure] = []
    monkeypatch.setattr(plot, "save_figure", lambda figure, path: caught.append(figure))

    def draw(*words: str) -> Figure:
        assert main([*words]) == 0
        return caught[-1]

    return draw


def test_command_draws_the_line_and_the_instant_requested(
    drawn: Callable[..., Figure], transposed: bool
) -> None:
    words = ["--along", "y", "--at", "0.1 mm", "--time", "2 s"]
    axes = drawn("plot", "one.nc", "pressure-profile", *words).axes[0]
    assert times_of(axes) == [2.0]
    assert_is_section(axes, 0, "y", 0.1e-3, 2.0, transposed)
    words = ["--figure", "pressure-profile", "--along", "x", "--at", "-0.02 mm", "--time", "2 s"]
    figure = drawn("compare", "one.nc", "two.nc", *words)
    assert times_of(figure) == [2.0]
    for line in (0, 1):
        assert_is_section(figure.axes[0], line, "x", -0.02e-3, 2.0, transposed)


@pytest.mark.parametrize(
    "name", ["contact-outline", pytest.param("pressure-map", marks=pytest.mark.slow)]
)
def test_command_compares_the_instant_requested(
    drawn: Callable[..., Figure], name: str, transposed: bool
) -> None:
    figure = drawn("compare", "one.nc", "two.nc", "--figure", name, "--time", "2 s")
    axes = figure.axes[0]
    assert_is_rim(axes.patches[0], axes, 2.0, transposed)


def test_the_ellipse_tells_the_axes_apart() -> None:
    """No two of its numbers along x and y are equal, and all contacts lie on the grid."""
    size = np.array(ELLIPSE_CELLS) * ELLIPSE_EDGES
    for pair in (ELLIPSE_CELLS, ELLIPSE_EDGES, ELLIPSE_AXES, np.abs(ELLIPSE_MIDDLE), size):
        assert pair[0] != pair[1]
    reach = np.abs(ELLIPSE_MIDDLE) + ellipse_growth(ELLIPSE_TIMES[-1]) * np.array(ELLIPSE_AXES)
    assert np.all(reach < size / 2)
