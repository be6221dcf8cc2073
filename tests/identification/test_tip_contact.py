"""Tip on a cantilever against the rods of `press_axisymmetric` and closed forms."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact import reference
from viscontact.identification.contact_point import deflection_in_contact
from viscontact.identification.elastic_indentation import elastic_indentation, indenter_profile
from viscontact.identification.stroke import Stroke
from viscontact.identification.tip_contact import PressedTip
from viscontact.indenters import Cone, FlatPunch, Sphere
from viscontact.reference.lag_means import lag_mean

STIFFNESS, NU = 0.03, 0.5
CORNERS, WAY = [0.0, 0.5, 1.5, 2.0], [0.0, 1e-6, 1e-6, 0.0]
TIPS = {"sphere": Sphere(5e-6), "cone": Cone(1.2), "punch": FlatPunch(1e-6)}


def pressed(indenter, law, count):
    """Instants, way of the base and bending, of loading, hold and retraction."""
    stroke = Stroke(np.array(CORNERS), np.array(WAY))
    x = np.arange(1, count + 1) / count
    placed = x * x * (3 - 2 * x)
    spans = pairwise(CORNERS)
    times = np.concatenate([[0.0], *(begin + (end - begin) * placed for begin, end in spans)])
    way = stroke.at(times)
    tip = PressedTip(elastic_indentation(indenter), 1 / STIFFNESS)
    mean = lag_mean(vc.Material(law, NU).contact_compliance())
    return times, way, tip.force(times, way, mean) / STIFFNESS


@pytest.mark.parametrize("tip", TIPS)
@pytest.mark.parametrize(
    "law", [vc.Zener(500.0, 333.0, 277.0), vc.PowerLaw(1e-3, 0.2, 1.0)], ids=["zener", "power-law"]
)
def test_bending_times_stiffness_is_the_force_under_the_indentation_that_is_left(tip, law):
    times, way, bending = pressed(TIPS[tip], law, 60)
    contact = reference.press_axisymmetric(
        indenter_profile(TIPS[tip]),
        times,
        approach=way - bending,
        creep_compliance=vc.Material(law, NU).contact_compliance(),
    )
    force = STIFFNESS * bending
    # Both are of second order in the steps; a punch is drawn off in one step of its own.
    np.testing.assert_allclose(force, contact.force, atol=5e-4 * force.max())
    assert force.max() > 1e-9


def test_bending_on_an_elastic_body_is_that_of_hertz_on_a_spring():
    _, way, bending = pressed(TIPS["sphere"], vc.Elastic(500.0), 30)
    exact = deflection_in_contact(TIPS["sphere"], 2 * 500.0 / (1 - NU), STIFFNESS, way)
    np.testing.assert_allclose(bending, exact, rtol=1e-9, atol=1e-18)


def test_the_largest_bending_converges_with_second_order():
    peaks = [
        pressed(TIPS["sphere"], vc.Maxwell(500.0, 300.0), n)[2].max() for n in (20, 40, 80, 160)
    ]
    changes = np.abs(np.diff(peaks))
    assert changes[0] / changes[1] == close_to(4, rel=0.2)
    assert changes[1] / changes[2] == close_to(4, rel=0.2)


def test_ends_of_loading_and_hold_are_found_where_the_hold_rises_or_falls():
    t = np.linspace(0.0, 3.0, 301)
    for drift in (-0.1, 0.0, 0.1):
        way = np.interp(t, [0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 1.0 + drift, 0.0])
        stroke = Stroke(t, way)
        assert t[stroke.loading_end] == close_to(1.0, abs=0.011)
        assert t[stroke.hold_end] == close_to(2.0, abs=0.011)
    triangle = Stroke(t, np.interp(t, [0.0, 1.0, 3.0], [0.0, 1.0, 0.0]))
    assert triangle.loading_end == triangle.hold_end == 100
    held = Stroke(t, np.minimum(t, 1.0))
    assert held.loading_end == 100
    assert held.hold_end == 300
