"""Matplotlib and Plotly draw the same panels of a run: labels, ranges, curves, bands, notes."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from returned import some
from synthetic_results import maxwell_sphere
from synthetic_sweeps import hertz_sweep
from viscontact import plot
from viscontact.drawing.content.history import drawn_scalars, history_panel
from viscontact.drawing.content.look import LIGHT
from viscontact.drawing.content.loop import Loop, cycle_panel
from viscontact.drawing.content.panel import Axis, Curve, Panel
from viscontact.drawing.plotly.friction import friction
from viscontact.drawing.plotly.indentation_fits import fit_over_time, force_over_approach
from viscontact.drawing.plotly.panel_over_run import histories, panel_over_run
from viscontact.drawing.plotly.responses import responses
from viscontact.drawing.plotly.traction_creepage import traction_creepage
from viscontact.identification import IndentationRecord, fit_indentation
from viscontact.indenters import Sphere
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit


def _run(*, singular: bool = False, swings: bool = False) -> xr.Dataset:
    times = [0.0, *np.geomspace(0.1, 300.0, 12)]
    run = maxwell_sphere(times, cells=8, fields=False)
    if swings:
        run["force"][:] = 10.0 + np.sin(np.arange(13.0))
    parts = {"approach": 0.05, "contact_area": 0.02, "peak_pressure": 0.1}
    errors = {f"{name}_error": part * np.abs(run[name]) for name, part in parts.items()}
    run = run.assign(errors)
    run["approach_error"][2] = np.nan
    if singular:
        run["peak_pressure_error"][:] = np.inf
    return run


RUNS = {
    "held": _run(),
    "singular": _run(singular=True),
    "swinging": _run(swings=True),
    "without errors": maxwell_sphere([0.0, 1.0, 2.0], cells=8, fields=False),
}


@pytest.mark.parametrize("name", RUNS)
def test_histories_are_the_same_in_matplotlib_and_plotly(name: str) -> None:
    run = RUNS[name]
    printed = plot.history(run).axes
    shown = {each.layout.meta["title"]: each for each in histories(run)}
    # A page has the extent of the contact and a constant force too.
    beyond = {SCALARS[each].label for each in ("force", "contact_length", "contact_width")}
    labels = {axes.get_ylabel() for axes in printed}
    assert labels <= set(shown)
    assert {label.split(" [")[0] for label in set(shown) - labels} <= beyond
    for axes in printed:
        page = shown[axes.get_ylabel()]
        (line,) = [each for each in axes.get_lines() if each.get_linestyle() != ":"]
        curve, band = page.data[-1], page.data[-2]
        np.testing.assert_allclose(line.get_ydata(), curve.y, rtol=1e-6)
        is_drawn = not page.layout.annotations
        assert [text.get_text().replace("\n", " ") for text in axes.texts] == [
            each.text for each in page.layout.annotations
        ]
        if is_drawn:
            assert axes.get_ylim() == close_to(page.layout.yaxis.range)
        assert axes.get_title(loc="right").removeprefix("peak ") == page.layout.meta["note"]
        shaded = np.concatenate([np.zeros((0, 2))] + [
            path.vertices for each in axes.collections for path in each.get_paths()
        ])  # fmt: skip
        known = np.asarray(band.y)[np.isfinite(band.y)]
        assert bool(known.size) == bool(shaded.size)
        if known.size:
            assert (shaded[:, 1].min(), shaded[:, 1].max()) == close_to(
                (known.min(), known.max()), rel=1e-6
            )
        frames = [frame.name for frame in page.frames]
        assert (axes.get_xscale() == "symlog") == (page.layout.uirevision == "log")
        assert frames == (["linear", "log"] if axes.get_xscale() == "symlog" else frames)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_traction_over_creepage_is_the_same_in_matplotlib_and_plotly() -> None:
    run = vc.steady(
        *(vc.Paraboloid(0.01, 0.01), vc.Material(vc.Elastic(1e6), 0.5)),
        *(vc.step(1.0, tilt_x=0.0, tilt_y=0.0), [0.1, 0.01]),
        grid=vc.Grid((24, 24), (3.4e-3, 3.4e-3)),
        friction=0.5,
        creepage=[0.05, 0.01, -0.02],
    )
    (axes,), (page,) = plot.traction_creepage(run).axes, traction_creepage(run)
    force = -run.tangential_force_y.sel(speed=0.01).values / (0.5 * 1.0)
    drawn = axes.lines[0].get_xydata()
    assert drawn[:, 0] == close_to([-2.0, 1.0, 5.0])  # %
    assert drawn[:, 1] == close_to(force[[2, 1, 0]])
    first = page.data[0]
    assert first.name == axes.get_legend().get_texts()[0].get_text() == "10 mm/s"
    np.testing.assert_allclose(first.x, drawn[:, 0], rtol=1e-6)
    np.testing.assert_allclose(first.y, drawn[:, 1], rtol=1e-6)
    bars = run.tangential_force_y_error.sel(speed=0.01).values[[2, 1, 0]] / 0.5
    np.testing.assert_allclose(first.error_y.array, bars, rtol=1e-6)
    assert "creepage -2 %" in first.text[0]


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_friction_is_the_same_in_matplotlib_and_plotly() -> None:
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    grid = vc.Grid((24, 24), (4e-3, 4e-3))
    run = vc.steady(ball, rubber, load, [0.1, 1.0], grid=grid, errors=False, fields="none")
    run["friction_coefficient_error"] = 0.1 * run["friction_coefficient"]
    run.attrs["title"] = "ball"
    (axes,), (page,) = plot.friction(run).axes, friction(run)
    lines, curves = axes.get_lines(), [page.data[-1], *page.data[:-1]]  # the result, and limits
    assert len(lines) > 1
    for line, curve in zip(lines, curves, strict=True):
        assert line.get_label() == curve.name
        np.testing.assert_allclose(line.get_xdata(), curve.x, rtol=1e-6)
        np.testing.assert_allclose(line.get_ydata(), curve.y, rtol=1e-6)
    (bars,) = axes.collections
    heights = [np.ptp(path.vertices[:, 1]) / 2 for path in bars.get_paths()]
    np.testing.assert_allclose(heights, curves[0].error_y.array, rtol=1e-5)
    assert axes.get_xlabel() == page.layout.xaxis.title.text
    assert axes.get_ylabel() == page.layout.meta["title"]
    np.testing.assert_allclose(np.log10(axes.get_ylim()), page.layout.yaxis.range, rtol=1e-6)


def test_loops_have_the_same_units_and_points_in_matplotlib_and_plotly() -> None:
    t = np.linspace(0.0, 2.0, 33)
    run = maxwell_sphere(t.tolist(), cells=8, fields=False)
    run["force"][:] = 20e3 + 10e3 * np.sin(np.pi * t)
    run["approach"][:] = 2e-4 + 1e-4 * np.sin(np.pi * t - 0.3)
    (axes,) = plot.hysteresis(run).axes
    panel = cycle_panel(run, Loop("loop-force", "approach", "force", last=0, end=32))
    assert (axes.get_xlabel(), axes.get_ylabel()) == (panel.x.label, panel.y.label)
    (line,) = axes.get_lines()
    _, cycle, _ = panel.curves
    np.testing.assert_allclose(line.get_xdata(), panel.x.unit(cycle.x))
    np.testing.assert_allclose(line.get_ydata(), panel.y.unit(cycle.y))


def test_responses_of_a_sweep_are_the_same_in_matplotlib_and_plotly() -> None:
    radii = ([0.01, 0.08], "m")
    ds = hertz_sweep(load__force=([1e3, 8e3, 2e3], "N"), indenter__radius=radii)
    pages = {each.layout.meta["title"]: each for each in responses(ds)}
    printed = plot.response(ds).axes
    assert [axes.get_ylabel() for axes in printed] == list(pages)
    for axes in printed:
        page = pages[axes.get_ylabel()]
        assert axes.get_xlabel() == page.layout.xaxis.title.text
        assert axes.get_xscale() == (page.layout.xaxis.type or "linear")
        lines = [line for line in axes.get_lines() if line.get_linestyle() != "None"]
        for line, curve in some(zip(lines, page.data, strict=True)):
            assert line.get_label() == curve.name
            np.testing.assert_allclose(line.get_xdata(), curve.x, rtol=1e-6)
            np.testing.assert_allclose(line.get_ydata(), curve.y, rtol=1e-6)


def test_fits_are_the_same_in_matplotlib_and_plotly() -> None:
    depth = 1e-6 * np.linspace(0.0, 1.0, 11)
    force = 16 / 3 * 2e6 * np.sqrt(5e-6) * depth**1.5
    record = IndentationRecord(Sphere(5e-6), np.linspace(0.0, 1.0, 11), depth, force)
    fit = fit_indentation(record, "elastic", poisson_ratio=0.5)
    loop, above, below = plot.fitted_indentation(fit).axes
    page, course = force_over_approach(fit), fit_over_time(fit)
    assert loop.get_xlabel() == page.layout.xaxis.title.text
    np.testing.assert_allclose(loop.get_xlim(), page.layout.xaxis.range)
    assert (loop.get_ylabel(), above.get_ylabel()) == (
        page.layout.meta["title"],
        course.layout.meta["title"],
    )
    assert below.get_ylabel() == course.layout.yaxis2.title.text
    lines = [*loop.get_lines(), *above.get_lines(), below.get_lines()[0]]
    for line, curve in zip(lines, [*page.data, *course.data], strict=True):
        np.testing.assert_allclose(line.get_xdata(), curve.x, rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(line.get_ydata(), curve.y, rtol=1e-6, atol=1e-9)


def test_a_panel_is_the_same_alone_and_beside_others() -> None:
    run = RUNS["held"]
    for name in some(drawn_scalars({"": run})):
        alone = history_panel({"": run}, name)
        beside = history_panel({"one": run, "two": run}, name)
        assert alone.y == beside.y
        assert [curve.ink.place for curve in beside.curves] == [0, 1]


def test_any_panel_over_time_is_drawn_by_plotly_on_both_scales() -> None:
    instants, areas = np.array([0.0, 1.0, 10.0]), np.array([0.0, 1e-6, 2e-6])
    x = Axis("Time", ReadableUnit("s", 1.0), (0.0, 10.0), "time", 1.0, has_choice=True)
    curve = Curve(instants, areas, error=0.1 * areas)
    panel = Panel(x, Axis.of("Contact area", "m2", areas), (curve,))
    figure = panel_over_run(panel, LIGHT, "area", ["a", "b", "c"])
    assert figure.layout.meta["title"] == panel.y.label
    assert figure.data[-1].y.tolist() == [0.0, 1.0, 2.0]
    assert [frame.name for frame in figure.frames] == ["linear", "log"]
    assert figure.frames[0].data[-1].x.tolist() == instants.tolist()
