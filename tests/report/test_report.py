"""The page of a run: it shows the numbers of the result, and no text becomes markup."""

from __future__ import annotations

import csv
import io
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote

import numpy as np
import pytest
import xarray as xr
from ruamel.yaml import YAML

import viscontact as vc
from closeness import close_to
from drawing.plotly.figure_data import Data, array_of, shown_at, title_of
from reports_without_pictures import without_pictures
from synthetic_results import maxwell_pressure, maxwell_sphere, roller
from viscontact.cli import main
from viscontact.drawing.content.history import load_names, response_names
from viscontact.drawing.content.map import maps_over
from viscontact.drawing.content.rim import rim_curves
from viscontact.drawing.content.section import section
from viscontact.drawing.plotly.panel_over_run import history
from viscontact.drawing.plotly.parts import plain
from viscontact.drawing.plotly.pressure_map import MOST_CELLS, pressure_map
from viscontact.drawing.svg.html import as_script
from viscontact.report import report_page
from viscontact.report.accuracy import accuracy_lines
from viscontact.report.drawings import geometry, recorded_surface
from viscontact.report.inputs import inputs
from viscontact.report.limits import notices
from viscontact.report.result_chapters import lines_csv
from viscontact.report.run_data import run_data
from viscontact.results.snapshots import take_snapshots
from viscontact.results.summary import headline

__all__ = ["without_pictures"]  # a fixture

TIMES = (0.0, 1.0, 10.0, 100.0, 300.0)
_MARKUP = "</title></script><script>alert(1)</script><img src=x onerror=alert(2)>"


def _run(times: tuple[float, ...] = TIMES, **options: Any) -> xr.Dataset:
    """A sphere on a Maxwell half-space in closed form, with all that a result states."""
    return _described(maxwell_sphere(times, **options))


def _described(ds: xr.Dataset) -> xr.Dataset:
    """A result written down, with what a run says of itself."""
    count = ds.sizes["time"]
    plain = {"residual": 1e-7, "time_error": 1e-4, "work": 1e-3, "loss_per_cycle": np.nan}
    for name, value in {**plain, "iterations": 9, "cells_across": 40, "outcome": 0}.items():
        ds[name] = "time", np.full(count, value), {"units": "1"}
    for name in ("contact_area", "approach", "peak_pressure", "contact_length"):
        ds[f"{name}_error"] = 0.01 * ds[name]
    return ds.assign_attrs(wall_time=2.0, memory="recursion, exact for a series law")


