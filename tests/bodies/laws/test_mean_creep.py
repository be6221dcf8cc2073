"""What rests on Phi and G of every law: means over intervals, complex moduli, shifted times."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.laws import Burgers, CreepSeries, Elastic, Maxwell, RelaxationSeries, Zener

LAWS = [
    Elastic(3.0),
    Maxwell(3.0, 7.0),
    Zener(3.0, 0.4, 7.0),
    Burgers(3.0, 50.0, 0.4, 7.0),
    CreepSeries(0.2, [0.3, 1.0], [2.0, 9.0], 0.01),
    CreepSeries(0.0, [1.0], [2.0]),
    RelaxationSeries(0.5, [2.0, 3.0], [1.0, 10.0]),
]
each_law = pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
decades = st.floats(-6, 6).map(lambda exponent: 10.0**exponent)


def exact_growth(ratio: float) -> float:
    """1 - (1 - exp(-r))/r by its series in fractions, for r up to 1."""
    r, term, total = Fraction(ratio), Fraction(1), Fraction(0)
    for k in range(2, 30):
        term = term * r / k
        total += term if k % 2 == 0 else -term
    return float(total)


@given(st.floats(-300, 0).map(lambda exponent: 10.0**exponent))
def test_mean_of_a_kelvin_unit_keeps_its_digits_over_the_shortest_times(ratio):
    law = CreepSeries(0.0, [1.0], [1.0])
    assert law.mean_creep(0.0, ratio) == close_to(exact_growth(ratio), rel=1e-15)


def test_mean_of_a_kelvin_unit_ends_at_its_final_value():
    """1 - 1/r for r so large that exp(-r) is nothing."""
    law = CreepSeries(0.0, [1.0], [1.0])
    assert law.mean_creep(0.0, 1e3) == close_to(1 - 1e-3, rel=1e-15)
    assert law.mean_creep(0.0, 1e300) == 1.0


@each_law
@given(decades, decades)
def test_mean_creep_is_the_integral_over_its_length(law, start, length):
    """Gauss-Legendre of 30 nodes on panels of at most two relaxation times."""
    nodes, weights = np.polynomial.legendre.leggauss(30)
    length = min(length, 200.0)
    edges = np.linspace(start, start + length, 101)
    t = edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2
    expected = (law(t) @ weights).mean() / 2
    assert law.mean_creep(start, start + length) == close_to(expected, rel=1e-13)


@each_law
@given(decades)
def test_mean_over_no_time_is_phi_there(law, t):
    assert law.mean_creep(t, t) == close_to(law(t), rel=1e-14)


@each_law
def test_means_come_in_the_shape_of_their_intervals(law):
    start, end = np.zeros((2, 3)), np.arange(6.0).reshape(2, 3)
    assert law.mean_creep(start, end).shape == (2, 3)
    assert type(law.mean_creep(0.0, 1.0)) is float
    assert type(law.complex_modulus(1.0)) is complex
    assert law.complex_modulus(np.ones((2, 3))).shape == (2, 3)


@pytest.mark.parametrize(
    ("start", "end"),
    [(-1.0, 1.0), (2.0, 1.0), (np.nan, 1.0), (0.0, np.nan), (0.0, np.inf), ([0, 3], [1, 2])],
)
def test_intervals_that_are_none_are_refused(start, end):
    with pytest.raises(ValueError, match=r"0 <= start <= end, got"):
        Maxwell(3.0, 7.0).mean_creep(start, end)


@pytest.mark.parametrize("omega", [0.0, -1.0, np.nan, np.inf, [1.0, 0.0]])
def test_frequencies_that_are_not_positive_are_refused(omega):
    with pytest.raises(ValueError, match=r"angular_frequency must be positive and finite, got"):
        Maxwell(3.0, 7.0).complex_modulus(omega)


@given(decades)
def test_maxwell_stores_and_loses_in_closed_form(omega):
    """Tschoegl (1989), section 3.4: G' = G x²/(1 + x²), G'' = G x/(1 + x²), x = omega eta/G."""
    G, eta = 3.0, 7.0
    x = omega * eta / G
    modulus = Maxwell(G, eta).complex_modulus(omega)
    assert modulus.real == close_to(G * x**2 / (1 + x**2), rel=1e-14)
    assert modulus.imag == close_to(G * x / (1 + x**2), rel=1e-14)


@given(decades)
def test_zener_stores_and_loses_in_closed_form(omega):
    """A Kelvin unit G2 + i omega eta in series with G1."""
    kelvin = 0.4 + 7.0j * omega
    expected = 3.0 * kelvin / (3.0 + kelvin)
    modulus = Zener(3.0, 0.4, 7.0).complex_modulus(omega)
    assert modulus.real == close_to(expected.real, rel=1e-13)
    # in the product of complex numbers the loss is a small difference at both ends
    assert modulus.imag == close_to(9.0 * 7.0 * omega / abs(3.0 + kelvin) ** 2, rel=1e-13)


@given(
    st.lists(st.tuples(decades, decades), min_size=1, max_size=5),
    decades,
    st.just(0.0) | decades,
    decades,
)
def test_complex_modulus_of_the_creep_is_that_of_the_relaxation(terms, instant, fluidity, omega):
    """G*(omega) 2 Phi*(omega) = 1, the two sides from either series."""
    creep = CreepSeries(instant, [a for a, _ in terms], [tau for _, tau in terms], fluidity)
    expected = creep.relaxation_series().complex_modulus(omega)
    assert creep.complex_modulus(omega).real == close_to(expected.real, rel=1e-9)
    assert abs(creep.complex_modulus(omega) / expected - 1) < 1e-12


@each_law
@given(decades, decades)
def test_a_slowed_law_is_the_law_at_times_as_much_shorter(law, factor, t):
    slow = law.slowed(factor)
    assert type(slow) is type(law)
    assert slow(t) == close_to(law(t / factor), rel=1e-12)
    if law(0.0) > 0:
        stiff = law.relaxation(t / factor)
        assert slow.relaxation(t) == close_to(stiff, rel=1e-9, abs=1e-12)
    omega = 1 / t
    assert abs(slow.complex_modulus(omega) / law.complex_modulus(omega * factor) - 1) < 1e-12


@pytest.mark.parametrize("factor", [0.0, -1.0, np.nan, np.inf])
def test_a_factor_that_is_not_positive_is_refused(factor):
    for law in LAWS:
        with pytest.raises(ValueError, match="slowed: factor must be a positive"):
            law.slowed(factor)


@each_law
def test_formulas_hold_for_ever_and_without_error(law):
    assert law.measured_until == math.inf
    assert law.inversion_error == 0.0
