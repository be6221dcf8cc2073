"""Cells that resolve the pressure near the free ends of bodies."""

from __future__ import annotations

import math

from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.contact_extent import PointContact

#: Cells along x at a free end in half widths of the contact, over the square root of the tolerance:
#: the load within a half width from the end is then off by a third of the tolerance for ν = 0.5.
AT_END = 3.0

#: Distance of an end from a contact that reaches it, in cells of the estimate.
NEAR = 1.5


def cell_for_ends(
    problem: Problem, contact: PointContact, tolerance: float
) -> tuple[float, float] | None:
    """Largest cell of a contact that reaches a free end [m]; None if it reaches none."""
    found = contact.estimate
    near = NEAR * found.grid.cell_size[0]
    ends = (found.centre_x - found.length / 2, found.centre_x + found.length / 2)
    free = [
        plane
        for body in problem.ended_bodies.values()
        for plane, kind in zip(body.planes, body.ends, strict=True)
        if plane is not None and kind == "free"
    ]
    if not any(abs(plane - end) < near for plane in free for end in ends):
        return None
    return AT_END * math.sqrt(tolerance) * found.width / 2, math.inf
