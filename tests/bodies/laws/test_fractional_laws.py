"""Power laws and spring-pots: closed forms, limits over many decades, and both ways round."""

from __future__ import annotations

import dataclasses
import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from closeness import close_to
from viscontact.laws import (
    FractionalMaxwell,
    FractionalZener,
    Maxwell,
    PowerLaw,
    Zener,
)
from viscontact.results.descriptions import describe, rebuild

LAWS = {
    "power": PowerLaw(0.5, 0.3, 2.0),
    "power with instant": PowerLaw(0.5, 0.3, 2.0, 0.1),
    "spring and spring-pot": FractionalMaxwell(2.0, 3.0, 0.6),
    "two spring-pots": FractionalMaxwell(2.0, 3.0, 0.8, 0.3),
    "Zener": FractionalZener(5.0, 1.0, 3.0, 0.4),
    "Zener without rest": FractionalZener(5.0, 0.0, 3.0, 0.4),
}
each_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS.keys())
exponents = st.floats(0.05, 0.95)
decades = st.floats(-10, 10).map(lambda exponent: 10.0**exponent)


SHORT = (("spring and spring-pot", 1.0), ("power with instant", 1.0))


def transformed(function, s):
    """S L[f](s) in many digits, from f in double precision: by mpmath's quadrature in ln t."""

    def integrand(u):
        return float(function(math.exp(u) / s)) * mpmath.exp(u - mpmath.exp(u))

    return float(mpmath.quad(integrand, mpmath.linspace(-60, 5, 27)))


@pytest.mark.parametrize(
    ("law", "s"),
    [
        pytest.param(law, s, id=f"{s}-{name}", marks=[] if (name, s) in SHORT else pytest.mark.slow)
        for name, law in LAWS.items()
        for s in (1.0, 1e-3, 1e3)
    ],
)
def test_transforms_of_creep_and_relaxation_are_inverse(law, s):
    """2 s² L[Phi] L[G] = 1, the definition of the pair; the laws give 13 digits of each."""
    product = 2 * transformed(law, s) * transformed(law.relaxation, s)
    # below exp(-60) a power of 0.3 still holds exp(-42) of the integral, and G ~ t^-0.3 likewise
    assert product == close_to(1.0, rel=1e-11)


