"""Spheres pressed in and drawn out, against Ting (1966, 1968) and Graham (1965).

T. C. T. Ting, J. Appl. Mech. 33 (1966) 845 and 35 (1968) 248; G. A. C. Graham, Int. J. Eng. Sci. 3
(1965) 27. Their integrals are evaluated in `reference`: in closed form where there is one, else by
quadrature, else with Boltzmann's integral along each rod of the transformed contact. J and M are
written by hand in `creeping_bodies`. Deviations are relative to the largest value of a history. The
radius is taken from the traced area, while the contact has six cells a radius or more.
"""

import math

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

import viscontact as vc
from closeness import close_to
from verification.creeping_bodies import BODIES, TIME
from verification.indenting import around, deviation, pressed
from verification.pressing import FORCE, RADIUS, order
from viscontact import reference

SPHERE = reference.SphereProfile(RADIUS)
PEAK, RISE = 1e-5, 60.0  # m, s
LARGEST = math.sqrt(RADIUS * PEAK)

#: The issue of all: a thousandth of the largest value.
BOUND = 1e-3

# Terms of M(t) = equilibrium + sum of moduli exp(-t/times), by hand, of the bodies of that name.
TERMS = {
    "maxwell": (0.0, [2e9], [TIME]),
    "zener": (2e9, [2e9], [TIME / 2]),
    "relaxation_series": (
        2 * 2e8 / 0.62,
        [2 * 3e8 / 0.62, 2 * 2e8 / 0.62],
        [5.0, 80.0],
    ),
}


def radius_deviation(run, exact):
    """Deviation of the radius, while six cells or more fit into it."""
    fine = exact > 6 * run.cell
    assert np.mean(fine) > 0.5
    return np.abs(run.radius - exact)[fine].max() / exact.max()


def haversine(times, largest):
    return largest * np.sin(math.pi * np.asarray(times) / (2 * RISE)) ** 2


@pytest.mark.parametrize(
    "name",
    ["zener", *(pytest.param(name, marks=pytest.mark.slow) for name in TERMS if name != "zener")],
)
def test_stage_in_and_out_at_constant_speed(name):
    """Ting (1966), the integrals in closed form. Measured, worst: force 4e-5, radius 9.2e-4."""
    exact = reference.ting_triangle(SPHERE, PEAK, RISE, *TERMS[name])
    times = vc.uniform_times(2 * RISE, 120)
    load = vc.triangle(approach=PEAK, rise=RISE)
    run = pressed(BODIES[name].material, load, times, LARGEST, cells=50.3, odd=False)
    assert deviation(run.force, exact.force(times)) < BOUND / 5
    assert radius_deviation(run, exact.contact_radius(times)) < BOUND
    np.testing.assert_allclose(run.approach, exact.approach(times), atol=1e-12 * PEAK)


@pytest.mark.parametrize(
    "name", ["zener", pytest.param("relaxation_series", marks=pytest.mark.slow)]
)
def test_contact_is_lost_when_ting_says(name):
    """Long before the stage is back. Bracketed by steps of 1/4000 of the way: exact to these."""
    exact = reference.ting_triangle(SPHERE, PEAK, RISE, *TERMS[name])
    assert 1.3 * RISE < exact.lost < 1.9 * RISE
    close = around(exact.lost + 3e-4 * RISE, 4e-3 * RISE)
    times = np.unique(np.concatenate([vc.uniform_times(2 * RISE, 60), close]))
    load = vc.triangle(approach=PEAK, rise=RISE)
    run = pressed(BODIES[name].material, load, times, LARGEST, cells=16.3)
    (_, found), (_, half) = run.changes()
    assert half == close_to(2.5e-4 * RISE)
    assert abs(found - exact.lost) <= half + 2e-4 * RISE


@pytest.mark.slow
def test_error_of_the_force_falls_with_the_square_of_mesh_and_step():
    """Ting (1966). Mesh and step refined together. Measured: order 2.0, down to 6.7e-5."""
    exact = reference.ting_triangle(SPHERE, PEAK, RISE, *TERMS["zener"])
    cells = np.array([8, 12, 16, 24, 32])
    errors = []
    for count in cells:
        times = vc.uniform_times(2 * RISE, 4 * count)
        load = vc.triangle(approach=PEAK, rise=RISE)
        material = BODIES["zener"].material
        runs = [
            pressed(material, load, times, LARGEST, cells=count + 0.3, odd=odd)
            for odd in (False, True)
        ]
        errors.append(np.mean([deviation(run.force, exact.force(times)) for run in runs]))
    assert errors[-1] < BOUND / 5
    assert order(1 / cells, errors) == close_to(2.0, abs=0.3)


