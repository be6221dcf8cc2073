"""Stresses inside layers under a wave, against a linear system of all waves and thin limits."""

import mpmath
import numpy as np
import pytest

from closeness import close_to
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.stack_waves import layer_at, stack_waves

WAVES = np.array([1e-8, 0.3, 2.0, 12.0, 44.0])

STACKS = {
    "rubber on steel": ElasticStack((ElasticLayer(1.0, 1.0, 0.499),), ElasticBase(8e4, 0.3)),
    "two coatings": ElasticStack(
        (ElasticLayer(0.5, 100.0, 0.2), ElasticLayer(1.0, 1.0, 0.45)), ElasticBase(10.0, 0.3)
    ),
    "sliding on a base": ElasticStack(
        (ElasticLayer(0.5, 5.0, 0.5), ElasticLayer(1.0, 3.0, 0.3, bonded=False)),
        ElasticBase(2.0, 0.1),
    ),
    "sliding between": ElasticStack(
        (ElasticLayer(0.5, 1.0, 0.4, bonded=False), ElasticLayer(1.0, 3.0, 0.5)), None
    ),
}


def matrix(nu):
    """Matrix A of y' = A y, from Hooke's law and equilibrium in plane strain."""
    nu = mpmath.mpf(nu)
    # λ/(λ + 2μ), μ/(λ + 2μ) and 4 (λ + μ)/(λ + 2μ)
    a, b, c = nu / (1 - nu), (1 - 2 * nu) / (2 - 2 * nu), 2 / (1 - nu)
    return mpmath.matrix([[0, 1, 1, 0], [-a, 0, 0, b], [c, 0, 0, a], [0, 0, -1, 0]])


def solved(stack, q, depth):
    """X, Y, S, T at a depth: one system for the waves of all parts, with as many digits as needed.

    Unknown are the vectors (U, W, T, S) at the upper sides of the layers, and the two waves of the
    base that decay.
    """
    with mpmath.workdps(40 + int(4 * q)):
        layers, base = stack.layers, stack.base
        n = len(layers)
        tops = [mpmath.mpf(0)]
        for layer in layers:
            tops.append(tops[-1] + mpmath.mpf(layer.thickness))
        moduli = [layer.shear_modulus for layer in layers]
        size = 4 * n + (2 if base else 0)
        system, right = mpmath.zeros(size, size), mpmath.zeros(size, 1)
        system[0, 2] = system[1, 3] = 1  # no shear, S = -1 at the surface
        right[1] = -1
        if base:
            grown = matrix(base.poisson_ratio) - mpmath.eye(4)
            decays = (grown * grown)[:, 2:4]
            moduli.append(base.shear_modulus)
        row = 2
        for k, layer in enumerate(layers):
            above = mpmath.expm(
                matrix(layer.poisson_ratio) * mpmath.mpf(q) * (tops[k + 1] - tops[k])
            )
            if k + 1 < n:
                beneath, first = mpmath.eye(4), 4 * (k + 1)
            else:
                beneath, first = (decays, 4 * n) if base else (mpmath.zeros(4, 0), 0)

            def join(
                part, upper=True, lower=True, *, above=above, beneath=beneath, first=first, k=k
            ):
                nonlocal row
                scales = [mpmath.mpf(m) if part < 2 else 1 for m in moduli[k : k + 2]]
                for i in range(4 if upper else 0):
                    system[row, 4 * k + i] += above[part, i] / scales[0]
                for i in range(beneath.cols if lower else 0):
                    system[row, first + i] -= beneath[part, i] / scales[1]
                row += 1

            if layer.bonded:
                for part in range(4 if beneath.cols else 2):
                    join(part)
            else:
                join(1)
                join(2, lower=False)
                if beneath.cols:
                    join(3)
                    join(2, upper=False)
        assert row == size
        found = mpmath.lu_solve(system, right)
        place = max(k for k in range(n + 1) if k == 0 or tops[k] < mpmath.mpf(depth))
        if place < n:
            nu, start = layers[place].poisson_ratio, found[4 * place : 4 * place + 4]
        else:
            nu, start = base.poisson_ratio, decays * found[4 * n : 4 * n + 2]
        inside = mpmath.expm(matrix(nu) * mpmath.mpf(q) * (mpmath.mpf(depth) - tops[place]))
        u, _, t, s = inside * start
        nu = mpmath.mpf(nu)
        x = 2 / (1 - nu) * u + nu / (1 - nu) * s
        return [float(each) for each in (x, nu * (x + s), s, t)]


