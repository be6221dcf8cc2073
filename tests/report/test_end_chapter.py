"""Chapter of a report on bodies that end, and the ends in figures of the line load."""

from __future__ import annotations

from xml.etree.ElementTree import tostring

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.drawing.content.exact_history import exact_sphere
from viscontact.drawing.content.map import maps_over
from viscontact.drawing.plotly.sections import draw_section, line_loads
from viscontact.report.end_chapter import compared_loads, end_chapter
from viscontact.report.limits import assumptions

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

LENGTH = 4e-3
ROLLER = vc.Roller(10e-3, LENGTH / 2)
GRID = vc.Grid((44, 32), (4.4e-3, 0.8e-3))
LAW = vc.Zener(700e6, 700e6, 7e9)
TIMES = [0.0, 5.0, 100.0]


@pytest.fixture(scope="module")
def track() -> xr.Dataset:
    """Roller on a creeping track of its own length, under a force that grows."""
    body = vc.Body(vc.Material(LAW, 0.4), LENGTH, ends=("free", "held"))
    load = vc.ramp(40.0, 50.0, eccentricity_x=0.1e-3)
    return vc.simulate(ROLLER, body, load, GRID, TIMES, errors=False)


def test_the_half_space_beside_a_track_is_elastic_with_its_compliance(track: xr.Dataset) -> None:
    found = compared_loads(track)
    assert found is not None
    assert found.place == "t = 100 s"
    assert found.loads["with ends"] == close_to(track.line_load[-1].values, rel=1e-12)
    elastic = vc.Material(vc.Elastic(0.5 / float(LAW(100.0))), 0.4)
    load = vc.step(40.0, eccentricity_x=0.1e-3)
    wide = vc.Grid((44, 64), (4.4e-3, 1.6e-3))
    half_space = vc.simulate(ROLLER, elastic, load, wide, [0.0], errors=False)
    expected = half_space.line_load[0].values
    assert found.loads["half-space"] == close_to(expected, abs=1e-3 * float(expected.max()))


def test_the_chapter_says_where_bodies_end_and_compares_line_loads(track: xr.Dataset) -> None:
    text = "".join(tostring(part, encoding="unicode") for part in end_chapter(track))
    for words in ("x = -2 mm", "free of stress", "x = 2 mm", "held by a wall", "half-space"):
        assert words in text
    assert "<img" in text


def test_a_line_contact_beside_an_end_is_not_compared_with_half_spaces() -> None:
    body = vc.Body(vc.Material(vc.Elastic(700e6), 0.4), LENGTH)
    grid = vc.Grid((96, 1), (LENGTH, 1e-3), periodic=(False, True))
    cylinder = vc.Paraboloid(10e-3, np.inf)
    ds = vc.simulate(cylinder, body, vc.step(50.0), grid, [0.0, 1.0], errors=False)
    assert compared_loads(ds) is None
    text = "".join(tostring(part, encoding="unicode") for part in end_chapter(ds))
    assert "free of stress" in text


def test_a_report_of_bodies_without_ends_has_no_chapter_on_them() -> None:
    material = vc.Material(LAW, 0.4)
    ds = vc.simulate(ROLLER, material, vc.step(40.0), GRID, [0.0], errors=False)
    assert not list(end_chapter(ds))
    assert not _marks(vc.plot.line_load(ds))


def _marks(figure: object) -> list[float]:
    """Places of dotted lines across the panels of a figure."""
    axes = figure.axes[0]  # type: ignore[attr-defined]
    dotted = [line for line in axes.get_lines() if line.get_linestyle() == ":"]
    return [float(np.asarray(line.get_xdata())[0]) for line in dotted]


def test_figures_along_x_mark_the_ends_of_bodies(track: xr.Dataset) -> None:
    assert _marks(vc.plot.line_load(track)) == close_to([-2.0, 2.0], rel=1e-9)
    assert _marks(vc.plot.pressure_profile(track)) == close_to([-2.0, 2.0], rel=1e-9)
    assert not _marks(vc.plot.pressure_profile(track, along="y"))
    maps = maps_over(track)
    for figure in (*line_loads(maps), draw_section(maps, "x")):
        places = [shape.x0 for shape in figure.layout.shapes]
        assert places == close_to([-2.0, 2.0], rel=1e-9)
    assert not draw_section(maps, "y").layout.shapes


def test_a_ball_beside_an_end_is_not_compared_with_half_spaces() -> None:
    body = vc.Body(vc.Material(vc.Elastic(1e6), 0.5), 4e-3, centre=1.8e-3, ends=("free", None))
    grid = vc.Grid((48, 48), (2.4e-3, 2.4e-3))
    ds = vc.simulate(vc.Sphere(0.01), body, vc.step(0.02), grid, [0.0, 1.0], errors=False)
    assert exact_sphere(ds, "history") is None
    half_space = vc.Material(vc.Elastic(1e6), 0.5)
    other = vc.simulate(vc.Sphere(0.01), half_space, vc.step(0.02), grid, [0.0, 1.0], errors=False)
    assert exact_sphere(other, "history") is not None
    assert "bodies end along x" in dict(assumptions(ds))["Ends"]
    assert "Ends" not in dict(assumptions(other))