def test_time_error_of_the_force_falls_with_the_square_of_the_step():
    """On one mesh, against 240 steps. Measured: order 2.03; 6e-4 at 15 steps, 4e-5 at 60."""
    material, load = BODIES["zener"].material, vc.triangle(approach=PEAK, rise=RISE)

    def force(steps):
        times = vc.uniform_times(2 * RISE, steps)
        return pressed(material, load, times, LARGEST, cells=10.3, tolerance=1e-9).force

    steps, fine = np.array([15, 30, 60]), force(240)
    errors = [deviation(force(n), fine[:: 240 // n]) for n in steps]
    assert errors[1] < 2e-4
    assert order(1 / steps, errors) == close_to(2.0, abs=0.2)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "sampled", "cells"),
    [
        ("zener", True, 44.3),
        ("relaxation_series", False, 110.3),
    ],
)
def test_stage_in_and_out_smoothly(name, sampled, cells):
    """Ting (1966) for a haversine, by quadrature. Measured, worst: force 1.6e-4, radius 9e-4.

    Where the contact has just begun to shrink, the gap just outside is next to nothing, and the
    traced rim is late by up to a tenth of a cell: hence the fine mesh of the law that is faster
    than the stage.
    """
    body, times = BODIES[name], vc.uniform_times(2 * RISE, 96)
    exact = reference.ting_hump(
        SPHERE, lambda t: haversine(t, PEAK), RISE, 2 * RISE, body.relaxation
    )
    load = (
        vc.ApproachHistory(times, haversine(times, PEAK))
        if sampled
        else vc.harmonic(
            approach=PEAK / 2, amplitude=-PEAK / 2, period=2 * RISE, cycles=1, phase=math.pi / 2
        )
    )
    run = pressed(body.material, load, times, LARGEST, cells=cells, odd=False)
    assert deviation(run.force, exact.force(times)) < BOUND / 3
    assert radius_deviation(run, exact.contact_radius(times)) < BOUND
    (_, found), (_, half) = run.changes()
    assert abs(found - exact.lost) <= half + 2e-4 * RISE


def test_force_up_and_down():
    """Ting (1966), by Lambert's function. Measured: approach 8e-5, radius 9e-4."""
    _, (modulus,), (time,) = TERMS["maxwell"]
    exact = reference.ting_force_triangle(FORCE, RISE, RADIUS, modulus, time)
    times = vc.uniform_times(2 * RISE, 120)
    largest = float(exact.contact_radius(exact.widest))
    run = pressed(BODIES["maxwell"].material, vc.triangle(FORCE, RISE), times, largest, cells=40.3)
    assert deviation(run.approach, exact.approach(times)) < BOUND / 4
    assert radius_deviation(run, exact.contact_radius(times)) < BOUND
    # Under a force contact ends with it, and not before.
    assert run.touching.tolist() == [False, *[True] * 119, False]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["burgers", "maxwell_with_elastic_bulk"])
def test_force_swings_three_times(name):
    """Graham (1965): haversines of force, sampled. Measured, worst: approach 2.5e-4, radius 9.9e-4.

    Where the contact has just begun to shrink, the gap just outside is next to nothing, and the
    traced rim is late by up to 0.09 of a cell: hence the fine mesh.
    """
    body, times = BODIES[name], vc.uniform_times(6 * RISE, 180)
    force = haversine(times, FORCE)
    force[::60] = 0.0
    exact = reference.press_axisymmetric(
        SPHERE, times, force=force, creep_compliance=body.creep, elements=150, substeps=2
    )
    load, largest = vc.ForceHistory(times, force), exact.contact_radius.max()
    run = pressed(body.material, load, times, largest, cells=100.3, odd=False, tolerance=1e-6)
    assert deviation(run.approach, exact.approach) < BOUND / 2
    assert radius_deviation(run, exact.contact_radius) < BOUND
    # A dent that a force has left is met again as soon as there is force.
    assert (run.touching == (force > 0)).all()
    assert deviation(np.array([state.work for state in run.states]), exact.work) < BOUND


@pytest.mark.parametrize("name", ["maxwell", pytest.param("zener", marks=pytest.mark.slow)])
def test_stage_and_force_jump(name):
    """Graham (1965) across jumps of approach: in, half out, in again, out, all at once.

    Measured: force 2e-4, radius 9e-4, both of the largest.
    """
    body = BODIES[name]
    corners = np.array([0, 40, 40, 80, 80, 120, 120.0, 160])
    levels = PEAK * np.array([1, 1, 0.6, 0.6, 0.9, 0.9, 0.4, 0.4])
    times = vc.uniform_times(160.0, 80)
    fine = np.sort(np.concatenate([times, [40, 80, 120]]))
    before = np.flatnonzero(np.diff(fine) == 0)
    given = np.interp(fine, corners[[0, 1, 3, 5, 7]], levels[[0, 2, 4, 6, 6]])
    given = vc.ApproachHistory(corners, levels).level_at(fine)
    given[before] = vc.ApproachHistory(corners, levels).level_at(fine[before], side="left")
    exact = reference.press_axisymmetric(
        SPHERE, fine, approach=given, creep_compliance=body.creep, substeps=4
    )
    after = np.delete(np.arange(len(fine)), before)
    load = vc.ApproachHistory(corners, levels)
    run = pressed(body.material, load, times, LARGEST, cells=40.3)
    assert deviation(run.force, exact.force[after]) < BOUND
    assert radius_deviation(run, exact.contact_radius[after]) < BOUND


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize("rise", [0.02, 0.1, 0.5])
def test_work_of_a_force_that_rises_in_steps_longer_than_the_law(rise):
    """Lee & Radok (1960): a^3 = (3 R/4) integral of C dF, the approach a^2/R, the work int F dw.

    Measured: 3e-4 to 7e-4; 6e-3 by mean pressures times changes of displacement.
    """
    material, end = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5), 20.0
    t = np.append(0.0, np.geomspace(1e-4, end, 4000))
    compliance = material.contact_compliance()(t)
    growth = compliance + rise / end * cumulative_trapezoid(compliance, t, initial=0)
    approach = np.cbrt(0.75 * RADIUS * FORCE * growth) ** 2 / RADIUS
    force = FORCE * (1 + rise * t / end)
    work = 0.4 * FORCE * approach[0] + cumulative_trapezoid(force, approach, initial=0)
    size = 2.6 * math.sqrt(RADIUS * approach[-1])
    ds = vc.simulate(
        *(vc.Paraboloid(RADIUS, RADIUS), material),
        vc.ForceHistory([0.0, end], [FORCE, FORCE * (1 + rise)]),
        *(vc.Grid((32, 32), (size, size)), vc.uniform_times(end, 8)),
        errors=False,
        fields="none",
    )
    np.testing.assert_allclose(ds.work, np.interp(ds.time, t, work), rtol=1.5e-3)
