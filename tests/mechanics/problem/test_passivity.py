"""Effective kernels of layers gain no energy and are symmetric."""

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from random_examples import given_few_or_many
from viscontact.mechanics.halfspace.layered_influence import layered_influence_table
from viscontact.mechanics.problem import passivity
from viscontact.mechanics.problem.creeping_stack import CreepingStack
from viscontact.mechanics.problem.passivity import passive_share
from viscontact.mechanics.problem.separation import separate, transformed
from viscontact.mechanics.problem.surface import surface_of
from viscontact.mechanics.time_integration.internal_variables import ramp_weights
from viscontact.mechanics.time_integration.step_shape import StepShape

decades = st.floats
MODULI = decades(-2.5, 2.5).map(lambda power: 1e6 * 10**power)


@st.composite
def materials(draw):
    """Elastic bodies and Zener bodies, of a constant Poisson's ratio or bulk modulus."""
    shear = draw(MODULI)
    law = vc.Elastic(shear)
    if draw(st.integers(0, 3)):
        ratio, time = 10 ** draw(decades(0.2, 2.0)), 10 ** draw(decades(-1.5, 1.5))
        law = vc.Zener(shear, shear / (ratio - 1), time * shear / (ratio - 1))
    if draw(st.integers(0, 3)) == 0:
        return vc.Material(law, bulk_modulus=shear * 10 ** draw(decades(0.5, 3.0)))
    return vc.Material(law, poisson_ratio=draw(st.sampled_from([0.0, 0.3, 0.45, 0.499, 0.5])))


@st.composite
def bodies(draw):
    """One to three layers on a rigid base or on a half-space."""
    layers = [
        vc.Layer(1e-3 * 10 ** draw(decades(-0.5, 0.5)), draw(materials()))
        for _ in range(draw(st.integers(1, 3)))
    ]
    base = draw(st.one_of(st.just("rigid"), materials()))
    return vc.Layered(layers, base, bonded=draw(st.booleans()))


def kernels(surface, q):
    return np.array([term.response.ratio(q) for term in surface.terms])


@given_few_or_many(5, 15, bodies(), st.data())
def test_no_wave_gains_energy(body, data):
    surface = surface_of([body])
    assume(len(surface.terms) > 1)
    slow, fast = CreepingStack(body).rates
    thinnest = min(layer.thickness for layer in body.layers)
    # Between the wave numbers and frequencies looked at, and far beyond.
    q = np.geomspace(1e-4 / body.thickness, 30 / thinnest, 97)
    omega = np.geomspace(1e-3 * slow, 1e3 * fast, 83)
    functions = [term.compliance for term in surface.terms]
    found = np.array([transformed(j, 1j * omega) for j in functions]).T @ kernels(surface, q)
    assert (found.real > 0).all()
    assert (-found.imag >= -1e-5 * np.abs(found)).all()
    # At once, at every time, and over every step.
    at = np.append(0.0, 1 / omega)
    creep = np.array([j(at) for j in functions]).T @ kernels(surface, q)
    assert (creep > 0).all()
    assert (creep >= creep[0] * (1 - 1e-6)).all()
    step = 10 ** data.draw(st.floats(-3, 3)) / fast
    rise = step * data.draw(st.floats(0.01, 1.0))
    shape = StepShape(step, rise=rise)
    new = [j.instant + ramp_weights(j, shape).new.sum() for j in functions]
    assert (new @ kernels(surface, q) > 0).all()


@given_few_or_many(5, 15, bodies())
def test_the_stated_error_holds_at_other_waves_and_frequencies(body):
    assume(len(surface_of([body]).terms) > 1)
    found, stack = separate(body), CreepingStack(body)
    slow, fast = stack.rates
    thinnest = min(layer.thickness for layer in body.layers)
    q = np.geomspace(0.02 / body.thickness, 12 / thinnest, 31)
    s = 1j * np.geomspace(slow / 20, fast * 20, 29)
    values = np.array([response.ratio(q) for response in found.responses])
    summed = np.array([transformed(j, s) for j in found.compliances]).T @ values
    assert np.abs(summed / stack.compliance(q, s) - 1).max() < found.error + 1e-9


