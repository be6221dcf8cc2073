"""Readable figures: prescribed quantities, runs in order, maps of many spots, whole sections."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

import viscontact as vc
from closeness import close_to
from synthetic_results import maxwell_sphere
from viscontact import plot
from viscontact.cli import main
from viscontact.drawing.content.ordered_names import ordered_values
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_time import label_log_time, set_log_time
from viscontact.drawing.matplotlib.layout.style import styles_of
from viscontact.units.formatting import readable_unit

PEAK = 3e6
SHELL_ORDER = ["F=1000N", "F=100N", "F=2kN", "F=300N"]


def with_tilt(ds: xr.Dataset, tilt: float) -> xr.Dataset:
    """A result with a prescribed tilt along x, whose stated error is rounding."""
    case = json.loads(ds.attrs["case"])
    case["load"]["tilt_x"] = [tilt]
    ds["tilt_x"] = "time", np.full(ds.sizes["time"], tilt), {"units": "rad"}
    ds["tilt_x_error"] = 1e-5 * ds["tilt_x"]
    return ds.assign_attrs(case=json.dumps(case))


def many_spots(count: int = 5) -> xr.Dataset:
    """A result with count² spots of one cell each in contact, the last of which has the peak."""
    ds = maxwell_sphere(cells=64)
    pressure = np.zeros(ds["pressure"].shape)
    place = 4 + 12 * np.arange(count)
    pressure[:, place[:, None], place[None, :]] = 1e6
    pressure[:, place[-1], place[-1]] = PEAK
    ds["pressure"][:] = pressure
    ds["gap"][:] = np.where(pressure > 0, 0.0, 1e-6)
    return ds


def panel(figure: Figure, label: str) -> Any:
    """Panel of a quantity."""
    [axes] = [axes for axes in figure.axes if axes.get_ylabel().startswith(label)]
    return axes


def test_a_prescribed_tilt_is_a_line_from_zero_without_band_or_offset() -> None:
    ds = with_tilt(maxwell_sphere(cells=40), 5e-4)
    figure = plot.history(ds)
    axes = panel(figure, "Tilt along x")
    figure.draw_without_rendering()
    assert not axes.collections
    assert axes.get_ylim() == close_to((0.0, 575.0))  # µrad
    assert axes.yaxis.get_offset_text().get_text() == ""
    # A tilt that is computed keeps its band.
    free = with_tilt(maxwell_sphere(cells=40), 5e-4)
    free.attrs["case"] = maxwell_sphere(cells=40).attrs["case"]
    assert panel(plot.history(free), "Tilt along x").collections


@pytest.mark.parametrize("width", [None, "single"])
def test_labels_of_times_over_a_week_do_not_touch(width: plot.Width | None) -> None:
    times = np.append(0.0, np.geomspace(36.0, 604800.0, 5))
    ds = maxwell_sphere(cells=40)
    ds = ds.isel(time=[0, -1]).interp(time=np.linspace(*ds["time"].values[[0, -1]], times.size))
    ds = ds.assign_coords(time=times).assign(force=("time", np.full(times.size, 10.0)))
    figure = plot.history(ds, width=width)
    figure.draw_without_rendering()
    labelled = 0
    for axes in figure.axes:
        boxes = [each.get_window_extent() for each in axes.get_xticklabels() if each.get_text()]
        labelled = max(labelled, len(boxes))
        for before, after in itertools.pairwise(boxes):
            assert after.x0 - before.x1 > 2
    assert labelled >= 4  # 0, 1 min, 1 h, 1 d


@pytest.mark.parametrize(
    "width", [0.4, *(pytest.param(w, marks=pytest.mark.slow) for w in (0.9, 1.6)), 5.0]
)
@pytest.mark.parametrize(("first", "end"), [(36.0, 6e5), (1e-6, 2e5), (1e3, 3e8), (2e3, 2e4)])
def test_labels_of_an_axis_of_any_width_do_not_touch(
    width: float, first: float, end: float
) -> None:
    figure = Figure(figsize=(6.0, 2.0))
    axes = figure.add_axes((0.1, 0.3, width / 6.0, 0.6))
    style.dress(axes)
    unit = readable_unit("s", end)
    start, stop = unit([first, end]).tolist()
    set_log_time(axes, start, stop)
    axes.set_xlim(0.0, stop)
    label_log_time(axes, unit, start, stop)
    figure.draw_without_rendering()
    boxes = [each.get_window_extent() for each in axes.get_xticklabels() if each.get_text()]
    assert boxes
    assert all(after.x0 > before.x1 + 1 for before, after in itertools.pairwise(boxes))


def test_a_prescribed_negative_tilt_is_below_zero() -> None:
    axes = panel(plot.history(with_tilt(maxwell_sphere(cells=40), -5e-4)), "Tilt along x")
    assert axes.get_ylim() == close_to((-575.0, 0.0))


def test_colours_of_a_sweep_follow_the_parameter() -> None:
    values = ordered_values(SHELL_ORDER)
    assert values == [1000.0, 100.0, 2000.0, 300.0]
    looks = styles_of(SHELL_ORDER)
    lightness = [sum(to_rgb(look["color"])) for look in looks]
    assert np.argsort(lightness).tolist() == np.argsort(values).tolist()
    assert {look["linestyle"] for look in looks} == {"-"}


@pytest.mark.parametrize(
    "names", [["one", "two", "three"], ["a=1 N, b=2 N", "a=2 N, b=3 N"], ["F=1 N", "F=1 mm"], ["1"]]
)
def test_other_runs_have_no_order(names: list[str]) -> None:
    assert ordered_values(names) is None


def test_eight_runs_are_named_in_two_rows_beside_a_long_entry_on_bands() -> None:
    ds = maxwell_sphere(cells=40)
    ds["approach_error"] = 0.1 * ds["approach"]
    figure = plot.compare_histories({f"force={n}N": ds for n in range(1, 9)})
    runs, band = figure.legends
    figure.draw_without_rendering()
    rows = {round(text.get_window_extent().y0) for text in runs.get_texts()}
    assert (len(runs.get_texts()), len(rows)) == (8, 2)
    assert [text.get_text()[:4] for text in band.get_texts()] == ["band"]
    legends = [each.get_window_extent() for each in (runs, band)]
    assert not any(each.overlaps(axes.bbox) for each in legends for axes in figure.axes)


def test_compare_draws_runs_in_the_order_of_the_parameter(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    grid = vc.Grid((20, 20), (2e-3, 2e-3))
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    for name in SHELL_ORDER:
        (tmp_path / name).mkdir()
        vc.save(ds, tmp_path / name / "result.nc")
    drawn: list[str] = []

    def draw(runs: dict[str, xr.Dataset], times: Any = None) -> Figure:
        drawn.extend(runs)
        return Figure()

    monkeypatch.setitem(plot.COMPARISONS, "history", draw)
    folders = [str(tmp_path / name) for name in SHELL_ORDER]
    assert main(["compare", *folders, "-o", str(tmp_path / "figure.png")]) == 0
    assert drawn == ["F=100N", "F=300N", "F=1000N", "F=2kN"]


def test_many_spots_are_coloured_cells_up_to_the_true_peak() -> None:
    figure = plot.pressure_map(many_spots(), times=[300.0])
    axes, bar = figure.axes
    [mesh] = [each for each in axes.collections if isinstance(each, QuadMesh)]
    assert (mesh.norm.vmin, mesh.norm.vmax) == (0.0, PEAK / 1e6)  # MPa
    drawn = np.ma.getdata(mesh.get_array())[~np.ma.getmaskarray(mesh.get_array())]
    assert (drawn.size, drawn.max()) == (25, PEAK / 1e6)
    assert bar.get_ylim() == close_to((0.0, 3.0))  # MPa
    assert len(axes.collections) == 1  # no lines over the spots


def test_the_style_of_a_map_can_be_chosen() -> None:
    ds = maxwell_sphere(cells=40)
    figures = {
        style: plot.pressure_map(ds, times=[300.0], style=style)
        for style in (None, "contours", "colours")
    }
    kinds = {
        style: [type(each) for each in figure.axes[0].collections]
        for style, figure in figures.items()
    }
    assert kinds[None] == kinds["contours"]
    assert QuadMesh not in kinds["contours"]
    assert kinds["colours"] == [QuadMesh]
    with pytest.raises(ValueError, match="style must be 'contours' or 'colours', got 'dots'"):
        plot.pressure_map(ds, style="dots")  # type: ignore[arg-type]


def test_style_of_another_figure_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "run.nc"
    vc.save(maxwell_sphere(cells=8), file)
    assert main(["plot", str(file), "history", "--style", "colours"]) == 2
    assert "--style: does not apply to the figure history" in capsys.readouterr().err


def test_the_film_shows_the_whole_section_of_a_peak_that_depends_on_the_mesh() -> None:
    ds = maxwell_sphere(cells=40)
    ds["peak_pressure_error"] = np.inf * ds["peak_pressure"]
    film = plot.animation(ds, seconds=1.0, fps=4.0)
    section = film.figure.axes[2]
    film.show(0.0)
    unit = {"kPa": 1e3, "MPa": 1e6, "GPa": 1e9}[section.get_ylabel()[-4:-1]]
    highest = float(ds.pressure.isel(time=0).max()) / unit
    drawn = np.asarray(section.get_lines()[0].get_ydata())
    assert drawn.max() == close_to(highest, rel=0.01)
    assert highest < section.get_ylim()[1] < 1.2 * highest
    # The panel of a peak that is not drawn is left out.
    assert not [each for each in film.figure.axes if each.get_ylabel().startswith("Peak pressure")]
