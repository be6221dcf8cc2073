"""Verification cases of bodies that end: an edge, and a cylinder between two free ends."""

from __future__ import annotations

import math

import numpy as np

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Roller
from viscontact.bodies.laws import Elastic
from viscontact.bodies.loads import step
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.free_end import end_functions, image_density
from viscontact.mechanics.halfspace.log_panels import LogPanels
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, history, single

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


_LINE, _RADIUS, _LENGTH = 10e3, 10e-3, 4e-3  # load per length [N/m], radius and length [m]


def _equal_lengths(cells: int) -> tuple[Comparison, ...]:
    """Rigid cylinder on a body of its own length, whose ends are free, without Poisson's effect."""
    # No stress on the ends and none along x: each slice is in plane strain, and in plane stress.
    exact = reference.hertz_line(_LINE, _RADIUS, _MODULUS)
    body = Body(Material(Elastic(_MODULUS / 2), poisson_ratio=0.0), _LENGTH)
    # The contact ends at the same place of a cell on each grid.
    across = 2 * cells + 1
    width = across * exact.half_width / (0.75 * cells + 0.3)
    grid = Grid((cells + 4, across), (_LENGTH * (1 + 4 / cells), width))
    roller = Roller(_RADIUS, _LENGTH / 2)
    (state,) = march(roller, body, step(_LINE * _LENGTH), grid, [0.0])
    profile = state.pressure[2:-2]
    return (
        history(np.full(cells, _LINE), profile.sum(axis=1) * grid.cell_size[1]),
        history(np.full(cells, exact.peak_pressure), profile.max(axis=1)),
    )


def _all_images(depth: int) -> tuple[Comparison, ...]:
    """Sum of all images of a line load near the corner, over the load."""
    panels = LogPanels.over(1e-12, 10.0, 2.5)
    place = int(np.searchsorted(panels.places, 10.0**-depth))
    image = image_density(panels, 0.5)[:, place]
    return (single(1 / (1 - 4 / math.pi**2), 1 + float(panels.weights @ image)),)


#: Displacement added by a free end to that of the mirrored half-space at distances of 0, 0.5 and 2
#: from it, under a unit line load cos y at the distance 1, over compliance, by finite elements.
PLACES = (0.0, 0.5, 2.0)
BY_ELEMENTS = {
    0.0: (-0.113470, 0.002447, 0.005293),
    0.3: (0.046222, 0.086574, 0.017144),
    0.45: (0.258236, 0.213274, 0.043785),
}


def _waves(_: int) -> tuple[Comparison, ...]:
    """Displacement near a free end under a wave of line load, for three Poisson's ratios."""
    found = []
    for ratio, expected in BY_ELEMENTS.items():
        functions = end_functions(ratio)
        ours = functions.at(np.array(PLACES)) @ functions.at(np.array(1.0))
        found.append(history(np.array(expected), ours))
    return tuple(found)


def _far_away(radii: int) -> tuple[Comparison, ...]:
    """What a free end adds below a pressure far away, over that at twice the distance."""
    grid = Grid((8, 8), (2e-4, 2e-4))
    pressure = np.full(grid.shape, _PRESSURE)
    half_space = ContactDomain(grid).convolution.apply(pressure)
    added = []
    for distance in (radii * 1e-4, 2 * radii * 1e-4):
        body = EndedResponse(poisson_ratio=0.3, planes=(-distance, None), free=(True, False))
        near = ContactDomain(grid, response=body).convolution.apply(pressure)
        added.append(float((near - half_space).mean()))
    return (single(2.0, added[0] / added[1]),)


CASES: tuple[Case, ...] = (
    Case(
        "images of a line load near an edge",
        "Michell 1900, Hetényi 1960",
        (Quantity("total load over the load", "1", 1e-4, 2e-5, has_order=False),),
        (3, 5, 7),
        _all_images,
    ),
    Case(
        "waves of line load beside a free end",
        "finite elements",
        tuple(
            Quantity(f"added displacement over compliance, ν = {ratio:g}", "1", 5e-5, 5e-5, False)
            for ratio in BY_ELEMENTS
        ),
        (1, 2, 3),
        _waves,
    ),
    Case(
        "pressure far from a free end",
        "similarity",
        (Quantity("effect of the end over that at twice the distance", "1", 2e-3, 2e-4),),
        (8, 16, 32),
        _far_away,
    ),
    Case(
        "edge of an incompressible body that ends",
        "Hetényi 1960",
        (Quantity("displacement", "m", 3e-4, 3e-5),),
        (16, 32, 64),
        _edge,
    ),
    Case(
        "cylinder on a body of its length, free ends, ν = 0",
        "Hertz 1882",
        (
            Quantity("line load", "N/m", 3e-5, 3e-5, has_order=False),
            Quantity("peak pressure", "Pa", 2e-4, 2e-4, has_order=False),
        ),
        (16, 32, 64),
        _equal_lengths,
    ),
)
