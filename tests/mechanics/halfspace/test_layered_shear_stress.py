"""Stresses of tractions in layers: half-spaces, equilibrium, interfaces, and sums of waves."""

from __future__ import annotations

import numpy as np
import pytest

from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_shear_stress import LayeredShearStress
from viscontact.mechanics.halfspace.stress import stress_on_plane
from viscontact.mechanics.halfspace.stress_influence import EXCHANGED
from viscontact.mechanics.halfspace.stress_response import HalfSpaceShearStress

XX, YY, ZZ, YZ, XZ, XY = range(6)
SOFT, HARD = ElasticLayer(1.0, 1.0, 0.3), ElasticLayer(0.7, 4.0, 0.45)
STACKS = {
    "rigid": ElasticStack((SOFT, HARD), None),
    "elastic": ElasticStack((SOFT, HARD), ElasticBase(20.0, 0.25)),
}
CELL = np.array([0.4, -0.4]), np.array([0.3, -0.3])


def at(stack: ElasticStack, x: float, y: float, z: float, axis: int = 0) -> np.ndarray:
    """Stresses at a point under a unit traction on one cell around the origin."""
    return LayeredShearStress(stack, axis).coefficients(x + CELL[0], y + CELL[1], z)[:, 0, 0]


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("depth", [0.01, 0.6, 1.0, 1.2, 1.7, 4.0])
def test_layers_of_one_material_have_the_stresses_of_cerruti(axis, depth):
    nu = 0.3
    stack = ElasticStack(
        (ElasticLayer(1.0, 2.0, nu), ElasticLayer(0.7, 2.0, nu)), ElasticBase(2.0, nu)
    )
    x, y = np.linspace(3.0, -3.0, 13), np.linspace(2.0, -2.5, 10)
    exact = HalfSpaceShearStress(nu, axis).coefficients(x, y, depth)
    found = LayeredShearStress(stack, axis).coefficients(x, y, depth)
    np.testing.assert_allclose(found, exact, atol=1e-10 * np.abs(exact).max())


@pytest.mark.parametrize("name", STACKS)
@pytest.mark.parametrize("place", [(0.7, 0.4, 0.5), (-0.3, 1.1, 1.3), (0.2, -0.6, 0.9)])
def test_stresses_are_in_equilibrium(name, place):
    stack, step = STACKS[name], 1e-3

    def slope(axis: int) -> np.ndarray:
        ahead, behind = (np.array(place) for _ in range(2))
        ahead[axis] += step
        behind[axis] -= step
        return (at(stack, *ahead) - at(stack, *behind)) / (2 * step)

    dx, dy, dz = (slope(axis) for axis in range(3))
    size = max(np.abs(each).max() for each in (dx, dy, dz))
    assert abs(dx[XX] + dy[XY] + dz[XZ]) < 1e-5 * size
    assert abs(dx[XY] + dy[YY] + dz[YZ]) < 1e-5 * size
    assert abs(dx[XZ] + dy[YZ] + dz[ZZ]) < 1e-5 * size


def strains(stress: np.ndarray, modulus: float, nu: float) -> np.ndarray:
    """Strains along the surface, which a bonded interface shares: xx, yy and xy."""
    xx, yy, zz, _, _, xy = stress
    young = 2 * modulus * (1 + nu)
    return np.array([xx - nu * (yy + zz), yy - nu * (xx + zz), (1 + nu) * xy]) / young


@pytest.mark.parametrize("name", STACKS)
@pytest.mark.parametrize("place", [(0.3, 0.0), (0.7, 0.4), (-1.6, 2.1)])
def test_tractions_and_strains_are_the_same_on_both_sides_of_an_interface(name, place):
    stack = STACKS[name]
    above, beneath = (at(stack, *place, 1.0 * (1 + off)) for off in (0.0, 2e-9))
    np.testing.assert_allclose(above[[ZZ, YZ, XZ]], beneath[[ZZ, YZ, XZ]], atol=1e-9)
    one, other = strains(above, 1.0, 0.3), strains(beneath, 4.0, 0.45)
    assert np.abs(above - beneath)[[XX, YY, XY]].max() > 1e-3  # those along it jump
    np.testing.assert_allclose(one, other, atol=1e-9)


@pytest.mark.parametrize("place", [(0.3, 0.0), (0.7, 0.4), (-1.6, 2.1)])
def test_a_rigid_base_is_not_strained(place):
    stress = at(STACKS["rigid"], *place, 1.7)
    assert np.abs(stress).max() > 1e-3
    np.testing.assert_allclose(strains(stress, 4.0, 0.45), 0.0, atol=1e-9)


@pytest.mark.parametrize("name", STACKS)
def test_the_surface_carries_the_traction_and_nothing_else(name):
    for place, load in (((0.1, 0.05), 1.0), ((0.7, 0.5), 0.0)):
        stress = at(STACKS[name], *place, 1e-7)
        np.testing.assert_allclose(stress[[ZZ, YZ, XZ]], [0.0, 0.0, -load], atol=2e-6)


@pytest.mark.parametrize("axis", [0, 1])
def test_the_other_axis_is_the_first_one_turned(axis):
    stack = STACKS["rigid"]
    x, y = np.linspace(1.5, -1.0, 6), np.linspace(0.8, -1.2, 5)
    found = LayeredShearStress(stack, axis).coefficients(x, y, 1.2)
    turned = LayeredShearStress(stack, 1 - axis).coefficients(y, x, 1.2)
    np.testing.assert_allclose(found, turned[EXCHANGED].swapaxes(1, 2), atol=1e-14)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_patch_on_a_long_period_has_the_sum_of_waves(axis):
    """The waves of a grid are those of smooth loads: with half the cells a quarter of the error."""
    stack, off = STACKS["rigid"], []
    for count in (48, 96, 192):
        grid, part = Grid((count, count), (12.0, 12.0)), count // 48
        load = np.zeros(grid.shape)
        inside = slice(22 * part, 26 * part)
        load[inside, inside] = 1.0
        response = LayeredShearStress(stack, axis)
        free = stress_on_plane(load, grid, 1.2, response).components
        period = Grid(grid.shape, grid.size, (True, True))
        waves = stress_on_plane(load, period, 1.2, response).components
        near = slice(16 * part, 32 * part)
        off.append(np.abs(free - waves)[:, near, near].max() / np.abs(waves).max())
    assert off[0] / off[1] > 3.5
    assert off[1] / off[2] > 3.5
    assert off[2] < 2e-3
