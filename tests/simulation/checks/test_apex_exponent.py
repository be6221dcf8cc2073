"""Exponent of the gap around the largest pressure."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.simulation.checks.singularities import apex_exponent

GRID, MIDDLE = vc.Grid((21, 21), (21.0, 21.0)), (10, 10)


def power(exponent: float, aside: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    r = np.hypot(GRID.x[:, None] - aside[0], GRID.y[None, :] - aside[1])
    return r**exponent


@pytest.mark.parametrize("exponent", [1.1, 1.3, 1.5, 1.8])
def test_exponent_of_an_apex_in_a_centre_is_that_of_the_gap(exponent: float) -> None:
    assert apex_exponent(power(exponent), GRID, MIDDLE) == close_to(exponent, rel=1e-9)


@pytest.mark.parametrize("exponent", [1.1, 1.3, 1.5, 1.8])
def test_exponent_of_an_apex_between_centres_is_somewhat_larger(exponent: float) -> None:
    found = apex_exponent(power(exponent, (0.5, 0.5)), GRID, MIDDLE)
    assert exponent < found < exponent + 0.3


@pytest.mark.parametrize("exponent", [2.0, 3.0, 5.0])
def test_no_tilt_and_no_place_makes_a_smooth_body_an_apex(exponent: float) -> None:
    for aside in ((0.0, 0.0), (0.5, 0.2), (-0.3, 0.4)):
        tilted = power(exponent, aside) + 0.3 * GRID.x[:, None]
        assert apex_exponent(tilted, GRID, MIDDLE) == close_to(2.0, rel=1e-9)


def test_crest_of_a_wave_and_a_rounded_cone_are_smooth() -> None:
    wave = 1 - np.cos(2 * np.pi * GRID.x / 25)[:, None] * np.ones(21)
    r = np.hypot(GRID.x[:, None], GRID.y[None, :])
    rounded = np.where(r < 2.5, r**2 / 5, r - 1.25)
    for gap in (wave, rounded):
        assert apex_exponent(gap, GRID, MIDDLE) == 2.0


@pytest.mark.parametrize("crown", [0.0, 0.01])
@pytest.mark.parametrize("start", [-0.5, 0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 2.5])
def test_rounded_edge_of_a_flat_body_is_no_apex(start: float, crown: float) -> None:
    flat = np.maximum(GRID.x + start, 0.0)[:, None] ** 2 * np.ones(21)
    assert apex_exponent(flat + crown * GRID.x[:, None] ** 2, GRID, MIDDLE) == 2.0


def test_exponent_is_unknown_at_the_border_of_the_grid_and_at_the_end_of_a_body() -> None:
    along_y = apex_exponent(power(1.3, (-8.0, 0.0)), GRID, (2, 10))
    assert along_y == close_to(1.3, rel=1e-9)
    assert apex_exponent(power(1.3, (-8.0, -8.0)), GRID, (2, 2)) == 2.0
    ended = np.where(power(1.0) < 3.5, power(1.3), np.inf)
    assert apex_exponent(ended, GRID, MIDDLE) == 2.0
