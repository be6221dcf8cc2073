"""Whole runs under friction against exact solutions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

import viscontact as vc
from closeness import close_to

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RADIUS, FORCE, MU = 0.01, 10.0, 0.3
INSTANT, LATE, RETARDATION = 1 / 2000e6, 1 / 200e6, 1.0  # contact compliance [1/Pa], time [s]
LIMIT = MU * FORCE
UNCOUPLED = vc.Friction(MU, coupling=False)


def elastic(nu: float = 0.0, compliance: float = INSTANT) -> vc.Material:
    return vc.Material(vc.Elastic((1 - nu) / (2 * compliance)), nu)


def zener(nu: float = 0.0) -> vc.Material:
    grown = (LATE - INSTANT) / (1 - nu)
    return vc.Material(vc.CreepSeries(INSTANT / (1 - nu), [grown], [RETARDATION]), nu)


def hertz_radius(compliance: float, force: float = FORCE) -> float:
    return (3 * force * RADIUS * compliance / 4) ** (1 / 3)


def states(material, load, tangential, cells, **given):
    """States of a sphere on a grid of cells across 1.1 diameters of Hertz's contact."""
    compliance = given.pop("compliance", INSTANT)
    size = 2.2 * hertz_radius(compliance)
    times = given.pop("times")
    return list(
        vc.march(
            vc.Paraboloid(RADIUS, RADIUS),
            material,
            load,
            vc.Grid((cells, cells), (size, size)),
            times,
            friction=given.pop("friction", UNCOUPLED),
            tangential=tangential,
            **given,
        )
    )


def later(**given: float) -> vc.TangentialHistory:
    """Tangential load that comes at 1 s, after the normal one; both at once do not slip."""
    return vc.TangentialHistory([1.0], **given)


def mindlin_shift(force: float, nu: float = 0.0, limit: float = LIMIT) -> float:
    """Johnson 1985, eq. 7.42."""
    left = 1 - force / limit
    full = 3 * limit / (16 * hertz_radius(INSTANT)) * (2 - nu) * 2 * INSTANT / (1 - nu)
    return full * (1 - left ** (2 / 3))


def test_a_sphere_shifts_after_cattaneo_and_mindlin():
    """With its own pressure: measured 2e-5 at 64 cells across 1.1 diameters."""
    (state,) = states(elastic(), vc.step(FORCE), later(force_x=1.5), 64, times=[1.0])
    assert state.tangential_displacement_x == close_to(mindlin_shift(1.5), rel=1e-4)
    assert state.slip_fraction == close_to(1 - (1 - 1.5 / LIMIT) ** (2 / 3), abs=0.01)
    assert state.tangential_force_x == close_to(1.5, rel=1e-9)
    assert state.duality_gap < 1e-6


def test_two_equal_bodies_are_uncoupled_and_yield_twice():
    """Their compliances and ν add, so that the shift of Johnson's eq. 7.42 doubles."""
    nu = 0.3
    one = elastic(nu, INSTANT / 2)
    given = {"times": [1.0], "friction": MU, "indenter_material": one}
    (both,) = states(one, vc.step(FORCE), later(force_x=0.5), 32, **given)
    (alone,) = states(elastic(nu), vc.step(FORCE), later(force_x=0.5), 32, times=[1])
    assert both.tangential_displacement_x == close_to(alone.tangential_displacement_x, rel=1e-9)
    assert both.tangential_displacement_x == close_to(mindlin_shift(0.5, nu), rel=5e-3)


@pytest.mark.parametrize("steps", [1, 3])
def test_heat_of_a_loop_after_mindlin_and_deresiewicz(steps):
    """Their loop of the virgin curve, scaled by two: also at one step a quarter of a cycle."""
    force = 1.5
    points = [0, force, -force, force, -force]
    tangential = vc.TangentialHistory([0, 1, 3, 5, 7], force_x=points)
    times = [0.0, *np.arange(1, 7 * steps + 1) / steps]
    found = states(elastic(), vc.step(FORCE), tangential, 48, times=times)

    def upper(at):
        return mindlin_shift(force) - 2 * mindlin_shift((force - at) / 2)

    area = quad(lambda at: upper(at) + upper(-at), -force, force)[0]
    heats = {round(state.time, 6): state.friction_heat for state in found}
    assert heats[7.0] - heats[3.0] == close_to(area, rel=2e-3)
    assert found[-1].tangential_displacement_x == close_to(-mindlin_shift(force), rel=1e-4)
    # Each cell's work of friction adds up to the heat.
    cell_area = found[-1].grid.cell_area
    assert float(found[-1].friction_work.sum()) * cell_area == close_to(heats[7.0], rel=1e-12)


