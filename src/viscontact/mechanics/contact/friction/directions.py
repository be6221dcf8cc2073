"""Directions in which tractions may change at first order, on their discs."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.problem import SlipProblem


@dataclass(frozen=True, eq=False)
class Directions:
    """Directions in which the traction of each cell may change at first order."""

    # Both in cells that stick, the tangent of the circle in those that slip, none without contact.
    slips: Bools
    normal: Floats  # unit vectors along the traction of cells that slip, 0 elsewhere; (2, nx, ny)
    sticks: Bools
    pull: Floats  # λ of cells that slip [m], (nx, ny)
    held: Floats  # 1 in both, 0 elsewhere

    def projected(self, fields: Floats) -> Floats:
        """Components along free directions."""
        x, y = self.normal
        found = fields - self.normal * (x * fields[0] + y * fields[1])
        found *= self.held
        return np.asarray(found)

    @property
    def matrix(self) -> tuple[Floats, Floats, Floats]:
        """Entries xx, xy and yy of the projector of each cell."""
        x, y = self.normal
        return self.held - x * x, -x * y, self.held - y * y


@dataclass(frozen=True, eq=False)
class ReachedCircles:
    """Cells in contact whose traction has reached its circle."""

    problem: SlipProblem
    reached: Bools
    normal: Floats  # unit vectors along the traction there, 0 elsewhere; (2, nx, ny)

    def directions(self, slip: Floats) -> Directions:
        """Free directions under a slip: cells on the circle that slip against it are held there."""
        x, y = self.normal
        pull = -(x * slip[0] + y * slip[1])
        slips = self.reached & (pull >= 0)
        # Products with truth values take twice the time.
        there = slips.astype(np.float64)
        sticks, held = self.problem.in_contact & ~slips, self.problem.held
        return Directions(slips, self.normal * there, sticks, pull * there, held)


def reached_circles(problem: SlipProblem, traction: Floats) -> ReachedCircles:
    """Circles that a traction has reached."""
    x, y = traction
    reached = np.asarray(x * x + y * y >= problem.reaching)
    return ReachedCircles(problem, reached, traction * (problem.inverse_bound * reached))
