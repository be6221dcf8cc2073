"""`ds.viscontact.explore()`: pressure map and sections with a slider."""

from __future__ import annotations

import shutil
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from closeness import close_to
from returned import some
from synthetic_results import maxwell_pressure, maxwell_sphere, roller
from viscontact.drawing.content.look import DARK, LIGHT
from viscontact.drawing.content.map import maps_over
from viscontact.drawing.plotly.pressure_map import pressure_map
from viscontact.units.formatting import readable_unit
from viscontact.units.systems import SYSTEMS, unit_in

TIMES = (0.0, 1.0, 100.0)
_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
_BROWSER = next(filter(None, map(shutil.which, _BROWSERS)), None)


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    return maxwell_sphere(TIMES)


def test_each_step_of_the_slider_shows_the_pressure_at_its_instant(ds: xr.Dataset) -> None:
    figure = ds.viscontact.explore(units="si")
    (slider,) = figure.layout.sliders
    assert [step.label for step in slider.steps] == ["0 s", "1 s", "100 s"]
    assert slider.active == 2
    heat = figure.data[0]
    radius = np.hypot(heat.x, heat.y[:, None])
    for step, time, frame in zip(slider.steps, TIMES, figure.frames, strict=True):
        assert list(step.args[0]) == [frame.name]
        assert frame.traces[0] == 0
        peak = float(ds.pressure.max())
        z = np.nan_to_num(frame.data[0].z)
        np.testing.assert_allclose(z, maxwell_pressure(radius, time), atol=1e-6 * peak)
        assert frame.layout.annotations[0].text.startswith(f"<b>t = {time:g} s</b>")
    # The bold line of each section is in axes of its own.
    bold = [figure.data[number].xaxis for number in figure.frames[0].traces[2:]]
    assert bold == ["x2", "x3"]


def test_a_long_contact_has_its_line_load_in_a_row_of_its_own() -> None:
    figure = roller(times=(0.0, 100.0)).viscontact.explore()
    assert figure.layout.yaxis4.title.text == "Line load [kN/m]"
    domains = [figure.layout[f"yaxis{mark}"].domain for mark in ("", 2, 4)]
    assert domains[0][0] > domains[1][1] > domains[1][0] > domains[2][1] > domains[2][0] >= 0


def test_in_a_narrow_cell_every_panel_has_the_whole_width() -> None:
    figure = roller(times=(0.0, 100.0)).viscontact.explore(width=380)
    assert figure.layout.width == 380
    marks = ("", 2, 3, 4)
    assert all(figure.layout[f"xaxis{mark}"].domain == (0, 1) for mark in marks)
    domains = [figure.layout[f"yaxis{mark}"].domain for mark in marks]
    for (above, _), (low, high) in pairwise(domains):
        assert above > high > low >= 0
    assert figure.data[0].colorbar.orientation == "h"
    with pytest.raises(ValueError, match="width: wanted 300 pixels or more, got 200"):
        roller(times=(0.0, 100.0)).viscontact.explore(width=200)


def test_the_map_contains_the_outline_of_the_reference() -> None:
    small, large = (maps_over(roller(times=times)) for times in ((0.0, 0.1), (100.0, 1000.0)))
    for one, other in ((small, large), (large, small)):
        figure = pressure_map(one.beside(other), LIGHT)
        for frame in some(figure.frames):
            for letter in "xy":
                low, high = figure.layout[f"{letter}axis"].range
                places = np.asarray(getattr(frame.data[2], letter), dtype=float)
                assert low < np.nanmin(places) < np.nanmax(places) < high


def test_colours_and_units_can_be_chosen(ds: xr.Dataset) -> None:
    layout = ds.viscontact.explore().layout
    assert layout.paper_bgcolor == LIGHT.card
    assert layout.template.layout.xaxis.showline
    assert layout.template.layout.yaxis.showline
    figure = ds.viscontact.explore(dark=True, units="us")
    assert figure.layout.paper_bgcolor == DARK.card
    assert figure.layout.xaxis.title.text == "x [in]"
    assert figure.data[0].colorbar.title.text == "Pressure [psi]"
    with pytest.raises(ValueError, match=r"units: wanted one of auto, mm, .*; got 'inches'"):
        ds.viscontact.explore(units="inches")


def test_a_result_without_fields_is_refused(ds: xr.Dataset) -> None:
    with pytest.raises(ValueError, match="fields"):
        ds.drop_vars(["pressure", "gap", "displacement"], errors="ignore").viscontact.explore()


def test_units_of_a_system_are_those_of_its_standard() -> None:
    """NIST SP 811: 1 in = 25.4 mm, 1 lbf = 4.4482216152605 N, 1 psi = 6894.757 Pa."""
    assert unit_in("us", "Pa", 1.0).factor == close_to(6894.757, rel=1e-7)
    assert unit_in("us", "N/m", 1.0).factor == close_to(175.1268, rel=1e-6)
    assert unit_in("us", "m2", 1.0).factor == close_to(6.4516e-4, rel=1e-12)
    assert unit_in("us", "J", 1.0).factor == close_to(0.1129848, rel=1e-6)
    # A horsepower of 550 ft·lbf/s is 745.69987 W.
    assert 6600 * unit_in("us", "W", 1.0).factor == close_to(745.69987, rel=1e-8)
    for system in set(SYSTEMS) - {"auto"}:
        force, length, area, line = (
            unit_in(system, si, 1.0).factor for si in ("N", "m", "m2", "N/m")
        )
        assert area == close_to(length**2, rel=1e-12)
        # Beside micrometres, a line load reads better in N/m.
        assert system == "um" or line == close_to(force / length, rel=1e-12)
    assert unit_in("auto", "m", 2e-3) == readable_unit("m", 2e-3)


@pytest.mark.slow
@pytest.mark.skipif(_BROWSER is None, reason="there is no Chromium")
def test_the_slider_works_in_a_browser(ds: xr.Dataset, tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api")
    path = tmp_path / "contact.html"
    ds.viscontact.explore(units="si").write_html(path, auto_play=False)
    sums, faults = [], []
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=_BROWSER, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1000, "height": 1100})
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(path.as_uri())
        page.wait_for_selector(".js-plotly-plot .slider-rail-rect")
        for _ in range(2):
            sums.append(
                page.evaluate(
                    "() => document.querySelector('.js-plotly-plot')._fullData[0].z.reduce("
                    "(sum, row) => row.reduce((part, value) => part + (value || 0), sum), 0)"
                )
            )
            rail = page.locator(".slider-rail-touch-rect").bounding_box()
            page.mouse.click(rail["x"] + 12, rail["y"] + rail["height"] / 2)
            page.wait_for_function(
                "() => document.querySelector('.annotation-text').textContent.startsWith('t = 0 s')"
            )
        browser.close()
    assert faults == []
    pressure = ds["pressure"].values.sum(axis=(1, 2))
    assert sums == close_to([pressure[-1], pressure[0]], rel=1e-4)