@each_law
@settings(max_examples=15)
@given(decades, st.floats(-9, 6))
def test_mean_creep_is_the_integral_over_its_length(law, start, width):
    """Gauss-Legendre on panels of a quarter of a decade in t, with a first one from 0."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    end = start * (1 + 10.0**width)
    edges = np.geomspace(start, end, 2 + int(4 * math.log10(end / start)))
    t = edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2
    expected = (law(t) @ weights) @ np.diff(edges) / 2 / (edges[-1] - edges[0])
    assert law.mean_creep(edges[0], edges[-1]) == close_to(expected, rel=2e-13)


@each_law
@settings(max_examples=15)
@given(decades)
def test_mean_from_the_start_holds_what_came_before(law, end):
    """t m(0, t) = t' m(0, t') + (t - t') m(t', t)."""
    half = end / 2
    parts = (law.mean_creep(0.0, half) + law.mean_creep(half, end)) / 2
    assert law.mean_creep(0.0, end) == close_to(parts, rel=1e-12)
    assert law.mean_creep(end, end) == close_to(law(end), rel=1e-15)


@each_law
def test_creep_grows_and_modulus_falls_over_forty_decades(law):
    t = np.logspace(-20, 20, 400)
    assert (np.diff(law(t)) >= 0).all()
    assert (np.diff(law.relaxation(t)) <= 0).all()
    assert (law.relaxation(t) > 0).all()
    # 2 Phi G <= 1, and for a power never far below: Tschoegl (1989), section 8.1
    assert (2 * law(t) * law.relaxation(t) <= 1 + 1e-12).all()


@each_law
@settings(max_examples=15)
@given(decades)
def test_complex_modulus_is_that_of_the_relaxation_and_of_the_creep(law, omega):
    """By the rules Γ(1+n) (i omega τ)^-n for (t/τ)^n and x/(1 + x), x = (i omega τ)^a, for E_a."""
    p = 1j * omega
    if isinstance(law, PowerLaw):
        crept = law.compliance * math.gamma(1 + law.exponent)
        compliance = law.instant + crept * (p * law.reference_time) ** -law.exponent
        expected = 1 / (2 * compliance)
    elif isinstance(law, FractionalMaxwell):
        x = p * law.time
        expected = law.shear_modulus / (x**-law.exponent + x**-law.second_exponent)
    else:
        x = (p * law.time) ** law.exponent
        relaxing = law.shear_modulus - law.equilibrium_modulus
        expected = law.equilibrium_modulus + relaxing * x / (1 + x)
    found = law.complex_modulus(omega)
    assert abs(found / expected - 1) < 1e-13
    assert found.imag == close_to(expected.imag, rel=1e-6)
    assert found.imag > 0


def test_power_law_without_instant_compliance_is_a_spring_pot():
    """Lakes (2009), Viscoelastic Materials, section 2.6: J E = sin(nπ)/(nπ)."""
    law, t = PowerLaw(0.5, 0.3, 2.0), np.logspace(-10, 10, 21)
    expected = math.sin(0.3 * math.pi) / (0.3 * math.pi)
    np.testing.assert_allclose(2 * law(t) * law.relaxation(t), expected, rtol=1e-14)
    assert law.relaxation(0.0) == math.inf


@given(decades, decades, decades)
def test_exponent_one_makes_the_classical_laws(modulus, viscosity, t):
    classic = Maxwell(modulus, viscosity)
    time = viscosity / modulus
    for law in (
        FractionalMaxwell(modulus, time, 1.0),
        PowerLaw(0.5 / modulus, 1, time, 0.5 / modulus),
    ):
        assert law(t) == close_to(classic(t), rel=1e-13)
        if t < 500 * time:
            assert law.relaxation(t) == close_to(classic.relaxation(t), rel=1e-11)


def test_fractional_zener_of_exponent_one_is_the_zener_law():
    glassy, rest, time, t = 5.0, 1.0, 3.0, np.logspace(-8, 4, 50)
    law = FractionalZener(glassy, rest, time, 1.0)
    delayed = rest * glassy / (glassy - rest)
    classic = Zener(glassy, delayed, time * glassy * delayed / rest)
    classic = Zener(glassy, delayed, delayed * time * glassy / rest)
    np.testing.assert_allclose(law(t), classic(t), rtol=1e-13)
    np.testing.assert_allclose(law.relaxation(t), classic.relaxation(t), rtol=1e-11)


def test_fractional_zener_without_rest_is_a_spring_and_a_spring_pot():
    t = np.logspace(-12, 12, 49)
    zener, maxwell = FractionalZener(2.0, 0.0, 3.0, 0.6), FractionalMaxwell(2.0, 3.0, 0.6)
    np.testing.assert_allclose(zener(t), maxwell(t), rtol=1e-13)
    np.testing.assert_allclose(zener.relaxation(t), maxwell.relaxation(t), rtol=1e-13)
    mean = maxwell.mean_creep(t, 10 * t)
    np.testing.assert_allclose(zener.mean_creep(t, 10 * t), mean, rtol=1e-12)


def test_limits_of_laws_after_infinite_time():
    assert FractionalZener(5.0, 1.0, 3.0, 0.4)(np.inf) == 0.5
    assert FractionalZener(5.0, 0.0, 3.0, 0.4)(np.inf) == np.inf
    assert FractionalZener(5.0, 1.0, 3.0, 0.4).relaxation(np.inf) == 1.0
    assert FractionalMaxwell(2.0, 3.0, 0.8, 0.3).relaxation(np.inf) == 0.0
    assert PowerLaw(1.0, 0.5, 1.0, 1.0).relaxation(np.inf) == 0.0


@given(exponents, exponents, decades)
def test_early_and_late_the_leading_spring_pot_alone_is_seen(one, other, time):
    """Over 30 decades to both sides; the other then adds less than 1e-30 to the power apart."""
    early, late = sorted((one, other))
    if late - early < 0.1:
        return
    law = FractionalMaxwell(2.0, time, late, early)
    for exponent, t in ((early, 1e-200 * time), (late, 1e200 * time)):
        alone = PowerLaw(0.25 / math.gamma(1 + exponent), exponent, time)
        assert law(t) == close_to(alone(t), rel=1e-12)
        assert law.relaxation(t) == close_to(alone.relaxation(t), rel=1e-11)


@each_law
@settings(max_examples=15)
@given(decades, decades)
def test_a_slowed_law_is_the_law_at_shorter_times(law, factor, t):
    slow = law.slowed(factor)
    assert type(slow) is type(law)
    assert slow(t) == close_to(law(t / factor), rel=1e-12)
    assert slow.relaxation(t) == close_to(law.relaxation(t / factor), rel=1e-10)


T = np.logspace(-6, 6, 25)
TENSILE = {
    "power": (PowerLaw, (0.5, 0.3, 2.0, 0.2)),
    "Maxwell": (FractionalMaxwell, (2.0, 3.0, 0.6)),
    "Zener": (FractionalZener, (5.0, 1.0, 3.0, 0.4)),
    "Zener without rest": (FractionalZener, (5.0, 0.0, 3.0, 0.4)),
}


@pytest.mark.parametrize(("kind", "data"), TENSILE.values(), ids=TENSILE.keys())
def test_tensile_data_give_phi_by_poisson_ratio_or_by_bulk_modulus(kind, data):
    """Phi = (1 + nu) D, and Phi = 3/2 (D - 1/(9K)); D is the law's own form in terms of 1/E."""
    tensile = kind(*data)
    # compliances are given as they are, moduli as their inverse: 1/E against 1/(2G)
    D = tensile(T) if kind is PowerLaw else 2 * tensile(T)
    by_ratio = kind.from_uniaxial(*data, poisson_ratio=0.3)
    np.testing.assert_allclose(by_ratio(T), 1.3 * D, rtol=1e-13)
    by_bulk = kind.from_uniaxial(*data, bulk_modulus=1.5)
    assert type(by_bulk) is kind
    np.testing.assert_allclose(by_bulk(T), 1.5 * (D - 1 / 13.5), rtol=1e-12)


