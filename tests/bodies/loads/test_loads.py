"""Load histories: values by hand, both sides of a jump, kinks, and what is refused."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bodies.loads.load_cycles import CYCLE, EPS, SWING, histories
from closeness import close_to
from viscontact.bodies.loads import harmonic
from viscontact.loads import ApproachHistory, ForceHistory, LoadPoint, ramp, step, triangle

# -- values ----------------------------------------------------------------------------------


def test_force_is_linear_between_points_and_held_after_the_last():
    held = ForceHistory([0, 2, 4], [0, 8, 4])
    assert held.force_at([0, 0.5, 2, 3, 4, 1e9]).tolist() == [0, 2, 8, 6, 4, 4]


def test_force_is_zero_before_the_first_point():
    late = ForceHistory([2, 3], [5, 5])
    assert late.force_at([0.0, 1.999, 2.0]).tolist() == [0, 0, 5]
    assert late.force_at([2.0], side="left").tolist() == [0]


def test_a_repeated_time_has_a_value_on_either_side():
    assert CYCLE.force_at([3.0], side="left").tolist() == [10]
    assert CYCLE.force_at([3.0], side="right").tolist() == [4]
    assert CYCLE.force_at([2.9, 3.1]) == close_to([10, 3.8], rel=4 * EPS)


@given(history=histories(), time=st.floats(0, 40))
def test_force_stays_between_its_neighbours_and_agrees_with_numpy_away_from_jumps(history, time):
    left, right = (float(history.force_at(time, side=side)) for side in ("left", "right"))
    assert min(left, right) >= 0
    assert max(left, right) <= history.largest_force
    if time in history.jumps:
        assert left != right
    elif time >= history.times[0] and time not in history.times:
        # NumPy interpolates by another formula; what is negligible counts as zero here.
        slack = 4 * EPS * history.largest_force + 1e-12 * history.largest_force
        assert right == left == close_to(np.interp(time, history.times, history.force), abs=slack)


@given(history=histories())
def test_points_come_out_exactly(history):
    first_of_pair = np.searchsorted(history.times, history.times, side="left")
    last_of_pair = np.searchsorted(history.times, history.times, side="right") - 1
    seen = np.where(history.force < 1e-12 * history.largest_force, 0, history.force)
    before = np.where(history.times > history.times[0], seen[first_of_pair], 0)
    assert history.force_at(history.times, side="left").tolist() == before.tolist()
    assert history.force_at(history.times).tolist() == seen[last_of_pair].tolist()


def test_a_constant_force_is_constant_to_the_last_digit():
    third = 1 / 3
    held = ForceHistory([0.1, 0.7], [third, third])
    assert set(held.force_at(np.linspace(0.1, 0.7, 101)).tolist()) == {third}


def test_negligible_force_is_exactly_zero():
    tail = ForceHistory([0, 1, 2, 3], [1e4, 0.9e-8, 1.1e-8, 0])
    assert tail.force_at([1.0, 2.0]).tolist() == [0.0, 1.1e-8]
    assert tail.at(1.0).force == 0.0


def test_all_that_is_prescribed_is_given_at_an_instant():
    history = ForceHistory([0, 2], [0, 10], eccentricity_x=[0, 4e-3], tilt_y=[1e-3, 3e-3])
    assert history.at(1.0) == LoadPoint(
        force=5.0, eccentricity_x=2e-3, eccentricity_y=0.0, tilt_x=None, tilt_y=2e-3
    )
    assert history.at(9.0).eccentricity_x == 4e-3
    with pytest.raises(dataclasses.FrozenInstanceError):
        history.at(1.0).force = 1.0


def test_eccentricity_and_tilt_jump_with_their_points():
    history = ForceHistory([0, 1, 1], 5.0, eccentricity_x=[1e-3, 1e-3, -2e-3], tilt_y=[0, 0, 1e-3])
    before, after = history.at(1.0, side="left"), history.at(1.0)
    assert (before.eccentricity_x, before.tilt_y) == (1e-3, 0.0)
    assert (after.eccentricity_x, after.tilt_y) == (-2e-3, 1e-3)


def test_after_the_last_point_all_that_is_prescribed_is_held_there():
    history = ForceHistory(
        [0, 1, 1], [0, 4, 5], eccentricity_x=[0, 1e-3, 2e-3], tilt_y=[0, 0, 1e-4]
    )
    for side in ("left", "right"):
        assert history.at(7.0, side=side) == history.at(1.0)
    assert history.at(1.0, side="left").force == 4
    with pytest.raises(ValueError, match="side must be"):
        history.at(7.0, side="middle")


def test_before_the_first_point_tilt_and_eccentricity_have_their_first_values():
    late = ForceHistory([2, 3], 5.0, eccentricity_y=[1e-3, 2e-3], tilt_x=[1e-4, 2e-4])
    assert late.at(0.0) == LoadPoint(0.0, 0.0, 1e-3, 1e-4, None)


# -- kinks and jumps -------------------------------------------------------------------------


def test_kinks_are_the_distinct_instants_of_the_points():
    assert CYCLE.kinks.tolist() == [0, 1, 3, 5]


def test_jumps_are_where_the_two_sides_differ():
    assert CYCLE.jumps.tolist() == [3]
    assert step(5.0).jumps.tolist() == [0]
    assert ForceHistory([2, 3], 5.0).jumps.tolist() == [2]
    assert ramp(5.0, 1.0).jumps.tolist() == []
    assert ForceHistory([0, 1, 1, 2], [0, 5, 5, 0]).jumps.tolist() == []


@pytest.mark.parametrize("name", ["eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y"])
def test_eccentricity_and_tilt_jump_only_under_load(name):
    values = [0, 0, 1e-3, 1e-3]
    assert ForceHistory([0, 1, 1, 2], [0, 5, 5, 5], **{name: values}).jumps.tolist() == [1]
    assert ForceHistory([0, 1, 1, 2], [0, 0, 0, 5], **{name: values}).jumps.tolist() == []


def test_a_tilt_jumps_under_a_stage_that_only_its_tilt_brings_into_contact():
    """The middle stays 1 um above the surface; an end may touch, for all the history knows."""
    tilts = [0, 0, 1e-3, 1e-3]
    assert ApproachHistory([0, 1, 1, 2], [-1e-6] * 4, tilt_x=tilts).jumps.tolist() == [1]
    assert ApproachHistory([0, 1, 1, 2], [-1e-6, -1e-6, -2e-6, -2e-6]).jumps.tolist() == []


def test_a_cycle_ends_at_a_valley_that_is_as_low_up_to_rounding():
    assert 0.1 + 0.2 > 0.3
    load = ForceHistory([0, 1, 2, 3, 4, 5], [0.0, 1.0, 0.3, 1.0, 0.1 + 0.2, 1.0])
    assert [(begin[0], end[0]) for begin, end in load.load_cycles] == [(2.0, 4.0)]


def test_largest_force_may_stand_on_the_left_of_a_jump():
    assert ForceHistory([0, 1, 1], [0, 9, 2]).largest_force == 9.0


# -- the usual histories ---------------------------------------------------------------------


def test_step_is_there_at_time_0_and_held():
    assert step(10e3).force_at([0.0, 1.0, 1e6]).tolist() == [10e3] * 3
    assert step(10e3).at(0.0, side="left").force == 0.0


def test_ramp_grows_then_holds():
    assert ramp(10.0, 4.0).force_at([0, 1, 4, 5]).tolist() == [0, 2.5, 10, 10]


def test_triangle_comes_back_to_zero_and_falls_as_it_rises_by_default():
    assert triangle(10.0, 2.0).force_at([0, 1, 2, 3, 4, 5]).tolist() == [0, 5, 10, 5, 0, 0]
    assert triangle(10.0, 2.0, 4.0).force_at([2, 4, 6]).tolist() == [10, 5, 0]


@pytest.mark.parametrize(
    "make",
    [
        lambda **tail: step(6.0, **tail),
        lambda **tail: ramp(6.0, 1.0, **tail),
        lambda **tail: triangle(6.0, 1.0, **tail),
    ],
)
def test_usual_histories_pass_on_eccentricity_and_tilt(make):
    assert make(eccentricity_x=1e-3, tilt_y=2e-3).at(1.0) == LoadPoint(6.0, 1e-3, 0.0, None, 2e-3)
    assert make(eccentricity_y=1e-3, tilt_x=2e-3).at(1.0) == LoadPoint(6.0, 0.0, 1e-3, 2e-3, None)


# -- as an object ---------------------------------------------------------------------------


def test_history_is_frozen_copied_and_read_only():
    force = np.array([0.0, 1.0])
    history = ForceHistory([0, 1], force)
    force[1] = 7.0
    assert history.largest_force == 1.0
    with pytest.raises(ValueError, match="read-only"):
        history.force[1] = 7.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        history.force = force


@given(history=histories())
def test_history_is_rebuilt_from_its_fields(history):
    fields = {field.name: getattr(history, field.name) for field in dataclasses.fields(history)}
    again = ForceHistory(**fields)
    assert again == history
    assert hash(again) == hash(history)


def test_histories_differ_when_any_field_does():
    assert step(5.0) == ForceHistory([0.0], [5.0])
    assert step(5.0) != step(6.0)
    assert step(5.0) != step(5.0, tilt_x=0.0)
    assert step(5.0) != 5.0


# -- refusals --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([], "times must be a list of at least one instant"),
        (1.0, "times must be a list of at least one instant"),
        ([-1, 0], "times must start at 0 s or later, got -1"),
        ([0, 2, 1], "times must not decrease, got 2.0 s followed by 1.0 s"),
        ([0, 1, 1, 1], "more than twice, got 1.0 s three times"),
        ([0, math.nan], "times must be finite, got nan"),
        ([0, math.inf], "times must be finite, got inf"),
        (["0 s", "1 s"], "times must be numbers in s"),
        ([False, True], "times must be numbers in s"),
        ([[0, 1], [2]], "times must be numbers in s"),
    ],
)
def test_bad_times_are_refused(times, message):
    with pytest.raises(ValueError, match=message):
        ForceHistory(times, 1.0)


@pytest.mark.parametrize(
    ("force", "message"),
    [
        ([0, math.nan], "force must be finite, got nan"),
        ([0, 1, 2], r"force must be a scalar or have one value for each of the 2 times.*\(3,\)"),
        ("10 N", "force must be numbers in N"),
        ([0, None], "force must be numbers in N"),
    ],
)
def test_bad_forces_are_refused(force, message):
    with pytest.raises(ValueError, match=message):
        ForceHistory([0, 1], force)


@pytest.mark.parametrize("name", ["eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y"])
@pytest.mark.parametrize("bad", [math.nan, [0.0, math.inf], [1.0], "1 mm", True, [[0, 0], [0, 0]]])
def test_bad_eccentricities_and_tilts_are_refused(name, bad):
    with pytest.raises(ValueError, match=f"^{name} must be"):
        ForceHistory([0, 1], 1.0, **{name: bad})


@pytest.mark.parametrize("axis", ["x", "y"])
def test_tilt_and_eccentricity_along_one_axis_contradict_each_other(axis):
    with pytest.raises(ValueError, match=f"tilt_{axis} and eccentricity_{axis} contradict"):
        step(1.0, **{f"eccentricity_{axis}": 1e-3, f"tilt_{axis}": 0.0})
    assert step(1.0, **{f"eccentricity_{axis}": 0.0, f"tilt_{axis}": 0.0}).largest_force == 1.0


@pytest.mark.parametrize("make", [step, ramp, triangle])
def test_force_and_approach_together_are_refused(make):
    with pytest.raises(ValueError, match=r"given twice; give force= in N or approach= in m"):
        make(1.0, approach=1e-4)


@pytest.mark.parametrize(
    ("make", "arguments"),
    [(step, {}), (ramp, {"duration": 1.0}), (triangle, {"rise": 1.0}), (harmonic, SWING)],
)
def test_an_eccentricity_does_not_go_with_an_approach(make, arguments):
    with pytest.raises(ValueError, match="eccentricity_y goes with a force"):
        make(approach=1e-4, eccentricity_y=1e-3, **arguments)


@pytest.mark.parametrize("make", [step, ramp, triangle])
def test_missing_force_is_named(make):
    with pytest.raises(ValueError, match=f"{make.__name__}: force is missing"):
        make()


@pytest.mark.parametrize("force", [math.nan, math.inf, "10 kN", True, [1.0, 2.0]])
def test_bad_force_of_a_step_is_refused(force):
    with pytest.raises(ValueError, match="force must be"):
        step(force)


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, "1 s", True])
def test_bad_durations_are_refused_with_their_name(bad):
    with pytest.raises(ValueError, match="ramp: duration must be"):
        ramp(1.0, bad)
    with pytest.raises(ValueError, match="triangle: rise must be"):
        triangle(1.0, bad)
    with pytest.raises(ValueError, match="triangle: fall must be"):
        triangle(1.0, 1.0, bad)


def test_missing_durations_are_named():
    with pytest.raises(ValueError, match="ramp: duration"):
        ramp(1.0)
    with pytest.raises(ValueError, match="triangle: rise"):
        triangle(1.0)


def test_side_is_left_or_right():
    with pytest.raises(ValueError, match=r"side must be .* got 'before'"):
        CYCLE.at(1.0, side="before")


@pytest.mark.parametrize("time", [math.nan, "1 s", True, None])
def test_instant_must_be_a_number(time):
    with pytest.raises(ValueError, match="time must be a finite number in s"):
        CYCLE.at(time)
    with pytest.raises(ValueError, match="times must be"):
        CYCLE.force_at(time)
