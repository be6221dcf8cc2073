"""Frequency response of layers against closed forms, and against linear systems of their waves."""

import mpmath
import numpy as np
import pytest

from closeness import close_to
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack

# From waves far longer than the layer is thick to such that would overflow cosh.
WAVES = np.geomspace(1e-4, 1e4, 33)
RATIOS = [0.0, 0.3, 0.38, 0.499, 0.5]


def closed(formula):
    """Values of a formula at WAVES in 40 digits: the closed forms cancel for long waves."""
    with mpmath.workdps(40):
        return np.array([float(formula(mpmath.mpf(float(w)))) for w in WAVES])


def bonded(nu):
    k = 3 - 4 * mpmath.mpf(nu)

    def ratio(w):
        lower = 2 * k * mpmath.cosh(2 * w) + 1 + k**2 + 4 * w**2
        return (2 * k * mpmath.sinh(2 * w) - 4 * w) / lower

    return ratio


def slipping(w):
    return (mpmath.cosh(2 * w) - 1) / (mpmath.sinh(2 * w) + 2 * w)


def on_half_space(eps, nu1, nu2):
    """O'Sullivan & King (1988), J. Tribol. 110, 235, without friction."""
    eps, nu1, nu2 = (mpmath.mpf(each) for each in (eps, nu1, nu2))
    lam = 1 - 4 * (1 - nu1) / (1 + eps * (3 - 4 * nu2))
    kap = (eps - 1) / (eps + 3 - 4 * nu1)

    def ratio(w):
        t = mpmath.exp(-2 * w)
        upper = 1 + 4 * w * kap * t - lam * kap * t**2
        return upper / (1 - (lam + kap + 4 * kap * w**2) * t + lam * kap * t**2)

    return ratio


@pytest.mark.parametrize("nu", RATIOS)
def test_one_layer_on_a_rigid_base_follows_the_closed_forms(nu):
    # Johnson (1985), Contact Mechanics, section 5.8. Measured: 1e-13.
    stuck = ElasticStack((ElasticLayer(1.0, 1.0, nu),), None)
    assert stuck.ratio(WAVES) == close_to(closed(bonded(nu)), rel=1e-12)
    slips = ElasticStack((ElasticLayer(2.0, 7.0, nu, bonded=False),), None)
    assert slips.ratio(WAVES / 2) == close_to(closed(slipping), rel=1e-12)


@pytest.mark.parametrize("nu", RATIOS)
@pytest.mark.parametrize(("eps", "nu2"), [(1e-4, 0.3), (0.1, 0.5), (1.0, 0.2), (10.0, 0.45)])
def test_a_coated_half_space_follows_the_closed_form(nu, eps, nu2):
    stack = ElasticStack((ElasticLayer(1.0, eps, nu),), ElasticBase(1.0, nu2))
    assert stack.ratio(WAVES) == close_to(closed(on_half_space(eps, nu, nu2)), rel=1e-12)
    # The limits that it states; long waves deviate by the order of q h/eps.
    assert stack.ratio(np.array([1e4])) == close_to(stack.short_waves)
    assert stack.ratio(np.array([1e-9])) == close_to(stack.long_waves, rel=2e-5)


def solved(layers, base, q):
    """L of one wave by a linear system: Papkovich-Neuber potentials of all layers at once.

    Each layer has the harmonic waves e^(-q z) from its top and e^(q z) from its bottom, alone and
    in 2 μ u = 4 (1 - ν) ψ e_z - grad(z ψ).
    """

    def amplitudes(nu, mu, z, sign, scale):
        """Rows u_x, u_z, σ_xz, σ_zz of the potentials φ and ψ."""
        e = np.exp(sign * q * z - scale)
        phi = [q / (2 * mu), -sign * q / (2 * mu), sign * q**2, -(q**2)]
        psi = [
            z * q / (2 * mu),
            (3 - 4 * nu - sign * q * z) / (2 * mu),
            -(1 - 2 * nu) * q + sign * z * q**2,
            2 * (1 - nu) * sign * q - z * q**2,
        ]
        return np.array([[a * e / q, b * e] for a, b in zip(phi, psi, strict=True)])

    parts = [(layer.poisson_ratio, layer.shear_modulus, layer.thickness) for layer in layers]
    count = 4 * len(parts) + (2 if base else 0)
    rows, right = [], []

    def at(index, z):
        nu, mu, h = parts[index]
        block = np.zeros((4, count))
        block[:, 4 * index : 4 * index + 2] = amplitudes(nu, mu, z, -1, 0.0)
        block[:, 4 * index + 2 : 4 * index + 4] = amplitudes(nu, mu, z, 1, q * h)
        return block

    def below(index):
        if index + 1 < len(parts):
            return at(index + 1, 0.0)
        block = np.zeros((4, count))
        if base:
            mu, nu = base.shear_modulus, base.poisson_ratio
            block[:, -2:] = amplitudes(nu, mu, 0.0, -1, 0.0)
        return block

    top = at(0, 0.0)
    rows += [top[2], top[3]]
    right += [0.0, -1.0]
    for index, layer in enumerate(layers):
        upper, lower = at(index, layer.thickness), below(index)
        jump = upper - lower
        is_rigid = base is None and index + 1 == len(parts)
        kept = [jump[1], *([] if is_rigid else [jump[3]])]
        if layer.bonded:
            kept += [jump[0], *([] if is_rigid else [jump[2]])]
        else:
            kept += [upper[2], *([] if is_rigid else [lower[2]])]
        rows += kept
        right += [0.0] * len(kept)
    found = np.linalg.solve(np.array(rows), np.array(right))
    nu, mu, _ = parts[0]
    return (top[1] @ found) * mu * q / (1 - nu)


