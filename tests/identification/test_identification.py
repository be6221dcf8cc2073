"""Prony series from creep, relaxation and oscillation: recovered series and refusals."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import gamma

from closeness import close_to
from viscontact.bodies.series_fits import fit_creep, fit_dynamic, fit_relaxation
from viscontact.case import read_material
from viscontact.identification import material_section
from viscontact.laws import CreepSeries, RelaxationSeries

T = np.geomspace(1e-2, 1e3, 60)
OMEGA = np.geomspace(1e-3, 1e2, 50)
# A decade and more between neighbours: times that a test can distinguish.
KNOWN_TIMES, KNOWN_STRENGTHS = (0.1, 5.0, 120.0), (2.0, 3.0, 1.5)


def relaxing(t, stays):
    return stays + sum(
        g * np.exp(-t / tau) for g, tau in zip(KNOWN_STRENGTHS, KNOWN_TIMES, strict=True)
    )


def creeping(t, instant, fluidity):
    delayed = sum(
        j * (1 - np.exp(-t / tau)) for j, tau in zip(KNOWN_STRENGTHS, KNOWN_TIMES, strict=True)
    )
    return instant + delayed + fluidity * t


def scattered(values, share, seed):
    return values * (1 + share * np.random.default_rng(seed).standard_normal(values.shape))


@pytest.mark.parametrize("stays", [0.0, 1.0])
def test_relaxation_without_scatter_gives_its_own_series_back(stays):
    fit = fit_relaxation(T, relaxing(T, stays), data="shear", fluid=stays == 0, tolerance=1e-9)
    np.testing.assert_allclose(fit.law.times, KNOWN_TIMES, rtol=1e-6)
    np.testing.assert_allclose(fit.law.moduli, KNOWN_STRENGTHS, rtol=1e-6)
    assert fit.law.equilibrium == close_to(stays, abs=1e-6)
    assert fit.residual < 1e-9


@pytest.mark.parametrize("fluidity", [0.0, 0.02])
def test_creep_without_scatter_gives_its_own_series_back(fluidity):
    measured = creeping(T, 0.5, fluidity)
    fit = fit_creep(T, measured, data="deviatoric", fluid=fluidity > 0, tolerance=1e-9)
    np.testing.assert_allclose(fit.law.times, KNOWN_TIMES, rtol=1e-6)
    np.testing.assert_allclose(fit.law.amplitudes, KNOWN_STRENGTHS, rtol=1e-6)
    assert (fit.law.instant, fit.law.fluidity) == close_to((0.5, fluidity), abs=1e-6)


def test_oscillation_without_scatter_gives_its_own_series_back():
    fit = fit_dynamic(OMEGA, *oscillating(), data="shear", tolerance=1e-9)
    np.testing.assert_allclose(fit.law.times, KNOWN_TIMES, rtol=1e-6)
    np.testing.assert_allclose(fit.law.moduli, KNOWN_STRENGTHS, rtol=1e-6)
    assert fit.law.equilibrium == close_to(1.0)


def oscillating():
    """Ferry (1980), eqs. 3.31 and 3.32: G' and G'' of a Prony series."""
    a = OMEGA[:, None] * np.array(KNOWN_TIMES)
    return 1.0 + (a**2 / (1 + a**2)) @ KNOWN_STRENGTHS, (a / (1 + a**2)) @ KNOWN_STRENGTHS


@pytest.mark.filterwarnings("ignore:the fit misses")
@pytest.mark.parametrize("seed", range(3))
def test_each_column_of_an_oscillation_weighs_by_the_inverse_of_its_scatter(seed):
    """The best linear estimate (Aitken 1936) of both moduli is better than the better column.

    With equal weights the scatter of 10 % in one of the two would cost some 1 % in the other.
    """
    exact = oscillating()
    for shares in ((1e-3, 0.1), (0.1, 1e-3)):
        columns = zip(exact, shares, (seed, seed + 9), strict=True)
        measured = [scattered(values, share, of) for values, share, of in columns]
        fit = fit_dynamic(OMEGA, *measured, data="shear")
        precise = shares.index(1e-3)
        found = list(fit.fitted.values())[precise]
        assert np.sqrt(np.mean((found / exact[precise] - 1) ** 2)) < 1e-3


