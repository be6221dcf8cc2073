"""Stresses inside layers under cells of pressure, against closed forms, waves and equilibrium."""

import numpy as np
import pytest
from scipy import integrate

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.stack_waves import stack_waves
from viscontact.mechanics.halfspace.stress import stress_on_plane, stress_on_section
from viscontact.mechanics.halfspace.stress_influence import stress_coefficients

COATED = ElasticStack(
    (ElasticLayer(0.4, 4.0, 0.25), ElasticLayer(0.3, 1.0, 0.45)), ElasticBase(2.0, 0.3)
)
ON_RIGID = ElasticStack((ElasticLayer(0.5, 1.0, 0.5),), None)


def equal_parts(nu):
    layers = tuple(ElasticLayer(each, 2.0, nu) for each in (0.7, 0.1, 1.3))
    return LayeredStress(ElasticStack(layers, ElasticBase(2.0, nu)))


@pytest.mark.parametrize("nu", [0.0, 0.3, pytest.param(0.5, marks=pytest.mark.slow)])
@pytest.mark.parametrize("edge", [0.01, pytest.param(0.5, marks=pytest.mark.slow), 1000.0])
def test_equal_layers_under_cells_of_any_size_are_loves_half_space(nu, edge):
    """Below the first layer nothing comes from Love's closed form. Measured: 1e-12."""
    body = equal_parts(nu)
    x = (np.arange(6.0, -7.0, -1) + 0.5) * edge
    y = np.append((np.arange(5.0, -1.0, -1) + 0.3) * edge, 0.0)
    for depth in (1e-6, 0.7, 0.75, 2.0, 5.0):
        wanted = stress_coefficients(x, y, depth, nu)
        assert body.coefficients(x, y, depth) == close_to(wanted, abs=1e-11)


@pytest.mark.parametrize("stack", [COATED, ON_RIGID])
@pytest.mark.parametrize(
    "depth",
    [
        1e-6,
        0.45,
        pytest.param(0.2, marks=pytest.mark.slow),
        pytest.param(0.4, marks=pytest.mark.slow),
    ],
)
def test_small_cells_in_a_row_have_the_stresses_of_single_ones(stack, depth):
    """Most of the row is interpolated, single cells are not. Measured: 2e-15."""
    body, edge = LayeredStress(stack), 0.004
    x, y = ((np.arange(count, -1.0, -1) - 0.3) * edge for count in (220, 130))
    row = body.coefficients(x, y, depth)
    for i in (0, 1, 100, 219):
        for j in (0, 64, 129):
            one = body.coefficients(x[i : i + 2], y[j : j + 2], depth)[:, 0, 0]
            assert row[:, i, j] == close_to(one, abs=1e-13)


@pytest.mark.parametrize(
    "periodic", [pytest.param((True, False), marks=pytest.mark.slow), (True, True)]
)
def test_equal_layers_are_a_half_space_on_every_grid(periodic):
    grid = Grid((9, 6), (2.0, 1.7), periodic, centre=(0.1, 0.2))
    pressure = np.random.default_rng(4).uniform(0, 1, grid.shape)
    for where in ({}, {"x": 0.3}):
        found, wanted = (
            stress_on_section(pressure, grid, [0.0, 0.75], body, **where).components
            for body in (equal_parts(0.3), 0.3)
        )
        assert found == close_to(wanted, abs=1e-11)


@pytest.mark.parametrize(
    "periodic", [(False, False), pytest.param((False, True), marks=pytest.mark.slow), (True, True)]
)
@pytest.mark.parametrize("body", [0.3, LayeredStress(COATED)])
def test_a_plane_and_a_section_agree_where_they_meet(periodic, body):
    grid = Grid((6, 5), (2.0, 1.7), periodic, centre=(0.1, 0.2))
    two = np.random.default_rng(5).uniform(0, 1, (2, *grid.shape))
    plane = stress_on_plane(two, grid, 0.5, body).components
    section = stress_on_section(two, grid, [0.5], body, y=grid.y[3]).components
    assert plane[..., 3] == close_to(section[:, :, 0], abs=1e-12)


def hankel_on_axis(stack, depth):
    """Axial and radial stress on the axis under Hertz's pressure sqrt(1 - r²).

    Its Hankel transform is (sin q - q cos q)/q³; on the axis the radial stress is the mean of X and
    Y. Gauss panels along real wave numbers: an integral of its own.
    """
    nodes, weights = np.polynomial.legendre.leggauss(24)
    edges = np.linspace(1e-9, 40 / depth, 400)
    half = np.diff(edges)[:, None] / 2
    q = (edges[:-1, None] + half * (1 + nodes)).ravel()
    waves = stack_waves(stack, q).stresses(depth)
    weighted = (half * weights).ravel() * (np.sin(q) - q * np.cos(q)) / q**2
    return (weighted * waves.normal).sum(), (weighted * (waves.along + waves.across)).sum() / 2


