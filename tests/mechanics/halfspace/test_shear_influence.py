"""Influence coefficients under shear against the integrals that define them, and closed forms."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.shear_influence import (
    along_coefficient,
    cross_coefficient,
    shear_tables,
)

CELLS = [(1.0, 1.0), (8.0, 1.0), (1.0, 3.0)]

# At the centre, on edges and corners, near, and on both sides of the switch of formulas.
PLACES = list(itertools.product([0.0, 0.5, 1.7, 19.0, 21.0], [0.0, 0.5, 6.3, 21.0]))


def over_cell(primitive, x, y, cell):
    """Integral over a cell of a kernel whose primitive along x is given, over π."""

    def line(offset):
        return primitive(x + cell[0] / 2, offset) - primitive(x - cell[0] / 2, offset)

    ends = [y - cell[1] / 2, *([0.0] if abs(y) < cell[1] / 2 else []), y + cell[1] / 2]
    parts = [quad(line, *pair, epsabs=0, epsrel=1e-12) for pair in itertools.pairwise(ends)]
    return sum(part[0] for part in parts) / np.pi


@pytest.mark.parametrize("cell", CELLS)
def test_the_part_along_x_is_the_integral_of_its_kernel(cell):
    for i, j in PLACES:
        x, y = i * cell[0], j * cell[1]
        # ∫ x²/r³ dx = asinh(x/|y|) - x/r
        expected = over_cell(
            lambda x, y: np.arcsinh(x / max(abs(y), 1e-300)) - x / np.hypot(x, y), x, y, cell
        )
        found = float(along_coefficient(np.array(x), np.array(y), cell))
        assert found == close_to(expected, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("cell", CELLS)
def test_the_cross_part_is_the_integral_of_its_kernel(cell):
    for i, j in PLACES:
        x, y = i * cell[0], j * cell[1]
        expected = over_cell(lambda x, y: -y / np.hypot(x, y), x, y, cell)
        found = float(cross_coefficient(np.array(x), np.array(y), cell))
        assert found == close_to(expected, rel=1e-9, abs=1e-12)


def test_centre_of_a_square_under_uniform_shear():
    """Johnson 1985, section 3.6: both parts of the kernel are equal in the middle of a square."""
    tables = shear_tables(Grid((4, 4), (4.0, 4.0)))
    assert tables.direct[0, 0] == close_to(4 * np.arcsinh(1.0) / np.pi, rel=1e-12)
    assert tables.along_x[0, 0] == close_to(tables.direct[0, 0] / 2, rel=1e-12)
    assert tables.cross[0, 0] == 0.0


def test_exchange_of_the_axes():
    one, other = shear_tables(Grid((5, 7), (5.0, 2.1))), shear_tables(Grid((7, 5), (2.1, 5.0)))
    np.testing.assert_allclose(one.along_x, other.along_y.T, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(one.cross, other.cross.T, rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("cells", [1, 6, 7])
def test_cells_along_a_period_make_the_strip_in_plane_and_antiplane_strain(cells):
    """Johnson 1985, section 2.4: in plane strain shear acts as pressure does, but for a constant.

    A strip along x under q_y is displaced along y as -(2/π) ∫ ln|y|, like a half-plane under
    pressure, so Y is a constant; under q_x, in antiplane strain, 1 + κ times as much.
    """
    grid = Grid((cells, 8), (1.5, 2.4), periodic=(True, False))
    tables = shear_tables(grid)
    width = grid.cell_size[1]
    np.testing.assert_allclose(tables.along_y.sum(axis=0), 2 / np.pi * width, rtol=1e-10)
    np.testing.assert_allclose(
        tables.along_x.sum(axis=0), tables.direct.sum(axis=0) - 2 / np.pi * width, atol=1e-10
    )
    assert np.abs(tables.cross.sum(axis=0)).max() < 1e-12


@pytest.mark.parametrize("place", [(1, 1), (2, 7), (5, 3)])
def test_direct_sum_of_many_images(place):
    """The images left out fall as 1/count² where the kernel is summed to a limit."""
    cell, period = (0.25, 0.3), 1.5
    tables = shear_tables(Grid((6, 8), (period, 2.4), periodic=(True, False)))
    x, y = place[0] * cell[0], np.full(8001, place[1] * cell[1])
    images = x + np.arange(-4000, 4001) * period
    across = along_coefficient(y, images, cell[::-1]).sum()
    cross = cross_coefficient(images, y, cell).sum()
    assert tables.along_y[place] == close_to(across, rel=1e-6)
    assert tables.cross[place] == close_to(cross, rel=1e-4)


def test_a_period_along_y_is_one_along_x_turned():
    one = shear_tables(Grid((5, 6), (1.0, 1.8), periodic=(True, False)))
    other = shear_tables(Grid((6, 5), (1.8, 1.0), periodic=(False, True)))
    np.testing.assert_allclose(one.along_x, other.along_y.T, rtol=1e-12)
    np.testing.assert_allclose(one.cross, other.cross.T, rtol=1e-12)
