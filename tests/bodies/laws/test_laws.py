"""Laws of creep: closed forms, conventions, conversions from tests, and what they refuse."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from returned import some
from viscontact.laws import (
    Burgers,
    CreepSeries,
    Elastic,
    Law,
    Maxwell,
    RelaxationSeries,
    Zener,
)

T = np.array([0.0, 1e-3, 0.5, 3.0, 20.0, 1e3])

LAWS = [
    Elastic(3.0),
    Maxwell(3.0, 7.0),
    Zener(3.0, 0.4, 7.0),
    Burgers(3.0, 50.0, 0.4, 7.0),
    CreepSeries(0.2, [0.3, 1.0], [2.0, 9.0], 0.01),
    RelaxationSeries(0.5, [2.0, 3.0], [1.0, 10.0]),
]
each_law = pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)

moduli = st.floats(-3, 3).map(lambda exponent: 10.0**exponent)


def test_elastic_creep_compliance_is_half_the_inverse_shear_modulus():
    assert Elastic(3.0)(5.0) == close_to(1 / 6)
    assert Elastic(3.0).relaxation(5.0) == close_to(3.0)


def test_maxwell_creeps_and_relaxes_in_closed_form():
    """Findley, Lai & Onaran (1976), Table 5.1."""
    G, eta = 3.0, 7.0
    law = Maxwell(G, eta)
    np.testing.assert_allclose(law(T), (1 / G + T / eta) / 2, rtol=1e-14)
    np.testing.assert_allclose(law.relaxation(T), G * np.exp(-T * G / eta), rtol=1e-12)


@given(moduli, moduli, moduli)
def test_zener_creeps_and_relaxes_in_closed_form(spring, delayed, eta):
    """Tschoegl (1989), section 3.3: the standard linear solid; Table 1 of the founding paper."""
    G1, G2 = spring, delayed
    law = Zener(G1, G2, eta)
    creep = (1 / G1 - np.expm1(-T * G2 / eta) / G2) / 2
    relaxation = (G1 * G2 + G1**2 * np.exp(-T * (G1 + G2) / eta)) / (G1 + G2)
    np.testing.assert_allclose(law(T), creep, rtol=1e-13)
    # A relative 1e-16 in the time becomes t/tau times as much, only where exp(-t/tau) counts.
    np.testing.assert_allclose(law.relaxation(T), relaxation, rtol=1e-11)


def test_burgers_creeps_and_relaxes_in_closed_form():
    """Findley, Lai & Onaran (1976), Table 5.1, stress and strain in shear."""
    R1, eta1, R2, eta2 = 3.0, 50.0, 0.4, 7.0
    law = Burgers(R1, eta1, R2, eta2)
    creep = (1 / R1 + T / eta1 + (1 - np.exp(-T * R2 / eta2)) / R2) / 2
    p1, p2 = eta1 / R1 + eta1 / R2 + eta2 / R2, eta1 * eta2 / (R1 * R2)
    q1, q2 = eta1, eta1 * eta2 / R2
    A = np.sqrt(p1**2 - 4 * p2)
    r1, r2 = (p1 - A) / (2 * p2), (p1 + A) / (2 * p2)
    relaxation = ((q1 - q2 * r1) * np.exp(-r1 * T) - (q1 - q2 * r2) * np.exp(-r2 * T)) / A
    np.testing.assert_allclose(law(T), creep, rtol=1e-13)
    np.testing.assert_allclose(law.relaxation(T), relaxation, rtol=1e-12)


@given(
    st.lists(st.tuples(moduli, moduli), min_size=0, max_size=5),
    moduli,
    st.just(0.0) | moduli,
)
def test_modulus_times_rheometer_compliance_never_exceeds_one(terms, instant, fluidity):
    """G(t) (2 Phi(t)) <= 1, with equality at t = 0: Tschoegl (1989), section 8.1."""
    law = CreepSeries(instant, [a for a, _ in terms], [tau for _, tau in terms], fluidity)
    product = law.relaxation(T) * 2 * law(T)
    assert product[0] == close_to(1.0, rel=1e-13)
    assert (product <= 1 + 1e-13).all()
    assert (np.diff(law(T)) >= 0).all()
    assert (np.diff(law.relaxation(T)) <= 0).all()


@each_law
def test_both_series_of_a_law_are_the_law(law):
    for series in (law.creep_series(), law.relaxation_series()):
        np.testing.assert_allclose(series(T), law(T), rtol=1e-12)
        np.testing.assert_allclose(series.relaxation(T), law.relaxation(T), rtol=1e-12)
    assert isinstance(law.creep_series(), CreepSeries)
    assert isinstance(law.relaxation_series(), RelaxationSeries)


@each_law
def test_one_time_gives_a_float_and_an_array_gives_its_shape(law):
    assert type(law(1.0)) is float
    assert type(law.relaxation(np.float64(1.0))) is float
    assert law(T.reshape(2, 3)).shape == (2, 3)
    assert law.relaxation([1.0, 2.0]).shape == (2,)


@each_law
@pytest.mark.parametrize("t", [-1.0, float("nan"), [0.0, -1e-9]])
def test_times_before_the_step_are_refused(law, t):
    with pytest.raises(ValueError, match="t: times since the step must be >= 0"):
        law(t)
    with pytest.raises(ValueError, match="t: times since the step must be >= 0"):
        law.relaxation(t)


@each_law
def test_laws_are_frozen_hashable_and_rebuilt_from_their_fields(law):
    assert isinstance(law, Law)
    fields = {field.name: getattr(law, field.name) for field in dataclasses.fields(law)}
    law(1.0), law.relaxation(1.0)  # cached values are no part of the object
    again = type(law)(**fields)
    assert again == law
    assert hash(again) == hash(law)
    with pytest.raises(dataclasses.FrozenInstanceError):
        law.instant = 1.0


def test_series_take_arrays_and_store_tuples():
    law = CreepSeries(0.1, np.array([1.0, 2.0]), np.array([3.0, 4.0]))
    assert law == CreepSeries(0.1, (1.0, 2.0), (3.0, 4.0))
    assert law.amplitudes == (1.0, 2.0)


def test_creep_ends_at_its_final_value():
    assert CreepSeries(0.1, [1.0, 2.0], [3.0, 4.0])(np.inf) == close_to(3.1)
    assert CreepSeries(0.1, [1.0], [3.0], 1e-9)(np.inf) == np.inf
    assert RelaxationSeries(0.5, [2.0], [3.0]).relaxation(np.inf) == 0.5


def test_kelvin_voigt_creeps_but_has_no_relaxation_modulus():
    law = CreepSeries(0.0, [2.0], [3.0])
    assert law(0.0) == 0.0
    assert law(3.0) == close_to(2 * (1 - np.exp(-1)))
    with pytest.raises(ValueError, match="instant compliance > 0"):
        law.relaxation(1.0)


def test_rheometer_compliance_is_twice_phi_and_moduli_stay():
    law = CreepSeries.from_shear(2.0, [4.0], [3.0], 0.5)
    assert law == CreepSeries(1.0, [2.0], [3.0], 0.25)
    assert law.relaxation(0.0) == close_to(1 / 2.0)
    for model in (Elastic(3.0), Maxwell(3.0, 7.0), Zener(3.0, 0.4, 7.0), LAWS[3], LAWS[5]):
        assert type(model).from_shear(*dataclasses.astuple(model)) == model


# A tensile test of each kind: E_1 = 3, Kelvin unit (0.9, 6), steady viscosity 30.
def tensile_compliance(t, *, delayed, flowing):
    D = 1 / 3.0 + 0 * t
    D = D - delayed * np.expm1(-t * 0.9 / 6.0) / 0.9
    return D + flowing * t / 30.0


TENSILE = [
    (Elastic, (3.0,), {"delayed": 0, "flowing": 0}),
    (Maxwell, (3.0, 30.0), {"delayed": 0, "flowing": 1}),
    (Zener, (3.0, 0.9, 6.0), {"delayed": 1, "flowing": 0}),
    (Burgers, (3.0, 30.0, 0.9, 6.0), {"delayed": 1, "flowing": 1}),
    (CreepSeries, (1 / 3.0, [1 / 0.9], [6 / 0.9], 1 / 30.0), {"delayed": 1, "flowing": 1}),
    # The tensile relaxation of that Zener: E1 E2/(E1 + E2) and E1²/(E1 + E2), tau eta/(E1 + E2)
    (RelaxationSeries, (2.7 / 3.9, [9 / 3.9], [6 / 3.9]), {"delayed": 1, "flowing": 0}),
]
each_test = pytest.mark.parametrize(
    ("kind", "data", "parts"), TENSILE, ids=[kind.__name__ for kind, _, _ in TENSILE]
)


@each_test
@pytest.mark.parametrize("nu", [-0.3, 0.0, 0.38, 0.5])
def test_tensile_data_with_poisson_ratio_give_phi_of_one_plus_nu_times_d(kind, data, parts, nu):
    law = kind.from_uniaxial(*data, poisson_ratio=nu)
    assert type(law) is kind
    np.testing.assert_allclose(law(T), (1 + nu) * tensile_compliance(T, **parts), rtol=1e-12)


@each_test
@pytest.mark.parametrize("bulk_modulus", [0.34, 1.0, 1e4])
def test_tensile_data_with_bulk_modulus_leave_the_volumetric_part_out(
    kind, data, parts, bulk_modulus
):
    """D = 1/(3G) + 1/(9K) in every textbook on elasticity, after the correspondence principle."""
    law = kind.from_uniaxial(*data, bulk_modulus=bulk_modulus)
    assert type(law) is kind
    expected = 1.5 * (tensile_compliance(T, **parts) - 1 / (9 * bulk_modulus))
    np.testing.assert_allclose(law(T), expected, rtol=1e-11, atol=1e-14)


def test_youngs_modulus_may_come_with_poisson_ratio_by_position():
    assert Elastic.from_uniaxial(2.6, 0.3).shear_modulus == close_to(1.0)


BAD = [0.0, -1.0, float("nan"), float("inf"), "x"]


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("law", LAWS[:4], ids=lambda law: type(law).__name__)
def test_moduli_and_viscosities_that_are_not_positive_are_refused_by_name(law, bad):
    for field in some(dataclasses.fields(law)):
        with pytest.raises(ValueError, match=rf"{type(law).__name__}: {field.name} must be"):
            dataclasses.replace(law, **{field.name: bad})


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: CreepSeries(-1.0, [1.0], [1.0]), r"CreepSeries: instant .*got -1 1/Pa"),
        (lambda: CreepSeries(1.0, [1.0, -2.0], [1.0, 2.0]), r"CreepSeries: amplitudes\[1\]"),
        (lambda: CreepSeries(1.0, [1.0], [0.0]), r"CreepSeries: times\[0\] .*got 0 s"),
        (lambda: CreepSeries(1.0, [1.0], [np.nan]), r"CreepSeries: times\[0\]"),
        (lambda: CreepSeries(1.0, [1.0], [1.0, 2.0]), "got 1 amplitudes and 2 times"),
        (lambda: CreepSeries(1.0, 1.0, 2.0), r"CreepSeries: amplitudes must be a list of numbers"),
        (lambda: CreepSeries(1.0, [1.0], [1.0], -0.1), r"CreepSeries: fluidity"),
        (lambda: CreepSeries(0.0, [0.0], [1.0]), "CreepSeries: .*all 0"),
        (lambda: RelaxationSeries(np.inf, [1.0], [1.0]), r"RelaxationSeries: equilibrium"),
        (lambda: RelaxationSeries(0.0, [-1.0], [1.0]), r"RelaxationSeries: moduli\[0\]"),
        (lambda: RelaxationSeries(0.0, [0.0], [1.0]), "RelaxationSeries: .*all 0"),
        (lambda: RelaxationSeries(0.0, [], []), "RelaxationSeries: .*all 0"),
        (lambda: Elastic.from_uniaxial(1.0), "exactly one of poisson_ratio and bulk_modulus"),
        (
            lambda: Maxwell.from_uniaxial(1.0, 1.0, poisson_ratio=0.3, bulk_modulus=1.0),
            "exactly one of poisson_ratio and bulk_modulus",
        ),
        (lambda: Elastic.from_uniaxial(1.0, 0.6), r"poisson_ratio must lie .*got 0\.6"),
        (lambda: Elastic.from_uniaxial(1.0, -1.0), r"poisson_ratio must lie .*got -1\.0"),
        (lambda: Elastic.from_uniaxial(9.0, bulk_modulus=0.5), r"at least .*= 1 Pa"),
        (lambda: Elastic.from_uniaxial(8.0, bulk_modulus=8.0 / 9), "bulk_modulus"),
        (
            lambda: CreepSeries.from_uniaxial(1.0, [], [], bulk_modulus=0.1),
            r"bulk_modulus 100 mPa is too small",
        ),
        (
            lambda: RelaxationSeries.from_uniaxial(1.0, [8.0], [1.0], bulk_modulus=0.9),
            r"bulk_modulus 900 mPa is too small",
        ),
        (lambda: Zener.from_uniaxial(1.0, 0.0, 1.0, poisson_ratio=0.3), r"delayed_modulus"),
    ],
)
def test_bad_arguments_are_refused_with_name_and_value(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_instant_tensile_compliance_that_is_all_volume_leaves_none_in_shear():
    law = CreepSeries.from_uniaxial(1.0, [2.0], [3.0], bulk_modulus=1 / 9)
    assert law.instant == close_to(0.0, abs=1e-15)
