"""Cells of an automatic grid that resolve the ring which slips around a contact under friction.

The ring is as wide as that of a sphere under the same part u of what friction carries: from the
radius a down to a (1 - u)^(1/3) (R. D. Mindlin, J. Appl. Mech. 16 (1949) 259), where the load along
the surface is largest. Under a torque u is that over 3π/16 μ W a (J. L. Lubkin, J. Appl. Mech. 18
(1951) 183), and a shift s of one at which all slips leaves 1 - u = (1 - s)^(3/2).
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.tangential import TangentialPoint
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.contact_extent import PointContact

#: Cells across the ring at a tolerance of 1 %; as the inverse root of the tolerance.
RING_CELLS = 4.0

#: Most cells of a grid that are made for the ring, and the most by which cells become shorter.
MOST_CELLS, MOST_FINER = 2**18, 2.0

#: Instants at which loads are compared beside their kinks.
SAMPLES = 65

#: Torque that friction carries over μ W a on a sphere.
TORQUE = 3 * math.pi / 16


def cell_for_ring(
    problem: Problem, largest: PointContact, end: float | None, grid: Grid, tolerance: float
) -> tuple[float, float] | None:
    """Largest edges of cells that resolve the ring [m]; None where the grid need not be finer."""
    if problem.friction is None or problem.tangential is None:
        return None
    radius = min(largest.estimate.extents) / 2
    part = _largest_part(problem, largest, end, radius)
    if not 0 < part < 1:
        return None
    ring = radius * (1 - (1 - part) ** (1 / 3))
    wanted = ring / (RING_CELLS * math.sqrt(0.01 / tolerance))
    finer = [min(max(edge / wanted, 1.0), MOST_FINER) for edge in grid.cell_size]
    excess = math.prod(grid.shape) * math.prod(finer) / MOST_CELLS
    if excess > 1:
        finer = [max(each / math.sqrt(excess), 1.0) for each in finer]
    if max(finer) == 1:
        return None
    x, y = (edge / each for edge, each in zip(grid.cell_size, finer, strict=True))
    return x, y


def _largest_part(
    problem: Problem, largest: PointContact, end: float | None, radius: float
) -> float:
    """Largest part of what friction carries that a load along the surface takes [-]."""
    load, tangential = problem.contact_load, problem.tangential
    assert tangential is not None  # it is given with friction
    latest = math.inf if end is None else end
    within = np.zeros(0) if end is None else np.linspace(0.0, end, SAMPLES)
    times = np.union1d(problem.history.stops, within)
    parts = [
        _part(
            problem, tangential.at(time, side=side), load.at(time, side=side).force, largest, radius
        )
        for time in times[times <= latest].tolist()
        for side in ("left", "right")
    ]
    return max(parts, default=0.0)


def _part(
    problem: Problem,
    point: TangentialPoint,
    force: float | None,
    largest: PointContact,
    radius: float,
) -> float:
    """Part of what friction carries at an instant; 0 where it is not known before the run [-]."""
    assert problem.friction is not None
    coefficient = problem.friction.coefficient
    along_x, along_y, torque = (each or 0.0 for each in point.forces)
    shift_x, shift_y, turn = (each or 0.0 for each in point.motions)
    found = 0.0
    if force:
        carried = coefficient * force
        found = max(math.hypot(along_x, along_y), abs(torque) / (TORQUE * radius)) / carried
    shift = max(math.hypot(shift_x, shift_y), abs(turn) * radius)
    slides = coefficient * float(largest.estimate.motion[0])
    if shift and slides > 0:
        found = max(found, 1 - max(1 - shift / slides, 0.0) ** 1.5)
    return found
