"""A monotone curve through points in log time: values, means, ends, and how it oscillates."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from mpmath import mp
from scipy.special import exp1

from closeness import close_to
from viscontact.bodies.laws.interconversion.curve_transform import oscillating
from viscontact.bodies.laws.interconversion.log_curve import LogCurve, mean_power
from viscontact.laws import CreepSeries

LAW = CreepSeries(0.2, [0.3, 1.0, 2.0], [2.0, 90.0, 1e5])
TIMES = np.array([1e-3, 2e-2, 3e-2, 1.0, 7.0, 40.0, 1e4, 2e4, 1e7])
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)


def by_panels(curve, start, end):
    """The mean by Gauss-Legendre on panels between the curve's points and quarters of decades."""
    marks = np.concatenate([curve.times, 10.0 ** np.arange(-40, 12, 0.25)])
    edges = np.unique(np.concatenate([[start, end], marks[(marks > start) & (marks < end)]]))
    t = edges[:-1, None] + np.diff(edges)[:, None] * (NODES + 1) / 2
    return (curve(t) @ WEIGHTS) @ np.diff(edges) / 2 / (end - start)


CURVES = {
    "line": LogCurve(TIMES, LAW(TIMES), beyond="line"),
    "value": LogCurve(TIMES, LAW(TIMES), beyond="value"),
    "power": LogCurve(TIMES, 1 / LAW(TIMES), before="power", beyond="power"),
    "from zero": LogCurve(np.append(0.0, TIMES), LAW(np.append(0.0, TIMES))),
}
each_curve = pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES.keys())


@each_curve
@given(st.floats(-8, 9), st.floats(-12, 9), st.booleans())
def test_means_are_integrals_over_lengths_wherever_they_begin_and_end(curve, at, over, early):
    start = 0.0 if early else 10.0**at
    end = start + 10.0**over
    if end - start < 1e-6 * start:
        return  # the rounding of the interval itself would be seen
    assert curve.mean(start, end) == close_to(by_panels(curve, start, end), rel=1e-13)


@each_curve
@given(st.floats(-8, 9), st.floats(-15, -6))
def test_means_over_next_to_nothing_are_values(curve, at, width):
    start = 10.0**at
    mean = curve.mean(start, start * (1 + 10.0**width))
    assert mean == close_to(float(curve(start)), rel=1e-5 * 10.0 ** (width + 6) + 1e-13)


@given(st.floats(-0.95, 1.0), st.floats(-10, 10), st.floats(-14, 3))
def test_mean_of_a_power_keeps_its_digits(exponent, at, width):
    """Between the values at the ends, and as the midpoint rule says, to its error."""
    start = np.array(10.0**at)
    end = start * (1 + 10.0**width)
    mean = mean_power(exponent, start, end)
    ends = np.sort([start**exponent, end**exponent])
    assert ends[0] * (1 - 1e-14) <= mean <= ends[1] * (1 + 1e-14)
    middle = (start + end) / 2
    relative = (end - start) / start
    if relative < 0.1:
        assert mean == close_to(middle**exponent, rel=relative**2 / 6 + 1e-14)


@given(
    arrays(float, 8, elements=st.floats(0.01, 3)),
    arrays(float, 8, elements=st.just(0.0) | st.floats(1e-12, 1.0)),
)
def test_curve_through_growing_points_grows_and_keeps_them(gaps, rises):
    times, values = 10.0 ** (np.cumsum(gaps) - 5), 1e-9 + np.cumsum(rises)
    curve = LogCurve(times, values)
    assert (curve(times) == values).all()
    t = np.geomspace(times[0] / 10, times[-1] * 10, 400)
    assert (np.diff(curve(t)) >= -1e-15 * values[-1]).all()


def test_interpolation_error_of_a_sampled_series_falls_with_the_third_power_of_the_spacing():
    t = np.logspace(-2.9, 6.9, 777)
    errors = []
    for per_decade in (6, 12, 24, 48):
        times = np.logspace(-3, 7, 10 * per_decade + 1)
        errors.append(np.abs(LogCurve(times, LAW(times))(t) / LAW(t) - 1).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 2.5).all()
    assert errors[-1] < 2e-6


