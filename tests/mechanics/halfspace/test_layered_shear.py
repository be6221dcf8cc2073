"""Response of layers to waves of traction, against other solutions of the same waves."""

import mpmath as mp
import numpy as np
import pytest

from closeness import close_to
from returned import some
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_shear import (
    LayeredShear,
    antiplane_compliance,
    short_waves_of,
    stack_ratios,
)

WAVES = np.array([0.01, 0.3, 1.0, 4.0, 12.0])
STACKS = {
    "cover on a rigid base": ElasticStack((ElasticLayer(1.0, 1.0, 0.3),), None),
    "incompressible on a rigid base": ElasticStack((ElasticLayer(0.7, 2.0, 0.5),), None),
    "two layers on a base": ElasticStack(
        (ElasticLayer(1.0, 1.0, 0.3), ElasticLayer(0.5, 4.0, 0.2)), ElasticBase(10.0, 0.4)
    ),
    "coating": ElasticStack((ElasticLayer(0.2, 50.0, 0.25),), ElasticBase(1.0, 0.48)),
    "sliding on a base": ElasticStack(
        (ElasticLayer(1.0, 1.0, 0.3, bonded=False),), ElasticBase(3.0, 0.2)
    ),
}


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.5])
def test_layers_of_one_material_respond_as_its_half_space(poisson_ratio):
    body = ElasticStack(
        (ElasticLayer(1.0, 1.0, poisson_ratio), ElasticLayer(0.3, 1.0, poisson_ratio)),
        ElasticBase(1.0, poisson_ratio),
    )
    exact = short_waves_of(poisson_ratio)
    for found, limit in some(zip(stack_ratios(body, WAVES), exact, strict=True)):
        np.testing.assert_allclose(found, limit, rtol=1e-12, atol=1e-12)


def test_half_space_has_the_ratios_of_johnson():
    # Johnson (1985), eqs. 3.91: u_x of a line of traction is that of a pressure, antiplane shear
    # is 1/(1 - ν) of it, and 3.18: the coupling is (1 - 2ν)/(2 (1 - ν)).
    assert short_waves_of(0.25) == (1.0, close_to(4 / 3), close_to(1 / 3))


def test_antiplane_waves_of_a_layer_on_a_rigid_base_are_exact():
    body = STACKS["cover on a rigid base"]
    np.testing.assert_allclose(antiplane_compliance(body, WAVES), np.tanh(WAVES), rtol=1e-14)


def test_a_layer_that_slides_answers_antiplane_waves_as_a_free_plate():
    body = STACKS["sliding on a base"]
    np.testing.assert_allclose(antiplane_compliance(body, WAVES), 1 / np.tanh(WAVES), rtol=1e-14)


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.5])
def test_long_waves_shear_a_bonded_layer_simply(poisson_ratio):
    # u = q h/G in any direction, corrected by (q h)²: the error falls with the square.
    body, thickness = ElasticStack((ElasticLayer(0.1, 2.0, poisson_ratio),), None), 0.1
    off = []
    for wave in (0.2, 0.1, 0.05):
        ratios = stack_ratios(body, np.array([wave]))
        compliance = (1 - poisson_ratio) / (2 * 2.0) * 2 / wave
        simple = thickness / 2.0
        off.append([abs(compliance * ratio[0] / simple - 1) for ratio in ratios[:2]])
    orders = np.log2(np.array(off[:-1]) / np.array(off[1:]))
    print("orders in the wave number", orders)
    np.testing.assert_allclose(orders, 2.0, atol=0.02)
    assert np.max(off[-1]) < 1e-4


@pytest.mark.parametrize("name", STACKS)
def test_shear_moves_the_surface_inwards_as_pressure_moves_it_along(name):
    # Reciprocity of work: the displacement along by a unit pressure is that into by a traction.
    vectors = STACKS[name].surface_waves(WAVES)
    (u, _, t, s) = (vectors[:, row] for row in range(4))
    along_by_pressure = (u[:, 0] * t[:, 1] - u[:, 1] * t[:, 0]) / (
        s[:, 0] * t[:, 1] - s[:, 1] * t[:, 0]
    )
    free = 1 - STACKS[name].layers[0].poisson_ratio
    coupling = stack_ratios(STACKS[name], WAVES).coupling
    scale = np.abs(coupling).max()
    np.testing.assert_allclose(along_by_pressure / free, coupling, rtol=1e-9, atol=1e-9 * scale)