#: Bonded and sliding layers, each with the fewest equations.
BY_DEFAULT = ("rubber on steel", "sliding between")


def amplitudes(stack, q, depth):
    found = stack_waves(stack, q).stresses(depth)
    return np.stack([found.along, found.across, found.normal, found.shear], axis=-1)


@pytest.mark.parametrize(
    "name",
    [each if each in BY_DEFAULT else pytest.param(each, marks=pytest.mark.slow) for each in STACKS],
)
def test_waves_in_layers_solve_the_system_of_all_layers(name):
    # Measured: 1e-12 of the pressure.
    stack = STACKS[name]
    depths = [0.0, 0.3, 0.5, 0.500001, *([1.5, 3.0] if stack.base else [])]
    for depth in depths:
        wanted = np.array([solved(stack, q, depth) for q in WAVES])
        assert amplitudes(stack, WAVES, depth) == close_to(wanted, abs=1e-11)


def test_deep_down_the_waves_keep_their_digits():
    """Relative to the stresses there, a hundred thousandth of the pressure."""
    stack = STACKS["two coatings"]
    q = np.array([12.0])
    wanted = np.array([solved(stack, q[0], depth) for depth in (1.2, 1.6)])
    found = np.concatenate([amplitudes(stack, q, depth) for depth in (1.2, 1.6)])
    assert np.abs(wanted).max() < 1e-4
    assert (np.abs(found - wanted) < 1e-11 * np.abs(wanted).max(axis=1, keepdims=True)).all()


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_equal_layers_are_a_half_space(nu):
    """Johnson (1985), section 13.2."""
    layers = tuple(ElasticLayer(each, 2.0, nu) for each in (0.7, 0.1, 1.3))
    q = np.geomspace(1e-10, 1e3, 40)
    stack = ElasticStack(layers, ElasticBase(2.0, nu))
    for depth in (0.0, 0.3, 0.7, 0.75, 2.1, 5.0):
        qz, decay = q * depth, np.exp(-q * depth)
        wanted = np.stack([qz - 1, -2 * nu + 0 * q, -1 - qz, -qz], axis=-1) * decay[:, None]
        assert amplitudes(stack, q, depth) == close_to(wanted, abs=1e-11)


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_a_thin_bonded_layer_is_sheared_at_its_base_by_the_slope_of_the_pressure(nu):
    """In a thin layer σzz = -p and, bonded to a rigid base, σxx = -ν/(1-ν) p.

    By equilibrium σxz = ν/(1-ν) z dp/dx: for ν = 1/2 that of the lubrication theory of a layer
    that is free on top. The errors are of second order in q h.
    """
    errors = []
    for thickness in (0.04, 0.02, 0.01):
        stack = ElasticStack((ElasticLayer(thickness, 1.0, nu),), None)
        x, _, s, t = amplitudes(stack, np.array([1.0]), thickness)[0]
        lateral = nu / (1 - nu)
        errors.append(np.abs([s + 1, x + lateral, t / (lateral * thickness) + 1]))
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    assert np.array(errors[-1]).max() < 2e-4
    assert ratios == close_to(np.full((2, 3), 4.0), rel=0.02)


@pytest.mark.parametrize("name", STACKS)
def test_tractions_are_the_same_on_both_sides_of_an_interface(name):
    stack = STACKS[name]
    q = np.geomspace(1e-4, 30, 20)
    for number in range(len(stack.layers) - (stack.base is None)):
        depth = sum(layer.thickness for layer in stack.layers[: number + 1])
        above, beneath = (amplitudes(stack, q, depth * scale) for scale in (1.0, 1 + 3e-9))
        assert beneath[:, 2:] == close_to(above[:, 2:], abs=1e-7)
        assert np.abs(above[:, 0] - beneath[:, 0]).max() > 0.01  # σxx jumps
        if not stack.layers[number].bonded:
            assert np.abs(above[:, 3]).max() < 1e-12


def test_depths_in_a_rigid_base_are_refused():
    stack = STACKS["sliding between"]
    assert [layer_at(stack, depth) for depth in (0.0, 0.5, 0.51, 1.5)] == [0, 0, 1, 1]
    with pytest.raises(ValueError, match=r"end at 1\.5 m on a rigid base; got 1\.6 m"):
        layer_at(stack, 1.6)
