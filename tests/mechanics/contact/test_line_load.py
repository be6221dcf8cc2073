"""Largest mean line load from the line load on rows of cells."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.line_load import line_load, peak_line_load

GRID = Grid((60, 14), (6.0, 2.8))  # dx 0.1, dy 0.2


def test_line_load_is_the_sum_across_times_the_cell_width():
    pressure = np.random.default_rng(3).random(GRID.shape)
    expected = [0.2 * sum(row) for row in pressure.tolist()]
    np.testing.assert_allclose(line_load(pressure, GRID), expected, rtol=1e-14)


def test_no_contact_has_no_line_load():
    assert peak_line_load(np.zeros(60), GRID, 0.0) == 0.0


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize(
    ("length", "mean"),
    [
        (4.0, (30 + 20) / 2),  # over two rows
        (5.0, (30 + 20 + 10 / 2) / 2.5),
        (1.0, 30.0),  # over half a row
        (0.0, 30.0),  # the extents of a few cells are rough
    ],
)
def test_peak_is_the_largest_mean_over_a_twentieth_of_the_length(way, length, mean):
    """At the end of the contact, off the middle of the grid."""
    load = np.zeros(60)
    load[12:52] = 5.0
    load[12:15] = 30.0, 20.0, 10.0
    assert peak_line_load(load[::way], GRID, length) == close_to(mean)


@pytest.mark.parametrize("length", [2.0, 3.0, 4.6, 6.0])
def test_peak_agrees_with_all_positions_of_the_mean(length):
    load = np.random.default_rng(8).random(60)
    window = length / 20
    starts = np.linspace(0.0, 6.0 - window, 100001)
    fine = np.repeat(load, 1000)  # cells of 0.1/1000
    before = np.append(0.0, np.cumsum(fine)) * 1e-4
    edges = np.arange(60001) * 1e-4
    means = (np.interp(starts + window, edges, before) - np.interp(starts, edges, before)) / window
    assert peak_line_load(load, GRID, length) == close_to(means.max(), rel=2e-4)


def test_mean_continues_across_the_border_of_a_period():
    load = np.ones(60)
    load[[0, 59]] = 9.0, 3.0
    period = Grid((60, 14), (6.0, 2.8), periodic=True)
    assert peak_line_load(load, period, 6.0) == close_to((3 + 9 + 1) / 3)
    assert peak_line_load(load, GRID, 6.0) == close_to((9 + 1 + 1) / 3)
