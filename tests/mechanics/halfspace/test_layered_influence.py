"""Influence coefficients of layers against quadrature, images and limits."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0, j1

from closeness import close_to
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.layered_influence import (
    correction_coefficient,
    layered_influence_table,
    periodic_layered_table,
)
from viscontact.mechanics.halfspace.smooth_kernel import smooth_kernel
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse

BONDED = ElasticStack((ElasticLayer(1.0, 1.0, 0.3),), None)
INCOMPRESSIBLE = ElasticStack((ElasticLayer(1.0, 1.0, 0.5),), None)
SLIPPING = ElasticStack((ElasticLayer(1.0, 1.0, 0.4, bonded=False),), None)
PLATE = ElasticStack((ElasticLayer(1.0, 1e4, 0.3), ElasticLayer(0.3, 1.0, 0.3)), None)
COATING = (ElasticLayer(1.0, 50.0, 0.2), ElasticLayer(3.0, 0.2, 0.5))
COATED = ElasticStack(COATING, ElasticBase(1.0, 0.3))
STACKS = {
    "bonded": BONDED,
    "incompressible": INCOMPRESSIBLE,
    "slipping": SLIPPING,
    "plate on springs": PLATE,
    "coated": COATED,
}


def hankel_integral(response, r, bessel=j0):
    """(1/π) ∫ (L - 1) J(q r) dq on the real axis, by Gauss rules between zeros and decades."""
    highest = 25 / response.length
    edges = np.union1d(np.geomspace(1e-8, highest, 300), np.arange(0, highest, 2 / max(r, 0.1)))
    nodes, weights = np.polynomial.legendre.leggauss(16)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    q = (middle[:, None] + half[:, None] * nodes).ravel()
    strength = (half[:, None] * weights).ravel() * (response.ratio(q) - response.short_waves)
    return float(strength @ bessel(q * r)) / np.pi, q, strength / np.pi


@pytest.mark.parametrize("name", STACKS)
def test_the_kernel_is_the_hankel_transform_of_the_response(name):
    stack = STACKS[name]
    kernel = smooth_kernel(stack, 400.0)
    scale = abs(hankel_integral(stack, 0.0)[0])
    for r in (0.0, 0.01, 0.3, 1.0, 4.7, 30.0, 300.0):
        value, q, strength = hankel_integral(stack, r)
        # Measured: 2e-11.
        assert kernel.value(np.array(r)) == close_to(value, abs=1e-10 * scale)
        moment = float(strength @ (r * j1(q * r) / q))  # ∫ J0(q r) r dr = r J1(q r)/q
        assert kernel.moment(np.array(r)) == close_to(moment, abs=1e-10 * scale * (1 + r))


class Images(SurfaceResponse):
    """L = 1 + c e^(-2 q h): a half-space and one image force at the depth 2 h."""

    short_waves, long_waves, mean_displacement = 1.0, 1.3, np.inf
    length = np.inf  # of an instance: its own

    def __init__(self, length):
        self.length = length

    def ratio(self, wave_number):
        return 1 + 0.3 * np.exp(-2 * wave_number * self.length)


@pytest.mark.parametrize("cell", [(1.0, 1.0), (8.0, 1.0), (1.0, 30.0)])
@pytest.mark.parametrize(
    "length",
    [
        1e-3,
        pytest.param(0.05, marks=pytest.mark.slow),
        0.6,
        pytest.param(3.0, marks=pytest.mark.slow),
        100.0,
    ],
)
def test_coefficients_are_integrals_over_the_cell_for_any_thickness(length, cell):
    # The image's kernel 0.3/(π sqrt(r² + 4 h²)) over the cell, by hand along x and by adaptive
    # quadrature along y.
    dx, dy = cell
    table = correction_coefficient(np.arange(26) * cell[0], 30, cell, Images(length))
    self_term = influence_table((1, 1), cell)[0, 0]
    for i, j in ((0, 0), (1, 0), (0, 1), (2, 3), (19, 19), (21, 0), (22, 27)):
        x, y = i * dx, j * dy

        def along_x(at, x=x):
            depth = np.hypot(at, 2 * length)
            return np.arcsinh((x + dx / 2) / depth) - np.arcsinh((x - dx / 2) / depth)

        near = [at for at in (-2 * length, 0.0, 2 * length) if abs(at - y) < dy / 2]
        expected, _ = quad(
            along_x, y - dy / 2, y + dy / 2, points=near or None, epsabs=0, epsrel=1e-12, limit=400
        )
        # Asked: 1e-8 of the self term.
        assert table[i, j] == close_to(0.3 / np.pi * expected, abs=1e-9 * self_term)


@pytest.mark.parametrize(
    "thickness",
    [
        1e-3,
        pytest.param(0.1, marks=pytest.mark.slow),
        1.0,
        pytest.param(10.0, marks=pytest.mark.slow),
    ],
)
def test_cells_of_a_layer_add_up_to_uniaxial_compression(thickness):
    # A uniform pressure on all cells: the compression h (1 - 2ν)/(2 (1 - ν) G) of the layer.
    layer = ElasticStack((ElasticLayer(thickness, 1.0, 0.3),), None)
    count = 60 + int(25 * thickness)
    table = layered_influence_table((count, count), (1.0, 1.0), layer)
    weight = np.where(np.arange(count) == 0, 1.0, 2.0)
    assert weight @ table @ weight == close_to(layer.mean_displacement, abs=1e-9)


@pytest.mark.parametrize("name", STACKS)
def test_nine_cells_make_one_of_three_times_the_size(name):
    small, large = (
        layered_influence_table(shape, (d, 2 * d), STACKS[name])
        for shape, d in (((95, 95), 0.1), ((31, 31), 0.3))
    )
    around = np.pad(small, ((1, 0), (1, 0)), mode="reflect")
    summed = sum(around[i : i + 93 : 3, j : j + 93 : 3] for i in range(3) for j in range(3))
    # Measured: 2e-10, where the formula changes at 20 cells.
    assert large == close_to(summed, abs=1e-9 * large[0, 0])


def strip_displacement(response, y):
    """(4/π) ∫ (L - 1) sin(q/2) cos(q y)/q² dq: a strip of width 1, less that on a half-space."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    highest = 60.0
    edges = np.union1d(np.geomspace(1e-7, highest, 200), np.arange(0, highest, 1 / (1 + y)))
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    q = (middle[:, None] + half[:, None] * nodes).ravel()
    strength = (half[:, None] * weights).ravel() * (response.ratio(q) - 1) / q**2
    return 4 / np.pi * float(strength @ (np.sin(q / 2) * np.cos(q * y)))


