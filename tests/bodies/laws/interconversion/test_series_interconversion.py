"""Creep and relaxation series are exact inverses of each other.

Truths from outside: the defining identity s² L[J] L[M] = 1, whose terms are all positive so
that it loses no digits; its form in time; the interlacing of the two spectra; a polynomial
root finder; the Prony pair published for PMMA.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from closeness import close_to
from viscontact.bodies.laws.interconversion.series import (
    RelaxationTerms,
    SeriesTerms,
    creep_from_relaxation,
    creep_function,
    merged,
    relaxation_from_creep,
    relaxation_function,
)

# s from far above the fastest to far below the slowest rate of any spectrum used here.
TRANSFORM_VARIABLES = np.logspace(-14, 14, 281)


def carson_creep(terms, s):
    """S L[J](s), by the transform table."""
    delayed = (terms.amplitudes / (1 + s[:, None] * terms.times)).sum(axis=1)
    return terms.instant + delayed + terms.fluidity / s


def carson_relaxation(terms, s):
    """S L[M](s), by the transform table."""
    scaled = s[:, None] * terms.times
    return terms.equilibrium + (terms.moduli * scaled / (1 + scaled)).sum(axis=1)


def product_error(creep, relaxation):
    s = TRANSFORM_VARIABLES
    return np.abs(carson_creep(creep, s) * carson_relaxation(relaxation, s) - 1).max()


def powers_of_ten(low, high):
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


@st.composite
def spectra(draw):
    """Strengths over 12 decades, some of them 0, at times over 12 decades, some nearly equal."""
    size = draw(st.integers(0, 10))
    times = 10 ** draw(arrays(float, size, elements=st.floats(-6, 6)))
    strengths = 10 ** draw(arrays(float, size, elements=st.floats(-12, 0)))
    strengths[draw(arrays(bool, size))] = 0.0
    if size >= 2:
        times[1] = times[0] * (1 + draw(st.sampled_from([0.0, 1e-15, 1e-9, 1e-7, 1e-4])))
    return strengths, times


# Rounding of products of a dozen factors and sums of a dozen positive terms: 1e-14 in practice.
IDENTITY = 1e-12


@given(spectra(), powers_of_ten(-8, 2), st.just(0.0) | powers_of_ten(-16, 2))
def test_relaxation_from_creep_makes_the_product_of_transforms_one(spectrum, instant, fluidity):
    strengths, times = spectrum
    creep = SeriesTerms(instant, strengths, times, fluidity)
    assert product_error(creep, relaxation_from_creep(*creep)) < IDENTITY


def test_a_weak_pole_where_the_others_cancel_does_not_spoil_the_product():
    """Residues from sums of squares, the obvious way, leave 5e-11 here."""
    creep = SeriesTerms(
        0.20833333333333331,
        np.array([9.41806297805786e-15, 0.06249999999999294, 0.16666666666666427]),
        np.array([1.000000137244736, 1.5000002058672348, 3.0000004117343844]),
        0.0,
    )
    assert product_error(creep, relaxation_from_creep(*creep)) < IDENTITY


@given(spectra(), st.just(0.0) | powers_of_ten(-12, 2))
def test_creep_from_relaxation_makes_the_product_of_transforms_one(spectrum, equilibrium):
    strengths, times = spectrum
    if equilibrium + strengths.sum() == 0:
        return
    relaxation = RelaxationTerms(equilibrium, strengths, times)
    assert product_error(creep_from_relaxation(*relaxation), relaxation) < IDENTITY


@given(spectra(), powers_of_ten(-8, 2), st.just(0.0) | powers_of_ten(-16, 2))
def test_relaxation_times_and_retardation_times_interlace(spectrum, instant, fluidity):
    """Park & Schapery (1999), section 3; Tschoegl (1989), section 8.1."""
    times = merged(*spectrum)[1]
    faster = relaxation_from_creep(instant, *spectrum, fluidity).times
    flowing = fluidity > 0
    assert faster.size <= times.size + flowing
    # A mode too weak to be a double next to its neighbour may be missing, none may be added:
    # no more relaxation than retardation times up to any instant, plus at most one ahead.
    for i, time in enumerate(times):
        assert np.count_nonzero(faster <= time * (1 - 1e-15)) <= i + 1
    if faster.size == times.size + flowing:
        assert (faster[: times.size] <= times).all()
        assert (faster[1:] >= times[: faster.size - 1]).all()


@given(spectra(), powers_of_ten(-8, 2), st.just(0.0) | powers_of_ten(-16, 2))
def test_there_and_back_is_the_same_creep_function(spectrum, instant, fluidity):
    creep = SeriesTerms(instant, *spectrum, fluidity)
    back = creep_from_relaxation(*relaxation_from_creep(*creep))
    t = np.logspace(-14, 14, 57)
    np.testing.assert_allclose(creep_function(back, t), creep_function(creep, t), rtol=1e-10)
    assert back.fluidity == close_to(fluidity, rel=1e-10)


@given(
    arrays(float, 6, elements=st.floats(0.1, 10)),
    arrays(float, 6, elements=st.floats(1.5, 50)),
    powers_of_ten(-2, 2),
    st.just(0.0) | powers_of_ten(-3, 1),
)
def test_there_and_back_returns_every_term_of_a_separated_spectrum(
    strengths, ratios, instant, fluidity
):
    times = 1e-4 * np.cumprod(ratios)
    back = creep_from_relaxation(*relaxation_from_creep(instant, strengths, times, fluidity))
    assert back.instant == close_to(instant, rel=1e-10)
    np.testing.assert_allclose(back.times, times, rtol=1e-10)
    np.testing.assert_allclose(back.amplitudes, strengths, rtol=1e-10)


def test_roots_are_those_of_the_polynomial():
    """The same relaxation times from the numerator of s L[J], by eigenvalues of a companion."""
    terms = SeriesTerms(0.5, np.array([1.0, 2.0, 0.7]), np.array([0.5, 3.0, 11.0]), 0.2)
    denominator = np.poly1d([1.0])
    for time in terms.times:
        denominator *= np.poly1d([time, 1.0])
    numerator = np.poly1d([terms.instant, terms.fluidity]) * denominator
    for amplitude, time in zip(terms.amplitudes, terms.times, strict=True):
        others = np.polydiv(denominator.coeffs, [time, 1.0])[0]
        numerator += np.poly1d([amplitude, 0.0]) * np.poly1d(others)
    expected = np.sort(-1 / numerator.roots.real)
    np.testing.assert_allclose(relaxation_from_creep(*terms).times, expected, rtol=1e-12)


def test_pmma_relaxation_is_the_pair_published_for_its_creep():
    """Eq. (15) as tensile compliance D [1/MPa] and the E(t) [MPa] that belongs to it."""
    creep = SeriesTerms(5.545e-4, np.array([6.17e-5, 8.38e-5]), 1 / np.array([0.1, 7.47e-3]), 0.0)
    relaxation = relaxation_from_creep(*creep)
    # The printed digits: two decimals of the moduli, three of the times' first digits.
    assert relaxation.equilibrium == close_to(1428.57, abs=0.005)
    np.testing.assert_allclose(relaxation.moduli, [184.15, 190.71], atol=0.005)
    np.testing.assert_allclose(relaxation.times, [8.989, 117.97], rtol=1e-4)


def convolution(creep, relaxation, t):
    """The integral of M(t - t') J(t') over t' from 0 to t, on panels that shrink at both ends."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    half = 0.5 * t * np.concatenate([[0.0], np.logspace(-14, 0, 57)])
    edges = np.concatenate([half, t - half[-2::-1]])
    middles, halves = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    s = (middles[:, None] + halves[:, None] * nodes).ravel()
    values = relaxation_function(relaxation, np.maximum(t - s, 0)) * creep_function(creep, s)
    return (values * (halves[:, None] * weights).ravel()).sum()


