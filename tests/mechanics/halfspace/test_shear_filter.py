"""Displacement along the surface under shear, against sums over all pairs of cells and waves."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.shear_filter import (
    periodic_shear_convolution,
    shear_convolution,
    shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_influence import (
    along_coefficient,
    cross_coefficient,
    shear_tables,
)

KAPPA = 0.4


def summed(traction, grid, kappa):
    """Sum over all pairs of cells of the coefficients of their offsets."""
    found = np.zeros(traction.shape)
    x, y = grid.x, grid.y
    tables = shear_tables(grid)
    for i, j in np.ndindex(grid.shape):
        dx, dy = np.broadcast_arrays(x[:, None] - x[i], y[None, :] - y[j])
        direct = tables.direct[
            np.abs(np.arange(grid.shape[0]) - i)[:, None], np.abs(np.arange(grid.shape[1]) - j)
        ]
        xx = along_coefficient(dx, dy, grid.cell_size)
        xy = cross_coefficient(dx, dy, grid.cell_size)
        qx, qy = traction[:, i, j]
        found[0] += (direct + kappa * xx) * qx + kappa * xy * qy
        found[1] += (direct + kappa * (direct - xx)) * qy + kappa * xy * qx
    return found


@pytest.mark.parametrize("shape", [(5, 6), (8, 3 + 1)])
def test_convolution_is_the_sum_over_all_pairs(shape):
    grid = Grid(shape, (1.3, 0.9))
    traction = np.random.default_rng(3).normal(size=(2, *shape))
    operator = shear_convolution(shear_tables(grid), (False, False)).sum_of(1.0, KAPPA)
    expected = summed(traction, grid, KAPPA)
    np.testing.assert_allclose(operator.apply(traction), expected, atol=1e-12)


def test_single_precision_serves_small_numbers():
    grid = Grid((6, 6), (1.0, 1.0))
    parts = shear_convolution(shear_tables(grid), (False, False))
    traction = 1e-60 * np.random.default_rng(4).normal(size=(2, 6, 6))
    both = (parts.sum_of(1.0, KAPPA, single=single).apply(traction * 1e60) for single in (0, 1))
    double, single = both
    np.testing.assert_allclose(single, double, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("axis", [0, 1])
def test_waves_of_traction_along_and_across_their_vector(axis):
    """Plane and antiplane strain: 2/k along the wave vector, 2 (1 + κ)/k across it."""
    grid = Grid((16, 12), (0.8, 0.6), periodic=True)
    k = 2 * np.pi * 3 / grid.size[axis]
    wave = np.cos(k * (grid.x[:, None] if axis == 0 else grid.y[None, :])) + np.zeros((16, 12))
    operator = periodic_shear_convolution(grid.shape, grid.cell_size).sum_of(1.0, KAPPA)
    for component in (0, 1):
        traction = np.zeros((2, 16, 12))
        traction[component] = wave
        factor = 1.0 if component == axis else 1 + KAPPA
        np.testing.assert_allclose(
            operator.apply(traction)[component], 2 / k * factor * wave, atol=1e-13
        )


def test_an_oblique_wave_turns_with_its_vector():
    grid = Grid((16, 16), (1.0, 1.0), periodic=True)
    k = 2 * np.pi * np.array([3.0, 4.0])
    along = k / np.hypot(*k)
    wave = np.cos(k[0] * grid.x[:, None] + k[1] * grid.y[None, :])
    operator = periodic_shear_convolution(grid.shape, grid.cell_size).sum_of(1.0, KAPPA)
    for direction, factor in ((along, 1.0), (np.array([-along[1], along[0]]), 1 + KAPPA)):
        found = operator.apply(direction[:, None, None] * wave)
        expected = 2 / np.hypot(*k) * factor * direction[:, None, None] * wave
        np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize("shape", [(8, 9), (7, 12)])
def test_the_operator_is_symmetric_and_positive(shape):
    """Reciprocity (Betti 1872): the work of one traction on the displacements of another."""
    random = np.random.default_rng(5)
    grid = Grid(shape, (1.0, 1.1))
    operators = [
        shear_convolution(shear_tables(grid), (False, False)).sum_of(1.0, 1.0),
        periodic_shear_convolution(shape, grid.cell_size).sum_of(1.0, 1.0),
        shear_preconditioner(shape, grid.cell_size, 1.0),
    ]
    for operator in operators:
        one, other = random.normal(size=(2, 2, *shape))
        there, back = (
            float((one * operator.apply(other)).sum()),
            float((other * operator.apply(one)).sum()),
        )
        assert there == close_to(back, rel=1e-4)
        assert float((one * operator.apply(one)).sum()) > 0


def test_the_preconditioner_inverts_the_waves_of_a_period():
    grid = Grid((9, 12), (1.0, 1.1), periodic=True)
    traction = np.random.default_rng(6).normal(size=(2, 9, 12))
    traction -= traction.mean(axis=(1, 2), keepdims=True)
    operator = periodic_shear_convolution(grid.shape, grid.cell_size).sum_of(1.0, KAPPA)
    inverse = shear_preconditioner(grid.shape, grid.cell_size, KAPPA)
    found = inverse.apply(operator.apply(traction))
    # But for waves of the shortest length along y, whose part across has no sign.
    whole = np.fft.rfft2(traction - found)[..., :-1]
    assert np.abs(whole).max() < 1e-5 * np.abs(np.fft.rfft2(traction)).max()
