"""The lists of instants: what they hold exactly, and what they refuse."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.mechanics.time_integration.requested_times import (
    AdaptiveTimes,
    adaptive_times,
    log_times,
    uniform_times,
)

numbers_of_steps = st.integers(1, 400)


@given(end=st.floats(1e-9, 1e9), n=numbers_of_steps)
def test_uniform_times_are_even_from_exactly_0_to_exactly_the_end(end, n):
    times = uniform_times(end, n)
    assert times.shape == (n + 1,)
    assert (times[0], times[-1]) == (0.0, end)
    # Two instants are rounded, and the step that the last one is not a multiple of.
    assert np.diff(times) == close_to(end / n, abs=4e-16 * end)


@given(first=st.floats(1e-9, 1e3), ratio=st.floats(1.1, 1e12), n=st.integers(2, 400))
def test_log_times_are_0_and_a_geometric_progression_to_exactly_the_end(first, ratio, n):
    end = first * ratio
    times = log_times(first, end, n)
    assert times.shape == (n + 1,)
    assert (times[0], times[1], times[-1]) == (0.0, first, end)
    assert (np.diff(times) > 0).all()
    # Logarithms up to 30 are rounded to 4e-15, and the quotient of two instants with them.
    quotients = times[2:] / times[1:-1]
    assert quotients == close_to(ratio ** (1 / (n - 1)), rel=2e-14)


def test_log_times_by_hand():
    assert log_times(0.25, 16.0, 4).tolist() == close_to([0, 0.25, 1, 4, 16], rel=1e-14)


def test_a_single_log_step_goes_straight_to_the_end():
    assert log_times(1.0, 1000.0, 1).tolist() == [0.0, 1000.0]


def test_whole_numbers_of_any_type_count_steps():
    assert uniform_times(1, np.int64(2)).tolist() == [0.0, 0.5, 1.0]
    assert log_times(1, 10, 2.0).tolist() == [0.0, 1.0, 10.0]


@pytest.mark.parametrize("n", [0, -1, 1.5, math.nan, math.inf, True, "120", None])
@pytest.mark.parametrize(
    "times", [lambda n: uniform_times(1.0, n), lambda n: log_times(1.0, 2.0, n)]
)
def test_number_of_steps_must_be_whole_and_positive(times, n):
    with pytest.raises(
        ValueError, match="n, the number of steps, must be a whole number from 1"
    ) as e:
        times(n)
    assert repr(n) in str(e.value)


@pytest.mark.parametrize("end", [0.0, -1.0, math.nan, math.inf, True, "10 s", None])
def test_end_must_be_a_positive_time(end):
    with pytest.raises(ValueError, match="end must be a positive finite number"):
        uniform_times(end, 10)
    with pytest.raises(ValueError, match="end must be a positive finite number"):
        log_times(1e-3, end, 10)


@pytest.mark.parametrize("first", [0.0, -1.0, math.nan, "1 s"])
def test_first_must_be_a_positive_time(first):
    with pytest.raises(ValueError, match="first must be a positive finite number"):
        log_times(first, 10.0, 10)


@pytest.mark.parametrize("first", [10.0, 11.0])
def test_first_must_come_before_the_end(first):
    with pytest.raises(ValueError, match=rf"first must be earlier than end, got first={first} s"):
        log_times(first, 10.0, 10)


@pytest.mark.parametrize("make", [AdaptiveTimes, adaptive_times])
def test_adaptive_times_are_checked_however_they_are_made(make):
    assert make(10, 0.1) == AdaptiveTimes(end=10.0, tolerance=0.1)
    for end in (-1.0, math.inf, "10 s"):
        with pytest.raises(ValueError, match="end must be a positive finite number"):
            make(end, 1e-3)
    for tolerance in (0.0, 0.2, math.nan, "1 %"):
        with pytest.raises(ValueError, match=r"tolerance must lie between 1e-6 and 0\.1"):
            make(10.0, tolerance)
