"""Elastic contacts of smooth bodies against Hertz (1882), as in Johnson, Contact Mechanics (1985).

Tolerances are two to four times what was measured, which is given beside them.
"""

import math

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

import viscontact as vc
from closeness import close_to
from verification.pressing import (
    BALL,
    ELASTIC,
    FORCE,
    MODULUS,
    RADIUS,
    Shifted,
    grid_around,
    order,
    over_time,
    press,
)
from viscontact import reference

SPHERE = reference.hertz_sphere(FORCE, RADIUS, MODULUS)


@pytest.mark.parametrize("odd", [False, True], ids=["rim between cells", "cell at the centre"])
@pytest.mark.parametrize("cells", [49.81, 50.0, 50.37])
def test_sphere_at_50_cells_a_radius_follows_hertz(cells, odd):
    """Johnson (1985), eqs. 4.22-4.24.

    Measured at the default solver tolerance: approach 2.0e-5, central pressure 2.3e-5, area
    7.8e-4, extents 1.9e-3.
    """
    a = SPHERE.contact_radius
    grid = grid_around((a, a), (cells, cells), odd=odd)
    state = press(BALL, grid)
    middle = grid.shape[0] // 2
    expected = SPHERE.pressure(math.hypot(grid.x[middle], grid.y[middle]))
    assert state.approach == close_to(SPHERE.approach, rel=5e-5)
    assert state.pressure[middle, middle] == close_to(expected, rel=1e-4)
    assert state.peak_pressure == close_to(SPHERE.peak_pressure, rel=2e-4)
    assert state.contact_area == close_to(math.pi * a**2, rel=2e-3)
    assert state.contact_length == close_to(2 * a, rel=4e-3)
    assert state.contact_width == close_to(2 * a, rel=4e-3)


def test_error_of_the_approach_falls_with_the_square_of_the_cell_size():
    """Johnson (1985), eq. 4.23; on meshes that hit centre and rim by chance, 6 of each fineness.

    A single family of meshes is lucky or unlucky with its rim. Measured: order 1.96.
    """
    rng = np.random.default_rng(0)
    a, cells = SPHERE.contact_radius, np.array([12, 17, 25, 36, 50])
    errors = [np.mean([_approach_error(n, a, rng) for _ in range(6)]) for n in cells]
    assert order(1 / cells, errors) == close_to(2.0, abs=0.2)


def _approach_error(cells, a, rng):
    cells = cells * rng.uniform(0.97, 1.03)
    shift = rng.uniform(-0.5, 0.5, 2) * a / cells
    grid = grid_around((a, a), (cells, cells))
    state = press(Shifted(BALL, *shift), grid, tolerance=1e-8, tilt_x=0.0, tilt_y=0.0)
    return abs(state.approach / SPHERE.approach - 1)


def test_pressure_approaches_the_hemisphere_in_every_cell():
    """Johnson (1985), eq. 3.39: away from the rim of second order, at it, first.

    Inside 0.9 a, measured 1.0e-3, 2.4e-4 and 6.2e-5 of the peak at 12, 24 and 48 cells.
    """
    a, cells = SPHERE.contact_radius, np.array([12.4, 24.3, 48.6])
    errors = [_pressure_error(n, a) for n in cells]
    assert errors[-1] < 2e-4
    assert order(1 / cells, errors) > 1.7


def _pressure_error(cells, a):
    grid = grid_around((a, a), (cells, cells))
    r = np.hypot(grid.x[:, None], grid.y[None, :])
    error = press(BALL, grid).pressure - SPHERE.pressure(r)
    return np.abs(error[r < 0.9 * a]).max() / SPHERE.peak_pressure


def test_paraboloid_under_an_eccentric_force_rolls_without_changing():
    """x²/(2 R) - tilt x is the same paraboloid about x = R tilt: so tilt = e/R, exactly.

    The approach at the origin is Hertz's less e²/(2 R). Measured: tilts to 6e-13, whatever the
    mesh, for the tilted paraboloid is one on every mesh; approach 4.7e-5 at 25 cells a radius.
    """
    a = SPHERE.contact_radius
    along, across = 0.5 * a, -0.3 * a
    grid = vc.Grid((100, 90), (4.0 * a, 3.6 * a))
    state = press(BALL, grid, eccentricity_x=along, eccentricity_y=across, tolerance=1e-9)
    assert state.tilt_x == close_to(along / RADIUS, rel=1e-8)
    assert state.tilt_y == close_to(across / RADIUS, rel=1e-8)
    lift = (along**2 + across**2) / (2 * RADIUS)
    assert state.approach + lift == close_to(SPHERE.approach, rel=2e-4)


