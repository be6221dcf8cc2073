"""Verification case of a body that ends: the edge of an incompressible one."""

from __future__ import annotations

import math

import numpy as np

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.halfspace.ended_half_space import EndedResponse
from viscontact.verify.case import Case, Comparison, Quantity, history

_MODULUS, _PRESSURE = 1e9, 1e6  # E*, and that on the rectangle [Pa]
_HALF_LENGTH, _HALF_WIDTH, _MIDDLE = 0.5e-3, 0.5e-3, 1e-3  # of the rectangle, from the edge [m]

#: Displacement of the edge over that of the half-space: two for the mirror image, times the sum of
#: all images of a load in two dimensions.
EDGE = 2 / (1 - 4 / math.pi**2)


def _edge(cells: int) -> tuple[Comparison, ...]:
    """Uniform pressure on a rectangle beside the free end, and the displacement along the edge."""
    grid = Grid((2 * cells, 2 * cells), (2e-3, 2e-3), centre=(_MIDDLE, 0.0))
    inside = (np.abs(grid.x - _MIDDLE) < _HALF_LENGTH)[:, None] & (np.abs(grid.y) < _HALF_WIDTH)
    body = EndedResponse(poisson_ratio=0.5, planes=(0.0, None), free=(True, False))
    displacement = ContactDomain(grid, response=body).convolution.apply(_PRESSURE * inside)
    half_space = reference.rectangle_displacement(
        *(_PRESSURE, _HALF_LENGTH, _HALF_WIDTH, _MODULUS), -_MIDDLE, grid.y
    )
    # What is even about the edge is flat there: the first row of cells is beside it.
    return (history(EDGE * np.asarray(half_space), displacement[0] / _MODULUS),)


CASES = (
    Case(
        "edge of an incompressible body that ends",
        "Hetényi 1960",
        (Quantity("displacement", "m", 3e-4, 3e-5),),
        (16, 32, 64),
        _edge,
    ),
)
