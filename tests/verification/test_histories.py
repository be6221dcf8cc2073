"""What holds for any law and any history of force or approach, drawn at random.

Boltzmann's superposition where the contact is fixed; the clock, its unit and the units of force and
length (Johnson 1985, ch. 3, and the time that occurs beside a law's times only); and that a force
and the approach it causes are two records of one experiment. Each run is a few steps on a small
mesh, on which all of this is exact but for the solver's tolerance.
"""

import numpy as np
import pytest
from hypothesis import strategies as st

import viscontact as vc
from random_examples import given_few_or_many
from verification.pressing import over_time

TOLERANCE = 1e-10

#: Bounds of results, and where a run is fed what another has found. The tolerance is that of the
#: gap: pressure at the rim differs by tens of it.
BOUND, REPLAYED = 1e-8, 1e-7

PUNCH, UNDER_PUNCH = vc.FlatPunch(1.0), vc.Grid((12, 12), (2.4, 2.4))
BALL, UNDER_BALL = vc.Paraboloid(1.0, 1.0), vc.Grid((20, 20), (0.5, 0.5))
ROLLER, UNDER_ROLLER = vc.Roller(1.0, 2.0, 15.0), vc.Grid((40, 20), (5.6, 0.5))

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

positive = st.floats(0.1, 10.0)


@st.composite
def laws(draw, strength=1.0):
    """Solids and fluids of one to three times, and powers of time; how much they creep."""
    if draw(st.integers(0, 4)) == 0:
        return vc.PowerLaw(
            1e-6 * strength * draw(positive), draw(st.floats(0.1, 0.9)), 1.0, instant=1e-6
        )
    count = draw(st.integers(1, 3))
    amplitudes = [1e-6 * strength * draw(positive) for _ in range(count)]
    times = [10.0 ** draw(st.floats(-2, 2)) for _ in range(count)]
    return vc.CreepSeries(1e-6, amplitudes, times, fluidity=draw(st.sampled_from([0.0, 1e-7])))


@st.composite
def materials(draw, strength=1.0):
    return vc.Material(draw(laws(strength)), draw(st.floats(0.0, 0.5)))


@st.composite
def levels(draw, lowest=0.2):
    """Knots, some of them jumps, and levels from `lowest` to 1."""
    ways = draw(st.sampled_from([(0,), (0, 0), (0, 1), (0, 2, 0), (0, 1, 1, 0), (0, 0, 1, 0, 2)]))
    return np.cumsum(ways).astype(float), np.array([draw(st.floats(lowest, 1.0)) for _ in ways])


TIMES = np.array([0.0, 0.3, 0.8, 1.0, 1.7, 2.5, 4.0, 6.0])


def force_for(material):
    """A force under which a contact is as large for every law, as long as it grows [N]."""
    return 8e-3 / material.contact_compliance()(float(TIMES[-1]))


def marched(indenter, material, load, grid, times=TIMES, tolerance=TOLERANCE):
    return list(vc.march(indenter, material, load, grid, times, tolerance=tolerance))


def close(found, exact, bound=BOUND):
    found, exact = np.asarray(found), np.asarray(exact)
    scale = np.abs(exact).max()
    assert scale > 0
    assert np.abs(found - exact).max() <= bound * scale


@given_few_or_many(
    4, 25, material=materials(0.02), one=levels(), other=levels(), share=st.floats(0.1, 0.9)
)
def test_forces_on_a_fixed_contact_are_superposed(material, one, other, share):
    """Boltzmann: approach and pressure of F1 + F2 are the sums of those of F1 and of F2.

    In steps that are short against the law; over longer ones the rule is another after a jump.
    """
    first = vc.ForceHistory(one[0], 1e3 * share * one[1])
    second = vc.ForceHistory(other[0], 1e3 * (1 - share) * other[1])
    knots = np.unique(np.concatenate([one[0], other[0]]))
    both = [
        (knot, first.level_at(knot, side=side) + second.level_at(knot, side=side))
        for knot in knots
        for side in ("left", "right")
        if knot > 0 or side == "right"
    ]
    together = vc.ForceHistory(*np.array(both).T)
    runs = [
        marched(PUNCH, material, load, UNDER_PUNCH, np.union1d(TIMES, knots))
        for load in (first, second, together)
    ]
    for name in ("approach", "pressure", "displacement"):
        apart, more, joint = (np.array([getattr(s, name) for s in states]) for states in runs)
        close(apart + more, joint, REPLAYED)


@given_few_or_many(
    4, 15, material=materials(), level=levels(0.5), late=st.floats(0.5, 50.0), staged=st.booleans()
)
def test_a_later_start_shifts_the_clock(material, level, late, staged):
    times, values = level

    def load(after):
        if staged:
            return vc.ApproachHistory(times + after, 0.012 * values)
        return vc.ForceHistory(times + after, force_for(material) * values)

    early = marched(BALL, material, load(0.0), UNDER_BALL)
    (before, *shifted) = marched(
        BALL, material, load(late), UNDER_BALL, np.append(late / 2, TIMES + late)
    )
    assert before.force == 0
    for name in ("pressure", "approach", "work"):
        close(
            [getattr(state, name) for state in shifted], [getattr(state, name) for state in early]
        )