# Ellipses.

AXIS_RATIOS = [1.5, 4.0, 10.0]


def elliptical(axis_ratio, *, along_x=True):
    """A paraboloid whose contact has this axis ratio (Johnson, eq. 4.26), and its solution."""
    parameter = 1 - axis_ratio**-2
    first, second = ellipk(parameter), ellipe(parameter)
    radius_ratio = (axis_ratio**2 * second - first) / (first - second)
    radii = (RADIUS * radius_ratio, RADIUS) if along_x else (RADIUS, RADIUS * radius_ratio)
    return vc.Paraboloid(*radii), reference.hertz_elliptical(FORCE, *radii, MODULUS)


@pytest.mark.parametrize("along_x", [True, False], ids=["long in x", "long in y"])
@pytest.mark.parametrize("axis_ratio", AXIS_RATIOS)
def test_ellipse_on_cells_of_its_own_shape_follows_hertz(axis_ratio, along_x):
    """Johnson (1985), section 4.2, at 25 cells a semi-axis, up to an axis ratio of 10.

    Measured, worst of all: approach 6.4e-5, peak 1.4e-4, area 1.2e-3, axes 7.5e-3, a fifth of
    a cell: at the tip of the 10:1 ellipse, whose own radius is a quarter of a cell, the gap does
    not open like that of a smooth rim. Hertz's formulas are written with Carlson's integrals in
    `reference` and checked there.
    """
    indenter, ellipse = elliptical(axis_ratio, along_x=along_x)
    axes = (ellipse.semi_axis_x, ellipse.semi_axis_y)
    assert max(axes) / min(axes) == close_to(axis_ratio, rel=1e-9)
    state = press(indenter, grid_around(axes, (25.3, 25.3)), tolerance=1e-8)
    assert state.approach == close_to(ellipse.approach, rel=1.5e-4)
    assert state.peak_pressure == close_to(ellipse.peak_pressure, rel=3e-4)
    assert state.contact_length == close_to(2 * axes[0], rel=1e-2)
    assert state.contact_width == close_to(2 * axes[1], rel=1e-2)
    assert state.contact_area == close_to(math.pi * axes[0] * axes[1], rel=3e-3)


@pytest.mark.parametrize(
    ("cells", "approach", "peak", "area"),
    [
        pytest.param((253, 25.3), 5e-5, 5e-5, 2e-3, id="square cells"),  # 1.9e-5, 1.2e-5, 5e-4
        pytest.param((16.8, 50.3), 3e-4, 8e-4, 3e-3, id="30:1 cells"),  # 1.3e-4, 3.6e-4, 6e-4
    ],
)
def test_slender_ellipse_does_not_mind_the_shape_of_the_cells(cells, approach, peak, area):
    """Johnson (1985), section 4.2; axis ratio 10; measured errors beside the tolerances."""
    indenter, ellipse = elliptical(10.0)
    axes = (ellipse.semi_axis_x, ellipse.semi_axis_y)
    state = press(indenter, grid_around(axes, cells), tolerance=1e-8)
    assert state.approach == close_to(ellipse.approach, rel=approach)
    assert state.peak_pressure == close_to(ellipse.peak_pressure, rel=peak)
    assert state.contact_area == close_to(math.pi * axes[0] * axes[1], rel=area)


def test_error_of_a_slender_ellipse_falls_with_the_square_of_the_cell_size():
    """Johnson (1985), section 4.2; axis ratio 10, cells of the same shape. Measured: 1.7."""
    indenter, ellipse = elliptical(10.0)
    axes, cells = (
        (ellipse.semi_axis_x, ellipse.semi_axis_y),
        np.array([9.7, 13.6, 19.1, 26.8, 37.4]),
    )

    def error(n, odd):
        state = press(indenter, grid_around(axes, (n, 1.04 * n), odd=odd), tolerance=1e-8)
        return abs(state.approach / ellipse.approach - 1)

    errors = [(error(n, False) + error(n, True)) / 2 for n in cells]
    assert order(1 / cells, errors) == close_to(2.0, abs=0.4)