def test_stress_on_the_axis_of_a_ball_converges_to_the_hankel_integral():
    depths = [0.2, 0.4, 0.4 * (1 + 2e-9), 0.6, 1.0]
    wanted = np.array([hankel_on_axis(COATED, depth) for depth in depths])
    errors = []
    for cells in (21, 41, 81):
        grid = Grid((cells, cells), (2.2, 2.2))
        pressure = np.sqrt(np.maximum(0, 1 - grid.x[:, None] ** 2 - grid.y[None, :] ** 2))
        stress = stress_on_section(pressure, grid, depths, LayeredStress(COATED))
        middle = cells // 2
        found = np.stack([stress["zz"][:, middle], stress["xx"][:, middle]], axis=1)
        errors.append(np.abs(found - wanted).max())
        assert stress["xx"][:, middle] == close_to(stress["yy"][:, middle], abs=1e-12)
    assert errors[2] < 1e-3
    # 1.5 is what a square root at the rim leaves of 2 in the sum over cells.
    assert errors[0] / errors[2] > 4**1.4


def divergence(body, depth, step):
    """Divergence of the stress at a point, by central differences, over its largest term."""
    grid = Grid((12, 10), (2.0, 1.6))
    pressure = np.random.default_rng(2).uniform(0, 1, grid.shape)
    i, j = 5, 6
    x, y = float(grid.x[i]), float(grid.y[j])
    before, after = (
        (
            stress_on_section(pressure, grid, [depth], body, x=x + way).components[:, 0, j],
            stress_on_section(pressure, grid, [depth], body, y=y + way).components[:, 0, i],
            stress_on_section(pressure, grid, [depth + way], body, y=y).components[:, 0, i],
        )
        for way in (-step, step)
    )
    dx, dy, dz = (far - near for near, far in zip(before, after, strict=True))
    # xx, yy, zz, yz, xz, xy
    rows = [(dx[0], dy[5], dz[4]), (dx[5], dy[1], dz[3]), (dx[4], dy[3], dz[2])]
    return np.array([abs(sum(row)) / max(map(abs, row)) for row in rows])


@pytest.mark.parametrize("depth", [0.3, 0.55, 0.9])
def test_stresses_in_every_layer_are_in_equilibrium(depth):
    body = LayeredStress(COATED)
    coarse, fine = divergence(body, depth, 0.02), divergence(body, depth, 0.005)
    assert fine.max() < 5e-3
    # what is left is the differences' own error, of second order
    assert (coarse / fine > 14).all()
    assert (coarse / fine < 18).all()


@pytest.mark.parametrize("stack", [COATED, ON_RIGID])
def test_the_surface_is_free_outside_the_load_and_carries_it_inside(stack):
    grid = Grid((12, 10), (2.0, 1.6))
    pressure = np.random.default_rng(6).uniform(0, 1, grid.shape)
    pressure[:4] = 0.0
    stress = stress_on_plane(pressure, grid, 0.0, LayeredStress(stack))
    # Just below the surface, at 1e-6 cells.
    assert stress["zz"] == close_to(-pressure, abs=1e-5)
    assert np.abs(stress["xz"]).max() < 1e-5
    assert np.abs(stress["yz"]).max() < 1e-5


def test_tractions_of_cells_are_the_same_on_both_sides_of_an_interface():
    grid = Grid((12, 10), (2.0, 1.6))
    pressure = np.random.default_rng(7).uniform(0, 1, grid.shape)
    for depth in (0.4, 0.7):
        above, beneath = (
            stress_on_plane(pressure, grid, depth * scale, LayeredStress(COATED))
            for scale in (1.0, 1 + 3e-9)
        )
        for name in ("zz", "xz", "yz"):
            assert beneath[name] == close_to(above[name], abs=1e-7)
        assert np.abs(above["xx"] - beneath["xx"]).max() > 0.05


def test_the_load_goes_through_every_depth():
    """Over rings around the axis, to where the stress falls as under a point load, as r^-5."""
    cell, half = 0.05, 200
    grid = Grid((2 * half + 1, 41), ((2 * half + 1) * cell, 41 * cell))
    pressure = np.sqrt(np.maximum(0, 1 - grid.x[:, None] ** 2 - grid.y[None, :] ** 2))
    force = pressure.sum() * grid.cell_area
    for depth in (0.4, 0.6, 1.0):
        stress = stress_on_section(pressure, grid, [depth], LayeredStress(COATED))["zz"][0, half:]
        radii = grid.x[half:]
        within = -2 * np.pi * integrate.simpson(stress * radii, x=radii)
        tail = -2 * np.pi * stress[-1] * radii[-1] ** 2 / 3
        assert within + tail == close_to(force, rel=2e-3)


