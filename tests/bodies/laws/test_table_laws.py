"""Measured laws: values as measured, what lies between, before and beyond, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.laws import CreepSeries, TabulatedCreep, TabulatedRelaxation
from viscontact.results.descriptions import describe, rebuild

LAW = CreepSeries(0.2, np.logspace(-2, 1, 6), 10.0 ** np.arange(-3, 6, 1.5))


def sampled(kind, per_decade, **options):
    """LAW as a table over 13 decades, from where it has not begun to where it has ended."""
    times = np.logspace(-6, 8, 14 * per_decade + 1)
    values = LAW(times) if kind is TabulatedCreep else LAW.relaxation(times)
    return kind(times, values, **options)


each_kind = pytest.mark.parametrize("kind", [TabulatedCreep, TabulatedRelaxation])


@each_kind
@given(st.lists(st.floats(-9, 9), min_size=2, max_size=30, unique=True))
def test_values_are_used_as_measured_at_the_tables_own_times(kind, decades):
    times = np.unique(10.0 ** np.array(decades))
    if times.size < 2 or (np.diff(np.log(times)) < 1e-9).any():
        return
    if kind is TabulatedCreep:
        assert (TabulatedCreep(times, LAW(times))(times) == LAW(times)).all()
    else:
        moduli = np.minimum.accumulate(LAW.relaxation(times))
        assert (TabulatedRelaxation(times, moduli).relaxation(times) == moduli).all()


@each_kind
def test_every_function_of_a_sampled_series_tends_to_the_series(kind):
    """What a finer table gains: the third power of the spacing, as the interpolation itself."""
    t, omega = np.logspace(-4.9, 6.9, 60), np.logspace(-4, 3, 22)
    errors = []
    for per_decade in (4, 8, 16):
        law = sampled(kind, per_decade)
        modulus = LAW.complex_modulus(omega)
        errors.append(
            [
                np.abs(law(t) / LAW(t) - 1).max(),
                np.abs(law.relaxation(t) / LAW.relaxation(t) - 1).max(),
                np.abs(law.mean_creep(t / 3, t) / LAW.mean_creep(t / 3, t) - 1).max(),
                np.abs(law.complex_modulus(omega) / modulus - 1).max(),
            ]
        )
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 1.9).all(), orders
    assert (np.array(errors[-1]) < [4e-5, 4e-4, 4e-5, 2e-3]).all(), errors[-1]


@each_kind
def test_inversion_error_bounds_what_the_inversion_adds(kind):
    """A table so fine that it is the series itself: what is left is the inversion."""
    law, t = sampled(kind, 50), np.logspace(-5, 6, 50)
    if kind is TabulatedCreep:
        error = np.abs(law.relaxation(t) - LAW.relaxation(t)) * 2 * LAW(t)
    else:
        error = np.abs(law(t) / LAW(t) - 1)
    assert error.max() < law.inversion_error < 1e-3


def inverse_in_even_steps(compliance, end, steps):
    """G from ∫ C(t - t') dG(t') = 1 by the trapezium rule on the means of G, C = 2 Phi."""
    risen = 2 * compliance(np.linspace(0.0, end, steps + 1))
    rises, modulus = np.diff(risen), np.empty(steps + 1)
    modulus[0] = 1 / risen[0]
    for n in range(1, steps + 1):
        means = (modulus[1:n] + modulus[: n - 1]) / 2
        known = 1 - means @ rises[n - 1 : 0 : -1] - rises[0] * modulus[n - 1] / 2
        modulus[n] = known / (risen[0] + rises[0] / 2)
    return modulus


@pytest.mark.parametrize(
    "law",
    [
        TabulatedCreep([0, 1, 10, 100], [1, 2, 3, 4], beyond="last"),
        TabulatedCreep([1, 10, 100], [1, 3, 10]),
        TabulatedCreep([0.1, 0.3, 1, 3, 10], [1.1, 1.3, 2, 4, 11]),
    ],
)
def test_what_a_kinked_tables_modulus_swings_counts_as_error(law):
    # No body of springs and dashpots has these compliances: what they are inverse to rises again
    # on its way, by up to all that it is.
    end = 10.0
    swinging = inverse_in_even_steps(law, end, 4000)  # its own error: below 1e-4
    t = np.linspace(0.0, end, 4001)
    error = np.abs(law.relaxation(t) - swinging) * 2 * law(t)
    assert error.max() > 0.01
    assert law.inversion_error > 0.8 * min(error.max(), 1.0)


def test_the_modulus_of_a_steep_table_stays_below_the_inverse_compliance():
    law = TabulatedCreep([1.0, 2.0], [1.0, 1e4])
    t = np.logspace(-2, 2, 41)
    assert (law.relaxation(t) * 2 * law(t) <= 1 + 1e-12).all()
    assert law.relaxation(0.5) == close_to(0.5)  # elastic up to the first row
    assert law.inversion_error == 1.0  # nothing is known


@each_kind
def test_modulus_times_compliance_never_exceeds_one(kind):
    """G(t) 2 Phi(t) <= 1 (Tschoegl 1989, section 8.1), to the error of the inversion."""
    law, t = sampled(kind, 5), np.logspace(-8, 9, 200)
    product = law.relaxation(t) * 2 * law(t)
    assert (product <= 1 + law.inversion_error).all()
    assert (product > 0.3).all()
    assert (np.diff(law(t)) >= 0).all()
    assert (np.diff(law.relaxation(t)) <= 0).all()


def test_creep_and_relaxation_tables_answer_oscillations_alike():
    """G*(omega) 2 Phi*(omega) = 1 with either from its own table: no inversion is involved."""
    omega = np.logspace(-4, 3, 22)
    creep, relaxation = sampled(TabulatedCreep, 16), sampled(TabulatedRelaxation, 16)
    ratio = creep.complex_modulus(omega) / relaxation.complex_modulus(omega)
    assert np.abs(ratio - 1).max() < 2e-3
    for law in (creep, relaxation):
        assert (law.complex_modulus(omega).imag > 0).all()


def test_means_are_integrals_also_of_the_numerical_creep():
    law = TabulatedRelaxation([0.0, 1.0, 10.0, 1e3], [5.0, 3.0, 2.0, 1.0])
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.linspace(0.2, 40.0, 4001)
    t = edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2
    assert law.mean_creep(0.2, 40.0) == close_to((law(t) @ weights).mean() / 2, rel=1e-8)


def test_before_the_first_row_the_body_is_elastic_or_a_power():
    times, compliance = [1.0, 10.0, 100.0], [1.0, 2.0, 4.0]
    first = TabulatedCreep(times, compliance)
    assert (first(0.0), first(0.5), first.relaxation(0.0)) == (1.0, 1.0, 0.5)
    slope = TabulatedCreep(times, compliance, before="slope")
    assert slope(0.1) == close_to(0.5)
    assert slope(0.0) == 0.0
    # 2 Phi = 2 t^n early, so that G = t^-n / (2 Γ(1+n) Γ(1-n))
    n = math.log10(2)
    expected = 1e-6**-n / (2 * math.gamma(1 + n) * math.gamma(1 - n))
    assert slope.relaxation(1e-6) == close_to(expected, rel=1e-5)
    steep = TabulatedCreep([1.0, 2.0], [1.0, 9.0], before="slope")
    assert steep(0.25) == close_to(0.25)
    stiff = TabulatedRelaxation(times, [4.0, 2.0, 1.0], before="slope")
    assert stiff.relaxation(0.1) == close_to(8.0)
    assert stiff(0.0) == 0.0


def test_beyond_the_last_row_the_slope_continues_or_the_value():
    times = [1.0, 10.0, 100.0]
    assert TabulatedCreep(times, [1.0, 2.0, 4.0])(1e4) == close_to(8.0)
    assert TabulatedCreep(times, [1.0, 2.0, 4.0], beyond="last")(1e4) == 4.0
    falling = TabulatedRelaxation(times, [4.0, 2.0, 1.0])
    assert falling.relaxation(1e4) == close_to(0.25)
    assert (falling.relaxation(np.logspace(2, 30, 50)) > 0).all()
    assert TabulatedRelaxation(times, [4.0, 2.0, 1.0], beyond="last").relaxation(1e9) == 1.0
    assert falling.measured_until == 100.0


def test_a_row_at_time_zero_is_the_instant_value():
    law = TabulatedCreep([0.0, 1.0, 10.0], [1.0, 3.0, 4.0])
    assert (law(0.0), law(0.5), law(1.0)) == (1.0, 2.0, 3.0)
    assert law.relaxation(0.0) == close_to(0.5)
    # straight from 1 to 3: early G is that of a Maxwell body, 2 Phi = 2 + 4 t
    assert law.relaxation(0.01) == close_to(math.exp(-0.02) / 2, rel=1e-4)


def test_creep_from_nothing_has_no_relaxation_modulus():
    law = TabulatedCreep([0.0, 1.0, 10.0], [0.0, 3.0, 4.0])
    assert law(0.5) == 1.5
    assert math.isnan(law.inversion_error)
    with pytest.raises(ValueError, match=r"instant compliance > 0, got 0\.0 1/Pa at 0 s"):
        law.relaxation(1.0)


@each_kind
def test_a_slowed_table_is_the_table_at_shorter_times(kind):
    law, t = sampled(kind, 4), np.logspace(-4, 6, 30)
    slow = law.slowed(37.0)
    assert type(slow) is kind
    assert slow.measured_until == 37.0 * law.measured_until
    np.testing.assert_allclose(slow(t), law(t / 37.0), rtol=1e-6)
    np.testing.assert_allclose(slow.relaxation(t), law.relaxation(t / 37.0), rtol=1e-6)


def test_tensile_and_rheometer_tables_are_converted_by_the_row():
    times, D = (1.0, 10.0), np.array([2.0, 4.0])
    assert TabulatedCreep.from_shear(times, D).compliance == (1.0, 2.0)
    assert TabulatedCreep.from_uniaxial(times, D, poisson_ratio=0.25).compliance == (2.5, 5.0)
    by_bulk = TabulatedCreep.from_uniaxial(times, D, bulk_modulus=1 / 9).compliance
    assert by_bulk == close_to((1.5, 4.5))
    assert TabulatedRelaxation.from_shear(times, [4.0, 2.0]).modulus == (4.0, 2.0)
    tensile = TabulatedRelaxation.from_uniaxial(
        times, [4.0, 2.0], poisson_ratio=0.25, beyond="last"
    )
    assert (tensile.modulus, tensile.beyond) == ((1.6, 0.8), "last")


BAD_TIMES = [
    (([1.0, np.nan, 3.0],), r"times, row 1: must be a finite number in s, got nan"),
    (([1.0, 3.0, 2.0],), r"times, row 2: must be after row 1, got 2\.0 s after 3\.0 s"),
    (([1.0, 1.0, 2.0],), r"times, row 1: must be after row 0"),
    (([-1.0, 1.0, 2.0],), r"times, row 0: must be >= 0 s, got -1\.0 s"),
    (([1.0, "2", 3.0],), r"times must be numbers in s, got '2' at \[1\]"),
    (([[1.0], [2.0], [3.0]],), r"times must be a list of numbers in s"),
    (([1.0, 2.0],), r"times and .* equal lengths, got 2 times and 3 values"),
]


@pytest.mark.parametrize(("times", "message"), BAD_TIMES)
@each_kind
def test_bad_times_are_refused_with_row_and_column(kind, times, message):
    values = [1.0, 2.0, 3.0] if kind is TabulatedCreep else [3.0, 2.0, 1.0]
    with pytest.raises(ValueError, match=message):
        kind(*times, values)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda t: TabulatedCreep(t, [1, 2, 1]),
            r"compliance, row 2: must not fall.*got 1\.0 1/Pa",
        ),
        (lambda t: TabulatedCreep(t, [0, 1, 2]), r"compliance, row 0: must be positive, got 0\.0"),
        (
            lambda t: TabulatedCreep(t, [1, -1, 2]),
            r"compliance, row 1: must be positive, got -1\.0",
        ),
        (lambda t: TabulatedCreep(t, [1, 2, np.inf]), r"compliance, row 2: must be a finite"),
        (lambda t: TabulatedCreep([1], [1]), "at least 2 rows at times above 0 s"),
        (lambda t: TabulatedCreep([0, 1], [1, 2]), "at least 2 rows at times above 0 s"),
        (lambda t: TabulatedCreep(t, [1, 2, 3], before="x"), "before must be one of 'first', 's"),
        (lambda t: TabulatedCreep(t, [1, 2, 3], beyond="x"), "beyond must be one of 'slope', 'l"),
        (lambda t: TabulatedRelaxation(t, [1, 2, 1]), r"modulus, row 1: must not grow"),
        (lambda t: TabulatedRelaxation(t, [2, 1, 0]), r"modulus, row 2: must be positive, got 0"),
        (lambda t: TabulatedRelaxation(t, [2, 1, -1]), r"modulus, row 2: must be positive, got -1"),
        (
            lambda t: TabulatedCreep.from_uniaxial(t, [1, 2, 3], bulk_modulus=1 / 9),
            r"compliance, row 0: bulk_modulus 111\.111 mPa is too small",
        ),
        (
            lambda t: TabulatedRelaxation.from_uniaxial(t, [3, 2, 1], bulk_modulus=9),
            r"with bulk_modulus the shear modulus is no table.*give poisson_ratio",
        ),
        (lambda t: TabulatedCreep.from_uniaxial(t, [1, 2, 3]), "exactly one of poisson_ratio"),
    ],
)
def test_bad_tables_are_refused_with_row_and_column(make, message):
    with pytest.raises(ValueError, match=message):
        make([1.0, 2.0, 3.0])


@each_kind
def test_tables_are_hashable_and_survive_as_plain_data(kind):
    law = sampled(kind, 1, before="slope", beyond="last")
    assert rebuild(describe(law)) == law
    assert hash(rebuild(describe(law))) == hash(law)


def test_a_modulus_that_falls_off_a_cliff_is_converted_without_ado():
    # A thousandth within 1 % of the time, and so on beyond: a power of -690.
    law = TabulatedRelaxation([1.0, 1.01, 10.0, 10.1], [1e9, 1e6, 0.99e6, 1e3])
    t = np.logspace(-1, 1, 41)
    assert (np.diff(law(t)) >= 0).all()
    assert (2 * law(t) * law.relaxation(t) <= 1 + law.inversion_error).all()
