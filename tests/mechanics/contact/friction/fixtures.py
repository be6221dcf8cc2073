"""Contacts under friction of bodies without physical units, for tests of the solver."""

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.friction.equilibrium import solve_slip
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.contact.friction.problem import ShearBlock, SlipProblem
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, ShiftConstraints
from viscontact.mechanics.halfspace.shear_filter import (
    periodic_shear_convolution,
    shear_convolution,
    shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_influence import shear_tables

#: Contact compliance J, radius, force, coefficient of friction, and the radius of Hertz's contact.
COMPLIANCE, RADIUS, FORCE, FRICTION = 5e-4, 10.0, 10.0, 0.3
CONTACT = (3 * FORCE * RADIUS * COMPLIANCE / 4) ** (1 / 3)
PEAK = 3 * FORCE / (2 * np.pi * CONTACT**2)


def shear_block(grid: Grid, kappa: float) -> ShearBlock:
    """Operators on all cells of a grid."""
    if all(grid.periodic):
        parts = periodic_shear_convolution(grid.shape, grid.cell_size)
    else:
        parts = shear_convolution(shear_tables(grid), (grid.periodic[0], grid.periodic[1]))
    return ShearBlock(
        parts.sum_of(1.0, kappa),
        parts.sum_of(1.0, kappa, single=True),
        shear_preconditioner(grid.shape, grid.cell_size, kappa),
        RigidShift(grid.x[:, None], grid.y[None, :], grid.cell_area),
        max(grid.cell_size),
    )


def hertz(cells: int, samples: int = 6):
    """Grid with a number of cells across Hertz's contact, and the means of its pressure."""
    edge = 2 * CONTACT / cells
    grid = Grid((cells + 2, cells + 2), ((cells + 2) * edge,) * 2)
    parts = ((np.arange(samples) + 0.5) / samples - 0.5) * edge
    pressure = np.zeros(grid.shape)
    for along in parts:
        for across in parts:
            squared = (grid.x[:, None] + along) ** 2 + (grid.y[None, :] + across) ** 2
            pressure += PEAK * np.sqrt(np.maximum(1 - squared / CONTACT**2, 0))
    return grid, pressure * FORCE / (pressure.sum() * grid.cell_area)


def under(forces=(0.0, 0.0, 0.0), motions=(None, None, None)) -> ShiftConstraints:
    """Constraints: the motions that are given, and forces otherwise."""
    free = np.array([motion is None for motion in motions])
    return ShiftConstraints(
        free, np.where(free, forces, 0.0), np.array([m or 0.0 for m in motions]), CONTACT
    )


def solved(
    block,
    pressure,
    constraints,
    *,
    before=None,
    entry=None,
    start=None,
    tolerance=1e-8,
    as_loads=False,
):
    """Solution of a step of an elastic body from the traction before it, given as such or moved."""
    nothing, earlier = np.zeros((2, *pressure.shape)), None
    past = None if before is None else -COMPLIANCE * block.convolution.apply(before)
    if as_loads:
        past, earlier = None, -before
    gripping = NormalContact(pressure, nothing[0], pressure > 0).gripping
    problem = SlipProblem(
        gripping,
        FRICTION * pressure * gripping,
        past,
        COMPLIANCE,
        np.zeros((3, *pressure.shape)) if entry is None else entry,
        constraints,
        1e-12,
        earlier,
    )
    first = before if start is None else start
    return solve_slip(problem, block, nothing if first is None else first, tolerance=tolerance)
