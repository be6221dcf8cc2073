"""Coupling of pressure and shear tractions on the surface, against integrals and reciprocity."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_filter import CouplingSum, coupling_filter
from viscontact.mechanics.halfspace.coupling_influence import coupling_coefficient, coupling_tables

GRIDS = [
    Grid((6, 8), (1.2, 2.4), periodic=periodic)
    for periodic in ((False, False), (True, False), (False, True), (True, True))
]


@pytest.mark.parametrize(("i", "j"), [(0, 0), (1, 0), (0, 1), (2, 3), (5, 7)])
def test_coefficients_are_integrals_over_the_cell(i, j):
    (table_x, table_y), samples = _tables(GRIDS[0]), 300
    dx, dy = GRIDS[0].cell_size
    places = (np.arange(samples) + 0.5) / samples - 0.5
    x, y = i * dx + places[:, None] * dx, j * dy + places[None, :] * dy
    squared = x**2 + y**2
    means = [float((part / squared).mean()) * dx * dy / np.pi for part in (x, y)]
    assert [table_x[i, j], table_y[i, j]] == close_to(means, rel=1e-6, abs=1e-12)


def test_coefficients_far_away_are_those_of_a_point():
    x, y = np.array([[30.0]]), np.array([[40.0]])
    found = coupling_coefficient(x, y, (0.5, 0.25))
    assert found == close_to(0.125 / np.pi * 30 / 2500, rel=1e-4)


@pytest.mark.parametrize("grid", GRIDS)
def test_work_is_reciprocal(grid):
    """Tractions work on the displacement of the pressure as the pressure on theirs (Betti)."""
    random, filtered = np.random.default_rng(0), coupling_filter(grid)
    traction, pressure = random.standard_normal((2, 6, 8)), random.standard_normal((6, 8))
    one, other = filtered.normal(traction) * pressure, filtered.along(pressure) * traction
    assert one.sum() == close_to(float(other.sum()), rel=1e-12)


def test_repeated_cells_are_the_sum_of_their_images():
    grid, images = GRIDS[1], 500
    table_x, table_y = _tables(grid)
    dx, dy = grid.cell_size
    x, y = np.arange(6)[:, None] * dx, np.arange(8)[None, :] * dy
    along, across = np.zeros((6, 8)), np.zeros((6, 8))
    for image in range(-images, images + 1):
        there = x + image * 1.2
        along += coupling_coefficient(there, y, (dx, dy))
        across += coupling_coefficient(y.T, there.T, (dy, dx)).T
    # The images left out add y/r² of as many dipoles: one over their number.
    np.testing.assert_allclose(table_x, along, atol=1e-4)
    np.testing.assert_allclose(table_y, across, atol=2e-4)


def test_a_line_load_moves_both_sides_towards_it_by_the_same_way():
    """±1/2 of c J W: Johnson 1985, section 2.2."""
    grid = Grid((1, 31), (1.0, 3.1), periodic=(True, False))
    pressure = np.zeros((1, 31))
    pressure[0, 15] = 10.0
    moved = coupling_filter(grid).along(pressure)
    np.testing.assert_allclose(moved[1, 0, :15], 1.0, rtol=1e-12)
    np.testing.assert_allclose(moved[1, 0, 16:], -1.0, rtol=1e-12)
    np.testing.assert_allclose(moved[0], 0.0, atol=1e-12)


def test_a_wave_of_pressure_moves_the_surface_by_its_slope():
    """u = 2/|k|² times its gradient: towards its crests (Johnson 1985, section 13.2)."""
    grid = GRIDS[3]
    k = 2 * np.pi * np.array([1 / 1.2, 2 / 2.4])
    phase = k[0] * grid.x[:, None] + k[1] * grid.y[None, :]
    expected = k[:, None, None] * np.sin(phase) * -2 / (k @ k)
    np.testing.assert_allclose(coupling_filter(grid).along(np.cos(phase)), expected, atol=1e-12)


def _tables(grid):
    tables = coupling_tables(grid)
    return tables.along_x, tables.along_y


@pytest.mark.parametrize("mirrored", [(False, False), (True, False), (False, True), (True, True)])
def test_maps_in_single_precision_are_those_in_double(mirrored):
    random, exact = np.random.default_rng(4), coupling_filter(GRIDS[0], mirrored=mirrored)
    shape = [n // (1 + even) for n, even in zip(GRIDS[0].shape, mirrored, strict=True)]
    traction, pressure = random.standard_normal((2, *shape)), random.standard_normal(shape)
    single = exact.in_single()
    for found, expected in (
        (single.normal(traction), exact.normal(traction)),
        (single.along(pressure), exact.along(pressure)),
    ):
        assert found.dtype == np.float32
        np.testing.assert_allclose(found, expected, atol=1e-6 * np.abs(expected).max())


@pytest.mark.parametrize("size", [1e-60, 1e12])
def test_changes_are_of_any_unit(size):
    """Single precision has no numbers beyond 1e38 or below 1e-38."""
    traction = np.random.default_rng(5).standard_normal((2, 6, 8))
    exact = CouplingSum([coupling_filter(GRIDS[0])])
    found = exact.in_single().change([size * traction]) / size
    expected = exact.normal([traction])
    np.testing.assert_allclose(found, expected, atol=1e-6 * np.abs(expected).max())
    assert not exact.in_single().change([0 * traction]).any()
