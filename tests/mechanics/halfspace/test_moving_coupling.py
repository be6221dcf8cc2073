"""Coupling of pressure and tractions in motion, against quadrature and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_filter import coupling_filter
from viscontact.mechanics.halfspace.coupling_influence import coupling_coefficient
from viscontact.mechanics.halfspace.moving_coupling import moving_coupling_filter
from viscontact.mechanics.halfspace.moving_load import MovingCompliance

CELL = (1e-3, 0.7e-3)
INSTANT, AMPLITUDE, LENGTH = 0.4, 1.3, 2.1e-3
CREEPING = MovingCompliance(INSTANT, np.array([AMPLITUDE]), np.array([LENGTH]))


def unit(shape: tuple[int, int], at: tuple[int, int]) -> np.ndarray:
    field = np.zeros(shape)
    field[at] = 1.0
    return field


@pytest.mark.parametrize("axis", [0, 1])
def test_a_moving_cell_displaces_the_surface_by_the_pressure_it_has_had(axis: int) -> None:
    """u = -(J0 X + J1 ∫ exp(-z/l) X(ξ + z) dz/l): the load was behind by z a time z/V ago."""
    grid = Grid((9, 8), (9 * CELL[0], 8 * CELL[1]))
    maps = moving_coupling_filter(grid, CREEPING, axis)
    found = maps.along(unit((9, 8), (4, 3)))

    def coefficient(own: int, x: float, y: float) -> float:
        pair = (x, y) if own == 0 else (y, x)
        cell = CELL if own == 0 else CELL[::-1]
        return float(coupling_coefficient(np.array([pair[0]]), np.array([pair[1]]), cell)[0])

    for own in (0, 1):
        for i, j in ((6, 3), (2, 3), (4, 5), (7, 6), (1, 1)):
            place = [(i - 4) * CELL[0], (j - 3) * CELL[1]]

            def later(z: float, own: int = own, place: list[float] = place) -> float:
                moved = [each + z * (at == axis) for at, each in enumerate(place)]
                return np.exp(-z / LENGTH) / LENGTH * coefficient(own, *moved)

            breaks = [k * CELL[axis] / 2 for k in range(1, 20)]
            delayed = quad(later, 0, 60 * LENGTH, points=breaks, limit=400, epsabs=1e-12)[0]
            exact = -(INSTANT * coefficient(own, *place) + AMPLITUDE * delayed)
            assert found[own, i, j] == close_to(exact, rel=1e-6, abs=1e-11)


def test_a_strip_stretches_the_surface_by_its_pressure_and_that_it_had() -> None:
    """du/dy = -2 (J0 p + J1 E p), with E p of a block in closed form: 1 - exp(-..) behind."""
    count, cell = 64, 1e-3
    grid = Grid((1, count), (1.0, count * cell), (True, False))
    pressure = np.zeros((1, count))
    pressure[0, 30:38] = 1.0
    (_, moved) = moving_coupling_filter(grid, CREEPING, 1).along(pressure)
    stretch = np.diff(moved[0]) / cell
    begin, end = grid.y[30] - cell / 2, grid.y[37] + cell / 2

    def had(y: float) -> float:
        if y > end:
            return 0.0
        return float(np.exp(-max(begin - y, 0.0) / LENGTH) - np.exp(-(end - y) / LENGTH))

    for k in (5, 20, 29, 33, 36, 40):
        low, high = grid.y[k], grid.y[k + 1]
        edges = [each for each in (begin, end) if low < each < high]
        delayed = quad(had, low, high, points=edges or None)[0] / cell
        pressed = (min(high, end) - max(low, begin)) / cell
        exact = -2 * (INSTANT * max(pressed, 0.0) + AMPLITUDE * delayed)
        assert stretch[k] == close_to(exact, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("periodic", [(False, False), (True, False), (False, True)])
def test_without_creep_it_is_the_coupling_at_rest(periodic: tuple[bool, bool]) -> None:
    grid = Grid((6, 10), (6e-3, 7e-3), periodic)
    axis = 0 if periodic[1] else 1
    random = np.random.default_rng(3)
    pressure, traction = random.normal(size=(6, 10)), random.normal(size=(2, 6, 10))
    elastic = MovingCompliance(1.0, np.empty(0), np.empty(0))
    moving, rest = moving_coupling_filter(grid, elastic, axis), coupling_filter(grid)
    for name, given in (("along", pressure), ("normal", traction)):
        exact = getattr(rest, name)(given)
        found = getattr(moving, name)(given)
        np.testing.assert_allclose(found, exact, atol=1e-12 * np.abs(exact).max())


def test_traction_displaces_into_the_surface_as_pressure_along_it() -> None:
    """The kernels are the same but for the sign, with the same delay."""
    grid = Grid((7, 7), (7e-3, 7e-3))
    maps = moving_coupling_filter(grid, CREEPING, 1)
    pressed = maps.along(unit((7, 7), (3, 3)))
    for axis in (0, 1):
        traction = np.zeros((2, 7, 7))
        traction[axis, 3, 3] = 1.0
        np.testing.assert_allclose(maps.normal(traction), -pressed[axis], atol=1e-12)