@pytest.mark.parametrize(("nu", "error"), [(0.0, 1e-6), (0.3, 2e-5), (0.5, 5e-5)])
def test_an_oblique_load_on_a_creeping_sphere_never_slips(nu, error):
    """Q = κ W at all times: q = κ p, shift κ (2 - ν)/(2 (1 - ν)) a²/R, and no heat.

    The displacement under proportional tractions is that of elastic spheres in growing contact
    (Mindlin & Deresiewicz 1953), at all times by the correspondence principle.
    """
    part = 0.15
    found = states(
        zener(nu),
        vc.step(FORCE),
        vc.tangential_step(force_x=part * FORCE),
        48,
        times=np.linspace(0, 10, 7),
        compliance=LATE,
    )
    ratio = part * (2 - nu) / (2 * (1 - nu))
    for state in found:
        # The approach is a²/R.
        assert state.tangential_displacement_x == close_to(ratio * state.approach, rel=error)
        assert state.slip_fraction == 0
        assert state.friction_heat == 0
    inner = found[-1].pressure > 0.3 * found[-1].peak_pressure
    ratios = found[-1].traction_x[inner] / found[-1].pressure[inner]
    # Largest in the cells that the edge passed through at the end of a step.
    np.testing.assert_allclose(ratios, part, rtol=0.03)


@pytest.mark.parametrize("nu", [0.17, 0.42, pytest.param(0.5, marks=pytest.mark.slow)])
def test_tractions_of_an_oblique_load_follow_the_pressure_but_at_the_edges_of_steps(nu):
    """q/p is the same to 1 % in all cells but those within one of an edge at the end of a step."""
    part = 0.22
    found = states(
        zener(nu),
        vc.step(FORCE),
        vc.tangential_step(force_x=part * FORCE),
        72,
        times=np.linspace(0, 10, 7),
        compliance=LATE,
    )
    last, cell = found[-1], found[-1].grid.cell_size[0]
    distance = np.hypot(last.grid.x[:, None], last.grid.y[None, :])
    edges = [np.sqrt(np.count_nonzero(each.in_contact) / np.pi) * cell for each in found]
    inside = last.in_contact & (np.min([abs(distance - edge) for edge in edges], axis=0) > cell)
    assert np.count_nonzero(inside) > 0.75 * np.count_nonzero(last.in_contact)
    ratios = last.traction_x[inside] / last.pressure[inside]
    np.testing.assert_allclose(ratios, part, rtol=0.01)
    assert max(each.slip_fraction for each in found) == 0


def test_a_clamped_stage_keeps_its_stick_zone():
    """Approach and shift held: all forces relax as the modulus, and c/a does not change."""
    approach = hertz_radius(INSTANT) ** 2 / RADIUS
    shift = 0.5 * mindlin_shift(2.4)
    material = zener()
    found = states(
        material,
        vc.step(approach=approach),
        vc.tangential_step(displacement_x=shift),
        40,
        times=vc.uniform_times(2.0, 100),
    )
    first, last = found[0], found[-1]
    # The relaxation function of the contact: G(t)/G(0).
    relaxed = float(material.law.relaxation(2.0) / material.law.relaxation(0.0))
    assert last.force / first.force == close_to(relaxed, rel=1e-4)
    assert last.tangential_force_x / first.tangential_force_x == close_to(relaxed, rel=1e-4)
    assert (last.slip_state == first.slip_state).all()
    np.testing.assert_allclose(
        last.traction_x, relaxed * first.traction_x, atol=1e-3 * np.abs(first.traction_x).max()
    )


def test_elastic_bodies_do_not_depend_on_the_rate():
    """The same loads in other times and, between its kinks, in more steps."""
    points = {"force_x": [0, 1.5, -1.2, 0.3], "force_y": [0, 0.5, 0.5, -0.5]}
    load = vc.ForceHistory([0, 1, 2, 3], [FORCE, FORCE, 1.1 * FORCE, FORCE])
    slow = vc.ForceHistory([0, 50, 60, 300], [FORCE, FORCE, 1.1 * FORCE, FORCE])
    one = states(
        elastic(), load, vc.TangentialHistory([0, 1, 2, 3], **points), 24, times=[0, 1, 2, 3]
    )
    other = states(
        elastic(),
        slow,
        vc.TangentialHistory([0, 50, 60, 300], **points),
        24,
        times=[0, 50, 60, 300],
    )
    assert len(one) == 4
    for ours, theirs in zip(one, other, strict=True):
        for name in ("tangential_displacement_x", "tangential_displacement_y", "friction_heat"):
            assert getattr(ours, name) == close_to(getattr(theirs, name), rel=1e-9, abs=1e-18)


