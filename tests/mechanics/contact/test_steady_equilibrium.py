"""Contact of a body in steady motion: exact limits, symmetries, and hard cases."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.moving_domain import MovingDomain
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.contact.steady_equilibrium import solve_steady_contact
from viscontact.mechanics.halfspace.elastic_stack import ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.moving_surface import MovingSurface
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE
from viscontact.reference import (
    fast_sphere_friction_coefficient,
    hertz_sphere,
    slow_friction_coefficient,
)

RADIUS, FORCE, INSTANT = 10.0, 10.0, 1 / 2000
LEVEL, FREE = Constraints((FORCE, None, None)), Constraints((FORCE, 0.0, 0.0))


def zener(length, ratio=10.0):
    """Compliance with a modulus that relaxes by a ratio, at a retardation length."""
    return MovingCompliance(INSTANT, np.array([(ratio - 1) * INSTANT]), np.array([length]))


def pressed(compliance, grid, *, axis=0, mirrored=False, constraints=LEVEL, **options):
    """Solution, pressure on the whole grid and friction coefficient by the slope of a sphere."""
    domain = MovingDomain(grid, MovingSurface(((HALF_SPACE, compliance),)), axis, mirrored=mirrored)
    gap = vc.Paraboloid(RADIUS, RADIUS).gap(grid.x[:, None], grid.y[None, :])
    open_gap = domain.reduce_by_symmetry(gap)
    held = domain.reduced_constraints(constraints)
    problem = ContactProblem(open_gap, domain.compliance, held, 1e-15)
    solution = solve_steady_contact(problem, domain, **options)
    pressure = domain.expand_by_symmetry(solution.values[0])
    inner = pressure[1:-1, 1:-1]
    assert inner.sum() == close_to(pressure.sum(), rel=1e-12)  # the grid holds the contact
    position = grid.x[:, None] if axis == 0 else grid.y[None, :]
    slope = position / RADIUS - solution.motion[1 + axis]
    return solution, pressure, float((pressure * slope).sum() / pressure.sum())


def square(cells, side, offset=0.0):
    return vc.Grid((cells, cells), (side, side), centre=(offset, 0.0))


def dissipation(solution, grid, compliance):
    """Friction coefficient by the loss in the modes."""
    pressure = solution.values[0]
    lost = MovingDomain(grid, MovingSurface(((HALF_SPACE, compliance),)), 0).loss.apply(pressure)
    return float((pressure * lost).sum() / pressure.sum())


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("thickness", [np.inf, 0.1])
def test_local_compliance_is_that_of_the_top_material_for_the_longest_wave_along_the_motion(
    thickness, axis
):
    """|J0 + J1/(1 + i q l)| at the retardation length l; short waves do not feel the base."""
    layer = ElasticStack((ElasticLayer(thickness, 1.0, 0.45),), None)
    response = HALF_SPACE if thickness == np.inf else layer
    grid, length, ratio = vc.Grid((8, 12), (1.0, 6.0)), 0.5, 10.0
    domain = MovingDomain(grid, MovingSurface(((response, zener(length, ratio)),)), axis)
    q = 2 * np.pi / (1.0, 6.0)[axis]
    wave = INSTANT * abs(1 + (ratio - 1) / (1 + 1j * q * length))
    short = float(response.ratio(np.array(1e6)))
    assert domain.local_compliance == close_to(wave * short, rel=1e-9)


@pytest.mark.parametrize(("length", "compliance"), [(1e-6, 10 * INSTANT), (1e9, INSTANT)])
def test_at_both_ends_of_speed_the_sphere_is_that_of_hertz(length, compliance):
    hertz = hertz_sphere(FORCE, RADIUS, 1 / compliance)
    grid = square(64, 2.4 * hertz.contact_radius)
    solution, pressure, _ = pressed(zener(length), grid)
    assert solution.converged
    # The error of 27 cells a radius; measured 6e-5 and 3e-4.
    assert solution.motion[0] == close_to(hertz.approach, rel=2e-4)
    assert pressure.max() == close_to(hertz.peak_pressure, rel=1e-3)


def test_slow_friction_is_the_exact_limit():
    length, grid = 0.02, square(96, 1.72)
    _, _, friction = pressed(zener(length), grid)
    limit = slow_friction_coefficient(RADIUS, 0.9, length)
    # The next term is of the order of the length over the contact radius, 0.03; measured -0.022.
    assert friction == close_to(limit, rel=0.05)
    assert friction < limit


def test_fast_friction_is_the_exact_limit():
    length, grid = 1e4, square(64, 0.8)
    solution, _, _ = pressed(zener(length), grid, tolerance=1e-9)
    found = dissipation(solution, grid, zener(length))
    limit = fast_sphere_friction_coefficient(FORCE, RADIUS, INSTANT, 9 * INSTANT, length)
    # Measured: -1.8e-2, -2.2e-3 and -2.6e-4 at lengths of 1e2, 1e3 and 1e4.
    assert found == close_to(limit, rel=1e-3)


def test_slope_and_dissipation_give_the_same_friction():
    grid = square(96, 1.4, 0.22)
    solution, pressure, by_slope = pressed(zener(1.0), grid, tolerance=1e-8)
    # Measured: 9e-6.
    assert by_slope == close_to(dissipation(solution, grid, zener(1.0)), rel=5e-5)
    # The resultant lies ahead of the axis.
    assert (pressure * grid.x[:, None]).sum() > 0


def test_without_creep_it_is_the_contact_at_rest():
    grid = square(48, 0.8)
    rest = MovingCompliance(INSTANT, np.empty(0), np.empty(0))
    solution, pressure, friction = pressed(rest, grid, tolerance=1e-9)
    gap = vc.Paraboloid(RADIUS, RADIUS).gap(grid.x[:, None], grid.y[None, :])
    problem = ContactProblem(gap, INSTANT, LEVEL, 1e-15)
    elastic = solve_contact(problem, ContactDomain(grid), tolerance=1e-9)
    assert np.abs(pressure - elastic.values[0]).max() < 1e-7 * pressure.max()
    assert abs(friction) < 1e-9
    assert solution.motion[0] == close_to(elastic.motion[0], rel=1e-9)


def test_a_free_tilt_turns_the_body_back_by_the_friction_coefficient():
    """A paraboloid with a free tilt is a level one that is displaced: the friction is the same."""
    free, _, friction = pressed(zener(1.0), square(96, 1.4), constraints=FREE, tolerance=1e-8)
    _, _, level = pressed(zener(1.0), square(96, 1.4, 0.22), tolerance=1e-8)
    assert friction == close_to(-free.motion[1], rel=1e-6)
    assert friction == close_to(level, rel=5e-5)  # measured: 9e-6
    assert abs(free.motion[2]) < 1e-9


def test_one_half_of_an_even_body_and_exchanged_axes_give_the_same_pressure():
    grid = square(48, 1.4, 0.22)
    _, whole, _ = pressed(zener(1.0), grid, tolerance=1e-10)
    half, mirrored, _ = pressed(zener(1.0), grid, mirrored=True, tolerance=1e-10)
    assert half.values[0].shape == (48, 24)
    assert np.abs(mirrored - whole).max() < 1e-7 * whole.max()
    turned = vc.Grid((48, 48), (1.4, 1.4), centre=(0.0, 0.22))
    _, along_y, _ = pressed(zener(1.0), turned, axis=1, mirrored=True, tolerance=1e-10)
    assert np.abs(along_y.T - whole).max() < 1e-7 * whole.max()


def test_any_start_leads_to_the_same_pressure():
    grid = square(48, 1.4, 0.22)
    _, expected, _ = pressed(zener(1.0), grid, tolerance=1e-9)
    aside = np.zeros(grid.shape)
    aside[5, 20] = FORCE / grid.cell_area
    start = Guess.of(aside, aside, np.zeros(3))
    found, pressure, _ = pressed(zener(1.0), grid, tolerance=1e-9, guess=start)
    assert found.converged
    assert np.abs(pressure - expected).max() < 1e-7 * expected.max()


@pytest.mark.parametrize(
    ("ratio", "speed", "side", "offset"),
    [(100.0, 1e-3, 3.5, 0.06), (100.0, 0.01, 3.2, 0.5), (1000.0, 0.01, 3.0, 0.9)],
)
def test_large_loss_angles_are_solved_to_the_tolerance(ratio, speed, side, offset):
    """Speeds V tau/a at which the relaxation length is short and the retardation length long.

    Newton's method alone does not converge in the first of them.
    """
    radius = (0.75 * FORCE * RADIUS * ratio * INSTANT) ** (1 / 3)
    grid = square(64, side, offset)
    solution, pressure, _ = pressed(zener(speed * radius * ratio, ratio), grid, mirrored=True)
    assert solution.converged
    assert solution.residual <= 1e-6
    assert pressure.sum() * grid.cell_area == close_to(FORCE, rel=1e-9)
    assert solution.work < 1500
