"""The errors that a result states are shown: in tables, in CSV, as bands; none are made up.

The errors here are written down, not computed: what is shown is compared with them.
"""

from __future__ import annotations

import csv
import math
import re
import shutil
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

import viscontact as vc
from closeness import close_to
from reports_without_pictures import without_pictures
from returned import some
from viscontact.cli import main
from viscontact.cli.run.summary import print_summary
from viscontact.plot import COMPARISONS, FIGURES
from viscontact.report import report_page
from viscontact.report.accuracy import error_rows
from viscontact.results.formatting import (
    format_error,
    format_percent,
    format_supported,
    format_with_error_in,
)
from viscontact.results.summary import headline, summary_rows
from viscontact.results.variables import SCALARS, scalars_of, scalars_with_error
from viscontact.simulation.accuracy.error_models import ERROR_MODELS
from viscontact.units.formatting import ReadableUnit

__all__ = ["without_pictures"]  # a fixture

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 1 MPa, delayed_modulus: 1 MPa, viscosity: 1 MPa s,
           poisson_ratio: 0.5}
load: {kind: triangle, force: 1 N, rise: 2 s}
time: {end: 5 s, steps: 20}
grid: {shape: [32, 32], size: [5 mm, 5 mm]}
output: {fields: [2 s]}
"""
#: Relative errors, no two alike.
PARTS = {
    "approach": 0.0123, "contact_area": 0.034, "contact_length": 0.0021, "contact_width": 0.0034,
    "peak_pressure": 0.056, "mean_pressure": 0.0078, "work": 0.009, "force": 0.0,
    "loss_per_cycle": 0.11,
}  # fmt: skip


@pytest.fixture(scope="module")
def directory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run."""
    here = tmp_path_factory.mktemp("stated")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    return here / "case"


@pytest.fixture(scope="module")
def bare(directory: Path) -> xr.Dataset:
    """Its result, as versions before this one wrote it."""
    with vc.open_results(directory) as ds:
        companions = [name for name in ds if str(name).removesuffix("_error") in SCALARS]
        return ds.load().drop_vars([name for name in companions if name not in SCALARS])


def with_errors(bare: xr.Dataset, **given: np.ndarray) -> xr.Dataset:
    """The result with errors of so many parts of each value, or with those given."""
    ds = bare.copy(deep=True)
    for name, part in PARTS.items():
        error = given.get(name, part * np.abs(ds[name].values))
        ds[f"{name}_error"] = ("time", error, {"units": SCALARS[name].units})
    return ds


@pytest.fixture
def ds(bare: xr.Dataset) -> xr.Dataset:
    return with_errors(bare)


@pytest.fixture
def singular(bare: xr.Dataset) -> xr.Dataset:
    """The same, as if its peak pressure were that of an edge."""
    peak = bare.peak_pressure.values
    return with_errors(bare, peak_pressure=np.where(peak > 0, np.inf, 0.0))


@pytest.fixture
def shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., str]:
    """What `show` prints of a dataset on eighty columns."""
    monkeypatch.setenv("COLUMNS", "80")

    def show(ds: xr.Dataset, *words: str) -> str:
        vc.save(ds, tmp_path / "result.nc")
        assert main(["show", str(tmp_path / "result.nc"), *words]) == 0
        return capsys.readouterr().out

    return show


# --- numbers ----------------------------------------------------------------------------------


@given(
    st.floats(1e-3, 1e5),
    st.floats(1e-6, 2.0) | st.floats(10.0, 200.0),
    st.sampled_from([-1, 1]),
    st.integers(1, 6),
)
def test_no_digit_is_printed_beyond_the_second_of_the_error(
    size: float, part: float, sign: int, digits: int
) -> None:
    value, error = sign * size, part * size
    printed = format_supported(value, error, digits)
    if printed == "0":
        assert abs(value) <= 0.051 * error  # half a step of the error's second digit
        return
    # Zeros in front of the decimal point only hold places.
    number = Decimal(printed) if "." in printed else Decimal(printed).normalize()
    last = number.as_tuple().exponent
    assert isinstance(last, int)
    assert last >= Decimal(f"{error:.1e}").adjusted() - 1
    # Half a step of the last of so many digits, or half a step of the error's second digit.
    allowed = max(0.51 * 10 ** (1 - digits) * size, 0.051 * error)
    assert abs(float(printed) - value) <= allowed


