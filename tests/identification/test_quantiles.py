"""Student's quantiles and chi-square exceedances against SciPy's."""

from __future__ import annotations

import math

import pytest
from scipy.special import chdtrc, stdtrit

from closeness import close_to
from viscontact.bodies.series_fits.quantiles import chi_square_exceedance, student_quantile

FREEDOMS = [0.5, 1, 1.5, 2, 3, 8, 37.3, 500, 9999, 10_000, 1e5, 1e6, 1e7, 1e12]


@pytest.mark.parametrize("freedom", FREEDOMS)
@pytest.mark.parametrize("probability", [0.50001, 0.6, 0.95, 0.975, 0.995, 0.9999])
def test_quantile_of_student_is_that_of_scipy(freedom: float, probability: float) -> None:
    found = student_quantile(freedom, probability)
    assert found == close_to(float(stdtrit(freedom, probability)), rel=1e-10)


@pytest.mark.parametrize("freedom", FREEDOMS)
@pytest.mark.parametrize("confidence", [1 - 1e-8, 1 - 1e-12, 1 - 1e-15])
def test_quantile_of_a_far_tail_is_that_of_scipy(freedom: float, confidence: float) -> None:
    probability = 0.5 + confidence / 2
    found = student_quantile(freedom, probability)
    assert found == close_to(float(stdtrit(freedom, probability)), rel=1e-10)


@pytest.mark.parametrize("freedom", [3.0, 1e5])
def test_quantile_of_certainty_is_infinite(freedom: float) -> None:
    assert student_quantile(freedom, 1.0) == math.inf


def test_quantile_near_the_middle_is_the_distance_over_the_density() -> None:
    # Cauchy's distribution, 1/pi at 0
    assert student_quantile(1.0, 0.5 + 1e-9) == close_to(math.pi * 1e-9, rel=1e-6)


def test_quantile_of_student_is_zero_in_the_middle() -> None:
    assert student_quantile(5.0, 0.5) == 0.0


def test_quantile_of_much_freedom_is_the_normal_one() -> None:
    # Abramowitz and Stegun (1964), table 26.1
    assert student_quantile(1e12, 0.975) == close_to(1.959963985, rel=1e-9)


@pytest.mark.parametrize("degrees", [2, 8, 64, 1000, 100_000])
@pytest.mark.parametrize("part", [0.5, 0.9, 1.0, 1.1, 1.5])
def test_exceedance_of_chi_square_is_that_of_scipy(degrees: int, part: float) -> None:
    found = chi_square_exceedance(part * degrees, degrees)
    # Of 1e5 degrees the terms are differences of logarithms of a million.
    assert found == close_to(float(chdtrc(degrees, part * degrees)), rel=1e-6, abs=1e-300)


def test_every_chi_square_exceeds_zero() -> None:
    assert chi_square_exceedance(0.0, 4) == 1.0
