"""Displacement along the surface under moving tractions, against quadratures and rest."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import scipy

import viscontact as vc
from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.moving_shear import (
    MovingShear,
    moving_shear_convolution,
    moving_shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_filter import shear_convolution
from viscontact.mechanics.halfspace.shear_influence import shear_tables

CELL = 0.5, 0.3
KAPPA = 0.7


def compliance(instant: float, amplitude: float, length: float) -> MovingCompliance:
    return MovingCompliance(instant, np.array([amplitude]), np.array([length]))


def random_pair(shape: tuple[int, int]) -> Floats:
    return np.random.default_rng(3).normal(size=(2, *shape))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("periodic", [False, True])
def test_surface_without_creep_moves_as_at_rest(axis, periodic):
    shape = (6, 9)
    across = [False, False]
    across[1 - axis] = periodic
    grid = vc.Grid(shape, (shape[0] * CELL[0], shape[1] * CELL[1]), periodic=tuple(across))
    shear = MovingShear(compliance(2.0, 0.0, 1.0), compliance(2.0 * KAPPA, 0.0, 1.0))
    field = random_pair(shape)
    moved = moving_shear_convolution(grid, shape, shear, axis).apply(field)
    rest = shear_convolution(shear_tables(grid), (across[0], across[1]))
    expected = 2.0 * rest.sum_of(1.0, KAPPA).apply(field)
    np.testing.assert_allclose(moved, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("axis", [0, 1])
def test_creeping_surface_remembers_the_tractions_ahead(axis):
    """A cell's displacement is J0 K + J1 ∫ exp(-z/l) K(ξ + z) dz/l, K by a quadrature of 1/r."""
    shape, length, instant, late = (5, 5), 0.8, 1.0, 3.0
    grid = vc.Grid(shape, (shape[0] * CELL[0], shape[1] * CELL[1]))
    shear = MovingShear(
        compliance(instant, late, length), compliance(KAPPA * instant, KAPPA * late, length)
    )
    operator = moving_shear_convolution(grid, shape, shear, axis)
    for loaded in (0, 1):
        field = np.zeros((2, *shape))
        field[loaded, 2, 2] = 1.0
        found = operator.apply(field)
        for place in ((0, 1), (4, 3), (2, 2), (1, 4)):
            offset = (place[0] - 2) * CELL[0], (place[1] - 2) * CELL[1]
            for moved in (0, 1):

                def at(z: float, pair: Any = (moved, loaded), offset: Any = offset) -> float:
                    x, y = offset
                    ahead = (x + z, y) if axis == 0 else (x, y + z)
                    return coefficient(*pair, *ahead)

                nodes, weights = graded_rule(length)
                memory = sum(w * at(z) for z, w in zip(nodes, weights, strict=True))
                expected = instant * at(0.0) + late * memory
                assert abs(found[(moved, *place)] - expected) < 2e-4


def coefficient(moved: int, loaded: int, x: float, y: float) -> float:
    """Displacement of unit J by a unit traction on a cell around the origin, by its corners."""
    a, b = CELL[0] / 2, CELL[1] / 2
    total = 0.0
    for u, v, sign in (
        (x + a, y + b, 1),
        (x + a, y - b, -1),
        (x - a, y + b, -1),
        (x - a, y - b, 1),
    ):
        r = math.hypot(u, v)
        along_x = v * math.asinh(u / abs(v)) if v else 0.0  # of x²/r³
        along_y = u * math.asinh(v / abs(u)) if u else 0.0
        direct = along_x + along_y
        if moved != loaded:
            total += sign * KAPPA * -r
        else:
            total += sign * (direct + KAPPA * (along_x if loaded == 0 else along_y))
    return total / math.pi


def graded_rule(length: float) -> tuple[Floats, Floats]:
    """Midpoints and weights of exp(-z/l)/l on [0, 30 l]."""
    edges = np.concatenate([np.linspace(0, 4, 4001), np.geomspace(4, 30, 400)[1:]]) * length
    weights = np.exp(-edges[:-1] / length) - np.exp(-edges[1:] / length)
    return (edges[1:] + edges[:-1]) / 2, weights


def test_preconditioner_is_the_inverse_of_short_waves():
    shape = (32, 48)
    grid = vc.Grid(shape, (shape[0] * CELL[0], shape[1] * CELL[1]))
    shear = MovingShear(compliance(1.0, 4.0, 2.0), compliance(0.6, 2.4, 2.0))
    operator = moving_shear_convolution(grid, shape, shear, 1)
    inverse = moving_shear_preconditioner(shape, grid.cell_size, shear, 1)
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    window = np.exp(-((x / 3) ** 2) - (y / 3) ** 2)
    field = np.stack([window * np.sin(3.5 * x + y), window * np.cos(2.5 * y)])
    again = inverse.apply(operator.apply(field))
    inside = np.s_[:, 12:20, 18:30]
    assert np.abs((again - field)[inside]).max() < 0.2 * np.abs(field).max()
    assert scipy.linalg.norm(again - field) < 0.2 * scipy.linalg.norm(field)
