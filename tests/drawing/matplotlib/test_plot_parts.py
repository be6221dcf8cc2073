"""Parts of figures: instants, sections, outlines, units, files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from returned import some
from synthetic_results import FORCE, RADIUS, maxwell_sphere, roller
from viscontact.drawing.content.rim import rim_curves, rim_polygons
from viscontact.drawing.content.window import window_around
from viscontact.plot import FIGURES, save_figure
from viscontact.results.snapshots import Snapshot, take_snapshots
from viscontact.units.formatting import readable_unit, time_labels


@pytest.fixture(scope="module")
def sphere() -> xr.Dataset:
    return maxwell_sphere(cells=40)


@pytest.fixture(scope="module")
def long_contact() -> xr.Dataset:
    return roller()


def test_nearest_stored_instants_are_taken_once_and_in_order(sphere: xr.Dataset) -> None:
    snapshots = take_snapshots(sphere, [290.0, 12.0, 8.0], "figure")
    assert [snapshot.time for snapshot in snapshots] == [10.0, 300.0]


def test_default_instants_run_from_first_contact_to_last() -> None:
    results = maxwell_sphere(np.concatenate([[0.0], np.geomspace(0.1, 1000.0, 25)]), cells=16)
    results["pressure"][0] = 0.0
    results["peak_pressure"][0] = 0.0
    results["contact_area"][0] = 0.0
    times = [snapshot.time for snapshot in take_snapshots(results, None, "figure")]
    assert len(times) == 5
    assert times[0] == close_to(0.1)
    assert times[-1] == close_to(1000.0)


def test_transverse_section_runs_through_the_requested_position(long_contact: xr.Dataset) -> None:
    at = float(long_contact["x"][20])
    snapshot = take_snapshots(long_contact, [0.0], "figure")[0]
    positions, pressure = snapshot.section("y", at)
    np.testing.assert_array_equal(positions, long_contact["y"])
    np.testing.assert_allclose(pressure, long_contact["pressure"][0, 20], rtol=1e-12)


def test_window_holds_the_contact_at_every_instant(long_contact: xr.Dataset) -> None:
    snapshots = take_snapshots(long_contact, None, "figure")
    window = window_around(snapshots)
    for x_low, x_high, y_low, y_high in some(snapshot.extent() for snapshot in snapshots):
        assert window.x[0] < x_low < x_high < window.x[1]
        assert window.y[0] < y_low < y_high < window.y[1]


@pytest.mark.parametrize(
    "halvings", [(8, 16, 32), pytest.param((8, 16, 32, 64), marks=pytest.mark.slow)]
)
def test_outline_of_a_hertz_contact_is_its_circle_to_second_order(
    halvings: tuple[int, ...],
) -> None:
    """Hertz's radius (eq. 16 with Phi(0) = 1/(2G)), and his gap, whose 3/2 law holds at the rim."""
    exact = np.cbrt(3 * RADIUS * FORCE / (16 * 1e9))
    errors = []
    for cells_a_radius in halvings:
        at_once = maxwell_sphere([0.0], cells=round(2.6 * cells_a_radius))
        (outline,) = rim_polygons(take_snapshots(at_once, None, "figure")[0])
        errors.append(np.abs(np.hypot(*outline.T) - exact).max() / exact)
    # Half a cell would be 1/16 at the coarsest; the worst corner is ten times better.
    assert errors[0] < 0.007
    # Where the rim falls within a cell differs between grids, so the fit is over all.
    order = -np.polyfit(np.log(halvings), np.log(errors), 1)[0]
    assert order > 1.8


@pytest.mark.parametrize(
    ("radii", "shape"),
    [((0.01, 0.01), (20, 20)), ((0.04, 0.01), (60, 24)), ((0.2, 0.01), (100, 48))],
    ids=["circle", "ellipse", "slender ellipse"],
)
def test_curve_drawn_is_nearer_to_hertzs_ellipse_than_the_polygon_and_smooth(
    radii: tuple[float, float], shape: tuple[int, int]
) -> None:
    hertz = vc.reference.hertz_elliptical(10.0, *radii, 2e9)
    axes = np.array([hertz.semi_axis_x, hertz.semi_axis_y])
    grid = vc.Grid(shape, tuple((2.7 * axes).tolist()))
    material = vc.Material(vc.Elastic(1e9), 0.0)
    run = vc.simulate(vc.Paraboloid(*radii), material, vc.step(force=10.0), grid, [0.0])
    snapshot = take_snapshots(run, None, "figure")[0]
    (polygon,), (curve,) = rim_polygons(snapshot), rim_curves(snapshot)
    edges = np.concatenate(
        [(1 - part) * polygon[:-1] + part * polygon[1:] for part in np.linspace(0, 1, 6)]
    )
    off = [np.sqrt(np.mean((np.hypot(*(each / axes).T) - 1) ** 2)) for each in (edges, curve)]
    assert off[1] < off[0]
    # Angles between neighbouring pieces of the line, in the shape of the cells.
    turns = []
    for line in (polygon, curve):
        steps = np.diff(line / snapshot.cell_size, axis=0)
        along = np.unwrap(np.arctan2(*steps.T[::-1]))
        turns.append(np.abs(np.diff(along)).max())
    assert turns[1] < 0.5 * turns[0]


