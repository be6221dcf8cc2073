"""Loads that prescribe an approach: where bodies touch, and what a stage keeps."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bodies.loads.load_cycles import SWING, histories
from closeness import close_to
from viscontact.bodies.loads import harmonic
from viscontact.loads import ApproachHistory, LoadPoint, ramp, step, triangle


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
