"""Maps and sections of a page and of the calculator: an ellipse beside the centre.

On nx != ny cells of dx != dy, so that no map can exchange the axes; against closed forms.
"""

from __future__ import annotations

import csv
import io
import re
from urllib.parse import unquote

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from drawing.plotly.figure_data import Data, array_of, figures_in, shown_at, title_of, unit_of
from reports_without_pictures import pictures_left_out, without_pictures
from synthetic_results import (
    ELLIPSE_AXES,
    ELLIPSE_MIDDLE,
    ELLIPSE_PEAK,
    ELLIPSE_TIMES,
    ellipse,
    ellipse_growth,
    ellipse_pressure,
)
from viscontact.report import drawings, report_page
from viscontact.report.run_data import run_data

FloatArray = NDArray[np.float64]

__all__ = ["without_pictures"]  # a fixture

LENGTHS = {"mm": 1e-3, "µm": 1e-6}
PRESSURES = {"MPa": 1e6, "kPa": 1e3}


@pytest.fixture(scope="module", params=[False, True], ids=["long in y", "long in x"])
def transposed(request: pytest.FixtureRequest) -> bool:
    return bool(request.param)


@pytest.fixture(scope="module")
def page(transposed: bool) -> str:
    with pictures_left_out():
        return report_page(ellipse(transposed=transposed))


@pytest.fixture(scope="module")
def figures(page: str) -> dict[str, Data]:
    """The figures of a page by name, as a browser receives them."""
    return figures_in(page)


def exact(x: FloatArray, y: FloatArray, t: float, transposed: bool) -> FloatArray:
    return ellipse_pressure(*((y, x) if transposed else (x, y)), t)


def middle(transposed: bool) -> tuple[float, float]:
    x, y = ELLIPSE_MIDDLE
    return (y, x) if transposed else (x, y)


def test_map_is_the_pressure_at_its_places(figures: dict[str, Data], transposed: bool) -> None:
    """Rows of the map follow y and its columns x, as Plotly draws heat maps."""
    drawn = figures["map"]
    heat = drawn["data"][0]
    length = LENGTHS[unit_of(title_of(drawn, "x"))]
    x, y = (length * array_of(heat[way]) for way in ("x", "y"))
    assert x.size != y.size
    pressure_unit = PRESSURES[unit_of(heat["colorbar"]["title"]["text"])]
    for index, t in enumerate(ELLIPSE_TIMES):
        z = array_of(shown_at(drawn, str(index))["data"][0]["z"])
        assert z.shape == (y.size, x.size)
        expected = exact(x, y[:, None], t, transposed)
        pressure = np.nan_to_num(z) * pressure_unit
        np.testing.assert_allclose(pressure, expected, atol=1e-4 * ELLIPSE_PEAK)
        # No colour without contact; a cell whose middle lies on the rim may be rounded either way.
        assert np.count_nonzero(np.isnan(z) != (expected == 0)) <= 1
        assert np.count_nonzero(expected) > 300


def test_rims_of_the_map_are_the_ellipses(figures: dict[str, Data], transposed: bool) -> None:
    drawn = figures["map"]
    length = LENGTHS[unit_of(title_of(drawn, "x"))]
    for index, t in enumerate(ELLIPSE_TIMES):
        shown = shown_at(drawn, str(index))
        assert shown["layout"]["meta"]["title"] == f"t = {t:g} s"
        points = length * np.array([array_of(shown["data"][1][way])[:-1] for way in ("x", "y")])
        offsets = points - np.array(middle(transposed))[:, None]
        axes = ellipse_growth(t) * np.array(ELLIPSE_AXES[::-1] if transposed else ELLIPSE_AXES)
        np.testing.assert_allclose(np.hypot(*(offsets / axes[:, None])), 1.0, atol=0.02)


def assert_is_section(
    position: FloatArray, pressure: FloatArray, along: str, t: float, transposed: bool
) -> None:
    """Pressure on a line through the middle, in each cell but for those at the rim."""
    x, y = middle(transposed)
    places = (position, np.full_like(position, y))
    if along == "y":
        places = (np.full_like(position, x), position)
    expected = exact(*places, t, transposed)
    peak = ELLIPSE_PEAK * ellipse_growth(t)
    inner = expected > 0.4 * peak
    assert np.count_nonzero(inner) >= 15
    # Between two rows of cells the pressure is linear, the circle's chord.
    np.testing.assert_allclose(pressure[inner], expected[inner], atol=0.01 * peak)
    assert np.all(pressure[expected == 0] < 0.1 * peak)
    assert pressure.max() == close_to(peak, rel=0.01)


