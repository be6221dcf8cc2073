"""Tangential loads: values, kinks, jumps, and refused arguments."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.joint import JointLoad


def test_a_history_is_linear_between_its_points_and_held_after_them():
    load = vc.TangentialHistory([1, 3, 3, 5], force_x=[0, 4, -2, 0], rotation=1e-3)
    assert load.at(0.5).forces == (0.0, 0.0, None)
    assert load.at(0.5).motions == (None, None, 0.0)
    assert load.at(2.0).forces[0] == close_to(2.0)
    assert load.at(3.0, side="left").forces[0] == close_to(4.0)
    assert load.at(3.0).forces[0] == close_to(-2.0)
    assert load.at(9.0).motions == (None, None, 1e-3)
    assert load.kinks.tolist() == [1.0, 3.0, 5.0]
    # The rotation comes at once, and the force jumps later.
    assert load.jumps.tolist() == [1.0, 3.0]


def test_harmonic_loads_have_kinks_where_they_turn_back():
    load = vc.tangential_harmonic(force_y=2.0, period=4.0, cycles=2, phase=np.pi / 2)
    assert load.at(0.0).forces[1] == close_to(2.0)
    assert load.at(1.0).forces[1] == close_to(0.0, abs=1e-12)
    assert load.kinks.tolist() == close_to([0.0, 2.0, 4.0, 6.0, 8.0])
    assert load.jumps.tolist() == [0.0]
    assert load.at(0.0, side="left").forces[1] == 0.0
    assert load.at(100.0).forces[1] == close_to(2.0)


def test_loads_that_act_along_one_direction_are_known():
    assert vc.tangential_step(torque=1.0).acts == (False, False, True)
    assert vc.tangential_ramp(displacement_y=1e-6, duration=1.0).acts == (False, True, False)
    assert vc.TangentialHistory([0, 1], force_x=[0, 1], force_y=[0, 0]).acts == (True, False, False)


def test_a_joint_load_has_the_kinks_and_jumps_of_both():
    normal = vc.ForceHistory([0, 2, 2], [1, 3, 2])
    joint = JointLoad(normal, vc.TangentialHistory([1, 2, 4], force_x=[1, 0, 1]))
    assert joint.kinks.tolist() == [0.0, 1.0, 2.0, 4.0]
    assert joint.jumps.tolist() == [0.0, 1.0, 2.0]
    assert joint.level_at(1.0) == close_to(2.0)
    assert np.isinf(joint.longest_step)
    shaken = vc.tangential_harmonic(force_x=1.0, period=12.8, cycles=3)
    assert JointLoad(normal, shaken).longest_step == close_to(0.1)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: vc.tangential_step(), "nothing is given; give one or more of force_x"),
        (lambda: vc.tangential_step(force=1.0), "unknown argument 'force'"),
        (lambda: vc.tangential_step(force_x=np.nan), "force_x must be finite"),
        (lambda: vc.tangential_ramp(force_x=1.0, duration=0.0), "duration must be a positive"),
        (lambda: vc.tangential_harmonic(force_x=1.0, period=1.0, cycles=0), "cycles must be"),
        (
            lambda: vc.tangential_step(force_x=1.0, displacement_x=1e-6),
            "displacement_x and force_x contradict each other",
        ),
        (lambda: vc.TangentialHistory([0, 1], force_x=[1, 2, 3]), "one value for each of the 2"),
        (lambda: vc.TangentialHistory([1, 0], force_x=[1, 2]), "times must not decrease"),
        (lambda: vc.Friction(-0.1), "coefficient must be a positive"),
        (lambda: vc.Friction("30 %"), "write 0.3 for 30 %"),
        (lambda: vc.Friction(30), "write 0.3 for 30 %"),
        (lambda: vc.Friction(0.3, coupling="no"), "coupling must be true or false"),
    ],
)
def test_what_is_refused_is_named_with_a_remedy(make, said):
    with pytest.raises(ValueError, match=said):
        make()


@pytest.mark.parametrize(
    ("times", "forces", "cycles"),
    [
        # To and fro from 1 s on; the last half cycle is not whole.
        ([0, 1, 2, 3, 4], [0, 1, -1, 1, -1], ((1, 3),)),
        # A level that is held ends where it does.
        ([0, 1, 2, 3, 4], [0, 1, 1, -1, 1], ((2, 4),)),
        # From a held level and a jump.
        ([0, 1, 2, 3, 4, 5, 5], [0, 1, 0.5, 1, 0, 0, 1], ((1, 3), (3, 5))),
        # It does not come back to the same level, or not at all.
        ([0, 1, 2, 3], [0, 1, -1, 2], ()),
        ([1], [2], ()),
    ],
)
def test_cycles_go_from_reversal_to_reversal_at_one_level(times, forces, cycles):
    assert vc.TangentialHistory(times, force_y=forces).whole_cycles == cycles
    moved = vc.TangentialHistory(times, displacement_x=forces)
    assert moved.whole_cycles == cycles


def test_cycles_of_a_harmonic_load_are_its_periods():
    load = vc.tangential_harmonic(rotation=0.1, period=2.0, cycles=3)
    assert load.whole_cycles == ((0, 2), (2, 4), (4, 6))
    # Every run has steps at their ends, which are no kinks.
    assert {2.0, 4.0} <= set(JointLoad(vc.step(1.0), load).stops.tolist())
