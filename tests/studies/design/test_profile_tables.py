"""Tables of free profiles, and the grid of their certified runs."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import LogarithmicProfile
from viscontact.studies.design.profiles.profile_runs import fine_grid
from viscontact.studies.design.profiles.tables import finite_table, rounded


def test_certified_runs_have_half_the_spacing_and_keep_an_odd_count_odd() -> None:
    assert fine_grid(Grid((108, 37), (1.0, 1.0))).shape == (216, 75)


def test_drops_have_five_digits() -> None:
    assert rounded(np.array([1.23456789e-6])).tolist() == [1.2346e-06]


def test_infinite_drops_at_the_ends_are_continued() -> None:
    line = finite_table(LogarithmicProfile(1.0), np.array([-1.0, -0.5, 0.0, 0.5, 1.0]), 1.0)
    assert line.round(3).tolist() == [0.863, 0.288, 0.0, 0.288, 0.863]
