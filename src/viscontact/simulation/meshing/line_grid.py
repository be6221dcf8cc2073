"""Automatic grid of a line contact: a single cell along the body, and a row of cells across it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from viscontact.backend.transforms import fast_length
from viscontact.bodies.cell_borders import with_borders_at
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadPoint
from viscontact.mechanics.halfspace.ended_response import planes_in
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.simulation.meshing.elastic_estimate import (
    MAX_PERIOD_CELLS,
    ContactEstimate,
    estimate_period,
)
from viscontact.units.formatting import format_quantity

#: Length of the period [m]: what a metre of the body has is what a period has.
LINE = 1.0

#: Cells across the contact, times the square root of the tolerance; at least and at most some.
ACROSS, LEAST_ACROSS, MOST_ACROSS = 8.0, 40.0, 4000.0

#: Width of the grid over twice the reach of the contact from the body's axis.
MARGIN = 2.0

#: Part of the half width of a coarse grid to which its contact reaches, and the one aimed at.
LEAST_REACH, MOST_REACH, AIM = 0.25, 0.8, 0.5

#: Coarse grids that are tried at most.
TRIES = 40

#: Half widths that are tried, over the body's depth there that the load suggests.
_WIDEST, _NARROWEST = 1e3, 1e-12


def line_axis(indenter: Indenter) -> int | None:
    """Axis along which a body continues without end, 0: x, 1: y; None unless it is one of them."""
    along_x, along_y = indenter.endless
    if along_x == along_y:
        return None
    return 0 if along_x else 1


def line_estimate(
    indenter: Indenter,
    compliance: float,
    point: LoadPoint,
    response: SurfaceResponse = HALF_SPACE,
) -> ContactEstimate:
    """Estimate an elastic line contact on a coarse row of cells; `compliance` in 1/Pa."""
    axis = line_axis(indenter)
    assert axis is not None  # of a body without end
    width = 2 * _first_half_width(indenter, axis, compliance, point)
    for _ in range(TRIES):
        row = with_borders_at(_row(axis, MAX_PERIOD_CELLS, width), planes_in(response))
        found = estimate_period(indenter, compliance, point, row, response=response)
        touched = found.in_contact.ravel()
        fills = bool(touched[0] or touched[-1])
        reach = 1.0 if fills else found.reach[1 - axis] / (width / 2)
        if LEAST_REACH <= reach <= MOST_REACH:
            return found
        width *= float(np.clip(reach / AIM, 0.1, 3.0))
    raise ValueError(
        "grid: no row of cells fits this line contact; give a grid with 'periodic: "
        f"{'[true, false]' if axis == 0 else '[false, true]'}', a single cell along the body, "
        "'shape' and 'size'"
    )


def line_grid(estimates: list[ContactEstimate], request: AutomaticGrid, axis: int) -> Grid:
    """Grid for all of some line contacts, whose cells suit the narrowest of them."""
    across = 1 - axis
    width = 2 * MARGIN * max(each.reach[across] for each in estimates)
    narrowest = min(each.extents[across] for each in estimates)
    cells = np.clip(ACROSS / math.sqrt(request.tolerance), LEAST_ACROSS, MOST_ACROSS)
    cell = narrowest / float(cells)
    if request.largest_cell is not None:
        cell = min(cell, request.largest_cell[across])
    return _row(axis, fast_length(math.ceil(width / cell)), width)


def _row(axis: int, cells: int, width: float) -> Grid:
    """Row of cells across a body without end."""
    if axis == 0:
        return Grid((1, cells), (LINE, width), periodic=(True, False))
    return Grid((cells, 1), (width, LINE), periodic=(False, True))


def _first_half_width(indenter: Indenter, axis: int, compliance: float, point: LoadPoint) -> float:
    """Distance from the axis at which the body is as deep as the load suggests [m]."""
    # A line load q indents a half-space by some q J, a cylinder of b = sqrt(4 R q J / pi) by b²/R.
    depth = point.approach if point.force is None else point.force / LINE * compliance
    assert depth is not None  # a point gives one of both

    def gap(half: float) -> float:
        place = (0.0, half) if axis == 0 else (half, 0.0)
        return float(indenter.gap(*(np.array([each]) for each in place))[0])

    return _where(gap, depth)


def _where(gap: Callable[[float], float], depth: float) -> float:
    """Distance at which a gap that grows reaches a depth, by bisection of its logarithm [m]."""
    low, high = math.log(_NARROWEST * depth), math.log(_WIDEST)
    for _ in range(60):
        middle = (low + high) / 2
        if gap(math.exp(middle)) < depth:
            low = middle
        else:
            high = middle
    if high == math.log(_WIDEST):
        raise ValueError(
            f"grid: the body is not {format_quantity(depth, 'm', 3)} deep anywhere, so that no "
            "grid can be fitted to its contact; give a grid"
        )
    return math.exp(high)
