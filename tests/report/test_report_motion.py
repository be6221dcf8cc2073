"""Report of a moving contact: the body's place and direction, sections, histories, loops."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from reports_without_pictures import without_pictures
from viscontact import plot
from viscontact.bodies.loads.motion import Motion
from viscontact.drawing.content.history import load_names, response_names
from viscontact.drawing.content.look import LIGHT
from viscontact.drawing.content.loop import cycle_panel, loops_of
from viscontact.drawing.content.map import maps_over
from viscontact.drawing.content.section import section
from viscontact.drawing.matplotlib.histories.hysteresis import loops as printed_loops
from viscontact.drawing.plotly.loops import loops
from viscontact.drawing.plotly.panel_over_run import history
from viscontact.drawing.plotly.pressure_map import pressure_map
from viscontact.drawing.plotly.sections import draw_section
from viscontact.drawing.svg.result_overview import result_overview
from viscontact.report.page import report_page
from viscontact.report.result_chapters import lines_csv
from viscontact.results.descriptions import describe

__all__ = ["without_pictures"]  # a fixture

pytestmark = [
    pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning"),
    pytest.mark.usefixtures("without_pictures"),
]

RUBBER = vc.Material(vc.Zener(9e6, 1e6, 1e6), poisson_ratio=0.5)
#: Cells along x and y [m].
CELL = 1e-4


def _run(
    motion: Motion | None, times: list[float], material: vc.Material = RUBBER, middle: float = -3e-4
) -> xr.Dataset:
    ball, load = vc.Paraboloid(0.01, 0.01), vc.step(0.2, tilt_x=0.0, tilt_y=0.0)
    grid = vc.Grid((16, 24), (16 * CELL, 24 * CELL), centre=(0.0, middle))
    return vc.simulate(ball, material, load, grid, times, motion=motion, errors=False)


@pytest.fixture(scope="module")
def moved() -> xr.Dataset:
    """A ball that moves against y, and is at rest at last."""
    return _run(vc.Travel([0.0, 0.6], y=[0.0, -6e-4]), [0.0, 0.3, 0.6, 0.9])


def test_map_has_axis_and_direction_of_the_body(moved: xr.Dataset) -> None:
    figure = pressure_map(maps_over(moved))
    assert figure.layout.yaxis.title.text == "y [mm]"
    crosses = [frame.data[-1] for frame in figure.frames]
    axes = [(*cross.x, *cross.y) for cross in crosses]
    np.testing.assert_allclose(axes, [[0, 0], [0, -0.3], [0, -0.6], [0, -0.6]], atol=1e-9)
    for frame in figure.frames[:3]:
        (arrow,) = frame.layout["annotations"]
        assert (arrow.x, arrow.y) == (*frame.data[-1].x, *frame.data[-1].y)
        # From its tail to its head [pixel], up the screen: against y.
        assert (arrow.ax, arrow.ay) == close_to((0, -34))
        assert (arrow.xshift, arrow.yshift) == close_to((0, -34))
    assert not figure.frames[3].layout["annotations"]  # at rest


def test_sections_follow_the_resultant_of_a_moving_contact(moved: xr.Dataset) -> None:
    fields = maps_over(moved)
    resultant = moved.position_y + moved.eccentricity_y  # which is measured from the body's axis
    # To a hundredth of a cell.
    np.testing.assert_allclose([y for _, y in fields.through], resultant, atol=0.006 * CELL)
    along_x, along_y = section(fields, "x"), section(fields, "y")
    assert along_x.place(fields.window.unit) == "through each resultant"
    assert along_y.place(fields.window.unit) == "at x = 0 mm"
    assert f"y = {fields.through[1][1]!r} m" in lines_csv(fields, along_x).splitlines()[0]


def test_section_along_the_motion_has_leading_and_trailing_edge(moved: xr.Dataset) -> None:
    along_x, along_y = (draw_section(maps_over(moved), way) for way in ("x", "y"))
    assert "leading edge" not in str(along_x.data)
    edges = [list(frame.data[-1].x) for frame in along_y.frames]
    assert edges[3] == []  # at rest
    leading, trailing = edges[1]
    pressed = moved.y.values[(moved.pressure[1].values > 0).any(axis=0)]
    assert leading == close_to((pressed.min() - CELL / 2) * 1e3)
    assert trailing == close_to((pressed.max() + CELL / 2) * 1e3)


def test_histories_show_position_and_what_the_motion_costs(moved: xr.Dataset) -> None:
    load, response = load_names(moved), response_names(moved)
    assert "position_y" in load
    assert history(moved, "position_y").layout.meta["note"] == ""
    assert {"resistance_y", "friction_coefficient", "motion_work", "heat"} <= set(response)
    assert "resistance_x" not in response  # rounding
    labels = [axes.get_ylabel() for axes in plot.history(moved).axes]
    assert "Resistance along y [mN]" in labels
    assert not [label for label in labels if label.startswith("Resistance along x")]
    rows = [words for words, *_ in result_overview(moved).rows]
    assert "resistance along y" in rows
    assert "resistance along x" not in rows


def test_elastic_body_has_no_panels_of_resistance() -> None:
    elastic = vc.Material(vc.Elastic(9e6), poisson_ratio=0.5)
    ds = _run(vc.Travel([0.0, 0.6], y=[0.0, -6e-4]), [0.0, 0.3, 0.6], elastic)
    shown = response_names(ds)
    assert not set(shown) & {"resistance_y", "friction_coefficient", "motion_work", "heat"}


def test_area_of_the_last_loop_is_the_motion_work_of_a_cycle() -> None:
    ds = _run(vc.reciprocating(3e-4, 1.0, cycles=2), np.linspace(0, 2, 49).tolist(), middle=0.0)
    (loop,) = loops_of(ds)
    assert (loop.name, loop.last, loop.end) == ("loop-y", 24, 48)
    (printed,) = printed_loops(ds).axes  # as in PDF
    assert printed.get_ylabel().startswith("Resistance along y")
    assert not printed.get_title(loc="right")  # a loss is one of force over approach
    (figure,) = loops(ds, replace(LIGHT, system="si"))
    position, force = figure.data[1].x, figure.data[1].y
    work = float(ds.motion_work[-1] - ds.motion_work[24])
    # A polygon of 24 corners in an ellipse has this part of its area; the loop is nearly one.
    polygon = np.sinc(2 / 24)
    assert np.trapezoid(force, position) == close_to(polygon * work, rel=3e-3)


@pytest.mark.parametrize(
    ("end", "last"),
    [(0.9, (0, 21)), (1.0, (0, 24)), (1.9, (0, 24)), (2.0, (24, 48)), (3.5, (48, 72))],
)
def test_last_loop_is_the_last_whole_cycle_of_the_motion(end: float, last: tuple[int, int]) -> None:
    """Of three cycles of 1 s, in the way of the body and back, after which it rests."""
    motion, times = vc.reciprocating(3e-4, 1.0, cycles=3), np.arange(0.0, end + 0.01, 1 / 24)
    columns = {
        "position_y": ("time", motion.position_at(times)[:, 1]),
        "resistance_y": ("time", np.cos(2 * np.pi * times)),
        "force": ("time", np.ones(times.size)),
    }
    case = json.dumps({"motion": describe(motion)})
    run = xr.Dataset(columns, {"time": times}, {"case": case})
    (loop,) = loops_of(run)
    assert (loop.last, loop.end) == last
    is_part = last != (0, times.size - 1)
    assert cycle_panel(run, loop).note.startswith("Bold: the last cycle. ") is is_part


def test_page_of_a_moving_contact_names_motion_and_edges(moved: xr.Dataset) -> None:
    page = report_page(moved)
    for text in ("Load and motion", "Along y, the direction of motion, at x = 0", "leading edge"):
        assert text in page
    assert "motion work of a cycle" not in page  # it does not turn back
    standing = report_page(_run(None, [0.0, 0.3]))
    for text in ("Load and motion", "the direction of motion", "hollow: trailing edge"):
        assert text not in standing