def test_torsion_slides_at_lubkins_limit():
    """Lubkin 1951: at a large rotation all slides, under 3π/16 μ W a."""
    radius = hertz_radius(INSTANT)
    (state,) = states(elastic(0.3), vc.step(FORCE), later(rotation=1.0), 48, times=[1.0])
    assert state.torque == close_to(3 * np.pi / 16 * LIMIT * radius, rel=2e-3)
    assert state.slip_fraction == 1


def test_a_small_torque_holds_the_sphere():
    """Mindlin 1949: a rotation of 3 M/(16 G a³) under full stick, to first order in the cells."""
    radius, modulus = hertz_radius(INSTANT), 1 / (2 * INSTANT)
    torque = 0.02 * LIMIT * radius
    (state,) = states(elastic(), vc.step(FORCE), later(torque=torque), 48, times=[1.0])
    assert state.rotation == close_to(3 * torque / (16 * modulus * radius**3), rel=0.04)


def test_contact_that_is_lost_takes_its_traction_along():
    """After it comes back, nothing is left of the slip before on an elastic body."""
    load = vc.ForceHistory([0, 1, 2, 3], [FORCE, 0, 0, FORCE])
    tangential = vc.TangentialHistory([0, 0.5, 1, 2, 3], force_x=[1.0, 0.3, 0, 0, 1.0])
    found = states(elastic(), load, tangential, 24, times=[0, 0.5, 1.5, 3.0])
    assert found[2].tangential_force_x == 0
    assert not found[2].slip_x.any()
    assert found[3].tangential_force_x == close_to(1.0, rel=1e-9)
    # Loaded together from zero, all sticks.
    assert found[3].slip_fraction < 0.02


def test_line_contact_sticks_after_cattaneo():
    """A cylinder: c/a = (1 - Q/(μ W))^(1/2) (Johnson 1985, eq. 7.30); it has no datum."""
    grid = vc.Grid((1, 160), (1e-3, 1.5e-3), periodic=(True, False))
    force, part = 2.0, 0.6
    cylinder = vc.Roller(RADIUS, 1.0)
    (state,) = vc.march(
        cylinder,
        vc.Material(vc.Elastic(40e6), 0.5),
        vc.step(force),
        grid,
        [1.0],
        friction=MU,
        tangential=later(force_y=part * MU * force),
    )
    assert np.isnan(state.tangential_displacement_y)
    stick = np.sqrt(1 - part)
    assert 1 - state.slip_fraction == close_to(stick, abs=0.03)


@pytest.mark.parametrize(("stick", "torque"), [(0.9, 0.1763), (0.7, 0.4097), (0.5, 0.5286)])
def test_the_twist_of_a_sphere_follows_lubkin(stick, torque):
    """Lubkin 1951: the twist at a stick radius c a is 3 μ W/(4π G a²) (K - E)(k'), k'² = 1 - c²."""
    radius, modulus = hertz_radius(INSTANT), 1 / (2 * INSTANT)
    (state,) = states(
        elastic(), vc.step(FORCE), later(torque=torque * LIMIT * radius), 64, times=[1.0]
    )
    squared = 1 - stick**2
    twist = 3 * LIMIT / (4 * np.pi * modulus * radius**2) * (ellipk(squared) - ellipe(squared))
    # The torques are rounded to four digits.
    assert state.rotation == close_to(twist, rel=8e-4)
    assert np.sqrt(1 - state.slip_fraction) == close_to(stick, abs=0.02)