def test_a_number_whose_error_exceeds_all_of_its_column_is_not_printed() -> None:
    pressure = ReadableUnit("MPa", 1e6)
    assert format_with_error_in(pressure, 15e6, 32e6, 15.6e6) == "? ± 32"
    assert format_with_error_in(pressure, 15e6, 14e6, 15.6e6) == "15 ± 14"
    assert format_supported(15.0, 32.0, largest=40.0) == "15"  # small beside others
    assert format_supported(0.2, 32.0, largest=15.0) == "?"
    assert format_supported(0.0, 32.0, largest=15.0) == "0"


def test_marks_of_errors_differ() -> None:
    assert format_supported(152.234, math.inf) == ">152.2"
    assert format_supported(152.234, math.nan) == "152.2"
    assert format_supported(math.nan, math.inf) == "-"
    assert [format_error(each) for each in (math.nan, 0.0, 0.0312)] == ["±?", "±0", "±0.031"]
    # A fifth of a cell of 18.75 µm, in mm: the quotient differs by rounding.
    assert {format_error(each) for each in (3.75e-6 / 1e-3, 3.7500000000000005e-6 / 1e-3)} == {
        "±0.0038"
    }
    assert [format_percent(each) for each in (0.0, 9e-5, 0.0996)] == ["0 %", "<0.01 %", "10 %"]


# --- tables -----------------------------------------------------------------------------------


def test_table_with_errors_is_whole_on_eighty_columns(
    ds: xr.Dataset, shown: Callable[..., str]
) -> None:
    ds["tilt_x"][:], ds["tilt_y"][:] = 1e-3, -2e-3  # all nine columns
    for words in ([], ["--errors"]):
        printed = shown(ds, *words)
        assert max(map(len, printed.splitlines())) <= 80
        assert "…" not in printed
        words = printed.split("─")[0].split()
        for word in ("time", "force", "approach", "tilt", "x", "y", "pressure", "[mrad]", "[kPa]"):
            assert word in words


def test_table_that_is_wider_than_the_terminal_loses_no_digit(
    ds: xr.Dataset, shown: Callable[..., str], monkeypatch: pytest.MonkeyPatch
) -> None:
    ds["tilt_x"][:], ds["tilt_y"][:] = 1.001e-3, -2.002e-3
    for name in ("tilt_x", "tilt_y", "force"):
        ds[f"{name}_error"] = 1e-3 * np.abs(ds[name])
    monkeypatch.setenv("COLUMNS", "60")
    printed = shown(ds, "--errors")
    assert "…" not in printed
    assert "±0.0020" in printed
    assert "pressure" in printed.split("─")[0].split()
    # A number a column and its error below it, but for the time's.
    assert len(re.findall(r"^ +±.*", printed, re.MULTILINE)) == 20
    assert all(len(line.split()) == 8 for line in re.findall(r"^ +±.*", printed, re.MULTILINE))


def test_last_line_of_the_table_is_the_largest_error_of_each_column(
    bare: xr.Dataset, shown: Callable[..., str]
) -> None:
    error = np.zeros(bare.sizes["time"])
    error[4] = 0.25 * bare.peak_pressure.values.max()  # at an instant that is not the largest
    printed = shown(with_errors(bare, peak_pressure=error))
    [line] = [line for line in printed.splitlines() if line.startswith(" largest ")]
    # Force, approach, area, length, width and peak; a part of each value is one of the largest.
    assert line.split() == ["largest", "±0%", "±1.2%", "±3.4%", "±0.21%", "±0.34%", "±25%"]


def test_each_number_has_its_error_below_it(ds: xr.Dataset, shown: Callable[..., str]) -> None:
    lines = shown(ds, "--errors", "--all").splitlines()
    [row] = [n for n, line in enumerate(lines) if re.match(r" +2 +1\.000 ", line)]
    at = ds.sel(time=2.0)
    half_widths = [float(each) for each in re.findall(r"±([\d.]+)", lines[row + 1])]
    expected = [
        at.approach_error * 1e6, at.contact_area_error * 1e6, at.contact_length_error * 1e3,
        at.contact_width_error * 1e3, at.peak_pressure_error * 1e-3,
    ]  # fmt: skip
    # Two digits of each; the force's is an exact zero.
    assert half_widths == close_to([0.0, *map(float, expected)], rel=0.05)


