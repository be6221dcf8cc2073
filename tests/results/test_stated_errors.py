"""The errors that a result states are shown as numbers, and none are made up.

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

import viscontact as vc
from closeness import close_to
from reports_without_pictures import without_pictures
from results.written_errors import CASE, PARTS, bare, directory, ds, shown, singular, with_errors
from viscontact.cli import main
from viscontact.cli.run.summary import print_summary
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

__all__ = ["bare", "directory", "ds", "shown", "singular", "without_pictures"]  # fixtures


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
