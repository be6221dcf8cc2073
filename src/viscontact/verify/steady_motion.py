"""Verification cases of steady motion: Hunter's cylinder, and a sphere at high speed."""

from __future__ import annotations

import math
import warnings
from functools import partial

import xarray as xr

from viscontact import reference
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter, Paraboloid
from viscontact.bodies.laws import CreepSeries
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.runs.steady import steady
from viscontact.verify.case import Case, Comparison, Quantity, single, with_mean_error

# Units of the theory: the contact is 4 to 15 % of the radius wide.
_RADIUS, _INSTANT, _DELAYED, _TIME = 10.0, 1 / 2000, 9 / 2000, 10.0
_LOAD, _LENGTH = 10.0, 1.0  # on the length of the cylinder
_RUBBER = Material(CreepSeries(2 * _INSTANT, [2 * _DELAYED], [_TIME]), poisson_ratio=0.5)

#: Places of the contact in its cells whose mean error is compared.
_PLACES = (0.2, 0.5, 0.8)


def _moving(body: Indenter, speed: float, grid: Grid) -> xr.Dataset:
    """Contact of a level body at one speed along y [m/s]."""
    load = step(_LOAD, tilt_x=None if any(grid.periodic) else 0.0, tilt_y=0.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # the approach has no datum
        found = steady(body, _RUBBER, load, speed, grid=grid, errors=False, fields="none")
    return found.isel(speed=0)


def _cylinder(speed: float, cells: int) -> tuple[Comparison, ...]:
    """Friction coefficient and half width, with a number of cells across the contact."""
    exact = reference.moving_cylinder(_LOAD, _RADIUS, _INSTANT, _DELAYED, _TIME, speed)
    cell, found = 2 * exact.half_width / cells, []
    across = 8 * math.ceil(1.25 * cells / 8)
    for place in _PLACES:
        centre = (0.0, exact.offset + place * cell)
        size = (_LENGTH, across * cell)
        grid = Grid((1, across), size, periodic=(True, False), centre=centre)
        ours = _moving(Paraboloid(math.inf, _RADIUS), speed, grid)
        found.append(
            (
                single(exact.friction_coefficient, float(ours.friction_coefficient)),
                single(exact.half_width, float(ours.contact_width) / 2),
            )
        )
    frictions, widths = zip(*found, strict=True)
    return with_mean_error(frictions), with_mean_error(widths)


def _fast_sphere(cells: int) -> tuple[Comparison, ...]:
    """Friction coefficient and approach; both limits are reached to 1e-6 at this speed."""
    speed, creep_rate = 1e5, _DELAYED / _TIME
    exact = reference.hertz_sphere(_LOAD, _RADIUS, 1 / _INSTANT)
    limit = reference.fast_sphere_friction_coefficient(_LOAD, _RADIUS, _INSTANT, creep_rate, speed)
    side = 2.5 * exact.contact_radius
    count, found = 2 * math.ceil(1.25 * cells), []
    for place in _PLACES:
        centre = (0.0, place * side / count)
        ours = _moving(
            Paraboloid(_RADIUS, _RADIUS), speed, Grid((count, count), (side, side), centre=centre)
        )
        found.append(
            (
                single(limit, float(ours.friction_coefficient)),
                single(exact.approach, float(ours.approach)),
            )
        )
    frictions, approaches = zip(*found, strict=True)
    return with_mean_error(frictions), with_mean_error(approaches)


CASES: tuple[Case, ...] = (
    Case(
        "cylinder in slow steady motion, V τ/a = 0.013",
        "Hunter 1961",
        (
            Quantity("friction coefficient", "1", 2e-3, 5e-4),
            Quantity("half width", "m", 1e-2, 2e-3),
        ),
        (32, 64, 128),
        partial(_cylinder, 0.01),
    ),
    Case(
        "cylinder in steady motion, V τ/a = 0.24",
        "Hunter 1961",
        (
            Quantity("friction coefficient", "1", 2e-4, 5e-5),
            Quantity("half width", "m", 3e-4, 1e-4),
        ),
        (32, 64, 128),
        partial(_cylinder, 0.1),
    ),
    Case(
        "cylinder in fast steady motion, V τ/a = 40",
        "Hunter 1961",
        (
            Quantity("friction coefficient", "1", 5e-5, 1e-5),
            Quantity("half width", "m", 3e-5, 1e-5),
        ),
        (32, 64, 128),
        partial(_cylinder, 10.0),
    ),
    Case(
        "sphere in fast steady motion",
        "Hertz 1882, first order in 1/V",
        (Quantity("friction coefficient", "1", 2e-4, 5e-5), Quantity("approach", "m", 3e-4, 5e-5)),
        (10, 20, 40),
        _fast_sphere,
    ),
)