def test_middle_of_a_long_roller_is_a_line_contact():
    """Johnson (1985), eqs. 4.43-4.45; L = 100 b, cells 70 times as long as wide.

    The force per length is that of the middle section itself: the ends, which are sharp, carry
    more than their share, so force over length would be 5 % off. In the middle the pressure
    varies along x on the scale L, which bends the profile by some (b/L)² only; the section's
    circle against the parabola adds b²/(4 R²) = 2.5e-5. Measured: peak 1.9e-5, width 9.3e-4
    (from the zero of a straight line through p² against y²).
    """
    radius, half_length = 0.005, 0.005
    b = radius / 100
    force = math.pi * MODULUS * b**2 / (4 * radius) * 2 * half_length
    grid = vc.Grid((65, 53), (2.2 * half_length, 53 * b / 20.3))
    with pytest.warns(vc.AccuracyWarning, match="end of the indenter's profile"):
        state = press(vc.Roller(radius, half_length), grid, force=force)
    profile = state.pressure[32]
    line = reference.hertz_line(profile.sum() * grid.cell_size[1], radius, MODULUS)
    pressed = profile > 0
    slope, top = np.polyfit(grid.y[pressed] ** 2, profile[pressed] ** 2, 1)
    assert profile.max() == close_to(line.peak_pressure, rel=2e-4)
    assert math.sqrt(-top / slope) == close_to(line.half_width, rel=3e-3)


# Work and unloading.


def test_work_of_a_sudden_load_is_the_elastic_energy():
    """Johnson (1985), eq. 4.23: F = c approach^1.5, so the energy is (2/5) F approach.

    Measured: 6e-5 at 25 cells a radius, all of it the mesh.
    """
    a = SPHERE.contact_radius
    state = press(BALL, grid_around((a, a), (25.3, 25.3)))
    assert state.work == close_to(0.4 * FORCE * SPHERE.approach, rel=2e-4)


@pytest.mark.parametrize("steps", [1, 10, 40])
def test_work_of_an_elastic_ramp_is_its_energy_in_any_steps(steps):
    """Johnson (1985), eq. 4.23; what elastic work comes to is no matter of the way."""
    a = SPHERE.contact_radius
    grid = grid_around((a, a), (25.3, 25.3))
    states = pressed_over_time(vc.ramp(FORCE, 1.0), grid, vc.uniform_times(1.0, steps))
    assert states[-1].work == close_to(press(BALL, grid).work, rel=1e-6)
    assert states[-1].work == close_to(0.4 * FORCE * SPHERE.approach, rel=2e-4)


CYCLES = [
    vc.triangle(FORCE, 1.0, 0.3),
    vc.triangle(approach=SPHERE.approach, rise=1.0, fall=0.3),
    vc.ForceHistory([0.0, 1.0, 1.0], [FORCE, FORCE, 0.0]),
    vc.ForceHistory([0.0, 0.5, 0.5, 1.0, 1.0], [0.0, 0.0, FORCE, FORCE, 0.0]),
]


@pytest.mark.parametrize("load", CYCLES)
@pytest.mark.parametrize("times", [[2.0], [0.3, 0.9, 1.2, 2.0], vc.adaptive_times(2.0, 0.01)])
def test_an_elastic_cycle_costs_nothing_in_any_steps(load, times):
    """Energy is conserved, also where contact begins, ends, or jumps within a step."""
    a = SPHERE.contact_radius
    final = pressed_over_time(load, grid_around((a, a), (12.3, 12.3)), times)[-1]
    most = 0.4 * FORCE * SPHERE.approach
    assert final.force == 0
    assert abs(final.work) < 1e-6 * most  # the solver's tolerance
    assert abs(final.loss_per_cycle) < 1e-6 * most


def test_elastic_body_forgets_everything_when_the_force_is_gone():
    """An elastic contact is a function of the force alone: the way down is the way up."""
    a = SPHERE.contact_radius
    grid = grid_around((a, a), (25.3, 25.3))
    states = pressed_over_time(vc.triangle(FORCE, 1.0), grid, vc.uniform_times(2.0, 20))
    final, scale = states[-1], SPHERE.approach
    assert final.outcome is vc.Outcome.NO_CONTACT
    assert final.force == final.contact_area == final.peak_pressure == 0
    assert abs(final.approach) < 1e-12 * scale  # measured: exactly 0
    assert np.abs(final.displacement).max() < 1e-12 * scale
    assert abs(final.work) < 1e-6 * FORCE * scale  # the solver's tolerance
    for name in ("approach", "contact_area", "peak_pressure"):
        there = over_time(states, name)
        np.testing.assert_allclose(there[:11], there[:9:-1], rtol=1e-5)


def pressed_over_time(load, grid, times):
    return list(vc.march(BALL, ELASTIC, load, grid, times))
