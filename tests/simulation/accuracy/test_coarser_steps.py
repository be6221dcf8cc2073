"""Grids and steps of coarser runs."""

from __future__ import annotations

import numpy as np

import viscontact as vc
from closeness import close_to
from viscontact.simulation.accuracy.coarser_grids import coarser_grid
from viscontact.simulation.accuracy.coarser_ratios import usual_coarsening
from viscontact.simulation.accuracy.coarser_steps import (
    _every_second,
    first_steps,
    parts_of_first_steps,
    parts_of_shared_steps,
)
from viscontact.simulation.accuracy.moving_levels import aligned_along, fewer_moving_times


def test_coarser_grid_keeps_parity_and_holds_the_region():
    grid = coarser_grid(vc.Grid((30, 31), (30.0, 31.0)), (2.0, 2.0), parity=True)
    assert grid == vc.Grid((16, 17), (32.0, 34.0))


def test_few_cells_and_steps_are_coarsened_less():
    assert usual_coarsening(60, across=50) == ((1.9, 4), (2.9, 8))
    assert usual_coarsening(20, across=30) == ((1.5, 2), (2.4, 4))
    assert usual_coarsening(6, across=30) == ((1.5, 1), (2.4, 1))


def test_every_second_time_keeps_the_stops():
    times = _every_second(np.arange(10.0), stops=np.array([0.0, 4.0]))
    assert times.tolist() == [0.0, 1.0, 4.0, 5.0, 7.0, 9.0]


def test_first_steps_are_those_behind_jumps():
    begins, durations = first_steps(np.array([0.0, 1.0, 3.0]), jumps=np.array([1.0, 3.0]))
    assert (begins.tolist(), durations.tolist()) == ([1.0], [2.0])
    parts = parts_of_first_steps(np.array([0.0, 1.0, 2.0]), jumps=np.array([1.0]))
    progression = [1.001, 1.002, 1.004, 1.007, 1.012, 1.023, 1.043, 1.081, 1.152, 1.285, 1.534, 2.0]
    assert parts == close_to(progression, abs=5e-4)


def test_steps_that_are_shared_are_divided():
    others, own = np.array([0.0, 1.0, 9.0, 12.0, 15.0]), np.array([0.0, 9.0, 15.0])
    assert parts_of_shared_steps(others, own).tolist() == [2.25, 4.5]


def test_coarser_grid_starts_alike_along_the_motion():
    fine, coarse = vc.Grid((8, 8), (8.0, 8.0)), vc.Grid((6, 6), (12.0, 12.0))
    assert aligned_along(coarse, fine, vc.Travel([0, 1], y=[0.5, 3.0])).centre == (0.0, -0.5)


def test_steps_of_a_moving_body_pass_more_cells():
    path = vc.Travel([0, 6], y=[0, 6.0])
    grid = vc.Grid((9, 9), (9.0, 9.0))
    times = fewer_moving_times(np.arange(7.0), path.kinks, path, grid, 3)
    assert times.tolist() == [0.0, 3.0, 6.0]
