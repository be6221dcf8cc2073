"""Steps chosen by their error: what they hit, how they grow, and what they refuse."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.bodies.loads import harmonic
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.loads import ApproachHistory, ForceHistory, ramp, step
from viscontact.mechanics.time_integration.adaptive_steps import AdaptiveSteps
from viscontact.mechanics.time_integration.fixed_steps import FixedSteps, plan_steps
from viscontact.mechanics.time_integration.load_stretches import stretch_at
from viscontact.mechanics.time_integration.requested_times import adaptive_times

KELVIN = SeriesCompliance(1.0, [1.0], [2.0])


def walk(steps, error_of=lambda each: 0.0):
    """Take all steps, each with an error by its duration; how many were refused, too."""
    taken, refused = [], 0
    while (each := steps.next_step()) is not None:
        if steps.accept_step(error_of(each)):
            taken.append(each)
        else:
            refused += 1
        assert refused + len(taken) < 10_000
    return taken, refused


def cubic(each, scale=1.0):
    """The error of a second-order rule over one step."""
    return scale * each.duration**3


@given(
    st.lists(st.floats(0.01, 9.9), max_size=5),
    st.lists(st.floats(0.0, 12.0), min_size=1, max_size=6, unique=True),
    st.sampled_from([0.0, 1e-3, 1.0, 1e3]),
)
def test_stops_kinks_and_end_are_all_hit_and_no_step_is_longer_than_asked(stops, knots, scale):
    load = ForceHistory(sorted(knots), np.arange(1.0, len(knots) + 1))
    steps = AdaptiveSteps(adaptive_times(10.0, 1e-2), np.array(stops), load, KELVIN)
    taken, _ = walk(steps, lambda each: cubic(each, scale))
    ends = {each.time for each in taken}
    assert {*stops, 10.0, *(kink for kink in load.kinks.tolist() if kink < 10)} <= ends
    assert sum(each.duration for each in taken) == close_to(10.0)
    assert taken[-1].time == 10.0
    assert all(scale * each.duration**3 <= 0.2 * 1e-2 * (1 + 1e-9) for each in taken)
    shown = [each.requested for each in taken if each.requested is not None]
    assert shown == sorted(set(shown))


def test_a_jump_is_two_steps_of_which_the_second_is_shown():
    load = ForceHistory([0, 2, 2], [1.0, 1.0, 5.0])
    taken, _ = walk(AdaptiveSteps(adaptive_times(4.0, 1e-2), np.zeros(0), load, KELVIN))
    at_jump = [each for each in taken if each.time == 2.0]
    assert [(each.is_jump, each.side, each.requested) for each in at_jump] == [
        (False, "left", None),
        (True, "right", 2.0),
    ]
    after = taken[taken.index(at_jump[1]) + 1]
    assert not after.smooth


def test_steps_grow_under_creep_in_log_time_and_a_decade_costs_a_fixed_number():
    # A pressure that falls as log t errs by d³ times its second derivative, 1/t².
    steps = AdaptiveSteps(adaptive_times(1e6, 1e-3), np.zeros(0), step(1.0), KELVIN)
    taken, _ = walk(steps, lambda each: 1e-2 * each.duration**3 / max(each.time, 1e-9) ** 3)
    ends = np.array([each.time for each in taken])
    in_decade = [((ends > 10.0**k) & (ends <= 10.0 ** (k + 1))).sum() for k in range(1, 5)]
    assert max(in_decade) - min(in_decade) <= 2
    assert max(in_decade) <= 15


def test_smaller_tolerance_takes_steps_by_its_cube_root():
    counts = [
        len(walk(AdaptiveSteps(adaptive_times(10.0, t), np.zeros(0), ramp(1.0, 10.0), KELVIN),
                 cubic)[0])
        for t in (1e-3, 1e-6)
    ]  # fmt: skip
    assert counts[1] / counts[0] == close_to(10.0, rel=0.2)


def test_a_refused_step_is_shortened_and_offered_again():
    steps = AdaptiveSteps(adaptive_times(10.0, 1e-3), np.zeros(0), ramp(1.0, 10.0), KELVIN)
    assert steps.accept_step(0.0)  # time 0
    first = steps.next_step()
    assert not steps.accept_step(1.0)
    again = steps.next_step()
    assert again.time - again.duration == first.time - first.duration
    assert again.duration == close_to(0.2 * first.duration)


@pytest.mark.parametrize("scale", [0.5, 1.0, 3.0, 20.0])
def test_the_last_two_steps_before_a_stop_are_equally_long(scale):
    steps = AdaptiveSteps(adaptive_times(10.0, 1e-2), np.array([3.7]), ramp(1.0, 10.0), KELVIN)
    taken, _ = walk(steps, lambda each: cubic(each, scale))
    last = next(k for k, each in enumerate(taken) if each.time == 3.7)
    assert taken[last].duration == close_to(taken[last - 1].duration, rel=1e-9)
    assert taken[-1].duration == close_to(taken[-2].duration, rel=1e-9)


def test_a_step_is_at_most_twice_as_long_as_the_one_before_also_after_a_stop():
    stops = np.array([3.7, 3.75])
    steps = AdaptiveSteps(adaptive_times(10.0, 1e-2), stops, ramp(1.0, 10.0), KELVIN)
    durations = np.array([each.duration for each in walk(steps)[0] if not each.is_jump])
    assert (durations[1:] / durations[:-1]).max() <= 2 * (1 + 1e-9)


def test_steps_and_their_number_go_on_after_a_restart_as_they_would_have():
    def begun():
        return AdaptiveSteps(adaptive_times(100.0, 1e-2), np.zeros(0), ramp(1.0, 100.0), KELVIN)

    steps = begun()
    for _ in range(9):
        steps.accept_step(0.5 * 0.2 * 1e-2)
    resumed = begun()
    resumed.restore(steps.restart_data())
    assert resumed.left == steps.left
    assert walk(resumed, cubic) == walk(steps, cubic)


def test_a_first_step_creeps_little():
    for compliance in (KELVIN, SeriesCompliance(1.0, [1.0], [2e-6])):
        steps = AdaptiveSteps(adaptive_times(10.0, 1e-3), np.zeros(0), step(1.0), compliance)
        assert steps.accept_step(0.0)
        duration = steps.next_step().duration
        assert compliance(duration) < 1.1 * compliance(0.0)


def test_steps_begin_small_where_bodies_come_to_touch():
    load = ApproachHistory([0.0, 10.0], [-1e-6, 1.5e-6])
    taken, _ = walk(AdaptiveSteps(adaptive_times(10.0, 1e-3), np.zeros(0), load, KELVIN))
    touch = next(k for k, each in enumerate(taken) if each.time == close_to(4.0, rel=1e-14))
    assert KELVIN(taken[touch + 1].duration) < 1.1 * KELVIN(0.0)
    assert taken[touch].duration > 10 * taken[touch + 1].duration


def test_a_swinging_load_is_never_stepped_over():
    load = harmonic(2.0, 1.0, period=1.0, cycles=3)
    taken, _ = walk(AdaptiveSteps(adaptive_times(6.0, 0.1), np.zeros(0), load, KELVIN))
    assert max(each.duration for each in taken if each.time <= 3.0) <= 1 / 128 * (1 + 1e-9)
    assert {1.0, 2.0, 3.0} <= {each.time for each in taken}


def test_what_is_left_is_predicted_within_a_factor_of_two_under_steady_growth():
    steps = AdaptiveSteps(adaptive_times(1e4, 1e-3), np.zeros(0), step(1.0), KELVIN)
    predicted, taken = [], 0
    while (each := steps.next_step()) is not None:
        if steps.accept_step(1e-2 * each.duration**3 / max(each.time, 1e-9) ** 3):
            taken += 1
            predicted.append(taken + steps.left)
    half = predicted[len(predicted) // 2 :]
    assert all(0.5 <= total / taken <= 2 for total in half)
    assert steps.left == 0


@pytest.mark.parametrize("tolerance", [0.0, -1e-3, 1.0, math.nan, "1 %", None, True])
def test_bad_tolerance_is_refused(tolerance):
    with pytest.raises(ValueError, match=r"tolerance must lie between 1e-6 and 0\.1"):
        adaptive_times(10.0, tolerance)


def test_fixed_steps_are_taken_whatever_error_they_make():
    steps = FixedSteps(plan_steps(np.array([0.0, 1.0, 2.0]), step(1.0)))
    taken, refused = walk(steps, lambda each: 1e9)
    assert [each.time for each in taken] == [0.0, 1.0, 2.0]
    assert refused == 0


@pytest.mark.parametrize("power", [30, -30])
def test_unit_of_time_changes_no_step(power):
    """Times scaled by a power of two have the same bits (IEEE 754)."""

    def ends(scale: float) -> list[float]:
        creep = SeriesCompliance(1.0, [1.0], [2.0 * scale])
        load = ramp(1.0, 3.0 * scale)
        steps = AdaptiveSteps(adaptive_times(10.0 * scale, 1e-3), np.zeros(0), load, creep)
        taken, _ = walk(steps, lambda each: cubic(each, 1e-3 / scale**3))
        return [each.time / scale for each in taken]

    assert ends(2.0**power) == ends(1.0)


def test_stretches_lie_between_kinks_and_are_cycles_of_a_curved_load():
    load = ApproachHistory([0.0, 1.0, 100.0, 101.0], [0.0, 1e-6, 1e-6, -1e-6])
    ends = [(0.0, 1.0), (0.5, 1.0), (1.0, 99.0), (100.0, 1.0), (100.9, 1.0)]
    assert [stretch_at(load, time, 200.0) for time, _ in ends] == close_to(
        [length for _, length in ends]
    )
    assert stretch_at(load, 100.0, 100.5) == close_to(0.5)
    cycles = harmonic(2.0, 0.5, 0.25, 100)
    assert 0.1 < stretch_at(cycles, 3.0, 25.0) < 0.5


def test_a_jump_of_the_contact_takes_a_part_of_its_stretch_after_a_long_rest():
    load = ApproachHistory([0.0, 1000.0, 1001.0], [1e-6, 1e-6, -1e-6])
    steps = AdaptiveSteps(adaptive_times(1001.0, 1e-3), np.zeros(0), load, KELVIN, jumps_in=1e-5)
    shortest = 0.0
    while (each := steps.next_step()) is not None:
        passes = each.time - each.duration < 1000.5 < each.time
        shortest = each.duration if passes and each.is_shortest else shortest
        steps.accept_step(0.0, math.inf if passes and not each.is_shortest else 0.0)
    assert 1e-6 < shortest <= 1e-5


def test_a_step_is_repeated_with_a_duration_at_most():
    steps = AdaptiveSteps(adaptive_times(10.0, 1e-3), np.zeros(0), ramp(1.0, 10.0), KELVIN)
    steps.accept_step(0.0)
    first = steps.next_step()
    steps.repeat_shorter(math.inf, 0.3 * first.duration)
    assert steps.next_step().duration == close_to(0.3 * first.duration)
    steps.repeat_shorter(1.7, math.inf)
    assert steps.next_step().duration == close_to(0.15 * first.duration)


def test_steps_close_in_on_a_time_at_which_no_near_state_was_found():
    load = ApproachHistory([0.0, 1.0], [1e-6, -1e-6])
    steps = AdaptiveSteps(adaptive_times(1.0, 1e-3), np.zeros(0), load, KELVIN, jumps_in=1e-5)
    steps.accept_step(0.0)
    while steps.next_step().time < 0.2:
        steps.accept_step(0.0, 0.5)
    lost = steps.next_step().time
    steps.repeat_shorter(math.inf, math.inf)
    for _ in range(30):  # the state ends at 0.19
        step = steps.next_step()
        if step.time > 0.19 and step.is_shortest:
            break
        if step.time > 0.19:
            steps.repeat_shorter(math.inf, math.inf)
            lost = step.time
            continue
        assert step.time < lost
        steps.accept_step(0.0, 0.7)
    assert 0.19 < step.time < 0.19 + 2e-5


def test_a_jump_that_is_not_solved_is_tried_sooner_a_few_times():
    load = ApproachHistory([0.0, 1.0], [1e-6, -1e-6])
    steps = AdaptiveSteps(adaptive_times(1.0, 1e-3), np.zeros(0), load, KELVIN, jumps_in=1e-5)
    steps.accept_step(0.0)
    while not steps.next_step().is_shortest:
        steps.accept_step(0.0, math.inf)
    begin, durations = steps.next_step().duration, []
    while steps.repeat_sooner():
        durations.append(steps.next_step().duration)
    assert durations == close_to([begin * 0.3**k for k in range(1, len(durations) + 1)], rel=1e-6)
    assert 1 <= len(durations) <= 5
    without = AdaptiveSteps(adaptive_times(1.0, 1e-3), np.zeros(0), load, KELVIN)
    without.accept_step(0.0)
    assert not without.repeat_sooner()


def test_a_way_somewhat_longer_than_a_step_by_the_change_of_the_force_is_one_step():
    load, stops = ApproachHistory([0.0, 1.0], [1e-6, -1e-6]), np.linspace(0.1, 1.0, 10)

    def taken(**options):
        steps = AdaptiveSteps(adaptive_times(1.0, 1e-3), stops, load, KELVIN, **options)
        # The change by which steps of 0.09 are proposed.
        found = []
        while (each := steps.next_step()) is not None:
            if steps.accept_step(0.0, 0.85 * each.duration / 0.09):
                found.append(each.duration)
        return found[-8:]

    assert taken(jumps_in=1e-5, stretched=1.2) == close_to([0.1] * 8)
    assert taken() == close_to([0.05] * 8)


def test_a_refused_step_is_shortened_though_the_way_is_somewhat_longer():
    load = ApproachHistory([0.0, 1.0], [1e-6, -1e-6])
    options = {"jumps_in": 1e-5, "stretched": 1.4}
    steps = AdaptiveSteps(adaptive_times(1.0, 1e-3), np.zeros(0), load, KELVIN, **options)
    steps.accept_step(0.0)
    for _ in range(12):
        before = steps.next_step().duration
        steps.repeat_shorter(1.01, math.inf)
        assert steps.next_step().duration < 0.85 * before


def test_steps_close_in_on_where_the_force_begins_to_change():
    load = ApproachHistory([0.0, 1.0], [1e-6, -1e-6])
    steps = AdaptiveSteps(adaptive_times(1.0, 1e-3), np.zeros(0), load, KELVIN, jumps_in=1e-5)
    begins, allowed = 0.4321, 2e-3  # where, and the longest step that passes it
    refused = 0
    while (each := steps.next_step()).time - each.duration < begins:
        change = each.duration / allowed if each.time > begins else 0.3
        if change > 1:
            refused += 1
            steps.repeat_shorter(change, math.inf)
        else:
            steps.accept_step(0.0, change)
    assert refused <= 5  # 10 where steps grow on
    restored = AdaptiveSteps(adaptive_times(1.0, 1e-3), np.zeros(0), load, KELVIN, jumps_in=1e-5)
    restored.restore(steps.restart_data())
    assert restored.next_step() == each