@given_few_or_many(
    4,
    15,
    material=materials(),
    level=levels(0.5),
    factor=st.floats(1e-3, 1e3),
    staged=st.booleans(),
)
def test_a_slower_law_under_a_slower_history_does_the_same_later(material, level, factor, staged):
    """Time has no unit but the law's: `slowed` multiplies it."""
    times, values = level

    def states(by):
        load = (
            vc.ApproachHistory(by * times, 0.012 * values)
            if staged
            else vc.ForceHistory(by * times, force_for(material) * values)
        )
        slowed = vc.Material(material.law.slowed(by), material.poisson_ratio)
        return marched(BALL, slowed, load, UNDER_BALL, by * TIMES)

    fast, slow = states(1.0), states(factor)
    for name in ("pressure", "approach", "work"):
        close([getattr(state, name) for state in slow], [getattr(state, name) for state in fast])


@given_few_or_many(
    4,
    15,
    material=materials(),
    level=levels(0.5),
    size=st.floats(1e-6, 1e3),
    hardness=st.floats(1e-3, 1e3),
)
def test_size_and_modulus_scale_out(material, level, size, hardness):
    """At a size times as large and a modulus times as high, the same angles and strains."""
    times, values = level
    law, force = material.law, force_for(material) * values
    harder = (
        vc.PowerLaw(law.compliance / hardness, law.exponent, 1.0, law.instant / hardness)
        if isinstance(law, vc.PowerLaw)
        else vc.CreepSeries(
            law.instant / hardness,
            [each / hardness for each in law.amplitudes],
            law.times,
            law.fluidity / hardness,
        )
    )
    grid = vc.Grid(UNDER_BALL.shape, tuple(size * edge for edge in UNDER_BALL.size))
    ours = marched(BALL, material, vc.ForceHistory(times, force), UNDER_BALL)
    scaled = vc.Material(harder, material.poisson_ratio)
    load = vc.ForceHistory(times, hardness * size**2 * force)
    theirs = marched(vc.Paraboloid(size, size), scaled, load, grid)
    for name, unit in (
        ("pressure", hardness),
        ("approach", size),
        ("contact_area", size**2),
        ("work", hardness * size**3),
    ):
        # Rounding takes the two solvers different ways, and pressure answers sharply to a gap.
        close([getattr(s, name) / unit for s in theirs], [getattr(s, name) for s in ours], REPLAYED)


@given_few_or_many(3, 8, material=materials(), level=levels(0.6), tilt=st.floats(-0.004, 0.004))
def test_a_stage_tilted_the_other_way_presses_the_mirror_image(material, level, tilt):
    times, values = level

    def states(slope):
        load = vc.ApproachHistory(times, 0.012 * np.sort(values), tilt_x=slope)
        return marched(ROLLER, material, load, UNDER_ROLLER)

    ours, theirs = states(tilt), states(-tilt)
    close([s.pressure[::-1] for s in theirs], [s.pressure for s in ours], REPLAYED * 10)
    for name in ("force", "work", "contact_area"):
        close([getattr(s, name) for s in theirs], [getattr(s, name) for s in ours])
    aside = [np.array([s.eccentricity_x for s in run]) for run in (ours, theirs)]
    assert np.abs(aside[0] + aside[1]).max() < REPLAYED


@given_few_or_many(
    3,
    6,
    material=materials(),
    force=st.lists(st.floats(0.5, 1.0), min_size=7, max_size=7),
    aside=st.floats(-1.0, 1.0),
)
def test_a_stage_that_replays_a_force_s_motion_finds_the_force(material, force, aside):
    """And its moment; and the force so found brings the motion about again."""
    times, tolerance = TIMES[:7], 1e-11
    # So that the contact is as large for every law.
    largest = 2 * force_for(material)
    prescribed = vc.ForceHistory(times, largest * np.array(force), eccentricity_x=aside)
    pushed = marched(ROLLER, material, prescribed, UNDER_ROLLER, times, tolerance)
    motion = {name: over_time(pushed, name) for name in ("approach", "tilt_x", "tilt_y")}
    stage = vc.ApproachHistory(times, **motion)
    staged = marched(ROLLER, material, stage, UNDER_ROLLER, times, tolerance)
    found = over_time(staged, "force")
    close(found, prescribed.level_at(times), REPLAYED)
    places = over_time(staged, "eccentricity_x")
    assert np.abs(places - aside).max() < REPLAYED
    close([s.pressure for s in staged], [s.pressure for s in pushed], 10 * REPLAYED)
    again = vc.ForceHistory(times, found, eccentricity_x=places)
    repeated = marched(ROLLER, material, again, UNDER_ROLLER, times, tolerance)
    close(over_time(repeated, "approach"), motion["approach"], REPLAYED)
    assert np.abs(over_time(repeated, "tilt_x") - motion["tilt_x"]).max() < REPLAYED
    close(over_time(repeated, "work"), over_time(staged, "work"), 10 * REPLAYED)


def test_a_stage_that_replays_a_lost_and_regained_contact_finds_the_force():
    """A dent is left, recovers in part, and is met where it is."""
    material = vc.Material(vc.Zener(1e6, 5e5, 5e5), 0.4)
    times = vc.uniform_times(6.0, 60)
    force = vc.ForceHistory([0, 1, 2, 4, 5], 1e3 * np.array([0, 1, 0, 0, 0.7]))
    pushed = marched(BALL, material, force, UNDER_BALL, times, 1e-11)
    load = vc.ApproachHistory(times, over_time(pushed, "approach"))
    staged = marched(BALL, material, load, UNDER_BALL, times, 1e-11)
    close(over_time(staged, "force"), force.level_at(times), REPLAYED)
    close([s.pressure for s in staged], [s.pressure for s in pushed], 10 * REPLAYED)
