"""Verification cases of elastic contacts: the error of the mesh alone."""

from __future__ import annotations

import math

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Cone, FlatPunch, Paraboloid, Roller
from viscontact.bodies.laws import Elastic
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.verify.case import Case, Comparison, Quantity, single, with_mean_error
from viscontact.verify.indentation import BALL, FORCE, RADIUS, grid_around, press

MODULUS = 2e9  # contact modulus of the body [Pa]
BODY = Material(Elastic(0.35 * MODULUS), poisson_ratio=0.3)

_HALF_ANGLE = math.radians(87)
_PUNCH, _ASIDE = 5e-3, 1e-3  # radius and eccentricity [m]


def _sphere(cells: int) -> tuple[Comparison, ...]:
    exact = reference.hertz_sphere(FORCE, RADIUS, MODULUS)
    a = exact.contact_radius
    run = press(BODY, step(FORCE), [0.0], grid_around((a, a), cells + 0.3))
    return (
        single(exact.approach, run.states[0].approach),
        single(exact.peak_pressure, run.central_pressure[0]),
        single(a, run.radius[0]),
    )


def _ellipse(cells: int) -> tuple[Comparison, ...]:
    exact = reference.hertz_elliptical(FORCE, 5 * RADIUS, RADIUS, MODULUS)
    axes = (exact.semi_axis_x, exact.semi_axis_y)
    shape = Paraboloid(5 * RADIUS, RADIUS)
    run = press(BODY, step(FORCE), [0.0], grid_around(axes, cells + 0.3), indenter=shape)
    return (
        single(exact.approach, run.states[0].approach),
        single(exact.peak_pressure, run.central_pressure[0]),
        single(math.pi * axes[0] * axes[1], run.states[0].contact_area),
    )


def _roller(cells: int) -> tuple[Comparison, ...]:
    """Peak pressure under the middle section's force: the sharp ends carry an excess."""
    radius = half_length = 5e-3
    b = radius / 100
    force = math.pi * MODULUS * b**2 / (4 * radius) * 2 * half_length
    across = 2 * int(1.3 * cells + 1) + 1
    grid = Grid((65, across), (2.2 * half_length, across * b / (cells + 0.3)))
    run = press(BODY, step(force), [0.0], grid, indenter=Roller(radius, half_length))
    profile = run.states[0].pressure[32]
    exact = reference.hertz_line(float(profile.sum()) * grid.cell_size[1], radius, MODULUS)
    return (single(exact.peak_pressure, float(profile.max())),)


def _punch(cells: int) -> tuple[Comparison, ...]:
    """Mean errors of several meshes, since the error of the edge varies with the cells."""
    exact = reference.flat_punch(FORCE, _PUNCH, MODULUS, _ASIDE)
    load, found = step(FORCE, eccentricity_x=_ASIDE), []
    for part in (0.95, 0.97, 0.99, 1.0, 1.02, 1.05):
        grid = grid_around((_PUNCH, _PUNCH), part * cells, margin=1.1, odd=part < 1)
        (state,) = press(BODY, load, [0.0], grid, indenter=FlatPunch(_PUNCH)).states
        found.append((single(exact.approach, state.approach), single(exact.tilt_x, state.tilt_x)))
    approaches, tilts = zip(*found, strict=True)
    return with_mean_error(approaches), with_mean_error(tilts)


def _cone(cells: int) -> tuple[Comparison, ...]:
    exact = reference.cone(FORCE, _HALF_ANGLE, MODULUS)
    a = exact.contact_radius
    grid = grid_around((a, a), cells + 0.3)
    run = press(BODY, step(FORCE), [0.0], grid, indenter=Cone(_HALF_ANGLE))
    return (
        single(exact.approach, run.states[0].approach),
        single(exact.mean_pressure, run.states[0].mean_pressure),
        single(a, run.radius[0]),
    )


def _energy(cells: int) -> tuple[Comparison, ...]:
    exact = reference.hertz_sphere(FORCE, RADIUS, MODULUS)
    a = exact.contact_radius
    run = press(BODY, step(FORCE), [0.0], grid_around((a, a), cells + 0.3), indenter=BALL)
    return (single(0.4 * FORCE * exact.approach, run.states[0].work),)


CASES: tuple[Case, ...] = (
    Case(
        "sphere",
        "Hertz 1882",
        (
            Quantity("approach", "m", 5e-4, 1e-4),
            Quantity("central pressure", "Pa", 5e-4, 1e-4),
            Quantity("contact radius", "m", 5e-3, 2e-3),
        ),
        (10, 20, 40, 80),
        _sphere,
    ),
    Case(
        "work of a sudden load on a sphere",
        "Hertz 1882",
        (Quantity("work", "J", 1e-3, 2e-4),),
        (10, 20, 40, 80),
        _energy,
    ),
    Case(
        "ellipse of axes 1 to 3",
        "Hertz 1882",
        (
            Quantity("approach", "m", 1e-3, 2e-4),
            Quantity("central pressure", "Pa", 1e-3, 2e-4),
            Quantity("contact area", "m2", 1e-2, 4e-3),
        ),
        (10, 20, 40, 80),
        _ellipse,
    ),
    Case(
        "middle of a long roller",
        "Hertz 1882, Johnson 1985",
        (Quantity("peak pressure", "Pa", 1e-3, 4e-4),),
        (10, 20, 40, 80),
        _roller,
    ),
    Case(
        "flat punch, eccentric",
        "Sneddon 1965",
        (Quantity("approach", "m", 1.5e-2, 8e-3), Quantity("tilt", "rad", 4e-2, 2e-2)),
        (16, 32, 64, 128),
        _punch,
    ),
    Case(
        "cone",
        "Love 1939, Sneddon 1965",
        (
            Quantity("approach", "m", 5e-4, 1e-4),
            Quantity("mean pressure", "Pa", 1e-2, 4e-3),
            Quantity("contact radius", "m", 5e-3, 2e-3),
        ),
        (10, 20, 40, 80),
        _cone,
    ),
)