STACKS = [
    (((0.5, 1.0, 0.3, True), (1.0, 20.0, 0.5, True)), None),
    (((0.5, 1.0, 0.5, False), (1.0, 0.1, 0.2, True), (0.2, 3.0, 0.0, True)), (0.5, 0.3)),
    (((0.1, 50.0, 0.3, True), (2.0, 1.0, 0.499, False)), None),
    (((1.0, 2.0, 0.4, True), (1.0, 5.0, 0.4, False)), (1.0, 0.1)),
]


@pytest.mark.parametrize(("parts", "base"), STACKS)
def test_stacks_follow_a_linear_system_of_all_their_waves(parts, base):
    layers = tuple(ElasticLayer(*part) for part in parts)
    base = base and ElasticBase(*base)
    waves = np.geomspace(0.05, 100.0, 23)
    expected = [solved(layers, base, q) for q in waves]
    # Rounding of the linear systems.
    assert ElasticStack(layers, base).ratio(waves) == close_to(expected, rel=1e-9)


def test_equal_layers_are_one():
    part = ElasticLayer(0.25, 3.0, 0.45)
    four = ElasticStack((part,) * 4, ElasticBase(0.7, 0.3))
    one = ElasticStack((ElasticLayer(1.0, 3.0, 0.45),), ElasticBase(0.7, 0.3))
    assert four.ratio(WAVES) == close_to(one.ratio(WAVES), rel=1e-11)
    same = ElasticStack((part,) * 4, ElasticBase(3.0, 0.45))
    assert same.ratio(WAVES) == close_to(np.ones(WAVES.size), rel=1e-12)


@pytest.mark.parametrize("nu", RATIOS)
def test_uniform_pressure_compresses_layers_on_a_rigid_base_without_lateral_strain(nu):
    own = (1 - nu) / 2  # compliance of the top, of G = 1
    stuck = ElasticStack((ElasticLayer(0.3, 1.0, nu), ElasticLayer(0.7, 4.0, 0.2)), None)
    # Uniaxial compression h/M of each layer, M = 2 G (1 - ν)/(1 - 2ν).
    squeezed = 0.3 * (1 - 2 * nu) / (2 - 2 * nu) + 0.7 / 4 * 0.6 / 1.6
    assert own * stuck.mean_displacement == close_to(squeezed, rel=1e-12)
    # The limit of long waves where layers are bonded; those that slide spread between the waves, to
    # h (1 - ν)/(2 G) of one layer in plane strain without lateral stress.
    q = np.array(1e-7)
    assert own * 2 / q * stuck.ratio(q) == close_to(squeezed, rel=1e-6, abs=1e-12)
    layers = (ElasticLayer(0.3, 1.0, nu, bonded=False), ElasticLayer(0.7, 4.0, 0.2, bonded=False))
    free = ElasticStack(layers, None)
    assert free.mean_displacement == close_to(stuck.mean_displacement, rel=1e-12)
    assert own * 2 / q * ElasticStack(layers[:1], None).ratio(q) == close_to(own * 0.3, rel=1e-6)


def test_the_response_is_analytic_in_the_wave_number():
    # Cauchy: the mean over a circle is the value in its middle.
    stack = ElasticStack((ElasticLayer(1.0, 9.0, 0.3), ElasticLayer(0.5, 1.0, 0.5)), None)
    circle = 2.0 + 0.3 * np.exp(2j * np.pi * np.arange(64) / 64)
    assert stack.ratio(circle).mean() == close_to(stack.ratio(np.array(2.0)), rel=1e-13)


def test_stiffer_layers_yield_less():
    soft, stiff = (
        ElasticStack((ElasticLayer(1.0, 1.0, 0.4), ElasticLayer(1.0, g, 0.4)), ElasticBase(g, 0.3))
        for g in (0.5, 2.0)
    )
    assert (stiff.ratio(WAVES) <= soft.ratio(WAVES)).all()
    assert (stiff.ratio(WAVES) > 0).all()