@pytest.mark.parametrize("seed", range(5))
def test_scatter_is_not_taken_for_terms(seed):
    """1 % of scatter leaves the residual at 1 %, not below: at most one term too many."""
    truth = relaxing(T, 1.0)
    fit = fit_relaxation(T, scattered(truth, 0.01, seed), data="shear")
    assert fit.terms in (3, 4)
    assert 0.007 < fit.residual < 0.012
    # What is fitted lies nearer to the truth than what was measured: some 7 parameters, 60 rows.
    np.testing.assert_allclose(fit.fitted["modulus"], truth, rtol=0.015)


def test_a_power_law_is_met_within_the_tolerance_with_more_terms():
    """A pure power law is a fluid of infinitely many terms, densest where most is asked."""
    terms = []
    for tolerance in (6e-3, 6e-4, 6e-5):
        fit = fit_relaxation(T, T**-0.2, data="shear", fluid=True, tolerance=tolerance)
        assert fit.residual <= tolerance
        fewer = fit_relaxation(T, T**-0.2, data="shear", fluid=True, terms=fit.terms - 1)
        assert fewer.residual > tolerance
        terms.append(fit.terms)
    # Sums of exponentials converge exponentially: each digit costs about the same.
    assert terms[0] < terms[1] < terms[2] < 20


@pytest.mark.parametrize("seed", range(3))
def test_small_values_weigh_as_much_as_large_ones(seed):
    """Relative residuals count: 1 % of scatter leaves less than 2 % of each of three decades."""
    creep = 1.0 + 1000.0 * (1 - np.exp(-T / 100.0)) + 10.0 * (1 - np.exp(-T / 0.1))
    fit = fit_creep(T, scattered(creep, 0.01, seed), data="deviatoric")
    np.testing.assert_allclose(fit.fitted["compliance"], creep, rtol=0.02)
    relaxation = 1.0 + 1000.0 * np.exp(-T / 0.1) + 10.0 * np.exp(-T / 30.0)
    fit = fit_relaxation(T, scattered(relaxation, 0.01, seed), data="shear")
    np.testing.assert_allclose(fit.fitted["modulus"], relaxation, rtol=0.02)


def test_oscillation_and_relaxation_of_a_power_law_agree_on_the_law():
    """Schapery & Park (1999): G = t^-n has G* = Gamma(1 - n) (i omega)^n; two routes, one law."""
    n = 0.25
    modulus = gamma(1 - n) * (1j * OMEGA) ** n
    one = fit_dynamic(OMEGA, modulus.real, modulus.imag, data="shear", fluid=True).law
    between = np.geomspace(0.1, 100.0, 30)  # what both tests have seen
    np.testing.assert_allclose(one.relaxation(between), between**-n, rtol=2e-3)


@pytest.mark.filterwarnings("ignore:the fit misses")
def test_a_given_number_of_terms_is_kept_and_more_never_fit_worse():
    measured = scattered(relaxing(T, 1.0), 0.01, 3)
    fits = [fit_relaxation(T, measured, data="shear", terms=n) for n in range(6)]
    assert [fit.terms for fit in fits[:4]] == [0, 1, 2, 3]
    residuals = [fit.residual for fit in fits]
    assert all(after <= before * 1.001 for before, after in pairwise(residuals))


def test_spring_and_dashpot_alone_need_no_exponential():
    spring = fit_creep(T, np.full_like(T, 2e-9), data="shear")
    assert (spring.terms, spring.law.instant) == (0, close_to(1e-9))
    maxwell = fit_creep(T, 1e-9 + 3e-10 * T, data="deviatoric", fluid=True)
    assert maxwell.terms == 0
    assert maxwell.law.fluidity == close_to(3e-10)


