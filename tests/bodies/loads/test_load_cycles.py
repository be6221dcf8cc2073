"""Cycles from valley to valley, kinks that are none, and classes of the user's own."""

import math

import numpy as np
import pytest

from bodies.loads.load_cycles import CYCLE, EPS
from closeness import close_to
from saturating_force import SaturatingForce
from viscontact.bodies.loads import harmonic
from viscontact.bodies.loads.largest_load import largest_load
from viscontact.loads import ApproachHistory, ForceHistory, LoadPoint, ramp, step, triangle

# -- classes of the user's own ---------------------------------------------------------------


def test_a_load_without_eccentricity_and_tilt_is_central_and_free_to_tilt():
    load = SaturatingForce(10.0, 2.0)
    level = 10 * (1 - math.exp(-1.5))
    assert load.at(3.0) == LoadPoint(close_to(level, rel=4 * EPS), 0.0, 0.0, None, None)
    assert load.is_even(0)
    assert load.is_even(1)


def test_a_curved_load_is_largest_at_its_crest():
    class Bump(SaturatingForce):
        """W_inf sin²(pi t/(12 T)): its crest is between the kinks, after more than 128 steps."""

        def level_at(self, times, *, side="right"):
            reached = np.clip(times, 0.0, self.kinks[-1])
            return self.largest_level * np.sin(np.pi * reached / self.kinks[-1]) ** 2

    time, point = largest_load(Bump(10.0, 2.0), end=24.0)
    assert time == close_to(12.0)
    assert point.force == close_to(10.0)


# -- cycles ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("load", "cycles"),
    [
        (triangle(5.0, 1.0, 2.0), [((0, "right"), (3, "left"))]),
        (ramp(5.0, 1.0), []),
        (step(5.0), []),
        (CYCLE, [((0, "right"), (5, "left"))]),  # a fall in two stages is one fall
        (ForceHistory([0, 2, 2], [5, 5, 0]), [((0, "left"), (2, "right"))]),
        (ForceHistory([0, 1, 2], [0, 5, 1]), []),  # what is left is not lost
        (
            ForceHistory([1, 2, 3, 4, 5, 6, 7, 8], [0, 5, 1, 1, 5, 1, 5, 0]),
            [((3, "left"), (6, "left"))],
        ),
        # However far a stage is withdrawn, it is apart.
        (ApproachHistory([0, 1, 2], [0, 2, -3]), [((0, "right"), (2, "left"))]),
        (harmonic(5.0, 1.0, 2.0, 2), [((0, "right"), (2, "right")), ((2, "right"), (4, "right"))]),
    ],
)
def test_a_cycle_lasts_from_valley_to_valley_of_one_level(load, cycles):
    assert list(load.load_cycles) == cycles


def test_points_on_a_straight_line_are_no_kinks():
    """A ramp by its ends, by points on it, and by a row of a table at each of many instants."""
    corners, forces = [0.0, 2.0, 4.0], [0.0, 0.05, 0.05]
    for times in ([0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0], np.linspace(0.0, 4.0, 41)):
        load = ForceHistory(times, np.interp(times, corners, forces))
        assert load.kinks.tolist() == corners
        assert load.at(0.7).force == close_to(0.7 * 0.025, rel=1e-15)


def test_points_where_only_the_place_of_the_force_or_a_tilt_bends_are_kinks():
    times, level = [0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 3.0]
    assert ForceHistory(times, level, [0.0, 1e-3, 2e-3, 3e-3]).kinks.tolist() == [0.0, 3.0]
    assert ForceHistory(times, level, [0.0, 1e-3, 1e-3, 1e-3]).kinks.tolist() == [0.0, 1.0, 3.0]
    tilted = ForceHistory(times, level, tilt_x=[0.0, 0.0, 1e-4, 2e-4])
    assert tilted.kinks.tolist() == [0.0, 1.0, 3.0]


def test_a_jump_between_equal_slopes_remains_one():
    load = ForceHistory([0.0, 1.0, 1.0, 2.0], [1.0, 1.0, 2.0, 2.0])
    assert load.kinks.tolist() == [0.0, 1.0, 2.0]
    assert load.jumps.tolist() == [0.0, 1.0]


def test_least_force_of_loads_that_pull():
    history = ForceHistory([0, 1, 2], [0, -5, 3])
    assert history.least_force == -5.0
    assert history.force_at([0.5, 1.0]).tolist() == [-2.5, -5.0]
    assert harmonic(mean=1.0, amplitude=3.0, period=1.0, cycles=1).least_force == -2.0
    assert harmonic(approach=1e-6, amplitude=3e-6, period=1.0, cycles=1).least_force == 0.0
    assert ApproachHistory([0, 1], [0, -1e-6]).least_force == 0.0
    # Rounding of either sign is no force.
    assert ForceHistory([0, 1, 2], [-2, 0, 1e-13]).force_at(2.0) == 0.0