def test_errors_of_some_instants_of_many_are_those_of_these_instants(
    bare: xr.Dataset, shown: Callable[..., str]
) -> None:
    """Of 60 instants 20 are shown; at the last one the error of the approach is 6 %."""
    last = bare.isel(time=[-1] * 60).assign_coords(time=np.arange(60.0))
    parts = np.linspace(1e-3, 0.06, 60) * np.abs(last.approach.values)
    lines = shown(with_errors(last, approach=parts), "--errors").splitlines()
    [row] = [n for n, line in enumerate(lines) if re.match(r" +59 ", line)]
    [half_width] = re.findall(r"±([\d.]+)", lines[row + 1])
    assert float(half_width) == close_to(1e6 * parts[-1], rel=0.05)


def test_error_of_the_loss_stands_behind_it(ds: xr.Dataset, shown: Callable[..., str]) -> None:
    assert re.search(r"loss per cycle: [\d.]+ µJ, within 11 %", shown(ds))


def test_peak_that_depends_on_the_mesh_is_not_printed_as_a_fact(
    singular: xr.Dataset, shown: Callable[..., str]
) -> None:
    peaks = singular.peak_pressure.values * 1e-3
    for words in (["--all"], ["--all", "--errors"]):
        printed = shown(singular, *words)
        marked = [float(each) for each in re.findall(r">([\d.]+)", printed)]
        assert marked == close_to(peaks[peaks > 0], rel=1e-3)
        assert "> peak pressure depends on the mesh: the number is the largest mean" in printed
        assert re.search(r"largest .* mesh *\n +error", printed)


def test_instants_of_unknown_error_are_counted(bare: xr.Dataset, shown: Callable[..., str]) -> None:
    error = 0.1 * bare.peak_pressure.values
    error[:3] = np.nan
    count = bare.sizes["time"]
    area = np.full(count, np.nan)
    printed = shown(with_errors(bare, peak_pressure=error, contact_area=area), "--errors", "--all")
    sentence = f"error not known: contact area at {count} of {count}, peak pressure at 3 of {count}"
    assert sentence in " ".join(printed.split())
    assert "±?" in printed