@pytest.mark.parametrize("rim", ["square", "frayed"])
def test_rim_that_is_not_smooth_stays_a_polygon(rim: str) -> None:
    x = np.arange(-31.5, 32.0)
    r, angle = np.hypot(x[:, None], x), np.arctan2(x, x[:, None])
    outside = {
        "square": np.maximum(np.abs(x[:, None]), np.abs(x)) - 18.3,
        "frayed": r - 20.3 - 2.0 * np.sign(np.sin(24 * angle)),
    }[rim]
    snapshot = Snapshot(
        0.0, x, x, 1.0 * (outside < 0), np.maximum(outside, 0.0) ** 1.5, outside < 0
    )
    for polygon, curve in some(zip(rim_polygons(snapshot), rim_curves(snapshot), strict=True)):
        assert np.array_equal(polygon, curve)


def test_outline_of_a_contact_with_a_hole_has_two_polygons() -> None:
    x = np.arange(-10.0, 11.0)
    r = np.hypot(x[:, None], x)
    outside = np.maximum(r - 8.2, 3.1 - r)
    snapshot = Snapshot(0.0, x, x, 1.0 * (outside < 0), np.maximum(outside, 0) ** 1.5, outside < 0)
    radii = sorted(float(np.hypot(*polygon.T).mean()) for polygon in rim_polygons(snapshot))
    assert radii == close_to([3.1, 8.2], abs=0.1)


def test_outline_one_cell_from_the_end_of_the_grid_is_the_circle_that_it_is_inside() -> None:
    """Its gap opens with the distance to the power of 3/2, and is not known beyond the grid."""
    x = np.arange(-5.5, 6.0)
    outside = np.hypot(x[:, None], x) - 4.9
    snapshot = Snapshot(0.0, x, x, 1.0 * (outside < 0), np.maximum(outside, 0) ** 1.5, outside < 0)
    (outline,) = rim_polygons(snapshot)
    assert np.hypot(*outline.T) == close_to(4.9, abs=0.2)


def test_outline_where_the_body_ends_stays_between_the_cells() -> None:
    x = np.arange(-5.5, 6.0)
    pressed = np.hypot(x[:, None], x) < 4
    snapshot = Snapshot(0.0, x, x, 1.0 * pressed, np.where(pressed, 0.0, np.inf), pressed)
    (outline,) = rim_polygons(snapshot)
    assert np.all(np.isfinite(outline))
    assert np.abs(np.hypot(*outline.T) - 4).max() < 1.0


def test_outline_of_a_flat_punch_is_its_own() -> None:
    punched = maxwell_sphere([0.0], cells=32)
    x = punched["x"].values
    radius = 0.8 * x[-1]
    pressed = np.hypot(x[:, None], x) <= radius
    punched["pressure"][0] = 1e6 * pressed
    punched["gap"][0] = np.where(pressed, 0.0, np.inf)
    case = punched.attrs["case"].replace(
        '"Sphere", "radius": 0.01', f'"FlatPunch", "radius": {radius}'
    )
    (outline,) = rim_polygons(take_snapshots(punched.assign_attrs(case=case), None, "figure")[0])
    assert np.abs(np.hypot(*outline.T) - radius).max() < 0.1 * (x[1] - x[0])


@pytest.mark.parametrize(
    ("unit", "largest", "symbol"),
    [
        ("Pa", 152e6, "MPa"),
        ("m", 167e-6, "µm"),
        ("m", 0.055, "mm"),
        ("m2", 94.5e-6, "mm²"),
        ("m2", 0.7e-6, "mm²"),
        ("m2", 2e-12, "µm²"),
        ("rad", 9.5e-4, "µrad"),
        ("1/Pa", 7e-10, "1/GPa"),
        ("1/Pa", 2e-6, "1/MPa"),
        ("m", 0.0, "m"),
    ],
)
def test_axes_get_the_unit_that_reads_best(unit: str, largest: float, symbol: str) -> None:
    chosen = readable_unit(unit, [0.0, -largest, np.nan])
    assert chosen.symbol == symbol
    assert float(chosen(largest)) * chosen.factor == close_to(largest)


def test_time_labels_are_distinct() -> None:
    assert time_labels([100.01, 100.02]) == ("100.01 s", "100.02 s")


@pytest.mark.parametrize(
    ("suffix", "start"),
    [(".png", b"\x89PNG"), (".pdf", b"%PDF"), (".svg", b"<?xml"), (".PNG", b"")],
)
def test_figures_are_saved_by_suffix(
    suffix: str, start: bytes, sphere: xr.Dataset, tmp_path: Path
) -> None:
    path = tmp_path / f"figure{suffix}"
    save_figure(FIGURES["history"](sphere), path)
    assert path.read_bytes().startswith(start)


def test_equal_figures_give_equal_files(sphere: xr.Dataset, tmp_path: Path) -> None:
    for suffix in (".svg", ".pdf"):
        first, second = tmp_path / f"1{suffix}", tmp_path / f"2{suffix}"
        for path in (first, second):
            save_figure(FIGURES["contact-outline"](sphere), path)
        assert first.read_bytes() == second.read_bytes()


def test_unknown_suffix_is_refused_and_nothing_written(sphere: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "figure.bmp"
    with pytest.raises(ValueError, match=r"must end in \.png, \.pdf or \.svg, got '.*figure\.bmp'"):
        save_figure(FIGURES["history"](sphere), path)
    assert not path.exists()