@each_law
def test_laws_are_hashable_and_survive_as_plain_data(law):
    law.relaxation(1.0)
    assert rebuild(describe(law)) == law
    assert hash(rebuild(describe(law))) == hash(law)
    values = dataclasses.astuple(law)
    if isinstance(law, PowerLaw):
        halved = dataclasses.replace(law, compliance=law.compliance / 2, instant=law.instant / 2)
        assert PowerLaw.from_shear(*values) == halved
    else:
        assert type(law).from_shear(*values) == law


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PowerLaw(0.0, 0.5, 1.0), r"PowerLaw: compliance must be a positive"),
        (lambda: PowerLaw(1.0, 0.0, 1.0), r"PowerLaw: exponent must lie above 0.*got 0\.0"),
        (lambda: PowerLaw(1.0, 1.1, 1.0), r"PowerLaw: exponent .*not above 1 \(a dashpot\)"),
        (lambda: PowerLaw(1.0, 0.5, -1.0), r"PowerLaw: reference_time"),
        (lambda: PowerLaw(1.0, 0.5, 1.0, -1.0), r"PowerLaw: instant .*>= 0"),
        (lambda: PowerLaw(1.0, 1.0, 1.0).relaxation(1.0), "instant compliance > 0 with a dashp"),
        (
            lambda: PowerLaw.from_uniaxial(1.0, 0.5, 1.0, bulk_modulus=1.0),
            "bulk_modulus 1 Pa is too small",
        ),
        (lambda: FractionalMaxwell(1.0, 1.0, 0.5, 0.5), r"second_exponent must be below expon"),
        (lambda: FractionalMaxwell(1.0, 1.0, np.nan), r"exponent must lie above 0"),
        (
            lambda: FractionalMaxwell.from_uniaxial(1.0, 1.0, 0.5, 0.2, bulk_modulus=1.0),
            r"bulk_modulus needs an instant tensile compliance.*0\.2",
        ),
        (lambda: FractionalZener(1.0, 1.0, 1.0, 0.5), r"equilibrium_modulus must be below shear"),
        (lambda: FractionalZener(1.0, -1.0, 1.0, 0.5), r"equilibrium_modulus must be a finite"),
        (lambda: FractionalZener(1.0, 0.5, 0.0, 0.5), r"FractionalZener: time"),
    ],
)
def test_bad_arguments_are_refused_with_name_and_value(make, message):
    with pytest.raises(ValueError, match=message):
        make()
