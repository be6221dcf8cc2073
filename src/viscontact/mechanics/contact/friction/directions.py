"""Directions in which tractions may change at first order, on their discs."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.discs import divided, on_circle
from viscontact.mechanics.contact.friction.problem import SlipProblem


@dataclass(frozen=True, eq=False)
class Directions:
    """Directions in which the traction of each cell may change at first order."""

    # Both in cells that stick, the tangent of the circle in those that slip, none without contact.
    slips: Bools
    normal: Floats  # unit vectors along the traction of cells that slip, 0 elsewhere; (2, nx, ny)
    sticks: Bools
    pull: Floats  # λ of cells that slip [m], (nx, ny)

    def projected(self, fields: Floats) -> Floats:
        """Components along free directions."""
        x, y = self.normal
        found = fields - self.normal * (x * fields[0] + y * fields[1])
        found *= self.sticks | self.slips
        return np.asarray(found)

    @property
    def matrix(self) -> tuple[Floats, Floats, Floats]:
        """Entries xx, xy and yy of the projector of each cell."""
        x, y = self.normal
        held = self.sticks | self.slips
        return held - x * x, -x * y, held - y * y


@dataclass(frozen=True, eq=False)
class ReachedCircles:
    """Cells in contact, and those whose traction has reached its circle."""

    held: Bools
    reached: Bools
    normal: Floats  # unit vectors along the traction there, 0 elsewhere; (2, nx, ny)

    def directions(self, slip: Floats) -> Directions:
        """Free directions under a slip: cells on the circle that slip against it are held there."""
        x, y = self.normal
        pull = -(x * slip[0] + y * slip[1])
        slips = self.reached & (pull >= 0)
        return Directions(slips, self.normal * slips, self.held & ~slips, pull * slips)


def reached_circles(problem: SlipProblem, traction: Floats) -> ReachedCircles:
    """Circles that a traction has reached."""
    reached = on_circle(traction, problem.bound, problem.in_contact)
    normal = divided(traction, problem.bound, reached)
    return ReachedCircles(problem.in_contact, reached, normal)