def test_before_and_beyond_follow_the_named_rules():
    times, grown = np.array([1.0, 10.0, 100.0]), np.array([1.0, 2.0, 3.0])
    line = LogCurve(times, grown, beyond="line")
    np.testing.assert_allclose(line([1e-9, 0.0, 1e5]), [1.0, 1.0, 6.0])
    assert LogCurve(times, grown, beyond="value")([1e9]) == [3.0]
    power = LogCurve(times, times**-0.5, before="power", beyond="power")
    t = np.array([1e-3, 1e3])
    np.testing.assert_allclose(power(t), t**-0.5, rtol=1e-14)
    assert power(np.zeros(1)) == np.inf
    straight = LogCurve([0.0, 1.0, 2.0], [1.0, 3.0, 4.0])
    np.testing.assert_allclose(straight([0.0, 0.25, 0.5, 1.0]), [1.0, 1.5, 2.0, 3.0])


def test_exponents_before_the_first_point_keep_within_their_bounds():
    steep = LogCurve([1.0, 2.0], [1.0, 9.0], before="power", steepest=(0.0, 1.0))
    assert steep([0.5]) == [0.5]


@pytest.mark.parametrize("falling", [False, True])
def test_oscillating_curve_tends_to_the_series_it_samples(falling):
    """Transforms of exponentials; the interpolation error decides."""
    omega = np.logspace(-4, 1, 11)
    function = LAW.relaxation if falling else LAW
    modulus = LAW.complex_modulus(omega)
    exact = modulus if falling else 1 / (2 * modulus)
    errors = []
    for per_decade in (8, 16, 32):
        times = np.logspace(-5, 9, 14 * per_decade + 1)
        found = oscillating(LogCurve(times, function(times), beyond="value"), omega)
        errors.append(np.abs(found / exact - 1).max())
    assert (np.log2(np.array(errors[:-1]) / errors[1:]) > 2.2).all()
    assert errors[-1] < 2e-4


def test_oscillating_power_is_its_closed_form():
    """i omega L[t^n] = Γ(1+n) (i omega)^-n, from a head and a tail that are powers."""
    for n in (-0.4, 0.4):
        times = np.geomspace(1.0, 1.001, 3)  # so near that a cubic is the power
        curve = LogCurve(times, times**n, before="power", beyond="power")
        omega = np.array([1e-6, 1.0, 1e6])
        expected = math.gamma(1 + n) * (1j * omega) ** -n
        np.testing.assert_allclose(oscillating(curve, omega), expected, rtol=1e-9)


def test_oscillating_straight_line_in_log_time_is_its_closed_form():
    """f = 1 up to 1 s and then 1 + b ln t: f* = 1 + b E1(i omega) (Abramowitz & Stegun 5.1.1)."""
    curve = LogCurve([1.0, 10.0, 1e3], [1.0, 1.5, 2.5], beyond="line")
    omega = np.logspace(-9, 9, 37)
    expected = 1 + 0.5 / math.log(10) * exp1(1j * omega)
    np.testing.assert_allclose(oscillating(curve, omega), expected, rtol=1e-12)


def test_a_steep_fall_after_a_power_is_still_a_fall():
    """The power through points 1e6 apart would leave the first one too steeply for a cubic."""
    curve = LogCurve([1.0, 2.0, 4.0], [1.0, 1e-6, 1e-7], before="power", beyond="power")
    assert (np.diff(curve(np.geomspace(0.5, 8.0, 500))) <= 0).all()


def test_the_rate_of_a_steep_curve_is_found_far_before_its_tail():
    # Beyond t = 2 it falls as t^-32: at 1e-11 s, where it is held, that is no number.
    steep = LogCurve([1.0, 1.5, 2.0], [1e9, 5e8, 5e4], beyond="power")
    with np.errstate(all="raise"):
        assert steep.rate(np.array([1e-11]), np.array([1e-11])) == [0.0]


@pytest.mark.parametrize("exponent", [-1.5, -3.0, -40.0, -693.0])
@pytest.mark.parametrize("ratio", [1 + 1e-9, 1.01, 3.0, 1e6])
def test_mean_of_a_steep_fall_is_that_of_its_integral(exponent, ratio):
    # From 1 to b it is (b^(n+1) - 1)/((n+1)(b - 1)), however little is left at b.
    with mp.workdps(40):
        b = mp.mpf(ratio)
        exact = float((b ** (exponent + 1) - 1) / ((exponent + 1) * (b - 1)))
    with np.errstate(over="raise", invalid="raise"):
        mean = mean_power(exponent, np.array(1.0), np.array(ratio))
    # The ratio as a difference from 1 has lost 1e-16 / 1e-9 of its digits before it comes here.
    assert mean == close_to(exact, rel=1e-12)
