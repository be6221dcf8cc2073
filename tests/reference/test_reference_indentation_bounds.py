"""Invariants of an indentation under any history, and refused histories."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from closeness import close_to
from inverse_pairs import maxwell, power_law, series
from viscontact import reference
from viscontact.reference.indentation_march import (
    LagCompliance,
    OutgrownError,
    deepest_approach,
    load_steps,
    march,
)
from viscontact.reference.lag_means import lag_mean
from viscontact.reference.rods import placed_rods

SPHERE, CONE = reference.SphereProfile(0.01), reference.ConeProfile(1.4)
MAXWELL = maxwell(1.0)[0]
BROAD = series(1 / 2e9, [1 / 2e9, 1 / 1e9], [0.2, 3.0])[0]


def worst(ours, exact):
    """Largest difference relative to the largest value."""
    return float(np.abs(ours - exact).max() / np.abs(exact).max())


# Symmetries and bounds, whatever the history.

histories = st.lists(st.floats(-0.5, 1.0), min_size=2, max_size=6)


@settings(max_examples=6)
@given(levels=histories, profile=st.sampled_from([SPHERE, CONE]))
def test_no_history_pulls_or_penetrates(levels, profile):
    """With p >= 0 and no penetration the rods are the contact problem, not only its shadow."""
    corners = np.arange(len(levels) + 1.0)
    t = np.linspace(0, corners[-1], 20 * len(levels) + 1)
    approach = np.interp(t, corners, 1e-5 * np.array([0.0, *levels]))
    contact = reference.press_axisymmetric(
        profile, t, approach=approach, creep_compliance=BROAD, elements=60
    )
    slope = (lambda r: r**2 / 0.02) if profile is SPHERE else (lambda r: r / math.tan(1.4))
    r = np.linspace(1e-6, 1.5, 40) * max(contact.places[-1], 1e-5)
    for k in range(0, t.size, 7):
        p = contact.pressure(r, t[k])
        assert np.all(p >= -1e-3 * max(p.max(), 1.0))
        opening = contact.displacement(r, t[k]) + slope(r) - approach[k]
        assert np.all(opening >= -2e-3 * 1e-5)


@settings(max_examples=3)
@given(
    load=st.floats(1e-2, 1e2), stiffness=st.floats(1e-2, 1e2), slowness=st.floats(1e-2, 1e2),
    shift=st.floats(0, 1e3),
)  # fmt: skip
def test_contact_scales_with_load_modulus_and_time_and_is_invariant_in_time(
    load, stiffness, slowness, shift
):
    """Force by c and J by 1/c leave the geometry; w goes with (F J)^(2/3); time only stretches."""
    t = np.linspace(0, 3, 31)
    force = np.interp(t, [0, 1, 2, 3], [0, 5, 1, 4])
    one = reference.press_axisymmetric(SPHERE, t, force=force, creep_compliance=BROAD, elements=40)
    other = reference.press_axisymmetric(
        SPHERE,
        shift + slowness * t,
        force=load * stiffness * force,
        creep_compliance=lambda lag: BROAD(lag / slowness) / stiffness,
        elements=40,
    )
    # The shift costs digits of the time step.
    np.testing.assert_allclose(other.approach, load ** (2 / 3) * one.approach, rtol=1e-8)
    np.testing.assert_allclose(
        other.contact_radius, load ** (1 / 3) * one.contact_radius, rtol=1e-7
    )


def test_resolution_error_is_near_the_true_one():
    exact = reference.ting_triangle(SPHERE, 1e-5, 1.0, 0.0, [2e9], [1.0])
    t = np.linspace(0, 2, 41)
    contact = reference.press_axisymmetric(
        SPHERE, t, approach=exact.approach(t), creep_compliance=MAXWELL, elements=40
    )
    estimated = reference.resolution_error(contact)
    assert estimated.force == close_to(worst(contact.force, exact.force(t)), rel=0.3)
    assert estimated.approach == 0.0


def test_means_of_a_compliance_are_used_where_it_has_them():
    class Counted:
        calls = 0

        def __call__(self, t):
            return (1 + t) / 2e9

        def mean(self, start, end):
            self.calls += 1
            return (1 + (start + end) / 2) / 2e9

    t = np.linspace(0, 2, 41)
    load = 5 * t * (2 - t)
    counted = Counted()
    with_means = reference.press_axisymmetric(SPHERE, t, force=load, creep_compliance=counted)
    without = reference.press_axisymmetric(SPHERE, t, force=load, creep_compliance=MAXWELL)
    assert counted.calls > 40
    np.testing.assert_allclose(with_means.approach, without.approach, rtol=1e-9)


def test_contact_beyond_the_last_rod_is_an_error():
    steps = load_steps(np.zeros(1), np.ones(1), by_approach=False, substeps=1)
    law = LagCompliance(lambda start, end: np.full_like(end, 1 / 2e9), 1 / 2e9)
    deepest = reference.hertz_sphere(1.0, 0.01, 2e9).approach
    assert deepest < deepest_approach(SPHERE, steps, law) < 1.01 * deepest
    [result] = march(placed_rods(SPHERE, 1.01 * deepest, 20), steps, law)
    assert result.state.approach == close_to(deepest, rel=1e-12)
    with pytest.raises(OutgrownError):
        list(march(placed_rods(SPHERE, 0.99 * deepest, 20), steps, law))


@pytest.mark.parametrize(
    ("times", "load", "message"),
    [
        ([0.0, 1.0], {}, "either approach= or force="),
        ([0.0, 1.0], {"force": [0.0, 1.0], "approach": [0.0, 1.0]}, "either approach= or force="),
        ([0.0, 2.0, 1.0], {"force": [0.0, 1.0, 2.0]}, "times.*entry 2"),
        ([0.0, math.nan], {"force": [0.0, 1.0]}, "times"),
        ([0.0, 1.0], {"force": [0.0, -1.0]}, "force.*nothing adheres"),
        ([0.0, 1.0], {"approach": [0.0, math.inf]}, "approach.*not finite"),
        ([0.0, 1.0], {"approach": [0.0]}, "approach.*2 times"),
        ([0.0, 1.0], {"force": [0.0, 1.0], "elements": 0}, "elements"),
        ([0.0], {"force": [1.0], "creep_compliance": power_law(0.5)[0]}, r"J\(0\) = 0"),
        ([0.0], {"force": [1.0], "creep_compliance": lambda t: 1 / t}, "creep_compliance"),
    ],
)
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_bad_histories_are_refused_with_the_place(times, load, message):
    with pytest.raises(ValueError, match=message):
        reference.press_axisymmetric(SPHERE, times, **{"creep_compliance": MAXWELL, **load})


def test_instants_outside_the_history_are_refused():
    contact = reference.press_axisymmetric(
        SPHERE, [0.0, 1.0], force=[0.0, 1.0], creep_compliance=MAXWELL
    )
    with pytest.raises(ValueError, match=r"^t: wanted an instant from 0 s to 1 s"):
        contact.pressure(0.0, 1.5)


def test_steps_too_long_for_the_law_are_refused_where_the_contact_falls_apart():
    """A soft body that creeps at once, all but: its J grows tenfold within one step."""
    creep = series(1 / 2e9, [6e-9], [0.2])[0]
    corners, levels = [0.0, 1.4, 2.1, 2.4, 6.9], [0.0, 8.6e-6, 1e-6, 7.3e-6, 8.4e-6]
    t = np.concatenate(
        [[0.0], *(np.linspace(a, b, 13)[1:] for a, b in itertools.pairwise(corners))]
    )
    load = {"approach": np.interp(t, corners, levels), "creep_compliance": creep}
    with pytest.raises(ValueError, match=r"times: .* a ring, .*substeps="):
        reference.press_axisymmetric(SPHERE, t, elements=60, **load)
    finer = reference.press_axisymmetric(SPHERE, t, elements=30, substeps=8, **load)
    assert reference.resolution_error(finer).force < 1e-2


def test_means_by_quadrature_keep_their_digits_near_lag_0_and_far_from_it():
    start, end = np.array([0.0, 1e-3, 5.0, 1e6, 2.0]), np.array([3.0, 1.0, 7.0, 1e6 + 1e-3, 2.0])
    mean = lag_mean(lambda t: t**0.2)(start, end)
    exact = (end**1.2 - start**1.2) / (1.2 * np.maximum(end - start, 1e-300))
    exact[3:] = [(1e6) ** 0.2, 2**0.2]  # to 1e-10 over so short an interval
    np.testing.assert_allclose(mean, exact, rtol=1e-9)
