"""Influence coefficients of tractions on layers, against sums over waves and finite elements."""

import numpy as np
import pytest
from scipy.special import jv

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_filter import CouplingSum, coupling_filter
from viscontact.mechanics.halfspace.coupling_influence import coupling_tables
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.halved_shear import halved_shear_convolution
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.halfspace.layered_shear_influence import (
    layered_coupling,
    shear_correction,
)
from viscontact.mechanics.halfspace.mirrored_shear import mirrored_shear_convolution
from viscontact.mechanics.halfspace.shear_filter import (
    periodic_shear_convolution,
    shear_convolution,
)
from viscontact.mechanics.halfspace.shear_influence import ShearTables, shear_tables

ON_RIGID = LayeredShear((ElasticStack((ElasticLayer(1.0, 1.0, 0.3),), None),), (1.0,))
ON_BASE = LayeredShear(
    (
        ElasticStack(
            (ElasticLayer(0.6, 1.0, 0.45), ElasticLayer(1.0, 4.0, 0.2)), ElasticBase(10.0, 0.4)
        ),
    ),
    (1.0,),
)
BODIES = {"on a rigid base": ON_RIGID, "on an elastic base": ON_BASE}
STRIPS = Grid((1, 24), (3.0, 12.0), periodic=(True, False))


def tables_of(grid: Grid, response: LayeredShear) -> ShearTables:
    own = shear_tables(grid)
    return ShearTables(own.direct, own.along_x, own.cross, (shear_correction(grid, response),))


def weights_of(response: LayeredShear) -> tuple[float, float, tuple[float]]:
    short = response.short_waves
    return short.along, short.across - short.along, (1.0,)