def test_on_a_rigid_base_the_load_goes_through_the_plane_of_every_depth():
    """There stresses fall exponentially, and sums over cells are exact for smooth fields."""
    grid = Grid((160, 160), (20.0, 20.0))
    pressure = np.zeros(grid.shape)
    pressure[76:84, 78:82] = np.random.default_rng(10).uniform(0, 1, (8, 4))
    for depth in (0.3, 0.5):
        stress = stress_on_plane(pressure, grid, depth, LayeredStress(ON_RIGID))
        assert -stress["zz"].sum() == close_to(pressure.sum(), rel=1e-6)


def test_a_thin_incompressible_layer_follows_lubrication_theory():
    """Beneath a smooth pressure σzz = -p and σyz = h dp/dy at a rigid base, within O(h²/a²)."""
    grid = Grid((1, 600), (1.0, 6.0), (True, False))
    pressure = np.exp(-(grid.y**2))
    slope = -2 * grid.y * pressure
    errors = []
    for thickness in (0.05, 0.025):
        body = LayeredStress(ElasticStack((ElasticLayer(thickness, 1.0, 0.5),), None))
        stress = stress_on_plane(pressure[None, :], grid, thickness, body)
        shear = stress["yz"][0] / thickness
        errors.append((np.abs(stress["zz"][0] + pressure).max(), np.abs(shear - slope).max()))
    assert np.array(errors[-1]).max() < 0.01
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    assert ratios == close_to(np.full((1, 2), 4.0), rel=0.2)


def test_layers_that_slide_pass_no_shear_on():
    stack = ElasticStack((ElasticLayer(0.4, 4.0, 0.25, bonded=False),), ElasticBase(2.0, 0.3))
    grid = Grid((12, 10), (2.0, 1.6))
    pressure = np.random.default_rng(8).uniform(0, 1, grid.shape)
    stress = stress_on_plane(pressure, grid, 0.4, LayeredStress(stack))
    assert np.abs(stress["xz"]).max() < 1e-11
    assert np.abs(stress["zz"]).max() > 0.3


def test_a_row_of_images_is_the_limit_of_long_rows():
    """A period along x against rows of many; what is missing falls as one over their length."""
    grid, body = Grid((8, 6), (2.0, 1.5), (True, False)), LayeredStress(COATED)
    pressure = np.random.default_rng(9).uniform(0, 1, grid.shape)
    for depth in (0.2, 0.55):
        found = stress_on_plane(pressure, grid, depth, body).components
        missing = []
        for periods in (41, 83):
            row = Grid((8 * periods, 6), (2.0 * periods, 1.5))
            stress = stress_on_plane(np.tile(pressure, (periods, 1)), row, depth, body)
            middle = 8 * (periods // 2)
            missing.append(np.abs(stress.components[:, middle : middle + 8] - found))
        # xx and yy; zz, yz and xz fall faster
        largest = np.array(missing).max(axis=(2, 3))
        assert largest[0, :2] / largest[1, :2] == close_to([83 / 41] * 2, rel=0.05)
        assert largest[1, :2].max() < 3e-3
        assert largest[1, 2:].max() < 2e-6


def test_a_strip_without_end_is_in_plane_strain():
    grid = Grid((1, 20), (1.0, 4.0), (True, False))
    pressure = np.sqrt(np.maximum(0, 1 - grid.y**2))[None, :]
    stress = stress_on_section(pressure, grid, [0.2, 0.4, 0.6, 2.0], LayeredStress(COATED), x=0.0)
    for place, nu in enumerate((0.25, 0.25, 0.45, 0.3)):
        along = nu * (stress["yy"][place] + stress["zz"][place])
        assert stress["xx"][place] == close_to(along, abs=1e-9)


def test_a_thin_layer_under_a_strip_of_any_length_has_finite_stresses():
    stack = ElasticStack((ElasticLayer(1.0, 1.0, 0.3),), None)
    edges = np.array([1e15, -1e15]), np.array([2.0, -2.0])
    found = LayeredStress(stack).coefficients(*edges, 0.5)[:, 0, 0]
    strip = LayeredStress(stack).coefficients(np.array([1e4, -1e4]), edges[1], 0.5)[:, 0, 0]
    np.testing.assert_allclose(found, strip, atol=1e-9)