def test_a_sum_that_gains_energy_is_made_passive_at_little_cost():
    # Two Kelvin bodies of 1 s and 10 s; the second is subtracted, too much at q of the last C.
    omega = np.geomspace(1e-3, 1e3, 61)
    harmonic = np.stack([1 + 1 / (1 + 1j * omega), 1 + 1 / (1 + 10j * omega)], axis=1)
    at_points = np.array([[2.0, 1.5, 1.0], [1.0, 0.9, 0.9]])
    weights = np.array([[1.0, 0.0], [-1.0, 0.9]])
    before = harmonic @ weights @ at_points
    assert before.imag.max() > 0.05
    share = passive_share(harmonic, weights, at_points)
    after = harmonic @ (weights + share) @ at_points
    assert after.imag.max() <= 1e-12
    # No less is enough by more than a factor.
    gain = (before.imag / np.abs(before)).max()
    assert np.abs(after / before - 1).max() < 10 * gain
    # Nothing is added to what is passive.
    assert passive_share(harmonic, np.eye(2), at_points) == close_to(np.zeros((2, 2)))


KELVINS = np.array([[1.0, 0.0], [-1.0, 0.9]])  # weights of two Kelvin bodies of 1 s and 10 s


def harmonic_kelvins(omega):
    return np.stack([1 + 1 / (1 + 1j * omega), 1 + 1 / (1 + 10j * omega)], axis=1)


def elastic_parts(q):
    """Two functions that fall over the wave number, the second one less."""
    return np.array([1 + np.exp(-q), 0.9 + 0.1 * np.exp(-3 * q)])


def test_sums_made_passive_lose_energy_between_the_points_as_well():
    """Random sums of two Kelvin bodies times two functions of the wave number that gain energy."""
    rng, found = np.random.default_rng(0), 0
    for _ in range(120):
        grown, times = 10 ** rng.uniform(-0.5, 1, 2), 10 ** rng.uniform(-1, 1, 2)
        levels, decays = rng.uniform(0.1, 1, 2), 10 ** rng.uniform(-1, 1, 2)
        weights, points = rng.uniform(-0.7, 1, (2, 2)), int(rng.integers(9, 25))

        def of(count, grown=grown, times=times, levels=levels, decays=decays):
            omega, q = np.geomspace(1e-3, 1e3, count)[:, None], np.linspace(0.0, 3.0, count)
            harmonic = 1 + grown / (1 + 1j * omega * times)
            return harmonic, levels[:, None] + np.exp(-decays[:, None] * q)

        harmonic, at_points = of(301)
        before = harmonic @ weights @ at_points
        if before.imag.max() < 1e-3 * np.abs(before).max() or before.real.min() < 0:
            continue
        found += 1
        share = passive_share(of(points)[0], weights, of(points)[1])
        assert (harmonic @ (weights + share) @ at_points).imag.max() <= 0
    assert found > 10


@pytest.mark.parametrize("part", [0.0, 0.5, 0.999])
def test_a_sum_is_passive_even_where_the_linear_program_leaves_a_gain(part, monkeypatch):
    harmonic, at_points = harmonic_kelvins(np.geomspace(1e-3, 1e3, 61)), elastic_parts(np.arange(3))
    least = passivity._least_share
    monkeypatch.setattr(passivity, "_least_share", lambda *given: part * least(*given))
    after = harmonic @ (KELVINS + passive_share(harmonic, KELVINS, at_points)) @ at_points
    assert after.imag.max() <= 1e-12


def test_a_gain_too_small_for_a_linear_program_is_balanced_too():
    harmonic = harmonic_kelvins(np.geomspace(1e-3, 1e3, 61))
    at_points, weights = elastic_parts(np.arange(3)), np.array([[1.0, 0.0], [-4e-10, 0.0]])
    weights[0, 0] = 1e-10
    before = harmonic @ weights @ at_points
    assert before.imag.max() > 0
    after = harmonic @ (weights + passive_share(harmonic, weights, at_points)) @ at_points
    assert after.imag.max() <= 1e-13 * np.abs(before).max()


def test_influence_coefficients_of_every_term_are_reciprocal():
    # What a cell displaces another by does not depend on which of the two is loaded: offsets of
    # (i, j) and, on turned cells, of (j, i), with the same cell at the end of both.
    rubber = vc.Material(vc.Zener(1e6, 1e5, 1e5), poisson_ratio=0.4)
    core = vc.Material(vc.Elastic(1e6), poisson_ratio=0.3)
    surface = surface_of([vc.Layered([vc.Layer(1e-3, rubber)], base=core)])
    assert len(surface.terms) > 2
    for term in surface.terms:
        wide = layered_influence_table((9, 7), (2e-4, 3e-4), term.response)
        tall = layered_influence_table((7, 9), (3e-4, 2e-4), term.response)
        assert wide == close_to(tall.T, abs=1e-9 * np.abs(wide).max())