def test_each_convention_of_a_test_gives_the_one_law():
    """Phi of shear 1/G is half of it; of tensile D it is (1 + nu) D, or 3/2 (D - 1/(9K))."""
    phi, nu, K = creeping(T, 0.5, 0.0), 0.3, 4.0
    fits = [
        fit_creep(T, phi, data="deviatoric"),
        fit_creep(T, 2 * phi, data="shear"),
        fit_creep(T, phi / (1 + nu), data="uniaxial", poisson_ratio=nu),
        fit_creep(T, 2 / 3 * phi + 1 / (9 * K), data="uniaxial", bulk_modulus=K),
    ]
    for fit in fits:
        np.testing.assert_allclose(fit.law(T), phi, rtol=2e-3)
    G = relaxing(T, 1.0)
    tensile = fit_relaxation(T, 2 * (1 + nu) * G, data="uniaxial", poisson_ratio=nu)
    np.testing.assert_allclose(tensile.law.relaxation(T), G, rtol=2e-3)
    # With an elastic bulk modulus the times of E differ from those of G: through creep, exactly.
    D = CreepSeries(2 / 3 * 0.5 + 1 / (9 * K), [2 / 3 * 2.0], [5.0])
    E = CreepSeries(D.instant / 2, [D.amplitudes[0] / 2], [5.0]).relaxation(T)  # inverse of D
    fit = fit_relaxation(T, E, data="uniaxial", bulk_modulus=K, tolerance=1e-9)
    np.testing.assert_allclose(fit.law(T), CreepSeries(0.5, [2.0], [5.0])(T), rtol=1e-6)


@settings(max_examples=10)
@given(st.floats(-6, 12), st.floats(-8, 8), st.integers(0, 2**16))
def test_fits_scale_with_units_of_time_and_stress(stress, time, seed):
    measured = scattered(relaxing(T, 1.0), 0.01, seed)
    one = fit_relaxation(T, measured, data="shear", terms=2)
    other = fit_relaxation(10.0**time * T, 10.0**stress * measured, data="shear", terms=2)
    assert other.residual == close_to(one.residual, rel=1e-4)
    np.testing.assert_allclose(
        other.law.relaxation(10.0**time * T), 10.0**stress * one.law.relaxation(T), rtol=1e-3
    )


def test_rows_in_any_order_and_time_zero_are_accepted():
    t = np.concatenate([[0.0], T])
    shuffled = np.random.default_rng(1).permutation(t)
    fit = fit_relaxation(shuffled, relaxing(shuffled, 1.0), data="shear", tolerance=1e-9)
    np.testing.assert_allclose(fit.law.times, KNOWN_TIMES, rtol=1e-6)


def test_a_fit_prints_its_residuals():
    fit = fit_relaxation(T, scattered(relaxing(T, 1.0), 0.01, 0), data="shear", terms=2)
    worst = np.abs(fit.fitted["modulus"] / fit.measured["modulus"] - 1)
    assert fit.largest_residual == close_to(worst.max())
    assert fit.residual == close_to(np.sqrt(np.mean(worst**2)))
    text = repr(fit)
    assert "RelaxationSeries of 2 terms to 60 rows of shear data" in text
    assert f"(modulus, row {worst.argmax()})" in text