def total(grid: Grid, response: LayeredShear) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Coefficients xx, xy and yy with those of the half-space."""
    own, rest = shear_tables(grid), shear_correction(grid, response)
    along, poisson, _ = weights_of(response)
    return (
        along * own.direct + poisson * own.along_x + rest.along_x,
        poisson * own.cross + rest.cross,
        along * own.direct + poisson * own.along_y + rest.along_y,
    )


@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("cell", [(0.3, 0.2), (2.5, 3.0)])
def test_coefficients_are_hankel_integrals_over_the_cell(name, cell):
    # Real wave numbers, Bessel's functions of SciPy, and Gauss's rule over the cell.
    response, count = BODIES[name], 6
    grid = Grid((count, count), (count * cell[0], count * cell[1]))
    rest, coupling = shear_correction(grid, response), layered_coupling(grid, response)
    own = coupling_tables(grid)
    for i, j in ((0, 0), (1, 0), (2, 3)):
        xx, xy, yy, zx, zy = _by_quadrature(response, cell, i, j)
        for found, exact in (
            (rest.along_x, xx),
            (rest.cross, xy),
            (rest.along_y, yy),
            (coupling.along_x - response.short_waves.coupling * own.along_x, zx),
            (coupling.along_y - response.short_waves.coupling * own.along_y, zy),
        ):
            assert found[i, j] == close_to(exact, abs=2e-10 * cell[0] * cell[1])


def _by_quadrature(response, cell, i, j):
    """Integrals of the rests of S, H and D over a cell."""
    nodes, weights = np.polynomial.legendre.leggauss(14)
    edges = np.linspace(0.0, 24.0, 61)
    half = np.diff(edges)[:, None] / 2
    q = ((edges[1:] + edges[:-1])[:, None] / 2 + half * nodes).ravel()
    of_q = (half * weights).ravel() / np.pi
    ratios, short = response.ratios(q), response.short_waves
    along, across, coupling = (each - limit for each, limit in zip(ratios, short, strict=True))
    nodes, weights = np.polynomial.legendre.leggauss(16)
    x, y = (i + nodes / 2)[:, None] * cell[0], (j + nodes / 2)[None, :] * cell[1]
    area = np.outer(weights, weights) * cell[0] * cell[1] / 4
    r = np.hypot(x, y)
    j0, j1, j2 = (jv(order, np.multiply.outer(r, q)) for order in range(3))
    mean, split = j0 @ (of_q * (along + across) / 2), j2 @ (of_q * (across - along) / 2)
    inwards = j1 @ (of_q * coupling)
    cos, sin = x / r, y / r
    fields = (
        mean + (cos**2 - sin**2) * split,
        2 * cos * sin * split,
        mean - (cos**2 - sin**2) * split,
        cos * inwards,
        sin * inwards,
    )
    return [float((area * field).sum()) for field in fields]


def test_strips_are_sums_over_waves_on_a_long_period():
    # On a rigid base strips far away are not felt: a period of 300 thicknesses stands for none.
    _, _, along = total(STRIPS, ON_RIGID)
    across, _, _ = total(STRIPS, ON_RIGID)
    coupling = layered_coupling(STRIPS, ON_RIGID).along_y
    width, period = STRIPS.cell_size[1], 300.0
    q = 2 * np.pi * np.arange(1, 200_000) / period
    ratios = ON_RIGID.ratios(q)
    mean = np.sin(q * width / 2) / (q * width / 2) * 2 * width / period
    for cells in (0, 1, 3, 20):
        cos, sin = np.cos(q * cells * width), np.sin(q * cells * width)
        uniform = ON_RIGID.mean_displacement * width / period
        exact = [
            uniform + float((2 / q * ratio * mean * cos).sum())
            for ratio in (ratios.along, ratios.across)
        ]
        # The sum is cut off at its waves: 1e-6 of the middle.
        assert along[0, cells] == close_to(exact[0], abs=2e-6)
        assert across[0, cells] == close_to(exact[1], abs=2e-6)
        inwards = float((2 / q * ratios.coupling * mean * sin).sum())
        assert coupling[0, cells] == close_to(inwards, abs=1e-7)


@pytest.mark.parametrize("thickness", [0.02, 0.1, 0.5])
def test_a_thin_layer_is_sheared_where_it_is_loaded(thickness):
    # u = q h/G under a cell far wider than the layer, and none beside it (Winkler).
    body = ElasticStack((ElasticLayer(thickness, 2.0, 0.3),), None)
    grid = Grid((5, 5), (100.0, 100.0))
    xx, xy, yy = total(grid, LayeredShear((body,), (1.0,)))
    compliance = (1 - 0.3) / (2 * 2.0)
    simple = thickness / 2.0 / compliance
    assert xx[0, 0] == close_to(simple, rel=thickness / 20)
    assert yy[0, 0] == close_to(simple, rel=thickness / 20)
    assert np.abs(xx[2, 2]) < 1e-8 * simple
    assert np.abs(xy).max() < 0.01 * simple


@pytest.mark.parametrize("name", BODIES)
def test_mirrored_and_halved_blocks_act_as_whole_ones(name):
    response = BODIES[name]
    grid, random = Grid((8, 6), (2.4, 1.5)), np.random.default_rng(3)
    tables, weights = tables_of(grid, response), weights_of(response)
    whole = shear_convolution(tables, (False, False)).sum_of(*weights)
    quarter = random.normal(size=(2, 4, 3))
    signs = np.array([1.0, -1.0])[:, None, None]  # x is even along both axes, y is odd
    half = np.concatenate([signs * quarter[:, :, ::-1], quarter], axis=2)
    full = np.concatenate([signs * half[:, ::-1], half], axis=1)
    expected = whole.apply(full)
    mirrored = mirrored_shear_convolution(tables, (True, True)).sum_of(*weights)
    halved = halved_shear_convolution(tables, (False, False), 0, even=True).sum_of(*weights)
    np.testing.assert_allclose(mirrored.apply(quarter), expected[:, 4:, 3:], atol=1e-12)
    np.testing.assert_allclose(halved.apply(full[:, 4:]), expected[:, 4:], atol=1e-12)


@pytest.mark.parametrize("name", BODIES)
def test_waves_on_a_periodic_grid_have_their_ratios(name):
    response, grid = BODIES[name], Grid((12, 16), (2.0, 3.0), periodic=(True, True))
    parts = periodic_shear_convolution(grid.shape, grid.cell_size, (response,))
    operator = parts.sum_of(*weights_of(response))
    coupling = coupling_filter(grid, layers=response)
    kx, ky = 2 * np.pi * 2 / 2.0, 2 * np.pi * 3 / 3.0
    k, phase = np.hypot(kx, ky), kx * grid.x[:, None] + ky * grid.y
    along, across = np.array([kx, ky]) / k, np.array([-ky, kx]) / k
    ratios = response.ratios(np.array([k]))
    for direction, ratio in ((along, ratios.along), (across, ratios.across)):
        traction = direction[:, None, None] * np.sin(phase)
        np.testing.assert_allclose(operator.apply(traction), 2 / k * ratio * traction, atol=1e-12)
    # A traction sin(kx) along its waves moves the surface by -cos(kx), as in a half-space.
    found = coupling.normal(along[:, None, None] * np.sin(phase))
    np.testing.assert_allclose(found, -2 / k * ratios.coupling * np.cos(phase), atol=1e-12)


def test_a_uniform_traction_shears_the_layers_of_a_periodic_grid():
    body = ElasticStack((ElasticLayer(0.5, 2.0, 0.3), ElasticLayer(1.0, 4.0, 0.2)), None)
    response, grid = LayeredShear((body,), (1.0,)), Grid((4, 4), (1.0, 1.0), periodic=(True, True))
    parts = periodic_shear_convolution(grid.shape, grid.cell_size, (response,))
    found = parts.sum_of(*weights_of(response)).apply(np.ones((2, 4, 4)))
    simple = (0.5 / 2.0 + 1.0 / 4.0) / ((1 - 0.3) / (2 * 2.0))
    np.testing.assert_allclose(found, simple, rtol=1e-12)


@pytest.mark.parametrize("grid", [Grid((7, 9), (2.1, 1.8)), STRIPS])
@pytest.mark.parametrize("name", BODIES)
def test_work_is_reciprocal(name, grid):
    random = np.random.default_rng(5)
    maps = coupling_filter(grid, layers=BODIES[name])
    pressure, traction = random.normal(size=grid.shape), random.normal(size=(2, *grid.shape))
    one, other = (maps.along(pressure) * traction).sum(), (pressure * maps.normal(traction)).sum()
    # Pressure moves the surface towards the load, tractions move it inwards ahead of them.
    assert one == close_to(other, rel=1e-12)


def test_a_sum_of_maps_adds_them():
    grid, random = Grid((6, 5), (1.8, 1.0)), np.random.default_rng(7)
    one, other = coupling_filter(grid), coupling_filter(grid, layers=ON_BASE)
    both = CouplingSum([one, other])
    tractions = random.normal(size=(2, 2, 6, 5))
    expected = one.normal(tractions[0]) + other.normal(tractions[1])
    np.testing.assert_allclose(both.normal(list(tractions)), expected, atol=1e-13)
    pressures = random.normal(size=(2, 6, 5))
    expected = one.along(pressures[0]) + other.along(pressures[1])
    np.testing.assert_allclose(both.along(list(pressures)), expected, atol=1e-13)
    nothing = np.zeros((2, 6, 5))
    assert not both.normal([nothing, nothing]).any()
    assert not both.along([nothing[0], nothing[0]]).any()