@pytest.mark.parametrize("along", ["x", "y"])
def test_sections_of_the_figures_run_through_the_middle(
    figures: dict[str, Data], along: str, transposed: bool
) -> None:
    drawn = figures[f"section-{along}"]
    length, unit = (unit_of(title_of(drawn, way)) for way in "xy")
    for index, t in enumerate(ELLIPSE_TIMES):
        bold = shown_at(drawn, str(index))["data"][len(ELLIPSE_TIMES)]
        thin = drawn["data"][index]
        assert (bold["name"], bold["line"]["width"] > thin["line"]["width"]) == (f"{t:g} s", True)
        position, pressure = LENGTHS[length] * array_of(bold["x"]), array_of(bold["y"])
        np.testing.assert_array_equal(array_of(thin["y"]), pressure)
        # The window holds the largest contact.
        way = "xy".index(along)
        reach = ellipse_growth(ELLIPSE_TIMES[-1]) * ELLIPSE_AXES[way ^ transposed]
        assert position[0] < middle(transposed)[way] - reach
        assert position[-1] > middle(transposed)[way] + reach
        assert_is_section(position, pressure * PRESSURES[unit], along, t, transposed)


@pytest.mark.parametrize("along", ["x", "y"])
def test_tables_of_the_sections_name_their_axis_and_instants(
    page: str, along: str, transposed: bool
) -> None:
    link = re.search(rf'<a [^>]*download="section-{along}.csv"[^>]*>', page)
    assert link
    reference = re.search(r'href="data:text/csv;charset=utf-8,([^"]*)"', link[0])
    assert reference
    head, *rows = csv.reader(io.StringIO(unquote(reference[1])))
    assert head == [f"{along} [m]", *(f"pressure at {t} s [Pa]" for t in ELLIPSE_TIMES)]
    position, *columns = np.array(rows, dtype=float).T
    np.testing.assert_allclose(position, ellipse(transposed=transposed)[along], rtol=1e-12)
    for pressure, t in zip(columns, ELLIPSE_TIMES, strict=True):
        assert_is_section(position, pressure, along, t, transposed)


def test_page_states_where_the_sections_lie(page: str, transposed: bool) -> None:
    """To a hundredth of a cell."""
    x, y = middle(transposed)
    for name, place in (("x", x), ("y", y)):
        stated = re.search(rf"at {name} = (-?[\d.]+) (mm|µm)", page.replace("−", "-"))
        assert stated
        assert float(stated[1]) * LENGTHS[stated[2]] == close_to(place, abs=1e-6)


def test_plan_of_the_geometry_shades_the_largest_contact_in_its_place(
    transposed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    figures: list[Figure] = []
    draw = drawings.as_svg
    monkeypatch.setattr(drawings, "as_svg", lambda each: (figures.append(each), draw(each))[1])
    ds = ellipse(transposed=transposed)
    drawings.geometry(ds)
    plan = figures[0].axes[2]
    units = [LENGTHS[re.search(r"\[(.*)\]", plan.get_xlabel())[1]]] * 2
    box = next(patch for patch in plan.patches if isinstance(patch, Rectangle))
    corner, size = np.array(box.get_xy()) * units, np.array([box.get_width(), box.get_height()])
    growth = ellipse_growth(ELLIPSE_TIMES[-1])
    extents = 2 * growth * np.array(ELLIPSE_AXES[::-1] if transposed else ELLIPSE_AXES)
    np.testing.assert_allclose(size * units, extents, rtol=1e-9)
    # Found to half a cell.
    np.testing.assert_allclose(corner + extents / 2, middle(transposed), atol=20e-6)


# --- the account of accuracy ------------------------------------------------------------------


def accuracy_of(ds: xr.Dataset) -> dict[str, str]:
    return dict(run_data(ds)["accuracy"])


@pytest.mark.parametrize("worst", range(len(ELLIPSE_TIMES)))
def test_residual_is_the_largest_of_all_instants(worst: int) -> None:
    ds = ellipse()
    ds["residual"][:] = 1e-9
    ds["residual"][worst] = 4.2e-7
    assert accuracy_of(ds)["Residual"].startswith("4.2e-07 at most")


@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("errors", [True, False])
def test_coarser_runs_are_reported_if_there_were_any(errors: bool) -> None:
    rubber, grid = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5), vc.Grid((32, 24), (2.7e-3, 2.4e-3))
    times = np.linspace(0.0, 1.0, 5)
    ds = vc.simulate(
        vc.Paraboloid(0.01, 0.01), rubber, vc.step(0.1), grid, times, errors=errors, fields="none"
    )
    assert float(ds.time_error.max()) > 0  # estimated in the run itself
    said = accuracy_of(ds)["Error estimation"]
    assert said.startswith("coarser runs" if errors else "none: ")
    assert said in report_page(ds)