@pytest.mark.parametrize(
    "creep",
    [
        pytest.param(
            SeriesTerms(5.545e-4, np.array([6.17e-5, 8.38e-5]), np.array([10.0, 133.87]), 0.0),
            id="pmma",
        ),
        pytest.param(SeriesTerms(1e-3, np.array([1.0]), np.array([2.0]), 0.3), id="burgers"),
        pytest.param(
            SeriesTerms(1e-3, np.logspace(-3, 0, 7), np.logspace(-6, 6, 7), 0.0), id="polymer"
        ),
    ],
)
@pytest.mark.parametrize("t", [1e-3, 1.0, 100.0])
def test_convolution_of_modulus_and_compliance_is_time(creep, t):
    # Gauss-Legendre on graded panels resolves these integrands to rounding.
    relaxation = relaxation_from_creep(*creep)
    assert convolution(creep, relaxation, t) == close_to(t, rel=1e-11)


def test_elastic_has_no_terms_either_way():
    assert relaxation_from_creep(0.25, [], [], 0.0)[0] == 4.0
    assert relaxation_from_creep(0.25, [0.0], [1.0], 0.0).moduli.size == 0
    creep = creep_from_relaxation(4.0, [], [])
    assert (creep.instant, creep.amplitudes.size, creep.fluidity) == (0.25, 0, 0.0)


def test_flow_and_equilibrium_exclude_each_other():
    assert creep_from_relaxation(0.0, [2.0, 3.0], [1.0, 4.0]).fluidity == close_to(1 / 14)
    assert creep_from_relaxation(1e-9, [2.0, 3.0], [1.0, 4.0]).fluidity == 0.0
    assert relaxation_from_creep(1.0, [2.0], [1.0], 1e-9).equilibrium == 0.0


def test_equal_times_add_up():
    strengths, times = merged([1.0, 2.0, 4.0, 0.0], [3.0, 1.0, 3.0, 7.0])
    assert strengths.tolist() == [2.0, 5.0]
    assert times.tolist() == [1.0, 3.0]


def test_creep_shortly_after_the_step_keeps_its_digits():
    # 1 - exp(-x) = x - x²/2: in double precision the naive form has 4 digits left here.
    terms = SeriesTerms(0.0, np.array([1.0]), np.array([1e12]), 0.0)
    assert creep_function(terms, np.array([1.0]))[0] == close_to(1e-12 - 0.5e-24, rel=1e-15)


def test_creep_without_instant_compliance_has_no_relaxation_series():
    with pytest.raises(ValueError, match=r"instant.*> 0, got 0\.0.*Dirac"):
        relaxation_from_creep(0.0, [1.0], [1.0], 0.0)


def test_relaxation_without_any_modulus_is_refused():
    with pytest.raises(ValueError, match="all moduli are 0"):
        creep_from_relaxation(0.0, [0.0], [1.0])
