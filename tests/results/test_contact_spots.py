"""Contact spots: synthetic bearing maps, borders of periods, and contacts of known number."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.cli import main
from viscontact.results.contact_spots import last_spots, spots_of
from viscontact.results.snapshot import Snapshot

CELL = 1e-6


def bearing_map(
    centres: list[tuple[float, float]], radius: float, cells: int = 64, periodic: bool = False
) -> Snapshot:
    """Discs of one radius, all in cells."""
    at = np.arange(cells) + 0.5
    x, y = np.meshgrid(at, at, indexing="ij")
    contact = np.zeros((cells, cells), bool)
    for cx, cy in centres:
        dx, dy = np.abs(x - cx), np.abs(y - cy)
        if periodic:
            dx, dy = np.minimum(dx, cells - dx), np.minimum(dy, cells - dy)
        contact |= np.hypot(dx, dy) < radius
    fields = contact.astype(float), (~contact).astype(float), contact
    return Snapshot(1.0, CELL * at, CELL * at, *fields, periodic=periodic)


def result(area: float) -> xr.Dataset:
    return xr.Dataset({"contact_area": ("time", [area])}, {"time": [1.0]})


def test_separate_discs_are_counted_with_their_areas() -> None:
    centres = [(10.0, 10.0), (30.0, 12.0), (50.0, 40.0), (20.0, 52.0)]
    shown = bearing_map(centres, 5.0)
    found = spots_of(result(4 * np.pi * 25 * CELL**2), shown)
    assert found.number == 4
    assert found.areas.sum() == close_to((shown.pressure > 0).sum() * CELL**2, rel=1e-12)
    # Each disc has the same place between the cells, so the same number of them.
    np.testing.assert_allclose(found.areas, found.areas[0])
    assert found.areas[0] == close_to(np.pi * 25 * CELL**2, rel=0.05)


def test_spots_that_meet_at_a_corner_are_two_and_at_an_edge_one() -> None:
    for cells, expected in (([(3, 3), (4, 4)], 2), ([(3, 3), (3, 4)], 1)):
        pressure = np.zeros((8, 8))
        for cell in cells:
            pressure[cell] = 1.0
        at = CELL * (np.arange(8) + 0.5)
        touching = Snapshot(1.0, at, at, pressure, 1 - pressure, pressure > 0)
        assert spots_of(result(2e-12), touching).number == expected


def test_a_spot_across_borders_of_a_period_is_one_and_the_period_is_the_nominal_area() -> None:
    centres = [(0.0, 0.0), (32.0, 0.0), (0.0, 40.0)]  # at a corner, and at two borders
    shown = bearing_map(centres, 6.0, periodic=True)
    found = spots_of(result(3 * np.pi * 36 * CELL**2), shown)
    assert found.number == 3
    np.testing.assert_allclose(found.areas, np.pi * 36 * CELL**2, rtol=0.03)
    assert found.nominal_area == close_to((64 * CELL) ** 2, rel=1e-12)
    assert found.fraction == close_to(3 * np.pi * 36 / 64**2, rel=1e-12)
    # Without the period the same cells are eight pieces.
    plain = Snapshot(1.0, shown.x, shown.y, shown.pressure, shown.gap, shown.in_contact)
    assert spots_of(result(1e-12), plain).number == 4 + 2 + 2


def test_nominal_area_of_a_free_contact_converges_to_the_convex_hull() -> None:
    # Two discs of radius r, d apart: pi r² + 2 r d. The hull of lattice points inside a convex
    # body of size r/h lacks about (r/h)^(-4/3) of it.
    errors = []
    for refine in (1, 4, 16):
        radius, cells = 5.3 * refine, 64 * refine
        centres = [(20.2 * refine, 32.0 * refine), (44.2 * refine, 32.0 * refine)]
        found = spots_of(result(1e-30), bearing_map(centres, radius, cells))
        assert found.number == 2
        exact = (np.pi * radius**2 + 2 * radius * 24.0 * refine) * CELL**2
        errors.append(1 - found.nominal_area / exact)
    assert errors[0] > errors[1] > errors[2] > 0
    assert errors[2] < 0.01
    assert errors[0] / errors[2] > 16  # better than first order


def in_cells(contact: np.ndarray, periodic: tuple[bool, bool]) -> Snapshot:
    """Cells in contact that are twice as long along y."""
    x, y = (
        CELL * size * (np.arange(n) + 0.5) for size, n in zip((1, 2), contact.shape, strict=True)
    )
    fields = contact.astype(float), (~contact).astype(float), contact
    return Snapshot(1.0, x, y, *fields, periodic=periodic)


@pytest.mark.parametrize(
    ("periodic", "cells"),
    [((True, False), 8 * 2 * 7), ((False, True), 3 * 2 * 12), ((True, True), 8 * 2 * 12)],
)
def test_nominal_area_reaches_over_the_period_and_over_the_contact_across_it(
    periodic: tuple[bool, bool], cells: int
) -> None:
    """Rows 2 and 4 of 8 along x, and columns 1 to 7 of 12 along y."""
    contact = np.zeros((8, 12), bool)
    contact[[2, 4], 1:8] = True
    found = spots_of(result(28 * CELL**2), in_cells(contact, periodic))
    assert found.number == 2
    assert found.nominal_area == close_to(cells * CELL**2, rel=1e-12)
    assert found.is_period
    assert found.text.endswith(f"{100 * 28 / cells:#.3g} % of the period")


@pytest.mark.parametrize("shape", [(1, 4), (3, 2)])
def test_a_spot_of_few_cells_fills_its_hull_and_no_more(shape: tuple[int, int]) -> None:
    """Between the centres of its cells lies less than its area."""
    contact = np.zeros((8, 12), bool)
    contact[2 : 2 + shape[0], 3 : 3 + shape[1]] = True
    area = 2 * shape[0] * shape[1] * CELL**2
    found = spots_of(result(area), in_cells(contact, (False, False)))
    assert found.nominal_area == close_to(area, rel=1e-12)
    assert found.text.endswith("100 % of its convex hull")


def test_a_smooth_ball_is_one_spot_that_fills_its_hull() -> None:
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    grid = vc.Grid((48, 48), (2e-3, 2e-3))
    ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.05), grid, [0.0, 1.0], errors=False)
    found = vc.contact_spots(ds)
    assert found.spots.values.tolist() == [1, 1]
    assert found.area_fraction.values == close_to(1.0, abs=0.05)
    assert found.largest_spot_area.values == close_to(ds.contact_area.values, rel=0.05)
    assert last_spots(ds) is None  # nothing to state


@pytest.fixture(scope="module")
def bumps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run of a plane with 4 x 3 rounded bumps on a period."""
    folder = tmp_path_factory.mktemp("bumps")
    x, y = np.meshgrid(np.arange(48) / 48, np.arange(48) / 48, indexing="ij")
    height = 2e-7 * np.cos(2 * np.pi * 4 * x) * np.cos(2 * np.pi * 3 * y)
    np.savez(folder / "bumps.npz", height=height, spacing=CELL, unit="m", periodic=True)
    case = folder / "bumps.yaml"
    case.write_text(
        "indenter: {shape: height-map, file: bumps.npz, level: none}\n"
        "material: {law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}\n"
        "load: {kind: step, mean_pressure: 0.1 MPa}\ntime: {end: 1 s, steps: 1}\n"
        "grid: {shape: [48, 48], size: [48 um, 48 um], periodic: true}\n"
        "output: {errors: false}\n",
        encoding="utf-8",
    )
    assert main(["run", str(case), "-q", "-o", str(folder / "out")]) == 0
    return folder / "out"


