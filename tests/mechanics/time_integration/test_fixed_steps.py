"""Every instant asked for is met once, and no kink or jump of the load is stepped over."""

from functools import cached_property
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads import harmonic
from viscontact.bodies.loads.clock import TIME, ReducedTime
from viscontact.loads import ApproachHistory, ForceHistory, ramp, step
from viscontact.mechanics.time_integration.fixed_steps import plan_steps

moments = st.lists(st.integers(0, 40), min_size=1, max_size=8, unique=True).map(
    lambda found: np.sort(np.array(found, dtype=float))
)
forces = st.lists(st.integers(0, 3), min_size=2, max_size=8)


@given(moments, forces, st.data())
def test_steps_tile_the_run_and_give_each_instant_asked_for_once(times, force, data):
    count = len(force)
    pool = st.integers(0, 40)
    knots = sorted(data.draw(st.lists(pool, min_size=count, max_size=count).filter(_two_at_most)))
    load = ForceHistory(np.array(knots, dtype=float), np.array(force, dtype=float) + 1.0)
    steps = plan_steps(times, load)
    assert steps[0].time == 0.0
    assert steps[0].is_jump
    assert sum(each.duration for each in steps) == close_to(times[-1])
    assert [each.requested for each in steps if each.requested is not None] == times.tolist()
    for before, after in pairwise(steps):
        assert after.time - before.time == after.duration >= 0
        # No kink inside a step, and the last step at an instant is the one that is shown.
        assert not ((load.kinks > before.time) & (load.kinks < after.time)).any()
        assert not (before.requested is not None and after.is_jump)


def _two_at_most(knots):
    return max(knots.count(knot) for knot in knots) <= 2


def test_a_jump_is_approached_and_then_taken():
    load = ForceHistory([0, 2, 2], [1.0, 1.0, 5.0])
    steps = plan_steps(np.array([0.0, 2.0, 3.0]), load)
    assert [(each.time, each.duration, each.requested) for each in steps] == [
        (0.0, 0.0, 0.0),
        (2.0, 2.0, None),
        (2.0, 0.0, 2.0),
        (3.0, 1.0, 3.0),
    ]
    assert [float(load.force_at(each.time, side=each.side)) for each in steps] == [1, 1, 5, 5]


def test_an_instant_that_misses_a_jump_by_rounding_is_just_after_it():
    """0.1 * 3 is 0.30000000000000004: a history typed one way, instants made another."""
    load = ForceHistory([0.0, 0.1 * 3, 0.1 * 3], [1.0, 1.0, 5.0])
    last = plan_steps(np.array([0.0, 0.3]), load)[-1]
    assert last.requested == 0.3
    assert float(load.force_at(last.time, side=last.side)) == 5.0


def test_what_happens_after_the_last_instant_is_not_stepped():
    assert [each.time for each in plan_steps(np.array([1.0]), ramp(1.0, 5.0))] == [0.0, 1.0]


def test_a_step_after_a_kink_is_not_predicted_from_before_it():
    smooth = {each.time: each.smooth for each in plan_steps(np.arange(6.0), ramp(1.0, 2.0))}
    assert smooth == {0.0: False, 1.0: False, 2.0: True, 3.0: False, 4.0: True, 5.0: True}


def test_a_step_load_starts_with_its_jump():
    (only,) = plan_steps(np.array([0.0]), step(3.0))
    assert only.is_jump
    assert only.side == "right"


def test_a_swinging_load_is_stepped_as_finely_as_it_needs_until_it_rests():
    load = harmonic(3.0, 1.0, period=12.8, cycles=1)  # a step of 0.1 s at most
    steps = plan_steps(np.array([0.0, 0.25, 12.8, 20.0]), load)
    durations = [each.duration for each in steps[1:]]
    assert max(durations[:-1]) <= 0.1 + 1e-12
    assert durations[:3] == close_to([0.25 / 3] * 3)
    assert durations[-1] == close_to(7.2)
    assert [each.requested for each in steps if each.requested is not None] == [
        0.0,
        0.25,
        12.8,
        20.0,
    ]


def test_bodies_come_to_touch_at_the_end_of_a_step():
    times = np.arange(5.0)
    taken = plan_steps(times, ApproachHistory([0, 4], [-1e-6, 1.5e-6]))
    assert [each.time for each in taken] == close_to([0, 1, 1.6, 2, 3, 4], rel=1e-14)
    assert [each.requested for each in taken] == [0, 1, None, 2, 3, 4]
    # As after a kink, nothing is extrapolated from before.
    assert [each.smooth for each in taken] == [False, False, True, False, True, True]
    # A requested time that differs by rounding is the touch.
    at_touch = plan_steps(times, ApproachHistory([0, 4], [-1e-6, 1e-6]))
    assert [each.requested for each in at_touch] == times.tolist()
    # Without a rise through 0 within the run the steps are the requested ones.
    for approach in ([0, 1e-6], [-1e-6, 0], [1e-6, -1e-6], [-1e-9, 10]):
        assert len(plan_steps(times[:1], ApproachHistory([0, 4], approach))) == 1
    for approach in ([0, 1e-6], [-1e-6, 0], [1e-6, -1e-6]):
        assert len(plan_steps(times, ApproachHistory([0, 4], approach))) == 5


def test_the_ends_of_cycles_are_met_without_a_request():
    load = harmonic(3.0, 1.0, period=0.7, cycles=3)
    taken = {each.time: each for each in plan_steps(np.array([0.0, 1.0, 2.5]), load)}
    assert {0.7, 1.4, 3 * 0.7} <= taken.keys()
    assert taken[1.4].requested is None
    after = min(time for time in taken if time > 1.4)
    assert taken[after].smooth  # they are no kinks


def test_a_step_asks_each_clock_once() -> None:
    """Memories of all terms and the estimate of the error share its integral."""
    history = vc.TemperatureHistory([0.0, 4.0], [293.15, 303.15])
    clocks = [_CountingClock(history, shift) for shift in (SLOW, QUICK)]
    [_, *steps] = plan_steps(np.array([1.0, 4.0]), step(1.0))
    for each in steps:
        for clock, shift in 3 * [*zip(clocks, (SLOW, QUICK), strict=True)]:
            expected = ReducedTime(history, shift).passed(each.time, each.duration)
            assert each.duration_on(clock) == expected
        assert each.duration_on(TIME) == each.duration
    assert [clock.asked for clock in clocks] == 2 * [[each.time for each in steps]]


SLOW, QUICK = vc.WLF(293.15, 8.86, 101.6), vc.Arrhenius(293.15, 80e3)


class _CountingClock(ReducedTime):
    """Clock that keeps the ends of the steps that it was asked for."""

    @cached_property
    def asked(self) -> list[float]:
        return []

    def passed(self, end: float, duration: float) -> float:
        self.asked.append(end)
        return super().passed(end, duration)
