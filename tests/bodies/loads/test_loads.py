"""Load histories: values by hand, both sides of a jump, and what is refused."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from saturating_force import SaturatingForce
from viscontact.bodies.loads import harmonic
from viscontact.bodies.loads.largest_load import largest_load
from viscontact.loads import ApproachHistory, ForceHistory, LoadPoint, ramp, step, triangle

EPS = np.finfo(float).eps

# Up to 10 N in 1 s, held to 3 s, dropped to 4 N at once, taken off by 5 s.
CYCLE = ForceHistory(times=[0, 1, 3, 3, 5], force=[0, 10, 10, 4, 0])
SWING = {"amplitude": 5e-5, "period": 2.0, "cycles": 3}


@st.composite
def histories(draw):
    """Histories of any shape: some points at the same instant, some forces zero."""
    gaps = draw(st.lists(st.sampled_from([0.0, 0.1, 1.0, 7.3]), max_size=7))
    times = np.cumsum([draw(st.floats(0, 5)), *gaps])
    once_or_twice = [i for i in range(times.size) if i < 2 or times[i] > times[i - 2]]
    times = times[once_or_twice]
    force = draw(st.lists(st.floats(0, 1e5), min_size=times.size, max_size=times.size))
    return ForceHistory(times, force)


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


# -- approach control ------------------------------------------------------------------------


def test_an_approach_is_prescribed_and_the_force_left_open():
    stage = ApproachHistory([0, 1, 1, 3], [0, 2e-6, -1e-6, 3e-6], tilt_y=None)
    assert stage.at(0.5) == LoadPoint(None, 0.0, 0.0, 0.0, None, approach=1e-6)
    assert stage.approach_at([1.0], side="left").tolist() == [2e-6]
    assert stage.approach_at([1.0, 2.0, 9.0]) == close_to([-1e-6, 1e-6, 3e-6])
    assert stage.largest_level == 3e-6
    assert (stage.kinks.tolist(), stage.jumps.tolist()) == ([0, 1, 3], [1])


def test_before_its_first_point_a_stage_does_not_press():
    assert ApproachHistory([1.0], [2e-6]).approach_at([0.0, 1.0]).tolist() == [0.0, 2e-6]
    assert ApproachHistory([1.0], [-2e-6]).approach_at([0.0, 1.0]).tolist() == [-2e-6, -2e-6]
    assert ApproachHistory([1.0], [2e-6]).jumps.tolist() == [1.0]
    assert ApproachHistory([1.0], [-2e-6]).jumps.tolist() == []


@given(
    st.lists(st.floats(0.1, 7.3), min_size=3, max_size=6),
    st.lists(
        st.floats(-1e-5, 1e-5) | st.sampled_from([-1e-5, -3e-7, 2e-6]), min_size=7, max_size=7
    ),
)
def test_bodies_touch_where_the_approach_rises_through_zero(spans, levels):
    times = np.cumsum([0.0, *spans])
    stage = ApproachHistory(times, levels[: times.size])
    for touch in stage.touches:
        assert stage.approach_at(touch) <= 0
        assert stage.approach_at(touch * (1 + 1e-9)) > 0
    signs = np.sign(stage.approach)
    near_kink = np.abs(stage.approach).min(initial=1.0) < 1e-13
    assert near_kink or stage.touches.size == np.count_nonzero(np.diff(signs) == 2)


def test_bodies_touch_at_a_kink_or_jump_or_not_at_all():
    for approach in ([0, 1, 0, 2], [-1, 0, 1, 2], [-1, -1, -1, 1], [1, -1, -1, 0], [-1, -2, 0, 0]):
        assert ApproachHistory([0, 1, 2, 2], approach).touches.size == 0
    assert ramp(1.0, 2.0).touches.size == harmonic(1.0, 1.0, 2.0, 1).touches.size == 0
    assert ApproachHistory([0, 1], [-1, 1], tilt_y=[1e-3, 0]).touches.size == 0
    assert ApproachHistory([0, 1], [-1, 1], tilt_y=None).touches.size == 1
    # From 1e-12 of a step before a kink on.
    assert ApproachHistory([0, 1], [-1.0, 1e-12]).touches.size == 0


def test_usual_histories_prescribe_an_approach_as_well():
    assert step(approach=1e-6) == ApproachHistory([0.0], [1e-6], None, None)
    assert ramp(duration=2.0, approach=1e-6, tilt_x=1e-3).at(1.0) == LoadPoint(
        None, 0.0, 0.0, 1e-3, None, approach=5e-7
    )
    assert triangle(approach=1e-6, rise=1.0).approach_at([0.5, 1.5, 4.0]) == close_to(
        [5e-7, 5e-7, 0.0]
    )


@given(history=histories(), time=st.floats(0, 40))
def test_a_stage_that_follows_a_force_history_has_its_values(history, time):
    stage = ApproachHistory(history.times, history.force)
    for side in ("left", "right"):
        reached = float(stage.approach_at(time, side=side))
        slack = 1e-12 * history.largest_force
        assert reached == close_to(float(history.force_at(time, side=side)), abs=slack)


# -- harmonic loads --------------------------------------------------------------------------


@given(
    time=st.floats(0, 6),
    phase=st.floats(-7, 7),
    mean=st.floats(5, 9),
    amplitude=st.floats(-5, 5),
)
def test_harmonic_force_is_the_sine_it_says(time, phase, mean, amplitude):
    swing = harmonic(mean, amplitude, 2.0, 3, phase)
    exact = mean + amplitude * math.sin(math.pi * time + phase)
    assert float(swing.level_at(time)) == close_to(exact, abs=1e-12)
    assert swing.at(time).force == float(swing.level_at(time))


def test_harmonic_load_of_a_negative_amplitude_begins_downwards_and_is_as_large():
    load = harmonic(10.0, -4.0, period=1.0, cycles=3)
    assert load.level_at([0.25, 0.75]).tolist() == close_to([6.0, 14.0])
    assert load.largest_level == 14.0


def test_harmonic_load_is_held_after_its_cycles_and_jumps_to_its_first_level():
    swing = harmonic(10.0, 5.0, 2.0, 3, phase=math.pi / 2)
    assert swing.level_at([6.0, 99.0]).tolist() == [15.0, 15.0]
    assert float(swing.level_at(0.0, side="left")) == 0.0
    assert (swing.kinks.tolist(), swing.jumps.tolist()) == ([0.0, 6.0], [0.0])
    soft = harmonic(5.0, 5.0, 2.0, 3, phase=-math.pi / 2)
    assert soft.jumps.tolist() == []


def test_lines_over_the_longest_step_of_a_harmonic_load_miss_it_by_the_chord_of_an_arc():
    swing = harmonic(10.0, 5.0, 2.0, 3)
    fine = np.linspace(0, 6, 100_001)
    steps = np.arange(0, 6 + swing.longest_step / 2, swing.longest_step)
    line = np.interp(fine, steps, swing.level_at(steps))
    missed = np.abs(line - swing.level_at(fine)).max()
    # A chord over an angle h is off by 1 - cos(h/2) at the crest; those beside it by 1.2e-3 less.
    assert missed == close_to(5 * (1 - math.cos(math.pi / 128)), rel=2e-3)


def test_harmonic_force_that_is_rounding_is_no_load():
    # Near its trough mean - mean cos(a) is mean a²/2: 3e-13 of the largest force 1.2e-6 rad away.
    swing = harmonic(mean=3.0, amplitude=3.0, period=2.0, cycles=2, phase=-math.pi / 2)
    assert swing.level_at(2.0 * (1 + 1.2e-6 / (2 * math.pi))) == 0.0
    assert swing.level_at(2.0 * (1 + 1.2e-5 / (2 * math.pi))) > 0.0
    hardly = harmonic(mean=3.0, amplitude=3.0, period=2.0, cycles=2, phase=1.2e-6 - math.pi / 2)
    assert hardly.jumps.size == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"stage_stiffness": 1.0}, "stage_stiffness goes with a prescribed approach"),
        ({"cycles": 0}, "cycles must be a whole number from 1"),
        ({"cycles": 1.5}, "cycles must be a whole number from 1"),
        ({"period": 0.0}, "period must be a positive finite number"),
        ({"amplitude": math.nan}, "amplitude must be a finite number in N"),
        ({"mean": None}, "mean is missing; give mean= in N or approach= in m"),
        ({"eccentricity_x": 1.0, "tilt_x": 0.0}, "contradict each other"),
        ({"tilt_x": [1e-3]}, r"harmonic: tilt_x must be a finite number in rad"),
    ],
)
def test_bad_harmonic_loads_are_refused(arguments, message):
    good = {"mean": 10.0, "amplitude": 5.0, "period": 2.0, "cycles": 3}
    with pytest.raises(ValueError, match=message):
        harmonic(**{**good, **arguments})


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


@pytest.mark.parametrize("make", [step, ramp, triangle, harmonic])
def test_spring_of_a_stage_is_kept_and_goes_with_an_approach(make):
    own = {step: {}, ramp: {"duration": 1.0}, triangle: {"rise": 1.0}, harmonic: SWING}[make]
    assert make(approach=1e-6, **own).stage_stiffness is None
    assert make(approach=1e-6, **own, stage_stiffness=0.2).stage_stiffness == 0.2
    for bad in (0.0, -1.0, math.nan, "0.2 N/m"):
        with pytest.raises(ValueError, match="stage_stiffness must be"):
            make(approach=1e-6, **own, stage_stiffness=bad)
    level = {"mean": 1.0} if make is harmonic else {"force": 1.0}
    with pytest.raises(ValueError, match="stage_stiffness goes with a prescribed approach"):
        make(**level, **own, stage_stiffness=0.2)
