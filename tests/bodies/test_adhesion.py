"""Adhesion and its cohesive laws: work, strength and slope against their definitions."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

import viscontact as vc
from closeness import close_to
from viscontact.bodies.cohesive_laws import LAWS

WORK, RANGE = 0.05, 2e-9


def law_of(name):
    return LAWS[name](WORK, RANGE)


def at(function, gap, across=0.0):
    return float(function(np.array([gap]), np.array([across]))[0])


@pytest.mark.parametrize("name", LAWS)
def test_traction_over_the_gap_does_the_work_of_adhesion(name):
    law = law_of(name)
    pieces = np.concatenate([[0.0], RANGE * np.geomspace(0.01, 1e4, 60), [RANGE]])
    pieces = np.unique(pieces)
    work = sum(
        quad(lambda gap: at(law.traction, gap), *each)[0] for each in itertools.pairwise(pieces)
    )
    assert work == close_to(WORK, rel=1e-7)


@pytest.mark.parametrize("name", LAWS)
def test_energy_is_the_work_that_is_left(name):
    law, gaps = law_of(name), RANGE * np.array([0.0, 0.3, 0.9, 2.0])
    step = 1e-6 * RANGE
    falls = (law.energy(gaps) - law.energy(gaps + step)) / step
    np.testing.assert_allclose(falls, law.traction(gaps + step / 2, 0 * gaps), rtol=1e-4)
    assert float(law.energy(np.zeros(1))[0]) == close_to(WORK, rel=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_strength_is_the_largest_traction(name):
    law = law_of(name)
    gaps = RANGE * np.linspace(0.0, 3.0, 30_001)
    tractions = law.traction(gaps, np.zeros(gaps.shape))
    assert tractions.max() == close_to(law.strength, rel=1e-7)
    assert at(law.traction, law.reach) <= 1e-11 * law.strength


@pytest.mark.parametrize("name", LAWS)
def test_slope_is_the_derivative_of_the_traction(name):
    law, across = law_of(name), np.full(4, 0.4 * RANGE)
    gaps, step = RANGE * np.array([0.2, 0.85, 1.1, 1.6]), 1e-6 * RANGE
    ends = law.traction(gaps + step, across) - law.traction(gaps - step, across)
    np.testing.assert_allclose(
        law.slope(gaps, across), ends / (2 * step), rtol=1e-5, atol=1e-6 * law.strength / RANGE
    )


def test_lennard_jones_has_the_strength_of_the_3_9_law():
    # 16 w/(9 sqrt(3) z0) at the gap (3^(1/6) - 1) z0, with (8 w/3 z0) ((z0/z)^3 - (z0/z)^9).
    law = law_of("lennard-jones")
    distance = 16 * WORK / (9 * np.sqrt(3) * law.strength)
    assert at(law.traction, distance * (3 ** (1 / 6) - 1)) == close_to(law.strength, rel=1e-12)
    assert at(law.traction, distance) == close_to(
        8 * WORK / (3 * distance) * (2.0**-3 - 2.0**-9), rel=1e-12
    )


def test_dugdale_front_within_a_cell_carries_the_part_that_is_within_the_range():
    law, across = law_of("dugdale"), 0.4 * RANGE
    for part in (0.0, 0.25, 0.5, 1.0):
        gap = RANGE + (0.5 - part) * across
        assert at(law.traction, gap, across) == close_to(part * law.strength, rel=1e-9, abs=1e-3)


@pytest.mark.parametrize("name", LAWS)
def test_decreasing_law_is_nowhere_below_and_nowhere_increases(name):
    law = law_of(name)
    gaps = RANGE * np.linspace(0.0, 5.0, 501)
    across = np.zeros(gaps.shape)
    majorant = law.decreasing.traction(gaps, across)
    assert (majorant >= law.traction(gaps, across) * (1 - 1e-12)).all()
    assert (np.diff(majorant) <= 1e-12 * law.strength).all()


def test_range_and_strength_are_one():
    by_range, by_strength = vc.Adhesion(0.05, range=2e-9), vc.Adhesion(0.05, strength=25e6)
    assert by_range.cohesive_law.strength == close_to(25e6, rel=1e-12)
    assert by_strength.cohesive_law.range == close_to(2e-9, rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"work": 0.0}, "Adhesion: work must be"),
        ({"work": -1.0}, "Adhesion: work must be"),
        ({"work": "50 mJ/m2"}, "Adhesion: work must be"),
        ({"work": 0.05, "range": 0.0}, "Adhesion: range must be"),
        ({"work": 0.05, "strength": np.inf}, "Adhesion: strength must be"),
        ({"work": 0.05, "range": 1e-9, "strength": 1e6}, "range or strength, not both"),
        ({"work": 0.05, "law": "exponental"}, "did you mean 'exponential'"),
    ],
)
def test_bad_adhesion_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        vc.Adhesion(**arguments)
