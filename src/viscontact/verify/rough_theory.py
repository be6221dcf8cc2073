"""Verification case of Persson's theory: full contact of a rough body that slides."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.bodies.laws import Zener
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.bodies.surfaces import Surface
from viscontact.bodies.surfaces.pressing import indenter_of
from viscontact.results.persson import persson_sliding
from viscontact.runs.steady import steady
from viscontact.verify.case import Case, Comparison, Quantity, history, single

_LENGTH, _PRESSURE, _SPEEDS = 1e-3, 1e8, [1e-4, 1e-3, 1e-2]


def _full_contact(cells: int) -> tuple[Comparison, ...]:
    """A map of three waves pressed until all of it touches."""
    phase = 2 * np.pi * np.arange(cells) / cells
    height = 2e-6 * np.cos(phase)[:, None] + 2e-6 * np.cos(phase) + 1e-6 * np.sin(3 * phase + 1.0)
    surface = Surface(height, _LENGTH / cells, periodic=True)
    rubber = Material(Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    grid = Grid((cells, cells), (_LENGTH, _LENGTH), periodic=True)
    load = step(_PRESSURE * grid.area, tilt_x=0.0, tilt_y=0.0)
    body = indenter_of(surface)
    run = steady(
        body, rubber, load, _SPEEDS, grid=grid, fields="none", errors=False, tolerance=1e-9
    )
    theory = persson_sliding(surface, rubber, _PRESSURE, _SPEEDS)
    area = float(run.contact_area.values[0]) / grid.area
    friction = run.friction_coefficient.values
    return single(1.0, area), history(theory.friction_coefficient.values, friction)


CASES: tuple[Case, ...] = (
    Case(
        "full contact of a sliding rough body",
        "Persson 2001",
        (
            Quantity("real over nominal area", "1", 1e-9, 1e-9),
            Quantity("friction coefficient", "1", 1e-6, 1e-6),
        ),
        (24, 48),
        _full_contact,
    ),
)
