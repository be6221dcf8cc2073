"""The figure of the line load draws ∫ p dy at the instants that its legend names."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from synthetic_results import roller
from viscontact.cli import main
from viscontact.plot import COMPARISONS, FIGURES
from viscontact.reference import hertz_elliptical

FORCE, RADII, SHEAR_MODULUS = 40.0, (0.4, 0.02), 1e8
OFFSET = (1.5e-3, -0.1e-3)


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    """An ellipse away from the centre, on cells longer along x, that grows for 4 s."""
    body = vc.Material(vc.Maxwell(SHEAR_MODULUS, 30 * SHEAR_MODULUS), poisson_ratio=0.5)
    load = vc.step(FORCE, eccentricity_x=OFFSET[0], eccentricity_y=OFFSET[1])
    grid = vc.Grid((60, 44), (20e-3, 3.4e-3))
    times = [0.0, 1.0, 4.0]
    return vc.simulate(vc.Paraboloid(*RADII), body, load, grid, times, errors=False)


def curve(axes: Axes, index: int = 0) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    line = axes.get_lines()[index]
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


def legend_of(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


def test_curve_is_that_of_hertz_at_the_first_instant(ds: xr.Dataset) -> None:
    axes = FIGURES["line-load"](ds, times=[0.0]).axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "Line load [kN/m]")
    x, load = curve(axes)
    a = hertz_elliptical(FORCE, *RADII, 4 * SHEAR_MODULUS).semi_axis_x
    expected = 0.75 * FORCE / a * np.maximum(1 - ((x * 1e-3 - OFFSET[0]) / a) ** 2, 0)
    np.testing.assert_allclose(load * 1e3, expected, atol=0.015 * expected.max())
    # The curve begins and ends at zero, within half a cell of the contact's ends.
    ends = (OFFSET[0] - a) * 1e3, (OFFSET[0] + a) * 1e3
    assert (x[0], x[-1]) == close_to(ends, abs=0.5 * 20 / 60)
    assert load[[0, -1]].tolist() == [0.0, 0.0]
    low, high = axes.get_xlim()
    assert low < x[0] < x[-1] < high


def test_each_curve_is_the_line_load_of_the_instant_that_is_named(ds: xr.Dataset) -> None:
    """By default all stored instants, else the nearest to those requested."""
    for times, named in ((None, [0.0, 1.0, 4.0]), ([1.2], [1.0]), ([3.0, 0.4], [0.0, 4.0])):
        axes = FIGURES["line-load"](ds, times=times).axes[0]
        assert legend_of(axes) == [f"{time:g} s" for time in named]
        assert len(axes.get_lines()) == len(named)
        for index, time in enumerate(named):
            x, load = curve(axes, index)
            at_time = ds.sel(time=time)
            expected = at_time.pressure.values.sum(axis=1) * (3.4e-3 / 44)
            np.testing.assert_allclose(at_time.line_load, expected, rtol=1e-12)
            pressed = expected > 0
            np.testing.assert_allclose(load[1:-1] * 1e3, expected[pressed], rtol=1e-12)
            np.testing.assert_allclose(x[1:-1] * 1e-3, ds.x.values[pressed], rtol=1e-12)


def test_fields_at_some_instants_are_drawn(ds: xr.Dataset) -> None:
    fields = ["pressure", "gap", "displacement", "line_load"]
    some = ds[fields].isel(time=[0, 2]).rename(time="field_time")
    thinned = xr.merge([ds.drop_vars(fields), some])
    assert legend_of(FIGURES["line-load"](thinned).axes[0]) == ["0 s", "4 s"]


def test_comparison_has_a_panel_for_each_instant_and_a_curve_for_each_run(ds: xr.Dataset) -> None:
    other = ds.copy(deep=True)
    other["pressure"] = 2 * ds.pressure
    first, last = COMPARISONS["line-load"]({"one": ds, "two": other}).axes
    assert [axes.get_title(loc="left") for axes in (first, last)] == ["t = 0 s", "t = 4 s"]
    for axes, time in ((first, 0.0), (last, 4.0)):
        (_, one), (_, two) = curve(axes, 0), curve(axes, 1)
        expected = ds.line_load.sel(time=time).values
        np.testing.assert_allclose(one[1:-1] * 1e3, expected[expected > 0], rtol=1e-12)
        np.testing.assert_allclose(two, 2 * one, rtol=1e-12)
        # Both panels have room for the highest curve of either.
        assert axes.get_ylim() == (0.0, close_to(1.05 * 2e-3 * float(ds.line_load.max())))


def test_figure_notes_where_the_line_load_depends_on_the_mesh() -> None:
    results = roller()
    count = results.sizes["time"]
    axes = FIGURES["line-load"](results).axes[0]
    assert axes.get_title(loc="right") == ""
    error = ("time", np.full(count, np.inf), {"units": "Pa"})
    axes = FIGURES["line-load"](results.assign(peak_pressure_error=error)).axes[0]
    assert axes.get_title(loc="right") == "at a sharp end it depends on the mesh"


def test_line_load_of_a_period_continues_at_its_border() -> None:
    """Two waves along x in full contact, and sixteen cells across."""
    grid = vc.Grid((40, 16), (2e-3, 1e-3), periodic=True)
    body = vc.Material(vc.Elastic(1e8), 0.5)
    waves = vc.Waviness(1e-8, wavelength_x=1e-3)
    ds = vc.simulate(waves, body, vc.step(1.0), grid, [0.0], errors=False)
    axes = FIGURES["line-load"](ds).axes[0]
    x, load = curve(axes)
    assert x.size == 42
    q = ds.line_load.values[0]
    scale = {"Line load [N/m]": 1.0, "Line load [kN/m]": 1e3}[axes.get_ylabel()]
    np.testing.assert_allclose(load * scale, [q[-1], *q, q[0]], rtol=1e-12)
    assert axes.get_xlim() == close_to((-1.0, 1.0))


def test_methods_and_commands_draw_it(ds: xr.Dataset, tmp_path: Path) -> None:
    assert ds.viscontact.plot.line_load(times=[0.0]).get_ylabel() == "Line load [kN/m]"
    vc.save(ds, tmp_path / "one.nc")
    vc.save(ds.assign(pressure=2 * ds.pressure), tmp_path / "two.nc")
    one, two, picture = (str(tmp_path / name) for name in ("one.nc", "two.nc", "line.png"))
    assert main(["plot", one, "line-load", "--time", "1 s", "-o", picture]) == 0
    assert Path(picture).read_bytes().startswith(b"\x89PNG")
    assert main(["compare", one, two, "--figure", "line-load", "-o", picture]) == 0


def test_command_names_the_instant_that_it_draws(
    ds: xr.Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    vc.save(ds, tmp_path / "one.nc")
    arguments = ["plot", str(tmp_path / "one.nc"), "line-load", "--time", "2 s"]
    assert main([*arguments, "-o", str(tmp_path / "line.png")]) == 0
    assert "2 s is not stored; drew 1 s" in capsys.readouterr().err
    assert main([*arguments, "--at", "1 mm"]) == 2
    assert "--at: does not apply to the figure line-load" in capsys.readouterr().err
