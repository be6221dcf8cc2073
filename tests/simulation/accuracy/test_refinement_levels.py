"""Maxima, minima and means over windows of times, with unknown values."""

from __future__ import annotations

import numpy as np

from viscontact.simulation.accuracy.error_bars import unknown_bars
from viscontact.simulation.accuracy.refinement_levels import (
    CARRIED,
    RefinementLevels,
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


NAN = np.nan


def levels(*rows: list[float]) -> RefinementLevels:
    values = np.array(rows)
    count = values.shape[1]
    return RefinementLevels(
        tuple(1.0 + k for k in range(len(rows))), values, np.zeros(count), np.zeros(count, bool)
    )


def test_a_grid_that_agrees_by_chance_does_not_hide_the_other_where_both_have_left_out_a_time() -> (
    None
):
    """By hand: the coarser grid is off by 0.4 and 0.2 beside; the finer one agrees at time 2."""
    own = [1.0, 1.0, 1.0, 1.0, 1.0]
    found = levels(own, [1.1, NAN, 1.0, NAN, 1.1], [1.4, NAN, NAN, NAN, 1.2])
    assert found.left_out.tolist() == [False, True, False, True, False]
    carried = found.carried(np.ones(5), np.zeros(5), remembers=True)
    np.testing.assert_allclose(carried.values[2, 1:4] - 1, 0.3 * CARRIED, rtol=1e-12)
    np.testing.assert_array_equal(carried.values[2, [0, 4]], [1.4, 1.2])
    assert (carried.by_cells(1.0)[1:4] >= 0.15 * CARRIED).all()


def test_carried_differences_fall_with_the_cells_in_contact() -> None:
    """Twice as many cells, half the relative difference."""
    found = levels([1.0, 1.0, 1.0], [1.2, NAN, 1.2])
    carried = found.carried(np.ones(3), np.array([10.0, 20.0, 10.0]), remembers=True)
    np.testing.assert_allclose(carried.values[1, 1] - 1, 0.1 * CARRIED, rtol=1e-12)


def test_an_elastic_contact_differs_as_at_the_same_size_while_it_grew() -> None:
    """Loading and unloading through 10, 20 and 30 cells: time 3 is like time 1."""
    own, cells = [1.0] * 5, np.array([10.0, 20.0, 30.0, 20.0, 10.0])
    found = levels(own, [1.0, 1.3, 1.0, NAN, 1.0])
    differences = [
        found.carried(np.ones(5), cells, remembers=each).values[1, 3] - 1 for each in (True, False)
    ]
    assert differences[0] == 0
    # By size it lies between time 1, which is as large, and time 2.
    np.testing.assert_allclose(differences[1], 0.15 * CARRIED, rtol=1e-12)
