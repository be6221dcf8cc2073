"""Maxima, minima and means over windows of times, with unknown values."""

from __future__ import annotations

import numpy as np

from viscontact.simulation.accuracy.error_bars import unknown_bars
from viscontact.simulation.accuracy.refinement_levels import (
    between_known,
    moving_maximum,
    moving_mean,
    moving_minimum,
)


def test_unknown_errors_are_nan_without_time() -> None:
    values = unknown_bars({"time": np.zeros(2), "force": np.ones(2)}).values
    assert list(values) == ["force"]
    np.testing.assert_array_equal(values["force"], [np.nan, np.nan])


def test_moving_maximum_skips_unknown_values() -> None:
    np.testing.assert_array_equal(
        moving_maximum(np.array([1.0, np.nan, 5.0, 2.0, 0.0]), reach=1), [1.0, 5.0, 5.0, 5.0, 2.0]
    )


def test_unknown_value_takes_the_larger_neighbour_of_two() -> None:
    np.testing.assert_array_equal(
        between_known(np.array([1.0, np.nan, 5.0, 2.0, np.nan])), [1.0, 5.0, 5.0, 2.0, np.nan]
    )


def test_moving_minimum_skips_unknown_values() -> None:
    np.testing.assert_array_equal(moving_minimum(np.array([1.0, np.nan, 5.0])), [1.0, 1.0, 1.0])


def test_moving_mean_skips_unknown_values() -> None:
    np.testing.assert_array_equal(moving_mean(np.array([1.0, np.nan, 5.0])), [3.0, 3.0, 3.0])