STRIPS = {name: STACKS[name] for name in ("bonded", "incompressible", "slipping", "coated")} | {
    "rubber on steel": ElasticStack((ElasticLayer(1.0, 1.0, 0.499),), ElasticBase(1e5, 0.3)),
    "hard coating": ElasticStack((ElasticLayer(1.0, 100.0, 0.45),), ElasticBase(1.0, 0.3)),
}


@pytest.mark.parametrize("name", STRIPS)
def test_a_strip_follows_its_own_integral(name):
    # The half-space's part, ∫ sin(q/2) cos(q y)/q², diverges for long waves as L - 1 does not
    # vanish there; the difference of two places does not.
    stack = STRIPS[name]
    table = periodic_layered_table((1, 12), (1.0, 1.0), stack, datum=1.0)[0]
    love = periodic_layered_table((1, 12), (1.0, 1.0), HALF_SPACE, datum=1.0)[0]
    for j in (1, 3, 11):
        rest = strip_displacement(stack, float(j)) - strip_displacement(stack, 0.0)
        assert table[j] - table[0] == close_to(
            love[j] - love[0] + rest, abs=1e-8 * max(1.0, stack.long_waves)
        )


@pytest.mark.parametrize(
    "stiffness",
    [
        None,
        pytest.param(1e-5, marks=pytest.mark.slow),
        1e-3,
        pytest.param(3.0, marks=pytest.mark.slow),
    ],
)
def test_cells_of_a_period_add_up_to_a_strip(stiffness):
    # On a rigid base, and soft and hard covers on a half-space.
    base = None if stiffness is None else ElasticBase(1.0, 0.3)
    stack = ElasticStack((ElasticLayer(1.0, stiffness or 1.0, 0.49),), base)
    strip = periodic_layered_table((1, 20), (1.0, 1.0), stack, datum=7.0)[0]
    for shape, cell in (((6, 20), (0.7, 1.0)), ((9, 20), (0.1, 1.0))):
        cells = periodic_layered_table(shape, cell, stack, datum=7.0)
        assert cells.sum(axis=0) == close_to(strip, abs=1e-8 * strip[0])


def test_a_base_like_its_layer_is_a_half_space():
    same = ElasticStack((ElasticLayer(1.0, 2.0, 0.3),), ElasticBase(2.0, 0.3))
    free = layered_influence_table((30, 30), (1.0, 0.5), same)
    assert free == close_to(influence_table((30, 30), (1.0, 0.5)), rel=1e-12)
    table = periodic_layered_table((8, 9), (1.0, 1.0), same, datum=3.0)
    love = periodic_layered_table((8, 9), (1.0, 1.0), HALF_SPACE, 3.0)
    assert table == close_to(love, abs=1e-12)
