"""Adhering spheres in units R = J = w = 1, on grids of one quarter."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

import viscontact as vc
from viscontact.bodies.cohesive_laws import LAWS
from viscontact.mechanics.contact.adhesion.equilibrium import solve_from, solve_near, traction_at
from viscontact.mechanics.contact.adhesion.problem import AdhesiveProblem
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.reference import maugis_dugdale

#: Units of force, radius and approach of Maugis 1992: K = 4/3.
FORCE = np.pi
DEPTH = np.cbrt((np.pi * 3 / 4) ** 2)


@dataclass(frozen=True)
class Sphere:
    """Sphere of a law and a Tabor number on a square grid."""

    law: str
    tabor: float
    cells: int
    half: float  # side of the quarter [R]

    @cached_property
    def domain(self):
        grid = vc.Grid((self.cells, self.cells), (2 * self.half, 2 * self.half))
        return ContactDomain(grid, mirrored=(True, True))

    @cached_property
    def gap(self):
        grid = self.domain.grid
        whole = vc.Paraboloid(1.0, 1.0).gap(grid.x[:, None], grid.y[None, :])
        return self.domain.reduce_by_symmetry(whole)

    @property
    def exact(self):
        return maugis_dugdale(1.0, 1.0, 1.0, 1 / self.tabor)

    @property
    def cells_in_zone(self):
        return np.pi / 8 / self.tabor**2 / self.domain.grid.cell_size[0]

    def problem(self, *, approach=0.0, force=None):
        constraints = Constraints((None, None, None), (approach, 0.0, 0.0))
        if force is not None:
            constraints = self.domain.reduced_constraints(Constraints((force, 0.0, 0.0)))
        law = LAWS[self.law](1.0, 1 / self.tabor)
        return AdhesiveProblem(ContactProblem(self.gap, 1.0, constraints, 1e-12), law)

    def contact(self, tolerance=1e-7, **given):
        """Contact from the attraction of the undeformed bodies, by descent."""
        problem = self.problem(**given)
        open_gap = np.maximum(self.gap - given.get("approach", 0.0), 0.0)
        return solve_from(
            problem, self.domain, traction_at(problem, self.domain, open_gap), tolerance
        )

    def retracted(self, approaches, tolerance=1e-7):
        """Contacts at falling approaches, by Newton's method from extrapolated guesses."""
        first = self.contact(tolerance, approach=approaches[0])
        found = [first]
        for number, approach in enumerate(approaches[1:], start=1):
            values = found[-1].values.copy()
            if number > 1:
                part = (approach - approaches[number - 1]) / (
                    approaches[number - 1] - approaches[number - 2]
                )
                values += part * (found[-1].values - found[-2].values)
            guess = Guess(values, np.array([approach, 0.0, 0.0]))
            found.append(solve_near(self.problem(approach=approach), self.domain, guess, tolerance))
        return found

    def force(self, solution):
        """Force of a contact on the whole grid [π w R]."""
        return float(solution.found.pressure.sum()) * 4 * self.domain.grid.cell_area / FORCE
