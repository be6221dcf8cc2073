"""Contact of coupled bodies in steady motion: pressure and tractions under one creepage.

As at rest (`simulation.transient.coupled_contact`), the normal contact in the gap that the last
tractions leave, and the tractions under its pressure, take turns until the displacement by the
tractions stays. Elastic bodies respond in motion as at rest, others by `moving_coupling`.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import ConvergenceError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.friction.mixing import AndersonMixing
from viscontact.mechanics.halfspace.coupling_filter import CouplingSum, coupling_filter
from viscontact.mechanics.halfspace.moving_coupling import moving_coupling_filter
from viscontact.mechanics.rolling_traction import RollingTraction
from viscontact.simulation.steady_motion.contact import Neighbour, SteadyContact, SteadySolver
from viscontact.simulation.steady_motion.moving_law import moving_coupling
from viscontact.simulation.steady_motion.traction import TractionSolver
from viscontact.units.formatting import format_quantity

#: Alternations of pressure and tractions.
MOST_ALTERNATIONS = 40

#: Tolerance of the first solves, and part of the last change that the next ones leave.
FIRST_TOLERANCE, FORCING = 1e-3, 0.03

#: Part of the tolerance to which the last pressure is solved.
LAST = 0.5


@dataclass(frozen=True, eq=False)
class CoupledSolver:
    """Solver of contact and tractions together, on any grid and at any speed."""

    solver: SteadySolver
    tractions: TractionSolver

    def solve(
        self, speed: float, grid: Grid, tolerance: float, near: Neighbour | None = None
    ) -> SteadyContact:
        """Solve at a speed [m/s], from a contact on other cells at a similar speed if given."""
        coupling, mixing = Coupling(self.solver, grid, speed, self.tractions), AndersonMixing()
        lift, wanted = np.zeros(grid.shape), max(tolerance, FIRST_TOLERANCE)
        work = 0.0
        for _ in range(MOST_ALTERNATIONS):
            found = self.solver.solve(speed, grid, LAST * wanted, near, lift=lift)
            work += found.solution.work
            if not (found.solution.converged and found.in_contact.any()):
                return found
            along = coupling.along(found.pressure)
            # The search for tractions is cheap: its tolerance is that of the run.
            traction = self.tractions.solve(found, along)
            reached = coupling.lift(traction)
            change = float(np.abs(reached - lift)[found.in_contact].max())
            error = change / max(float(np.abs(found.displacement).max()), np.finfo(float).tiny)
            if error <= tolerance and wanted <= tolerance:
                solution = replace(found.solution, work=work)
                return replace(found, solution=solution, traction=traction, along=along)
            wanted = max(tolerance, min(wanted, FORCING * error))
            lift, near = mixing.next(lift, reached), found.neighbour
        at = format_quantity(speed, "m/s", 6)
        raise ConvergenceError(
            f"pressure and tractions of coupled bodies stopped at {at} with a change of "
            f"{error:.2g} over the displacement, short of the tolerance {tolerance:g}; likely "
            "causes: a grid too coarse for the contact, or a tolerance near rounding"
        )


@dataclass(frozen=True, eq=False)
class Coupling:
    """Displacements by which pressure and tractions act on each other at a speed [m/s]."""

    solver: SteadySolver
    grid: Grid
    speed: float
    tractions: TractionSolver

    @cached_property
    def _maps(self) -> CouplingSum:
        transforms, problem = self.solver.transforms, self.solver.problem
        if problem.contact.surface.creep.is_elastic:
            return CouplingSum([coupling_filter(self.grid, transforms)])
        extent = max(self.grid.size_about_origin)
        compliance = moving_coupling(self.tractions.laws, self.speed, extent)
        return CouplingSum(
            [moving_coupling_filter(self.grid, compliance, problem.axis, transforms)]
        )

    @cached_property
    def _compliance(self) -> float:
        """Σ c J of elastic bodies, which subtract [1/Pa]; 1 of maps that have it [-]."""
        contact = self.solver.problem.contact
        if not contact.surface.creep.is_elastic:
            return 1.0
        terms = contact.shear.terms
        return sum(term.coupling * float(term.compliance(np.array(0.0))) for term in terms)

    def along(self, pressure: Floats) -> Floats:
        """Displacement along the surface under a pressure [m], (2, nx, ny)."""
        return self._maps.along([self._compliance * pressure])

    def lift(self, traction: RollingTraction) -> Floats:
        """Displacement into the surface under the tractions of the only creepage [m]."""
        pair = np.stack([traction.traction_x[0], traction.traction_y[0]])
        return self._maps.normal([self._compliance * pair])
