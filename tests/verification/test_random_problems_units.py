"""The same contact in nanometres and kilometres, pascals and terapascals: one dimensionless answer.

Results do not depend on units. Factors that are powers of two change no digit of any number, so
that every number that comes out has to be the same to the last bit; others round.
"""

import re
from itertools import islice

import numpy as np
import pytest

import viscontact as vc
from verification.auditing import Findings, audit
from verification.hard_problems import hard_problem, law_of
from verification.rescaling import Units, in_units, rescaled_problem

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

ONE = Units()

#: Of length, modulus and time: about a milliard, a million, both ways.
BINARY = (Units(2.0**-30, 2.0**20, 2.0**30), Units(2.0**10, 2.0**-20, 2.0**-30))

#: Metres, pascals and seconds, where these were nanometres, ..., kilometres; and so on.
DECIMAL = (Units(1e-9, 1e12, 1e9), Units(1e-6, 1e6, 1e-9), Units(1e3, 1e-3, 1e3))

#: Laws that are computed from ratios of times alone. Others take logarithms of the times, or fit
#: exponentials for their predictions, which rounds.
EXACT = ("elastic", "Maxwell", "Zener", "Burgers", "creep series", "relaxation series")


def states(problem):
    """All states up to the end, or to where the run says why not."""
    found = []
    try:
        found.extend(problem.march())
    except vc.DomainError:
        return found
    return found


def seeds(exact, count):
    """The first seeds whose law is exact, or is not."""
    fitting = (seed for seed in range(2000, 3000) if (law_of(seed) in EXACT) == exact)
    return list(islice(fitting, count))


def slow_but(kept, arguments):
    """Of as many arguments all but the first few are slow."""
    return [
        pytest.param(*each, marks=[pytest.mark.slow] if number >= kept else [])
        for number, each in enumerate(arguments)
    ]


@pytest.mark.parametrize("units", BINARY)
@pytest.mark.parametrize("seed", slow_but(3, [(seed,) for seed in seeds(True, 8)]))
def test_units_of_powers_of_two_change_no_bit(seed, units):
    problem = hard_problem(seed)
    given, other = states(problem), states(rescaled_problem(problem, units))
    assert len(given) == len(other) > 0
    for one, two in zip(given, other, strict=True):
        found = in_units(two, units)
        for name, value in in_units(one, ONE).items():
            assert np.array_equal(value, found[name], equal_nan=True), name


@pytest.mark.parametrize(
    ("seed", "units"),
    slow_but(4, zip([*seeds(False, 6), *seeds(True, 3)], 3 * DECIMAL, strict=True)),
)
def test_any_units_change_a_displacement_within_the_tolerance_only(seed, units):
    problem = hard_problem(seed)
    given, other = states(problem), states(rescaled_problem(problem, units))
    assert len(given) == len(other) > 0
    largest = 0.0
    for one, two in zip(given, other, strict=True):
        displacement, found = in_units(one, ONE)["displacement"], in_units(two, units)
        largest = max(largest, float(displacement.max()))
        # Both within 1e-6 of what they should be; measured 4e-7.
        assert np.abs(found["displacement"] - displacement).max() <= 2e-6 * largest
        assert one.outcome == two.outcome


@pytest.mark.parametrize("decade", [-120, -29, -9, 9, 29, 120])
@pytest.mark.parametrize("which", ["length", "modulus", "time"])
@pytest.mark.parametrize("seed", slow_but(1, [(2003,), (2014,), (2023,)]))
def test_magnitudes_near_the_end_of_numbers_are_right_or_refused(seed, which, decade):
    # The grid's width, the modulus or the run's end is about ten to the decade.
    problem = hard_problem(seed)
    end = float(problem.times[-1])
    now = {
        "length": problem.grid.size[0],
        "modulus": 1 / float(problem.material.contact_compliance()(end)),
        "time": end,
    }[which]
    units = Units(**{which: 2.0 ** round(np.log2(10.0**decade / now))})
    try:
        found = audit(rescaled_problem(problem, units))
    except ValueError as refusal:  # of an argument, before there is a run
        found = Findings(stopped=str(refusal))
    assert (found.instants == 0) == bool(found.stopped)
    assert max(found.gap, found.balance, found.fields) <= 1.01e-6
    if found.stopped:
        assert abs(decade) > 9
        assert re.search("beyond what can be computed with|must be within", found.stopped)
