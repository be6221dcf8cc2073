"""Dissimilar bodies that roll: Bufler, Bentall and Johnson, and another program."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.rolling_bodies import (
    BENTALL,
    DISSIMILAR_FORCE,
    HELD,
    IRON,
    RADIUS,
    bufler,
    dissimilar,
)

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


@pytest.mark.slow
def test_free_rolling_of_dissimilar_bodies_that_stick_has_the_creepage_of_bufler():
    """Without slip nothing is lost: there is no resistance."""
    exact, half = bufler()
    errors = []
    for cells in (10, 20):
        last = dissimilar(cells, 8.0, 10.0)
        errors.append(abs(last.creepage / exact - 1))
        assert last.slip_fraction == 0
        assert abs(last.resistance_y) < 1e-6 * DISSIMILAR_FORCE
    assert errors[1] < 2e-3
    assert errors[1] < errors[0] / 2.5
    assert last.contact_width / 2 == close_to(half, rel=1e-2)


def test_coupled_balls_under_opposite_lateral_creepages_are_mirror_images():
    """Across the plane of the motion, which the pressure is not even about any more."""
    half, radius, cells, steps = 1e-3, 0.01, 8, 6
    soft, stiff = vc.Material(vc.Elastic(1e6), 0.2), vc.Material(vc.Elastic(1e7), 0.3)
    force, cell = 4 * half**3 / (3 * radius * 4.35e-7), 2 * half / cells
    grid = vc.Grid((16, 16 + steps), (16 * cell, (16 + steps) * cell), centre=(0.0, 3 * cell))
    states = []
    for lateral in (0.01, -0.01):
        path = vc.Travel([0, 1], y=[0, steps * cell], creepage=0.003, lateral_creepage=lateral)
        *_, last = vc.march(
            *(vc.Paraboloid(radius, radius), soft, vc.step(force, tilt_x=0.0, tilt_y=0.0), grid),
            np.linspace(0, 1, steps + 1),
            indenter_material=stiff,
            friction=0.3,
            motion=path,
        )
        states.append(last)
    right, left = states
    assert right.tangential_force_x == close_to(-left.tangential_force_x, rel=1e-6)
    assert right.tangential_force_y == close_to(left.tangential_force_y, rel=1e-6)
    peak = right.peak_pressure
    np.testing.assert_allclose(right.pressure, left.pressure[::-1], atol=1e-5 * peak)
    assert np.abs(right.pressure - right.pressure[::-1]).max() > 0.01 * peak


def test_exchanged_bodies_creep_the_other_way():
    """The plane is the roller and the roller the plane: q and the creepage change their sign."""
    last, other = (dissimilar(8, 2.0, 0.05, exchanged=each) for each in (False, True))
    assert last.creepage == close_to(-other.creepage, rel=1e-6)
    assert last.peak_pressure == close_to(other.peak_pressure, rel=1e-5)
    assert last.slip_fraction == other.slip_fraction


@pytest.mark.slow
@pytest.mark.parametrize("part", BENTALL)
def test_dissimilar_rollers_have_the_creepages_of_contact(part):
    """The pressure feels the tractions: its resultant and that of the work are ahead or behind."""
    creepage, peak, sticking = BENTALL[part]
    last = dissimilar(40, 3.0, 0.05, part)
    assert last.creepage == close_to(creepage, rel=4e-3)
    assert last.peak_pressure == close_to(peak, rel=1e-3)
    if sticking is not None:
        assert 1 - last.slip_fraction == close_to(sticking / 200, abs=0.03)
    # What the drive and the resistance do is heat of friction.
    put_in = last.resistance_y - last.tangential_force_y * last.creepage
    assert last.friction_power == close_to(put_in, rel=1.5e-2)


@pytest.mark.parametrize("part", [0.75, -0.75])
def test_a_body_that_has_relaxed_at_once_resists_as_an_elastic_one(part):
    """Of 16 cells the form by the slope is off by 2 % to 4 %, the other by its loss only."""
    modulus, ratio = 8.2e4, 0.28
    relaxes = vc.Material(vc.Zener(2 * modulus, 2 * modulus, 1e-6 * modulus), ratio)
    elastic, found = (dissimilar(16, 2.5, 0.05, part, iron=iron) for iron in (IRON, relaxes))
    assert found.resistance_y == close_to(elastic.resistance_y, rel=1e-3)
    assert found.creepage == close_to(elastic.creepage, rel=3e-3)
    put_in = found.resistance_y - found.tangential_force_y * found.creepage
    assert found.friction_power == close_to(put_in, rel=5e-2)


@pytest.mark.slow
def test_bodies_with_next_to_no_friction_roll_freely_at_the_creepage_of_bentall_and_johnson():
    """All slips: in the middle, which carries half the load, forth, and back beside it.

    Pressure stretches the surfaces by 2 Δ(c J) p against each other: the creepage is that at
    |y| = 0.4040 a. CONTACT has 5.260e-4 (cases 1 and 2 of `bentall.ref_out`).
    """
    creepage = 2 * 2.7890e-6 * math.sqrt(1 - 0.4040**2) * 103.13
    assert creepage == close_to(5.260e-4, rel=1e-3)
    # A cell that turns round on both sides changes the force by a ninth of what friction carries.
    below, above = (
        dissimilar(40, 2.2, 1e-4, creepage=share * creepage).tangential_force_y
        for share in (0.97, 1.03)
    )
    carried = 1e-4 * DISSIMILAR_FORCE
    assert 0 < below < 0.2 * carried
    assert 0 > above > -0.25 * carried


@pytest.mark.slow
def test_work_of_a_ball_on_a_dissimilar_plane_is_heat_of_friction():
    """In three dimensions, of a drive under half of what friction carries; on 10 and 16 cells."""
    soft, hard = vc.Material(vc.Elastic(1e6), 0.3), vc.Material(vc.Elastic(5e6), 0.2)
    half, mu = 1e-3, 0.2
    force = 4 * half**3 / (3 * RADIUS * (0.7 / 2e6 + 0.8 / 10e6))
    errors = []
    for cells in (10, 16):
        cell, steps = 2 * half / cells, 2 * cells
        count = cells + 8 + steps
        size = (cells + 8) * cell, count * cell
        *_, last = vc.march(
            vc.Paraboloid(RADIUS, RADIUS),
            soft,
            vc.step(force, **HELD),
            vc.Grid((cells + 8, count), size, centre=(0.0, steps * cell / 2)),
            np.arange(steps + 1) * cell / 0.1,
            indenter_material=hard,
            friction=mu,
            tangential=vc.tangential_step(force_y=-0.5 * mu * force),
            motion=vc.Travel([0.0, steps * cell / 0.1], y=[0.0, steps * cell], rolling=True),
        )
        put_in = 0.1 * (last.resistance_y - last.tangential_force_y * last.creepage)
        errors.append(abs(last.friction_power / put_in - 1))
    assert errors[1] < 5e-3
    assert errors[1] < errors[0] / 1.8