def test_bumps_of_a_period_are_counted_and_stated_in_table_and_figure(
    bumps: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # cos a cos b has a peak where both are 1, and where both are -1: 2 x 4 x 3 in a period.
    with vc.open_results(bumps) as ds:
        found = vc.contact_spots(ds, 1.0)
        area = float(ds.contact_area[-1])
    assert found.spots.values.tolist() == [24]
    assert float(found.mean_spot_area[0]) == close_to(area / 24)
    assert float(found.area_fraction[0]) == close_to(area / (48e-6) ** 2)
    assert main(["show", str(bumps)]) == 0
    words = f"24, mean area {1e12 * area / 24:.3g} µm²"
    said = " ".join(capsys.readouterr().out.split())
    assert words in said
    assert f"{100 * area / (48e-6) ** 2:.3g} % of the period" in said
    assert main(["plot", str(bumps), "contact-spots", "-o", str(tmp_path / "s.png")]) == 0
    assert (tmp_path / "s.png").stat().st_size > 5000


@pytest.mark.slow
def test_spots_are_a_chapter_of_the_report(bumps: Path, tmp_path: Path) -> None:
    with vc.open_results(bumps) as ds:
        found = last_spots(ds)
    assert found is not None
    assert main(["report", str(bumps), "-o", str(tmp_path / "r.html")]) == 0
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert found.text[1:] in page
    assert "<h2>Contact spots</h2>" in page


def test_figure_of_spots_draws_how_many_are_as_large(bumps: Path) -> None:
    from viscontact import plot

    with vc.open_results(bumps) as ds:
        figure = plot.contact_spots(ds, times=1.0)
        largest = float(vc.contact_spots(ds, 1.0).largest_spot_area[0])
    (line,) = figure.axes[0].get_lines()
    assert list(line.get_ydata()) == list(range(1, 25))
    assert 1e-12 * line.get_xdata()[0] == close_to(largest)
    assert np.all(np.diff(line.get_xdata()) <= 0)


def test_spots_need_stored_fields() -> None:
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    grid = vc.Grid((24, 24), (2e-3, 2e-3))
    ds = vc.simulate(
        vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False, fields="none"
    )
    with pytest.raises(ValueError, match="contact-spots: needs stored fields"):
        vc.contact_spots(ds)
    assert last_spots(ds) is None