class _Page(HTMLParser):
    """What a browser would find in a page, as far as these tests ask."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.attributes: list[tuple[str, str, str]] = []
        self.scripts: list[str] = []
        self.words: list[str] = []
        self._within = ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._within = tag
        self.attributes += [(tag, name, value or "") for name, value in attrs]
        if tag == "script":
            self.scripts.append("")

    def handle_endtag(self, tag: str) -> None:
        self._within = ""

    def handle_data(self, data: str) -> None:
        if self._within == "script":
            self.scripts[-1] += data
        elif self._within != "style":
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())

    @property
    def figures(self) -> dict[str, Data]:
        return {each["layout"]["meta"]["name"]: each for each in json.loads(self.scripts[0])}

    def download(self, name: str) -> list[list[str]]:
        """Rows of a table that can be downloaded."""
        place = self.attributes.index(("a", "download", name))
        link = next(v for tag, key, v in self.attributes[place:] if (tag, key) == ("a", "href"))
        head, content = link.split(",", 1)
        assert head == "data:text/csv;charset=utf-8"
        return list(csv.reader(io.StringIO(unquote(content))))


@pytest.fixture(scope="module")
def page() -> _Page:
    return _Page(report_page(_run()))


def test_a_page_asks_for_nothing_outside(page: _Page) -> None:
    links = {"src", "href", "action", "srcset", "poster", "data", "background"}
    asked = [value for _, name, value in page.attributes if name in links]
    assert len(asked) > 10
    assert [value for value in asked if not value.startswith(("data:", "#"))] == []
    [policy] = [value for _, name, value in page.attributes if "default-src" in value]
    assert policy.startswith("default-src 'none';")
    assert "http" not in policy


@pytest.mark.usefixtures("without_pictures")
def test_text_of_users_is_never_markup(page: _Page) -> None:
    named = ("title", "warnings", "memory", "version", "grid_enlarged")
    found = _Page(report_page(_run(fields=False).assign_attrs(dict.fromkeys(named, _MARKUP))))
    assert len(found.scripts) == len(page.scripts) == 3
    assert not any("alert(1)" in script for script in found.scripts)
    assert not [each for each in found.attributes if each[1] == "onerror"]
    assert found.text.count("<img src=x onerror=alert(2)>") >= len(named)
    assert "map" not in found.figures
    assert "No fields are stored" in found.text
    # The run's own warnings come before what the theory always assumes.
    assert 0 < found.text.index("This run warns:") < found.text.index("No friction")


def test_a_map_holds_the_pressure(page: _Page) -> None:
    drawn = page.figures["map"]
    assert (title_of(drawn, "x"), title_of(drawn, "y")) == ("x [µm]", "y [µm]")
    heat = drawn["data"][0]
    assert heat["colorbar"]["title"]["text"] == "Pressure [MPa]"
    x, y = (array_of(heat[name]) * 1e-6 for name in "xy")
    radius = np.hypot(x, y[:, None])
    for index, instant in enumerate(TIMES):
        shown = shown_at(drawn, str(index))
        pressure = np.nan_to_num(array_of(shown["data"][0]["z"])) * 1e6
        exact = maxwell_pressure(radius, instant)
        # Half a step of 1/65535 of the peak, a whole one at the rim.
        np.testing.assert_allclose(pressure, exact, atol=1.6e-5 * heat["zmax"] * 1e6)
        assert shown["layout"]["meta"]["title"] == f"t = {instant:g} s"
        peak = float(shown["layout"]["meta"]["note"].split()[-2])
        assert peak == close_to(pressure.max() * 1e-6, rel=1e-3)


def test_outlines_are_the_smooth_rims_of_the_figures(page: _Page) -> None:
    last = take_snapshots(_run(), TIMES[-1], "rim")[0]
    (curve,) = rim_curves(last)
    drawn = shown_at(page.figures["map"], "4")["data"][1]
    x, y = array_of(drawn["x"]), array_of(drawn["y"])
    assert np.isnan([x[-1], y[-1]]).all()
    outline = np.array([x[:-1], y[:-1]]).T * 1e-6
    np.testing.assert_allclose(outline, curve, atol=1e-6 * np.abs(curve).max())
    lines = page.figures["outlines"]["data"]
    assert [each["name"] for each in lines] == [f"{t:g} s" for t in TIMES]
    np.testing.assert_array_equal(array_of(lines[-1]["x"]), x)


def test_a_fine_map_shows_means_that_keep_the_force() -> None:
    ds = _described(roller(times=(1000.0,), shape=(900, 32)))
    fields = maps_over(ds)
    heat = pressure_map(fields).data[0]
    assert (len(heat.x) <= 256, fields.strides(MOST_CELLS)) == (True, (4, 1))
    cell = (heat.x[1] - heat.x[0]) * (heat.y[1] - heat.y[0]) * 1e-6
    force = np.nansum(heat.z) * 1e6 * cell
    exact = ds["pressure"].values.sum() * float((ds.x[1] - ds.x[0]) * (ds.y[1] - ds.y[0]))
    assert force == close_to(exact, rel=1e-5)  # seven digits in each cell


def test_csv_files_hold_every_digit(page: _Page) -> None:
    ds = _run()
    head, *rows = page.download("history.csv")
    column = head.index("contact_area_error [m^2]")
    assert [float(row[0]) for row in rows] == list(TIMES)
    assert [float(row[column]) for row in rows] == ds["contact_area_error"].values.tolist()
    head, *rows = page.download("section-x.csv")
    assert head[-1] == "pressure at 300.0 s [Pa]"
    middle = ds["pressure"].values[-1, :, 31:33].mean(axis=1)  # an even grid: y = 0 lies between
    assert [float(row[-1]) for row in rows] == middle.tolist()


@pytest.mark.usefixtures("without_pictures")
def test_a_long_contact_has_its_line_load_on_the_page() -> None:
    """A tilted roller, 57 cells by 18 in contact on 96 by 32: the curve holds the force."""
    ds = _described(roller(times=(0.0, 100.0), tilt=0.3))
    page = _Page(report_page(ds))
    dx, dy = (float(ds[way][1] - ds[way][0]) for way in ("x", "y"))
    expected = ds["pressure"].values.sum(axis=2) * dy
    curve = page.figures["line-load"]
    assert ("div", "id", "line-load") in page.attributes
    assert (title_of(curve, "x"), title_of(curve, "y")) == ("x [mm]", "Line load [kN/m]")
    for index, load in enumerate(expected):
        shown = array_of(curve["data"][index]["y"]) * 1e3
        assert shown.sum() * dx == close_to(ds["pressure"][index].values.sum() * dx * dy)
        position = array_of(curve["data"][index]["x"]) * 1e-3
        middle = np.interp(0.02, position, shown)
        assert middle == close_to(np.interp(0.02, ds.x, load), rel=1e-4)
    head, *rows = page.download("line-load.csv")
    assert head == ["x [m]", "line load at 0.0 s [N/m]", "line load at 100.0 s [N/m]"]
    x, *loads = np.array(rows, dtype=float).T
    np.testing.assert_array_equal(x, ds["x"])
    np.testing.assert_allclose(loads, expected, rtol=1e-12)


def test_a_round_contact_has_no_line_load_on_the_page(page: _Page) -> None:
    assert {"section-x", "section-y"} < set(page.figures)
    assert "line-load" not in page.figures
    assert not [value for _, _, value in page.attributes if value.startswith("line-load")]


def test_bands_are_the_errors_of_the_result(page: _Page) -> None:
    panel = page.figures["history-contact_area"]
    assert panel["layout"]["meta"] == {
        "name": "history-contact_area",
        "title": "Contact area [mm²]",
        "note": "",
    }
    band, line = (array_of(each["y"]) for each in panel["data"])
    count = len(TIMES)
    np.testing.assert_allclose(band[:count], 1.01 * line, rtol=1e-6)
    np.testing.assert_allclose(band[count:-1][::-1], 0.99 * line, rtol=1e-6)
    for name in ("linear", "log"):
        band, line = (array_of(each["x"]) for each in shown_at(panel, name)["data"])
        np.testing.assert_array_equal(band[:-1], [*line, *line[::-1]])
    panel = page.figures["history-contact_width"]
    assert np.isnan(array_of(panel["data"][0]["y"])).all()
    assert panel["layout"]["meta"]["note"] == "error not known"


def test_a_logarithmic_axis_has_the_start_half_a_decade_before_the_first_step(page: _Page) -> None:
    panel = page.figures["history-approach"]
    linear, log = (shown_at(panel, name) for name in ("linear", "log"))
    np.testing.assert_array_equal(array_of(linear["data"][1]["x"]), TIMES)
    places = [-0.5, 0.0, 1.0, 2.0, np.log10(300)]
    np.testing.assert_allclose(array_of(log["data"][1]["x"]), places, rtol=1e-6)
    axis = log["layout"]["xaxis"]
    ticks = dict(zip(axis["ticktext"], array_of(axis["tickvals"]), strict=True))
    assert ticks == {"0": -0.5, "1": 0.0, "10": 1.0, "100": 2.0}
    assert (title_of(linear, "x"), title_of(log, "x")) == ("Time [s]", "Time [s], logarithmic")


def test_a_logarithmic_axis_over_days_is_marked_in_seconds_minutes_hours_and_days() -> None:
    ds = _run(fields=False)
    panel = history(ds.assign_coords(time=ds["time"] * 2000.0), "approach")
    axis = shown_at(panel.to_plotly_json(), "log")["layout"]["xaxis"]
    ticks = dict(zip(axis["ticktext"], array_of(axis["tickvals"]), strict=True))
    for text, hours in (("1 h", 1.0), ("1 d", 24.0)):
        assert ticks[text] == close_to(np.log10(hours / 24))  # the axis is in days
    assert axis["title"]["text"] == "Time, logarithmic"


def test_a_peak_that_depends_on_the_mesh_is_marked() -> None:
    ds = _run(fields=False)
    ds["peak_pressure_error"][:] = np.inf
    panel = history(ds, "peak_pressure")
    band, line = panel.data
    assert np.isnan([*band.y, *line.y]).all()
    assert panel.layout.meta["note"] == "depends on the mesh"
    assert panel.layout.annotations[0].text == "not drawn: smaller cells give more"
    assert re.search(r"the peak pressure >[\d.]+ MPa \(depends on the mesh\)\.", headline(ds))
    assert "smaller cells give more" in dict(accuracy_lines(ds))["Depends on the mesh"]


def test_the_first_sentence_gives_the_result_with_errors() -> None:
    ds = _run(fields=False)
    ds["contact_area"][-1], ds["contact_area_error"][-1] = 57.634e-6, 0.149e-6
    said = "After 300 s the contact covers 57.63 ± 0.15 mm² under 50 N;"
    assert headline(ds).startswith(said)


def test_a_lost_contact_is_reported_where_it_was_largest() -> None:
    ds = _run()
    for name in ("contact_area", "peak_pressure", "pressure"):
        ds[name][-1] = 0.0
    assert headline(ds).startswith("At t = 100 s, when it is largest, the contact covers")
    assert "from t = 300 s to the end, t = 300 s, they do not touch" in headline(ds)
    fields = maps_over(ds)
    drawn = pressure_map(fields)
    assert (fields.start, drawn.layout.meta["title"]) == (3, "t = 100 s")
    assert drawn.frames[-1].layout["meta"]["note"] == "No contact"


def test_a_run_that_ended_early_says_so() -> None:
    ds = _run(fields=False)
    said = "The run ended at t = 10 s, before its last instant, t = 300 s"
    [notice] = notices(ds.isel(time=slice(0, 3)))
    assert (notices(ds), notice[: len(said)]) == ([], said)


def test_sections_run_through_the_resultant_or_else_the_largest_pressure() -> None:
    ds = _run(times=(300.0,))
    assert maps_over(ds).through == ((0.0, 0.0),)  # late, a Maxwell body's peak is at the rim
    two = ds.copy(deep=True)
    two["pressure"][0, 8:-8] = 0.0  # two spots
    assert two["pressure"].values[0, 31].max() == 0
    ((x, _),) = maps_over(two).through
    assert abs(x) >= float(ds.x[-8])


def test_inputs_have_units(page: _Page) -> None:
    for words in ("radius 10 mm", "shear modulus 1 GPa", "force 50 N", "Poisson's ratio 0.5"):
        assert words in page.text


def test_what_is_prescribed_is_the_load_and_the_rest_is_the_answer() -> None:
    ds = _run(fields=False)
    case = json.loads(ds.attrs["case"])
    motion = {"type": "HarmonicHistory", "control": "approach", "mean": 2e-6, "period": 2.0}
    moved = ds.assign_attrs(case=json.dumps(case | {"load": motion}))
    load, response = load_names(ds), response_names(ds)
    assert (load, "approach" in response) == (["force"], True)
    load, response = load_names(moved), response_names(moved)
    assert (load, "force" in response) == (["approach"], True)
    assert ("mean", "2 µm") in [(each.name, each.value) for each in inputs(moved)]


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # few cells and steps
def test_a_measured_surface_is_drawn_from_the_fields() -> None:
    axis = np.linspace(-60e-6, 60e-6, 66)  # 66² heights: more than a result keeps
    bumps = 3e-7 * np.cos(axis[:, None] * 1.5e5) * np.sin(axis * 1e5 + 1)
    body = vc.Sphere(2e-3) + vc.HeightMap(axis, axis, bumps)
    material = vc.Material(vc.Zener(1e9, 1e9, 1e9), 0.4)
    load = vc.step(force=0.02, eccentricity_x=2e-6)
    grid = vc.Grid((40, 40), (100e-6, 100e-6))
    ds = vc.simulate(body, material, load, grid, [0.0, 1.0], errors=False)
    exact = body.gap(grid.x[:, None], grid.y)
    surface = recorded_surface(ds)
    # To the tolerance of the gaps, 1e-6 of the largest displacement, some 0.4 µm.
    found = surface.gap(grid.x[:, None], grid.y)
    np.testing.assert_allclose(found, exact - exact.min(), rtol=0, atol=1e-12)
    page = _Page(report_page(ds))
    assert "Not drawn" not in page.text
    assert "as the grid of this run resolves it" in page.text
    text = "".join(geometry(ds.drop_vars(["gap", "displacement"])).itertext())
    assert "Not drawn: the surface is measured" in text


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # few cells
def test_a_measured_surface_that_slides_is_drawn_from_the_fields() -> None:
    axis = np.linspace(-60e-6, 60e-6, 66)
    bumps = 3e-7 * np.cos(axis[:, None] * 1.5e5) * np.sin(axis * 1e5 + 1)
    body = vc.Sphere(2e-3) + vc.HeightMap(axis, axis, bumps)
    material = vc.Material(vc.Zener(1e9, 1e9, 1e6), 0.5)
    grid = vc.Grid((40, 40), (100e-6, 100e-6))
    ds = vc.steady(body, material, vc.step(0.02), [1e-3, 1e-1], grid=grid, errors=False)
    found = recorded_surface(ds).gap(grid.x[:, None], grid.y)
    exact = body.gap(grid.x[:, None], grid.y)
    np.testing.assert_allclose(found, exact - exact.min(), rtol=0, atol=1e-11)
    assert "Not drawn" not in _Page(report_page(ds)).text


@pytest.mark.slow
def test_a_long_run_stays_below_15_megabytes(page: _Page) -> None:
    times = np.linspace(0.0, 300.0, 60)
    ds = _described(roller(times=(0.0, 300.0), shape=(512, 256)))
    fields = maps_over(ds.isel(time=np.arange(60) % 2).assign_coords(time=times))
    assert (len(fields.snapshots), fields.stored) == (24, 60)
    rest = sum(map(len, page.scripts[1:])) + sum(len(value) for *_, value in page.attributes)
    sections = sum(len(quote(lines_csv(fields, section(fields, way)))) for way in ("x", "y"))
    assert len(as_script(plain(pressure_map(fields)))) + sections + rest < 13e6


def test_the_citation_is_that_of_the_file(page: _Page) -> None:
    file = Path(__file__).parents[2] / "CITATION.cff"
    cited = YAML(typ="safe").load(file)
    [paper] = cited["references"]
    assert cited["title"] in page.text
    for words in (paper["title"], str(paper["year"]), paper["authors"][0]["family-names"]):
        assert words in page.text


# --- the command


@pytest.mark.usefixtures("without_pictures")
def test_report_writes_a_page_next_to_the_result(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = tmp_path / "run"
    run.mkdir()
    vc.save(_run(), run / "result.nc")
    assert main(["report", str(run)]) == 0
    assert capsys.readouterr().out.strip() == str(run / "report.html")
    page = (run / "report.html").read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>")
    # Runs of a case that was changed have its title; their directories tell them apart.
    assert re.search(r"<h1>(.*?)</h1>", page)[1].endswith(" (run)")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["no-run"], "no-run: no result there"),
        (
            ["run.nc", "-o", "a.docx"],
            "a.docx: a report is a page or a PDF; name it a.html or a.pdf",
        ),
        (["run.nc", "-o", "nowhere/a.html"], "nowhere/a.html: there is no directory nowhere"),
    ],
)
def test_what_cannot_be_reported_is_refused_in_a_line(
    words: list[str],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    vc.save(_run(times=(0.0, 1.0), fields=False), tmp_path / "run.nc")
    assert main(["report", *words]) == 2
    error = capsys.readouterr().err
    assert error.startswith(said)
    assert error.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]


def test_run_data_is_the_result_in_si_units_and_fits_into_json() -> None:
    ds = _run()
    ds["peak_pressure_error"][:] = np.inf
    ds["approach_error"][0] = np.nan
    data = json.loads(json.dumps(run_data(ds), allow_nan=False))
    scalars = data["scalars"]
    assert (data["axis"]["name"], data["axis"]["values"]) == ("time", list(TIMES))
    # The radius of a Hertz contact is sqrt(R d): the area is pi R d, here with R = 10 mm. The
    # area is counted in cells, 30 to 50 across.
    area, approach = (scalars[name]["value"] for name in ("contact_area", "approach"))
    assert area == close_to(np.pi * 0.01 * np.array(approach), rel=0.03)
    assert scalars["peak_pressure"]["mesh"] == [True] * len(TIMES)
    assert None not in scalars["peak_pressure"]["value"]
    assert scalars["approach"]["mesh"] == [False] * len(TIMES)
    assert scalars["peak_pressure"]["error"] == [None] * len(TIMES)
    assert [each is None for each in scalars["approach"]["error"]] == [True] + [False] * 4
