"""A law beside a spring: closed pairs, both limits of the spring, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import gamma

from closeness import close_to
from viscontact.bodies.laws.interconversion.mittag_leffler import mittag_leffler
from viscontact.laws import (
    BesideSpring,
    Burgers,
    CreepSeries,
    Elastic,
    FractionalMaxwell,
    FractionalZener,
    Maxwell,
    PowerLaw,
    RelaxationSeries,
    TabulatedCreep,
    TabulatedRelaxation,
)
from viscontact.results.descriptions import describe, rebuild

T = np.logspace(-8, 8, 161)


def beside_burgers(spring):
    law = Burgers(3.0, 50.0, 0.4, 7.0)
    series = law.relaxation_series()
    return law, RelaxationSeries(series.equilibrium + spring, series.moduli, series.times)


def beside_kelvin_voigt(spring):
    """G = 1/2 with eta = 1, and a spring beside it: stiffer and faster, without instant part."""
    return CreepSeries(0.0, [1.0], [2.0]), CreepSeries(
        0.0, [0.5 / (0.5 + spring)], [1 / (0.5 + spring)]
    )


def beside_spring_pot(spring):
    """Fractional Kelvin-Voigt: 2 Phi = (1 - E_n(-G_s A t^n))/G_s (Mainardi 2010, section 3.2)."""
    n = 0.3
    A = 2 * gamma(1 + n)
    return (
        PowerLaw(1.0, n, 1.0),
        lambda t: A * t**n * mittag_leffler(spring * A * t**n, n, 1 + n) / 2,
    )


def beside_fractional_maxwell(spring):
    return FractionalMaxwell(2.0, 3.0, 0.7), FractionalZener(2.0 + spring, spring, 3.0, 0.7)


@pytest.mark.parametrize("spring", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(
    "pair",
    [beside_burgers, beside_kelvin_voigt, beside_spring_pot, beside_fractional_maxwell],
)
def test_pair_creeps_in_closed_form_within_its_estimate(pair, spring):
    """From a spring that is nothing beside the law to one that is all, over 16 decades."""
    law, closed = pair(spring)
    beside = BesideSpring(law, spring)
    # 1e-5 is what the body may have crept and still be taken as elastic
    assert beside(T) == close_to(closed(T), rel=beside.inversion_error + 1e-5)
    assert beside.inversion_error < 1e-4


@pytest.mark.parametrize("law", [Maxwell(2.0, 6.0), PowerLaw(1.0, 0.3, 1.0, 0.1)])
def test_relaxation_and_complex_modulus_are_those_of_the_law_and_the_spring(law):
    beside = BesideSpring(law, 0.7)
    np.testing.assert_array_equal(beside.relaxation(T), law.relaxation(T) + 0.7)
    np.testing.assert_array_equal(beside.complex_modulus(T), law.complex_modulus(T) + 0.7)


@pytest.mark.parametrize("law", [CreepSeries(0.0, [1.0], [2.0]), PowerLaw(1.0, 0.3, 1.0, 0.1)])
def test_means_are_integrals_over_their_length(law):
    """Also over an interval that begins before the march does."""
    beside = BesideSpring(law, 0.7)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for end in (1e-9, 1e-3, 30.0):
        edges = np.append(0.0, np.geomspace(end * 1e-12, end, 400))
        t = edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2
        expected = (beside(t) @ weights) @ np.diff(edges) / 2 / end
        assert beside.mean_creep(0.0, end) == close_to(expected, rel=1e-6)
        assert beside.mean_creep(end, end) == close_to(beside(end), rel=1e-12)


def test_two_parallel_springs_are_a_spring():
    beside = BesideSpring(Elastic(2.0), 3.0)
    np.testing.assert_allclose(beside([0.0, 1e-9, 1.0, 1e9]), 0.1, rtol=1e-12)


def test_pair_ends_on_the_spring_or_on_both():
    assert BesideSpring(Maxwell(2.0, 6.0), 3.0)(np.inf) == close_to(1 / 6, rel=1e-9)
    solid = BesideSpring(FractionalZener(5.0, 1.0, 3.0, 0.4), 3.0)
    assert solid(np.inf) == close_to(1 / 8)


@pytest.mark.parametrize(
    "kind", [TabulatedCreep, pytest.param(TabulatedRelaxation, marks=pytest.mark.slow)]
)
def test_measured_law_with_a_parallel_spring_is_the_table_of_the_sum(kind):
    law, spring = FractionalZener(5.0, 1.0, 3.0, 0.5), 2.0
    times = np.logspace(-5, 7, 241)
    values = law(times) if kind is TabulatedCreep else law.relaxation(times)
    beside = BesideSpring(kind(times, values), spring)
    t = np.logspace(-3, 5, 60)
    closed = FractionalZener(7.0, 3.0, 3.0, 0.5)
    assert beside(t) == close_to(closed(t), rel=2e-4)
    assert beside.measured_until == 1e7
    assert 0 < beside.inversion_error < 1e-3


def test_conversion_error_of_a_measured_modulus_is_stated_beside_a_stiff_spring_too():
    times = np.geomspace(1e-2, 1e4, 7)
    law = TabulatedRelaxation(times, 1e6 * (1 + 9 / (1 + times)))
    # The spring takes nearly all of the load, and its own part of the error is far smaller.
    assert 0 < law.creep_error <= BesideSpring(law, 1e10).creep_error


def test_a_slowed_pair_is_the_pair_at_shorter_times():
    beside = BesideSpring(PowerLaw(1.0, 0.3, 1.0), 0.7)
    np.testing.assert_allclose(beside.slowed(50.0)(T), beside(T / 50.0), rtol=2e-5)


def test_pair_survives_as_plain_data():
    beside = BesideSpring(PowerLaw(1.0, 0.3, 1.0), 0.7)
    beside(1.0)
    assert rebuild(describe(beside)) == beside
    assert math.isinf(beside.measured_until)


def test_bad_pairs_are_refused():
    with pytest.raises(ValueError, match=r"BesideSpring: law must be a law such as"):
        BesideSpring(3.0, 1.0)
    with pytest.raises(ValueError, match=r"BesideSpring: shear_modulus must be a positive"):
        BesideSpring(Elastic(1.0), 0.0)