RISING, FALLING = [1.0, 2.0, 3.0, 4.0], [4.0, 3.0, 2.0, 1.0]
NAN = float("nan")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: fit_creep([1, 2, NAN, 4], RISING, data="shear"), "times, row 2: .*got nan"),
        (lambda: fit_creep([1, -2, 3, 4], RISING, data="shear"), r"times, row 1: .*got -2\.0"),
        (lambda: fit_creep(RISING, [1, 2, 0, 4], data="shear"), r"compliance, row 2: .*got 0\.0"),
        (
            lambda: fit_creep(RISING, [1, 2, 3, "x"], data="shear"),
            "numbers in 1/Pa, got 'x' at",
        ),
        (
            lambda: fit_creep(RISING, [RISING], data="shear"),
            "a list of numbers in 1/Pa, got",
        ),
        (lambda: fit_creep(RISING, [1, 2, 3], data="shear"), "got 4 times, 3 compliance"),
        (lambda: fit_creep([1, 2], [1, 2], data="shear"), "at least 3 rows, got 2"),
        (lambda: fit_creep(RISING, FALLING, data="shear"), "falls .*can only rise"),
        (lambda: fit_creep([3] * 4, RISING, data="shear"), "two different values"),
        (lambda: fit_creep(RISING, RISING, data="tensile"), "deviatoric, shear, uniaxial, got 't"),
        (lambda: fit_creep(RISING, RISING, data="uniaxial"), "exactly one of poisson_ratio"),
        (
            lambda: fit_creep(RISING, RISING, data="shear", poisson_ratio=0.3),
            "go with uniaxial data only",
        ),
        (lambda: fit_creep(RISING, RISING, data="shear", terms=3), "from 0 to 2, .*got 3"),
        (lambda: fit_creep(RISING, RISING, data="shear", terms=1.5), "whole number"),
        (lambda: fit_creep(RISING, RISING, data="shear", excess=1.0), "excess must be above 1"),
        (lambda: fit_relaxation(RISING, RISING, data="shear"), "rises .*can only fall"),
        (lambda: fit_relaxation(RISING, FALLING, data="deviatoric"), "shear, uniaxial, got 'dev"),
        (
            lambda: fit_relaxation(RISING, [4, 3, 2, -1], data="shear"),
            r"modulus, row 3: .*got -1\.0",
        ),
        (
            lambda: fit_dynamic([0, 1, 2, 3], RISING, FALLING, data="shear"),
            r"angular_frequency, row 0: .*above 0 rad/s, got 0\.0",
        ),
        (lambda: fit_dynamic(RISING, FALLING, RISING, data="shear"), "storage falls"),
        (lambda: fit_dynamic(RISING, RISING, [1, 1, 0, 1], data="shear"), "loss, row 2"),
    ],
)
def test_bad_data_are_refused_with_row_and_column(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_uniaxial_test_too_soft_for_its_bulk_modulus_is_refused():
    with pytest.raises(ValueError, match=r"bulk_modulus .* is too small"):
        fit_relaxation(T, relaxing(T, 1.0), data="uniaxial", bulk_modulus=0.1)


def test_the_law_of_a_fit_is_a_law_like_any_other():
    fit = fit_relaxation(T, relaxing(T, 1.0), data="shear")
    assert isinstance(fit.law, RelaxationSeries)
    assert fit.law(0.0) == close_to(1 / (2 * 7.5), rel=5e-3)


@pytest.mark.parametrize(
    "fit",
    [
        fit_creep(T, 1e-9 * creeping(T, 0.5, 0.02), data="uniaxial", poisson_ratio=0.3, fluid=True),
        fit_creep(T, 1e-9 * creeping(T, 0.5, 0.0), data="uniaxial", bulk_modulus=4e9),
        fit_relaxation(T, 1e9 * relaxing(T, 1.0), data="uniaxial", poisson_ratio=0.3),
        fit_relaxation(T, 1.234565e6 * relaxing(T, 0.0), data="shear", fluid=True),
        fit_creep(T, 1e-6 * creeping(T, 0.5, 0.0), data="deviatoric"),
    ],
    ids=["fluid", "bulk", "relaxation", "shear fluid", "deviatoric"],
)
def test_the_section_of_a_case_file_is_the_law_to_its_six_digits(fit, tmp_path):
    """Read back by the reader of case files."""
    text = material_section(fit)
    if "uniaxial" not in text:
        assert "# the data are of shear alone" in text
        text += "\n  poisson_ratio: 0.3"
    path = tmp_path / "material.yaml"
    path.write_text(text, encoding="utf-8")
    law = read_material(path).law
    np.testing.assert_allclose(law(T), fit.law(T), rtol=5e-6)
