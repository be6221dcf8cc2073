"""Tables of a result with its errors: whole, on any width, and of all instants.

The errors here are written down, not computed: what is shown is compared with them.
"""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from closeness import close_to
from results.written_errors import bare, directory, ds, shown, singular, with_errors

__all__ = ["bare", "directory", "ds", "shown", "singular"]  # fixtures


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
