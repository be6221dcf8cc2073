"""The Mittag-Leffler function against mpmath, closed forms, its limits and its monotony."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import erfcx

from closeness import close_to
from viscontact.bodies.laws.interconversion.mittag_leffler import mittag_leffler

FORTY_DECADES = np.logspace(-20, 20, 161)


def summed(x: float, alpha: float, beta: float) -> float:
    """E_α,β(-x) by its power series, with as many digits as cancel; for x^(1/α) up to 60."""
    late = x ** (1 / alpha)
    with mpmath.workdps(40 + int(late / 2)):
        x, alpha, beta = mpmath.mpf(x), mpmath.mpf(alpha), mpmath.mpf(beta)
        total, k = mpmath.mpf(0), 0
        while True:
            term = (-x) ** k * mpmath.rgamma(alpha * k + beta)
            total, k = total + term, k + 1
            if alpha * k > late + 2 and abs(term) < abs(total) * mpmath.mpf(10) ** -25:
                return float(total)


@pytest.mark.parametrize(
    "alpha",
    [*(pytest.param(each, marks=pytest.mark.slow) for each in (0.15, 0.3, 0.5, 0.9)), 0.7, 0.97],
)
def test_values_are_those_of_the_series_in_many_digits(alpha):
    """Both sides of every change of method: x = 1, x = 8, x^(1/α) = 40."""
    for beta in (alpha, 1.0, 1 + alpha, 2.0, 2 + alpha):
        for late in (1e-3, 0.5, 1.01, 3.0, 12.0, 30.0, 36.0, 39.9, 41.0, 55.0):
            x = late**alpha
            # 1e-14 but for β = α near 1, where the first term of the asymptotic series is nothing:
            # 1.4e-12 at 0.9, 3.3e-12 at 0.97
            assert mittag_leffler(x, alpha, beta) == close_to(
                summed(x, alpha, beta), rel=5e-12 if alpha > 0.95 else 2e-12
            )


def test_one_half_is_the_scaled_complementary_error_function():
    """Erdélyi (1955), Higher Transcendental Functions III, 18.1: E_1/2(-x) = exp(x²) erfc(x)."""
    np.testing.assert_allclose(mittag_leffler(FORTY_DECADES, 0.5), erfcx(FORTY_DECADES), rtol=2e-14)


def test_one_is_the_exponential():
    x = np.logspace(-20, 2.8, 100)
    np.testing.assert_allclose(mittag_leffler(x, 1.0), np.exp(-x), rtol=1e-15)
    np.testing.assert_allclose(mittag_leffler(x, 1.0, 2.0), -np.expm1(-x) / x, rtol=1e-13)


@pytest.mark.parametrize("alpha", [0.05, 0.4, 0.8])
@pytest.mark.parametrize("step", [0.0, 1.0])
def test_both_ends_of_forty_decades_are_the_first_terms_of_both_series(alpha, step):
    """Two terms each; the third is x², or 1/x², of the first."""
    beta = 1 + step * alpha
    x = np.logspace(-20, -9, 12)
    early = 1 / math.gamma(beta) - x / math.gamma(alpha + beta)
    np.testing.assert_allclose(mittag_leffler(x, alpha, beta), early, rtol=3e-14)
    y = 1 / x
    late = 1 / (y * math.gamma(beta - alpha)) - float(mpmath.rgamma(beta - 2 * alpha)) / y**2
    np.testing.assert_allclose(mittag_leffler(y, alpha, beta), late, rtol=3e-14)


@given(st.floats(0.05, 1.0), st.floats(0.0, 1.0), st.floats(-10, 10))
def test_the_function_falls_ever_more_slowly(alpha, more, exponent):
    """Complete monotony for β >= α (Schneider 1996, Expo. Math. 14, 3): positive, falling, convex.

    Checked where differences are far above rounding.
    """
    x = 10.0**exponent * np.array([1.0, 1.5, 2.0])
    values = mittag_leffler(x, alpha, alpha + more)
    assert (values >= 0).all()
    if values[0] - values[2] > 1e-6 * values[0] and 10.0**exponent < 20:
        assert values[0] > values[1] > values[2]
        assert values[0] - values[1] > values[1] - values[2]


@pytest.mark.parametrize(
    ("x", "alpha", "beta"), [(1.0, 0.0, 1.0), (1.0, 1.1, 2.0), (1.0, 0.5, 0.4), (1.0, 0.5, 4.1)]
)
def test_parameters_out_of_range_are_refused(x, alpha, beta):
    with pytest.raises(ValueError, match="wanted 0 < alpha <= 1 and alpha <= beta <= 4"):
        mittag_leffler(x, alpha, beta)


@pytest.mark.parametrize("x", [-1e-9, np.nan])
def test_positive_arguments_of_the_series_are_refused(x):
    with pytest.raises(ValueError, match="x must be >= 0"):
        mittag_leffler(np.array([1.0, x]), 0.5)


def test_one_argument_gives_a_float_and_infinity_gives_nothing():
    assert type(mittag_leffler(1.0, 0.5)) is float
    assert mittag_leffler(np.ones((2, 3)), 0.5).shape == (2, 3)
    for alpha in (0.1, 0.5, 0.9):
        assert mittag_leffler(np.inf, alpha) == 0.0