def test_a_jump_of_the_force_on_a_creeping_sphere():
    """Partial slip of the instant compliance on the pressure of Lee and Radok (1960).

    This pressure is a sum of those of flat punches of all radii s, h(s) ds/sqrt(s² - r²), with
    h = 2 M(t - t(s)) s/(π R) and t(s) the time at which the contact had the radius s. By
    Ciavarella's theorem (1998) the tractions are μ of those with s > c.
    """
    retardation, time, force = 10.0, 10.0, 1.5

    def compliance(t):
        return INSTANT + (LATE - INSTANT) * (1 - np.exp(-t / retardation))

    def begun(s):
        grown = 4 * s**3 / (3 * FORCE * RADIUS)
        if grown <= INSTANT:
            return 0.0
        return -retardation * np.log(1 - (grown - INSTANT) / (LATE - INSTANT))

    def density(s):
        t, relaxation = time - begun(s), retardation * INSTANT / LATE
        modulus = 1 / LATE + (1 / INSTANT - 1 / LATE) * np.exp(-t / relaxation)
        return 2 * modulus * s / (np.pi * RADIUS)

    edge = (3 * FORCE * RADIUS * compliance(time) / 4) ** (1 / 3)

    def carried(c):
        points = [hertz_radius(INSTANT)] if c < hertz_radius(INSTANT) else None
        return quad(lambda s: MU * 2 * np.pi * s * density(s), c, edge, points=points)[0]

    assert carried(0.0) == close_to(LIMIT, rel=1e-6)  # of Lee and Radok: the whole force
    stick = brentq(lambda c: carried(c) - force, 0.0, edge)
    shift = MU * np.pi * INSTANT * quad(density, stick, edge)[0]
    grown = LATE - INSTANT
    material = vc.Material(vc.CreepSeries(INSTANT, [grown], [retardation]), 0.0)
    found = states(
        material,
        vc.step(FORCE),
        vc.TangentialHistory([time], force_x=force),
        64,
        times=vc.log_times(0.02, time, 60),
        compliance=float(compliance(time)),
    )
    assert found[-1].tangential_displacement_x == close_to(shift, rel=6e-4)
    assert np.sqrt(1 - found[-1].slip_fraction) == close_to(stick / edge, abs=0.02)


@pytest.mark.parametrize("cells", [30, 42])
def test_error_bars_of_a_loop_hold(cells):
    """Errors from the solutions of Cattaneo, Mindlin and Deresiewicz, in coefficients of others."""
    force, limit = 0.9, 0.45 * FORCE
    exact = vc.reference.cattaneo_mindlin(FORCE, RADIUS, 1 / INSTANT, force, 0.45)
    size = 2.6 * hertz_radius(INSTANT)
    ds = vc.simulate(
        vc.Paraboloid(RADIUS, RADIUS),
        elastic(),
        vc.step(FORCE),
        vc.Grid((cells, cells), (size, size)),
        [1.0, 2.0, 4.0, 6.0, 8.0],
        friction=vc.Friction(0.45, coupling=False),
        tangential=vc.TangentialHistory(
            [1, 2, 4, 6, 8], force_x=force * np.array([0, 1, -1, 1, -1])
        ),
        fields="none",
    )
    stick = (1 - force / limit) ** (2 / 3)
    for name, true in (
        ("tangential_displacement_x", exact.displacement),
        ("slip_fraction", 1 - stick),
        ("stick_area", np.pi * exact.stick_radius**2),
    ):
        assert abs(float(ds[name][1]) - true) < float(ds[f"{name}_error"][1]) < 0.6 * true
    heat = float(ds.friction_heat[4] - ds.friction_heat[2])
    assert abs(heat - exact.heat_of_cycle) < float(ds.friction_heat_error[4])
    assert float(ds.tangential_force_x_error[1]) < 1e-5 * force


def test_an_elastic_bulk_modulus_creeps_along_the_surface_as_theory_says():
    """A flat punch that sticks: q in the ratio of p, shift Q/(4 a) (2 - ν)/(2 G), for any ν.

    By correspondence (2 - ν)/(2 G) becomes J(t) + Φ(t), of (1 - ν)/(2 G) and 1/(2 G), whose ratio
    is not constant here. The same cells under an elastic body give the factor of the cells.
    """
    law, bulk, grid = vc.Zener(1e6, 5e5, 5e5), 3e6, vc.Grid((24, 24), (2.4e-3, 2.4e-3))
    material, plain = vc.Material(law, bulk_modulus=bulk), vc.Material(vc.Elastic(1e6), 0.0)
    found, reference = (
        list(
            vc.march(
                vc.FlatPunch(1e-3),
                body,
                vc.step(1.0),
                grid,
                [0.0, 0.5, 1.0, 4.0],
                friction=UNCOUPLED,
                tangential=vc.tangential_step(force_x=0.15),
                tolerance=1e-8,
            )
        )
        for body in (material, plain)
    )
    assert all(state.slip_fraction == 0 for state in found)
    of_cells = reference[0].tangential_displacement_x * 1e6  # at J + Φ = 2/(2 G)
    for state in found:
        crept = float(material.contact_compliance()(state.time) + law(state.time))
        # Of first order in the cells: 6e-4 on these, 3e-4 and 1.4e-4 on twice and four times them.
        assert state.tangential_displacement_x == close_to(of_cells * crept, rel=2e-3)
    late, first = found[-1], found[0]
    ratio = late.tangential_displacement_x / first.tangential_displacement_x
    assert abs(ratio / (late.approach / first.approach) - 1) > 0.05