@pytest.mark.parametrize("name", STACKS)
def test_ratios_agree_with_equilibrium_in_forty_digits(name):
    stack = STACKS[name]
    found = stack_ratios(stack, WAVES)
    for place, wave in enumerate(WAVES):
        exact = _ratios_by_equilibrium(stack, wave)
        for kind in range(3):
            assert found[kind][place] == close_to(exact[kind], rel=1e-9, abs=1e-10)


def test_long_waves_tend_to_the_base():
    response = LayeredShear((STACKS["two layers on a base"],), (1.0,))
    off = []
    for wave in (1e-2, 1e-3, 1e-4):
        ratios = response.ratios(np.array([wave]))
        pairs = zip(ratios, response.long_waves, strict=True)
        off.append([abs(float(each[0]) / limit - 1) for each, limit in pairs])
    orders = np.log10(np.array(off[:-1]) / np.array(off[1:]))
    np.testing.assert_allclose(orders, 1.0, atol=0.1)  # first order in q h


def _ratios_by_equilibrium(stack, wave):
    """A, B and D by the equations of elasticity over the depth, integrated in forty digits.

    State u, w, σxz, σzz of u = u sin qx, w = w cos qx: unlike in the package none is scaled, and
    the exponentials of depths are those of mpmath.
    """
    with mp.workdps(40):
        q = mp.mpf(float(wave))
        if stack.base is None:
            plane = mp.matrix([[0, 0], [0, 0], [1, 0], [0, 1]])
            antiplane = mp.matrix([0, 1])
        else:
            plane = _decaying(_matrix(q, stack.base.shear_modulus, stack.base.poisson_ratio))
            antiplane = mp.matrix([1, -mp.mpf(stack.base.shear_modulus) * q])
        for layer in reversed(stack.layers):
            height = mp.mpf(layer.thickness)
            if not layer.bonded:
                # Without shear traction: of the plane below the vector without it.
                own = plane * mp.matrix([plane[2, 1], -plane[2, 0]])
                plane = mp.matrix([[1, 0], [0, own[1]], [0, 0], [0, own[3]]])
                antiplane = mp.matrix([1, 0])
            matrix = _matrix(q, layer.shear_modulus, layer.poisson_ratio)
            plane = mp.expm(-matrix * height) * plane
            shear = mp.matrix(
                [[0, 1 / mp.mpf(layer.shear_modulus)], [q**2 * layer.shear_modulus, 0]]
            )
            antiplane = mp.expm(-shear * height) * antiplane
        # Tractions of the body on the surface: -σxz along, -σzz into it.
        tractions = -plane[2:4, :]
        response = plane[0:2, :] * tractions**-1
        top = stack.layers[0]
        half_space = (1 - mp.mpf(top.poisson_ratio)) / (2 * mp.mpf(top.shear_modulus)) * 2 / q
        along, into = response[0, 0] / half_space, -response[1, 0] / half_space
        across = -antiplane[0] / antiplane[1] / half_space
        return float(along), float(across), float(into)


def _matrix(q, shear_modulus, poisson_ratio):
    """Derivatives of u, w, σxz, σzz over the depth, by Hooke's law and equilibrium."""
    mu, nu = mp.mpf(shear_modulus), mp.mpf(poisson_ratio)
    # σzz = M w' + λ q u with M = λ + 2μ; divided by M, so that ν = 1/2 has a limit.
    over_m = (1 - 2 * nu) / (2 * mu * (1 - nu))
    ratio = nu / (1 - nu)  # λ/M
    stretch = 2 * mu / (1 - nu)  # M - λ²/M
    return mp.matrix(
        [
            [0, q, 1 / mu, 0],
            [-ratio * q, 0, 0, over_m],
            [stretch * q**2, 0, 0, ratio * q],
            [0, 0, -q, 0],
        ]
    )


def _decaying(matrix):
    """Plane of states that decay with depth: (A - q)² of the double eigenvalues ±q."""
    q = -matrix[3, 2]
    grown = matrix - q * mp.eye(4)
    return (grown * grown)[:, 2:4]
