"""The contact compliance of laws that are no series, and of several bodies."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import gamma

from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.bodies.materials.material import Material
from viscontact.laws import Maxwell as MaxwellLaw
from viscontact.laws import PowerLaw, TabulatedCreep, TabulatedRelaxation, Zener
from viscontact.mechanics.time_integration.plan import plan_hereditary_integral
from viscontact.mechanics.time_integration.prony_approximation import as_exponentials

ZENER = Zener(1e9, 5e8, 1e9)
GUM = PowerLaw(1e-7, 0.4, 1.0)
TIMES = np.geomspace(1e-4, 1e3, 281)
TABLE = TabulatedCreep([0.0, *TIMES], [ZENER(0.0), *ZENER(TIMES)])
MODULI = TabulatedRelaxation([0.0, *TIMES], [ZENER.relaxation(0.0), *ZENER.relaxation(TIMES)])
T = np.geomspace(1e-3, 1e2, 60)


def test_constant_poissons_ratio_scales_any_law():
    compliance = Material(GUM, 0.3).contact_compliance()
    assert compliance(T) == close_to(0.7e-7 * T**0.4, rel=1e-13)
    assert compliance.instant == 0.0
    # M of J = c t^a is t^-a / (c Γ(1+a) Γ(1-a)).
    exact = T**-0.4 / (0.7e-7 * gamma(1.4) * gamma(0.6))
    assert compliance.relaxation(T) == close_to(exact, rel=1e-12)


@pytest.mark.parametrize(("start", "end"), [(0.0, 2.0), (1.0, 1.5), (0.9999, 1.0)])
def test_mean_is_the_integral_over_the_interval(start, end):
    compliance = Material(GUM, bulk_modulus=4e7).contact_compliance()
    # In ln t, where a power is smooth down to 0.
    lowest = max(start, 1e-12)
    area = quad(lambda x: math.exp(x) * compliance(math.exp(x)), *np.log([lowest, end]), limit=400)
    assert compliance.mean(start, end) == close_to(area[0] / (end - start), rel=1e-8)
    assert compliance.mean(end, end) == close_to(compliance(end), rel=1e-12)


@pytest.mark.parametrize(
    ("law", "bulk"),
    [
        pytest.param(TABLE, 5e8, id="creep table"),
        pytest.param(MODULI, 5e9, id="modulus table", marks=pytest.mark.slow),
    ],
)
def test_elastic_bulk_with_a_table_is_that_of_the_series_it_was_sampled_from(law, bulk):
    exact = Material(ZENER, bulk_modulus=bulk).contact_compliance()
    ours = Material(law, bulk_modulus=bulk).contact_compliance()
    # 40 rows a decade: a monotone cubic misses an exponential by some 1e-6 between them.
    assert ours(T) == close_to(exact(T), rel=5e-6)
    assert ours.relaxation(T) == close_to(exact.relaxation(T), rel=2e-5)
    assert 0 < ours.inversion_error < 1e-3


@pytest.mark.parametrize("bulk", [1e6, 1e8, 1e10])
def test_incompressible_and_rigid_limits_of_the_bulk_modulus(bulk):
    """Between 1/4 and 1 of 1/G~, that is Phi/2 and 2 Phi; s L[J] falls as K grows."""
    compliance = Material(GUM, bulk_modulus=bulk).contact_compliance()
    assert (compliance(T) >= 0.5 * GUM(T) * (1 - 1e-9)).all()
    assert (compliance(T) <= 2.0 * GUM(T) * (1 + 1e-6)).all()


def test_two_bodies_add_whatever_their_laws():
    bodies = [Material(TABLE, 0.3), Material(MaxwellLaw(1e9, 1e12), 0.4), Material(GUM, 0.5)]
    parts = [body.contact_compliance() for body in bodies]
    both = parts[0] + parts[1] + parts[2]
    other_way = parts[2] + (parts[1] + parts[0])
    assert both(T) == close_to(sum(part(T) for part in parts), rel=1e-14)
    assert other_way(T) == close_to(both(T), rel=1e-14)
    assert both.instant == close_to(sum(part.instant for part in parts))
    assert both.measured_until == 1e3


def test_relaxation_of_unlike_bodies_is_the_exact_inverse():
    series = [Material(ZENER, 0.3), Material(MaxwellLaw(1e9, 1e12), 0.4)]
    exact = series[0].contact_compliance() + series[1].contact_compliance()
    mixed = Material(TABLE, 0.3).contact_compliance() + series[1].contact_compliance()
    assert mixed.relaxation(T) == close_to(exact.relaxation(T), rel=2e-5)


def test_data_end_where_they_end():
    assert Material(TABLE, 0.3).known_until == 1e3
    assert Material(TABLE, 0.3, measured_until=50.0).known_until == 50.0
    assert Material(ZENER, 0.3).known_until == math.inf
    assert Material(ZENER, 0.3, measured_until=50.0).known_until == 50.0
    with pytest.raises(ValueError, match=r"Material: measured_until must be a positive"):
        Material(ZENER, 0.3, measured_until=0.0)


# -- how it is remembered --------------------------------------------------------------------


@pytest.mark.parametrize("exponent", [0.1, 0.5, 0.9])
def test_a_power_law_becomes_exponentials_within_the_bound_that_is_said(exponent):
    compliance = Material(PowerLaw(1e-7, exponent, 1.0), 0.3).contact_compliance()
    series, error = as_exponentials(compliance, 1e-3, 1e4)
    between = np.geomspace(1e-3, 1e4, 2001)
    measured = np.abs(series(between) / compliance(between) - 1).max()
    assert measured <= 1.05 * error
    assert error <= 1e-6
    assert len(series.times) <= 40
    assert (series.amplitudes > 0).all()


def test_a_series_is_remembered_exactly_and_a_short_run_of_any_law_too():
    instants = np.linspace(0.0, 100.0, 101)
    for law in (ZENER, TABLE):
        plan = plan_hereditary_integral(
            Material(law, 0.3).contact_compliance(), instants, numbers=10_000
        )
        assert plan.error == 0.0
        assert "exact" in plan.method or "given law" in plan.method


@pytest.mark.parametrize(("steps", "numbers"), [(10_000, 100), (1_000, 100_000)])
def test_a_long_or_large_run_is_remembered_by_few_exponentials_and_says_so(steps, numbers):
    instants = np.linspace(0.0, 100.0, steps + 1)
    compliance = Material(GUM, 0.3).contact_compliance()
    plan = plan_hereditary_integral(compliance, instants, numbers)
    assert 0 < plan.error < 1e-6
    assert f"{plan.error:.1e}" in plan.method
    assert plan.fields_kept < 60


def test_a_measured_creep_compliance_is_used_as_it_is_and_a_modulus_converted():
    # Steps that no body of springs and dashpots has: the inverse is next to unknown, J is given.
    times, steep = [1.0, 2.0, 3.0, 4.0], [1e-9, 1.001e-9, 9e-9, 9.01e-9]
    creep = Material(TabulatedCreep(times, steep), 0.3)
    relaxation = Material(TabulatedRelaxation(times, [9e8, 8.99e8, 1e8, 0.99e8]), 0.3)
    assert creep.law.inversion_error > 0.1
    assert creep.contact_compliance().inversion_error == 0.0
    assert relaxation.contact_compliance().inversion_error == relaxation.law.inversion_error > 0.0


@pytest.mark.parametrize(
    ("compliance", "is_elastic"),
    [
        (SeriesCompliance(1e-9, [], []), True),
        (SeriesCompliance(1e-9, [1e-9], [1.0]), False),
        (SeriesCompliance(0.0, [], [], fluidity=1e-9), False),  # a dashpot has no time of its own
    ],
)
def test_a_body_is_elastic_without_creep_and_flow(
    compliance: SeriesCompliance, is_elastic: bool
) -> None:
    assert compliance.is_elastic == is_elastic