def test_summary_of_a_run_has_an_accuracy_column(
    directory: Path,
    singular: xr.Dataset,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    shutil.copy(directory / "progress.jsonl", tmp_path)
    vc.save(singular, tmp_path / "result.nc")
    print_summary(tmp_path)
    printed = capsys.readouterr().out
    *lines, _ = printed.splitlines()  # the last is the file, wherever that lies
    assert max(map(len, lines)) <= 80
    rows = {line.split(" [")[0]: line for line in printed.splitlines() if " [" in line}
    # The error is a part of each value; it is largest where the approach is, at 2 s.
    at = singular.sel(time=2.0)
    value, half_width = float(at.approach) * 1e6, float(at.approach_error) * 1e6
    text = f"{value:.1f} ±{half_width:.1f} 1.2 % at 2 s"
    assert " ".join(rows["approach"].split()).endswith(text)
    assert rows["peak pressure"].count(">") == 1  # none without contact, at first and last
    assert "depends on the mesh" in rows["peak pressure"]
    assert "±: the error of each value at that instant" in printed


def test_each_value_is_followed_by_the_error_of_its_instant(bare: xr.Dataset) -> None:
    error = 0.02 * bare.peak_pressure.values
    error[2] = 0.5 * bare.peak_pressure.values.max()  # the worst, at an instant of no row
    [row] = [
        row
        for row in summary_rows(with_errors(bare, peak_pressure=error))
        if row.name == "peak_pressure"
    ]
    largest = float(bare.peak_pressure.max())
    assert float(row.largest.split(" ± ")[1]) == close_to(0.02 * largest * 1e-3, rel=0.05)
    assert float(row.error[1:]) == close_to(0.5 * largest * 1e-3, rel=0.05)
    assert (row.part, row.when) == ("50 %", f"{float(bare.time[2]) * 1e3:.0f} ms")


@pytest.mark.usefixtures("without_pictures")
def test_table_notebook_report_and_headline_say_the_same(ds: xr.Dataset) -> None:
    area = next(row for row in summary_rows(ds) if row.name == "contact_area")
    text = f"{area.largest} {area.unit}"
    assert " ± " in text
    assert text in str(ds.viscontact)
    assert text in headline(ds)
    [of_report] = [row for row in error_rows(ds) if row[0].startswith("contact area")]
    assert of_report[3] == area.largest
    assert text in report_page(ds)


def test_table_on_a_narrow_terminal_has_errors_below_their_values(
    directory: Path,
    ds: xr.Dataset,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    shutil.copy(directory / "progress.jsonl", tmp_path)
    vc.save(ds, tmp_path / "result.nc")
    monkeypatch.setenv("COLUMNS", "60")
    print_summary(tmp_path)
    table = capsys.readouterr().out.split("±: the error")[0]
    assert "…" not in table
    assert re.search(r"^mean pressure .* [\d.]+ +0.78 % *\n +±[\d.]+.* +at ", table, re.MULTILINE)


@pytest.mark.parametrize("words", [[], ["--all"]])
def test_older_results_are_shown_as_ever(
    bare: xr.Dataset, shown: Callable[..., str], words: list[str]
) -> None:
    printed = shown(bare, *words)
    assert not re.search(r"±|mesh|error at most|not known|^ +error ", printed, re.MULTILINE)
    assert "approach" in printed


def test_errors_that_a_result_does_not_state_are_refused_in_one_line(
    bare: xr.Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    vc.save(bare, tmp_path / "old.nc")
    assert main(["show", str(tmp_path / "old.nc"), "--errors"]) == 2
    said = capsys.readouterr().err
    assert "the result states none" in said
    assert said.count("\n") == 1


def test_csv_holds_every_error_to_the_last_digit(singular: xr.Dataset, tmp_path: Path) -> None:
    vc.save(singular, tmp_path / "result.nc")
    assert main(["export", str(tmp_path / "result.nc"), "-o", str(tmp_path / "history.csv")]) == 0
    with (tmp_path / "history.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for name in PARTS:
        unit = {"m2": "m^2"}.get(SCALARS[name].units, SCALARS[name].units)
        column = [float(row[f"{name}_error [{unit}]"]) for row in rows]
        assert np.array_equal(column, singular[f"{name}_error"].values, equal_nan=True), name
        values = [float(row[f"{name} [{unit}]"]) for row in rows]
        assert np.array_equal(values, singular[name].values, equal_nan=True), name
    assert {row["outcome"] for row in rows} == {"converged", "no_contact"}


def test_csv_of_an_older_result_has_no_empty_columns(
    bare: xr.Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    vc.save(bare, tmp_path / "old.nc")
    assert main(["export", str(tmp_path / "old.nc")]) == 0
    header = capsys.readouterr().out.splitlines()[0].split(",")
    assert len(header) == 1 + len(scalars_of())
    assert header[-1] == "outcome"


# --- figures ----------------------------------------------------------------------------------


def panel(figure: Figure, label: str) -> Axes:
    [axes] = [axes for axes in figure.axes if axes.get_ylabel().startswith(label)]
    return axes


def bands(axes: Axes) -> list[np.ndarray]:
    """Corners of the bands, as drawn."""
    shaded = [each for each in axes.collections if isinstance(each, PolyCollection)]
    return [path.vertices for each in shaded for path in each.get_paths()]


@pytest.mark.parametrize(
    ("label", "name", "unit"),
    [
        ("Contact area", "contact_area", 1e-6),
        ("Approach", "approach", 1e-6),
        ("Peak", "peak_pressure", 1e3),
    ],
)
def test_band_ends_at_value_plus_and_minus_error(
    ds: xr.Dataset, label: str, name: str, unit: float
) -> None:
    axes = panel(FIGURES["history"](ds), label)
    [corners] = bands(axes)
    value, error, time = ds[name].values / unit, ds[f"{name}_error"].values / unit, ds.time.values
    for instant, middle, half_width in some(zip(time, value, error, strict=True)):
        at = corners[corners[:, 0] == instant, 1]
        assert at.min() == close_to(middle - half_width, rel=1e-12, abs=1e-15)
        assert at.max() == close_to(middle + half_width, rel=1e-12, abs=1e-15)


def test_band_is_interrupted_where_the_error_is_not_known(bare: xr.Dataset) -> None:
    error = 0.1 * bare.peak_pressure.values
    error[8:11] = np.nan
    axes = panel(FIGURES["history"](with_errors(bare, peak_pressure=error)), "Peak")
    spans = [(each[:, 0].min(), each[:, 0].max()) for each in bands(axes)]
    time = bare.time.values
    assert spans == [(time[0], time[7]), (time[11], time[-1])]


def test_panel_of_a_peak_that_depends_on_the_mesh_says_so_and_has_no_band(
    singular: xr.Dataset, ds: xr.Dataset
) -> None:
    figure = FIGURES["history"](singular)
    axes = panel(figure, "Peak")
    assert axes.get_title(loc="right") == "peak depends on the mesh"
    # Without contact its error is zero, which makes no band either.
    assert bands(axes) == []
    assert bands(panel(figure, "Approach"))
    assert panel(FIGURES["history"](ds), "Peak").get_title(loc="right") == ""
    both = COMPARISONS["history"]({"round": ds, "sharp": singular})
    said = "1 of 2 runs not drawn:\npeak depends on the mesh"
    assert panel(both, "Peak").get_title(loc="right") == said
    assert len(bands(panel(both, "Peak"))) == 1


@pytest.mark.slow
def test_peak_that_depends_on_the_mesh_has_no_curve(
    singular: xr.Dataset, ds: xr.Dataset, bare: xr.Dataset
) -> None:
    axes = panel(FIGURES["history"](singular), "Peak")
    assert [text.get_text() for text in axes.texts] == ["not drawn:\nsmaller cells give more"]
    assert axes.get_yticks().size == 0
    [line] = axes.get_lines()
    assert np.isnan(np.asarray(line.get_ydata(), dtype=float)).all()
    # The other run of a comparison is drawn, on an axis that fits it.
    axes = panel(COMPARISONS["history"]({"round": ds, "sharp": singular}), "Peak")
    first, second = (np.asarray(line.get_ydata(), dtype=float) for line in axes.get_lines())
    assert np.isfinite(first).all()
    assert np.isnan(second).all()
    assert first.max() <= axes.get_ylim()[1] < 2 * first.max()
    assert not axes.texts
    # Of a peak that depends on the mesh at some instants, the others are drawn.
    error = 0.1 * bare.peak_pressure.values
    error[4:7] = np.inf
    axes = panel(FIGURES["history"](with_errors(bare, peak_pressure=error)), "Peak")
    drawn = np.isfinite(np.asarray(axes.get_lines()[0].get_ydata(), dtype=float))
    assert drawn.tolist() == np.isfinite(error).tolist()
    assert axes.get_title(loc="right") == "peak depends on the mesh"
    assert not axes.texts


@pytest.mark.parametrize(
    "name",
    [
        "pressure-profile",
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("pressure-map", "pressure-radial")
        ),
    ],
)
def test_figures_of_pressure_say_that_the_peak_depends_on_the_mesh(
    name: str, singular: xr.Dataset, ds: xr.Dataset
) -> None:
    def said(results: xr.Dataset) -> bool:
        titles = [axes.get_title(loc="right") for axes in FIGURES[name](results).axes]
        return any("depends on the mesh" in title for title in titles)

    assert said(singular)
    assert not said(ds)


def test_map_without_a_largest_pressure_has_an_open_end(
    singular: xr.Dataset, ds: xr.Dataset
) -> None:
    tops = []
    for results in (singular, ds):
        figure = FIGURES["pressure-map"](results)
        figure.draw_without_rendering()
        [bar] = [axes for axes in figure.axes if axes.get_label() == "<colorbar>"]
        tops.append(bar.get_ylim()[1] * 1e3)
    peak = float(ds.pressure.max())
    assert tops[0] < peak <= tops[1]


def test_loop_has_its_error_along_the_approach(ds: xr.Dataset) -> None:
    [axes] = FIGURES["hysteresis"](ds).axes
    corners = np.concatenate(bands(axes))
    at = ds.sel(time=1.0)  # on the way up, where the loop passes once
    passed = corners[np.isclose(corners[:, 1], float(at.force), rtol=1e-9, atol=0), 0]
    low, high = (float(at.approach + sign * at.approach_error) * 1e6 for sign in (-1, 1))
    assert np.abs(passed - low).min() < 1e-9 * high
    assert np.abs(passed - high).min() < 1e-9 * high


@pytest.mark.parametrize("name", ["history", "hysteresis"])
def test_legend_names_the_band_once_where_there_is_one(
    name: str, ds: xr.Dataset, bare: xr.Dataset
) -> None:
    def legend(figure: Figure) -> list[str]:
        inside = [axes.get_legend() for axes in figure.axes]
        found = [each for each in (*figure.legends, *inside) if each is not None]
        return [text.get_text() for each in found for text in each.get_texts()]

    assert legend(FIGURES[name](ds)) == ["band: error estimate"]
    assert legend(FIGURES[name](bare)) == []
    both = COMPARISONS[name]({"one": ds, "other": bare})
    assert legend(both) == ["one", "other", "band: error estimate"]


@pytest.mark.parametrize(
    ("part", "area_part", "label"),
    [
        (1e-6, 1e-6, "error estimate within the line's width"),
        (1e-6, 0.1, "band: error estimate, where wider than the line"),
        (0.1, 0.1, "band: error estimate"),
    ],
)
def test_legend_names_bands_only_where_they_can_be_seen(
    part: float, area_part: float, label: str, bare: xr.Dataset
) -> None:
    parts = dict.fromkeys(PARTS, part) | {"force": 0.0, "contact_area": area_part}
    errors = {name: each * np.abs(bare[name].values) for name, each in parts.items()}
    [legend] = FIGURES["history"](with_errors(bare, **errors)).legends
    assert [text.get_text() for text in legend.get_texts()] == [label]


def test_figures_of_older_results_have_no_bands(bare: xr.Dataset) -> None:
    for name in ("history", "hysteresis"):
        assert not any(bands(axes) for axes in some(FIGURES[name](bare).axes))


def test_one_wild_error_does_not_flatten_the_curve(bare: xr.Dataset) -> None:
    error = np.zeros(bare.sizes["time"])
    error[5] = 1e3 * bare.approach.values.max()
    axes = panel(FIGURES["history"](with_errors(bare, approach=error)), "Approach")
    low, high = axes.get_ylim()
    assert np.ptp(bare.approach.values) * 1e6 > (high - low) / 4


def test_steady_value_is_not_drawn_as_rounding(bare: xr.Dataset) -> None:
    steady = bare.copy(deep=True)
    steady["peak_pressure"][:] = 36e6 * (1 + 1e-13 * np.arange(bare.sizes["time"]))
    low, high = panel(FIGURES["history"](steady), "Peak").get_ylim()
    assert low == 0.0
    assert high > 36


# --- check ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("shape", "is_singular"),
    [
        ("shape: sphere, radius: 10 mm", False),
        ("shape: flat-punch, radius: 2 mm", True),
        ("shape: cone, half_angle: 80 deg", True),
        ("shape: pyramid, half_angle: 80 deg, faces: 4, rotation: 45 deg", True),
        ("shape: roller, radius: 10 mm, half_length: 2 mm", True),
        ("shape: wedge, half_angle: 80 deg, half_length: 2 mm", True),
    ],
)
def test_check_says_of_which_bodies_the_peak_depends_on_the_mesh(
    shape: str, is_singular: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = CASE.replace("shape: sphere, radius: 10 mm", shape)
    (tmp_path / "case.yaml").write_text(lines, encoding="utf-8")
    assert main(["check", str(tmp_path / "case.yaml")]) == 0
    printed = capsys.readouterr().out
    [line] = [line for line in printed.splitlines() if line.startswith("  peak pressure")]
    assert bool(re.search(r">[\d.]+ [kM]?Pa on a coarse mesh", line)) == is_singular
    assert ("depends on the mesh" in line) == is_singular


def test_scalars_that_promise_an_error_are_those_whose_error_is_estimated() -> None:
    promised = scalars_with_error()
    # Those per unit length of a line contact follow from those of a period.
    of_period = {name for name in promised if not SCALARS[name].per_length_of}
    assert of_period == {*ERROR_MODELS, "mean_pressure"}
