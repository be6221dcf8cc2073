"""Temperature beside the curves of a run, alone, and the laws over the reduced time."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot as plt

import viscontact as vc
from closeness import close_to
from viscontact.drawing.content.history import history_panel, load_names
from viscontact.drawing.content.law_curves import run_times
from viscontact.drawing.content.temperature_course import temperature_aside, temperature_panel
from viscontact.drawing.matplotlib import creep, draw_load, history
from viscontact.drawing.plotly.panel_over_run import history as plotly_history
from viscontact.report.clocks import clock_line
from viscontact.report.inputs import inputs

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

WLF = vc.WLF(293.15, 8.86, 101.6)
RUBBER = vc.Material(vc.Zener(1e6, 3e5, 1e6), 0.5, shift=WLF)
JUMPY = vc.TemperatureHistory([0.0, 4.0, 4.0, 10.0], [293.15, 303.15, 283.15, 283.15])


def run(temperature: object, material: vc.Material = RUBBER) -> xr.Dataset:
    ball, grid = vc.Sphere(0.01), vc.Grid((24, 24), (4e-3, 4e-3))
    times = np.linspace(0.0, 10.0, 6)
    options = {"errors": False, "fields": "none", "temperature": temperature}
    return vc.simulate(ball, material, vc.step(0.1), grid, times, **options)


@pytest.fixture(scope="module")
def warmed() -> xr.Dataset:
    return run(JUMPY)


def test_temperature_is_on_an_axis_of_its_own(warmed: xr.Dataset) -> None:
    aside = history_panel({"": warmed}, "approach").aside
    assert aside is not None
    assert aside.axis.label == "Temperature [°C]"
    rises = (aside.curve.x > 0) & (aside.curve.x < 4.0)
    expected = 293.15 + 10 * aside.curve.x[rises] / 4
    np.testing.assert_allclose(aside.curve.y[rises], expected)
    at_jump = aside.curve.y[aside.curve.x == 4.0]
    assert at_jump.tolist() == close_to([303.15, 283.15])
    assert history_panel({"": warmed}, "temperature").aside is None
    assert history_panel({"": warmed}, "force").aside is None  # prescribed
    assert history_panel({"one": warmed, "two": warmed}, "approach").aside is None
    assert history_panel({"": run(303.15)}, "approach").aside is None
    assert history_panel({"": run(None)}, "approach").aside is None


def test_both_libraries_draw_it_at_the_right(warmed: xr.Dataset) -> None:
    figure = history(warmed)
    right = [axes for axes in figure.axes if axes.get_ylabel() == "Temperature [°C]"]
    assert len(right) == len(figure.axes) / 2
    drawn = right[0].lines[0].get_ydata()
    assert drawn.max() == close_to(30.0)
    assert drawn.min() == close_to(10.0)
    plt.close(figure)
    interactive = plotly_history(warmed, "approach")
    [aside] = [trace for trace in interactive.data if trace.yaxis == "y2"]
    assert np.max(aside.y) == close_to(30.0, rel=1e-6)
    assert interactive.layout.yaxis2.side == "right"
    assert interactive.layout.yaxis2.title.text == "Temperature [°C]"


def test_temperature_is_prescribed_as_the_load_is(warmed: xr.Dataset) -> None:
    assert load_names(warmed) == ["force", "temperature"]
    panel = history_panel({"": warmed}, "temperature")
    assert panel.y.label == "Temperature [°C]"
    assert panel.y.unit(panel.curves[0].y[0]) == close_to(20.0)
    assert "temperature" not in load_names(run(303.15))


def test_load_is_drawn_with_the_temperature() -> None:
    figure = draw_load(vc.step(1.0), 10.0, temperature=JUMPY)
    assert [axes.get_ylabel() for axes in figure.axes] == ["Force [N]", "Temperature [°C]"]
    assert len(draw_load(vc.step(1.0), 3.0, temperature=None).axes) == 1
    assert temperature_aside(vc.TemperatureHistory([5.0, 6.0], [290.0, 300.0]), 4.0) is None


def test_history_alone_is_drawn_in_degrees() -> None:
    panel = temperature_panel(JUMPY)
    assert panel.y.limits is not None
    low, high = panel.y.unit(panel.y.limits).tolist()
    assert 5.0 < low < 10.0 < 30.0 < high < 35.0
    html = JUMPY._repr_html_()
    assert "Temperature" in html or "temperature" in html
    assert ">20<" in html  # a tick in °C
    day = vc.HarmonicTemperature(288.15, 10.0, 86400.0, 300)
    assert temperature_panel(day).note == "the beginning"
    assert str(day)


def test_law_is_drawn_over_the_reduced_time(warmed: xr.Dataset) -> None:
    figure = creep(warmed)
    assert {axes.get_xlabel() for axes in figure.axes} == {"Reduced time [s]"}
    assert run_times({"": warmed}, None)[-1] == close_to(float(warmed.reduced_time[-1]))
    # At a constant temperature the law is that at this temperature, over the time.
    warm = run(303.15)
    figure = creep(warm)
    assert {axes.get_xlabel() for axes in figure.axes} == {"Time [s]"}
    law, curve = RUBBER.at(303.15).law, figure.axes[0].lines[0]
    assert curve.get_xdata()[-1] == close_to(10.0)
    assert curve.get_ydata()[-1] * 1e-6 == close_to(law(10.0), rel=1e-9)


def test_report_names_the_clock(warmed: xr.Dataset) -> None:
    line = clock_line(warmed, "Half-space")
    assert "its shift with temperature (WLF)" in line
    assert "after 10 s" in line
    assert clock_line(run(303.15), "Half-space") == (
        "The law at 30 °C, by its shift with temperature (WLF)."
    )
    aged = vc.Material(RUBBER.law, 0.5, ageing=vc.Ageing(3600.0, 0.8))
    assert "its ageing (age 1 h at first, exponent 0.8)" in clock_line(
        run(None, aged), "Half-space"
    )
    assert clock_line(run(None), "Half-space") == ""
    assert ("Temperature", "at times") in [(row.part, row.name) for row in inputs(warmed)]
