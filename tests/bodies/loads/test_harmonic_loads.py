"""Harmonic loads: the sine that they say, its jumps and its end, and what is refused."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.bodies.loads import harmonic


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
