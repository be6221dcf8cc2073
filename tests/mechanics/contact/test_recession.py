"""Cells whose values rise or fall since their last turn."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from viscontact.mechanics.contact.recession import TURNS, ContactTrend

GRID = vc.Grid((1, 4), (1.0, 4.0), periodic=(True, False))
OPEN = [False] * 4


def trend_after(*steps: tuple[list[float], list[bool]], error: float = 0.0) -> ContactTrend:
    trend = ContactTrend.at_first(GRID)
    for gap, in_contact in steps:
        trend = trend.after(np.array([gap]), np.zeros((1, 4)), np.array([in_contact]), error)
    return trend


def opens(*steps: tuple[list[float], list[bool]], error: float = 0.0) -> list[bool]:
    found: list[bool] = trend_after(*steps, error=error).gap.rises[0].tolist()
    return found


def test_a_gap_closes_at_first_and_opens_when_the_contact_leaves_the_cell() -> None:
    first = [1.0, 2.0, 3.0, np.inf], OPEN
    pressed = [0.0, 0.5, 1.5, np.inf], [True, False, False, False]
    left = [0.1, 0.6, 1.4, np.inf], OPEN
    assert opens(first) == OPEN
    assert opens(first, pressed) == OPEN
    assert opens(first, pressed, left) == [True, True, False, False]


def test_changes_within_the_error_of_the_solver_are_no_turns() -> None:
    small = [1 + 0.5 * TURNS, 1 + 2 * TURNS, 1.05, 1.2]
    assert opens(([1.0] * 4, OPEN), (small, OPEN)) == [False, True, True, True]
    assert opens(([1.0] * 4, OPEN), (small, OPEN), error=0.1) == [False, False, False, True]


def test_small_changes_one_way_add_up_to_a_turn() -> None:
    steps = [([1 + 0.4 * TURNS * k] * 4, OPEN) for k in range(5)]
    assert opens(*steps[:3]) == OPEN
    assert opens(*steps) == [True] * 4


def test_gaps_of_cells_in_contact_are_zero_whatever_the_solver_leaves_of_them() -> None:
    noise, more = [1e-12, -1e-12, 3e-12, 0.0], [3e-12, 1e-12, -1e-12, 1e-12]
    assert opens((noise, [True] * 4), (more, [True] * 4)) == OPEN


def test_a_contact_recedes_where_its_pressure_falls_as_well() -> None:
    trend, gap = ContactTrend.at_first(GRID), np.ones((1, 4))
    for pressure in ([1.0, 1.0, 1.0, 0.0], [2.0, 0.5, 1.0, 0.0]):
        trend = trend.after(gap, np.array([pressure]), np.zeros((1, 4), bool), 0.0)
    found = trend.recession(np.array([pressure]))
    np.testing.assert_array_equal(found.falls[0], [False, True, False, False])


def test_cells_that_were_in_contact_count_as_left_until_their_gaps_close() -> None:
    pressed = [0.0, 0.5, 1.0, 1.0], [True, False, False, False]
    open_again, closing = ([0.1, 0.6, 1.1, 1.1], OPEN), ([0.05, 0.5, 1.0, 1.0], OPEN)
    left = [
        trend_after(*steps).recession(np.zeros((1, 4))).left[0, 0]
        for steps in ([pressed], [pressed, open_again], [pressed, open_again, closing])
    ]
    assert left == [True, True, False]
    assert not trend_after(pressed, open_again).left[0, 1:].any()


def test_trend_on_a_larger_grid_knows_nothing_of_the_new_cells() -> None:
    larger = GRID.widened((1, 6))
    trend = trend_after(([1.0] * 4, OPEN), ([2.0] * 4, OPEN)).on(GRID, larger)
    np.testing.assert_array_equal(trend.gap.rises[0], [False, True, True, True, True, False])
    np.testing.assert_array_equal(trend.gap.extreme[0], [np.inf, 2.0, 2.0, 2.0, 2.0, np.inf])


@pytest.mark.parametrize("mirrored", [(True, False), (False, True), (True, True)])
def test_trends_of_an_even_contact_are_followed_on_a_part_of_the_grid(mirrored):
    random, grid = np.random.default_rng(7), vc.Grid((6, 8), (1.0, 1.0))
    larger = grid.widened((10, 12))
    whole, part = ContactTrend.at_first(grid), ContactTrend.at_first(grid, mirrored)
    for _ in range(6):
        quarter = random.random((2, 3, 4))
        gap, pressure = (np.block([[q[::-1, ::-1], q[::-1]], [q[:, ::-1], q]]) for q in quarter)
        whole, part = (each.after(gap, pressure, gap < 0.3, 0.0) for each in (whole, part))
    assert part.left.size == whole.left.size // 2 ** sum(mirrored)
    on_larger = np.ones(larger.shape)
    pairs = zip(whole.recession(pressure), part.recession(pressure), strict=True)
    grown = (each.on(grid, larger).recession(on_larger) for each in (whole, part))
    for one, other in (*pairs, *zip(*grown, strict=True)):
        np.testing.assert_array_equal(one, other)
