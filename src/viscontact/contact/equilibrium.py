"""Contact equilibrium of one time step: p >= 0, g >= 0, p g = 0, with force and moment balances.

The pressure minimises 1/2 p·J K p + p·g0 over p >= 0 subject to the balances, whose multipliers are
the rigid motion: approach and tilts. The search (`conjugate_gradients`) runs on a patch around the
contact; its result is checked on the whole grid.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.conjugate_gradients import BoundedCG, contact_residual
from viscontact.contact.domain import ContactDomain
from viscontact.contact.problem import ContactProblem, Guess
from viscontact.contact.winkler import winkler_contact

#: Search directions of one solve.
MAX_ITERATIONS = 400

#: Tolerance of a solve on a coarser grid, whose result is only a first guess.
NESTED_TOLERANCE = 1e-3

#: Rounding of a gap, relative to the height of a prescribed motion.
GAP_ROUNDING = 1e-14

#: Rounds of search and check. A second one is needed where a contact outgrows its patch, or where
#: single precision does not meet the tolerance at once.
MAX_ROUNDS = 20


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """Pressure and motion that a solve has found, with the residual of the contact conditions."""

    #: Pressure [Pa] and unit displacement K p by a fresh convolution [Pa m]; shape (2, nx, ny).
    values: NDArray[np.float64]
    motion: NDArray[np.float64]  # approach [m] and tilts [rad]
    gap: NDArray[np.float64]  # +inf outside the body [m]
    residual: float  # largest gap in contact or penetration over the largest displacement [-]
    iterations: int  # search directions, without those on coarser grids
    convolutions: int  # on patches or on all cells, without those on coarser grids
    converged: bool  # residual and balances are within the tolerance

    @property
    def found(self) -> Guess:
        """The solution as a guess for another solve."""
        return Guess(self.values[0], self.values[1], self.motion)


def solve_contact(
    problem: ContactProblem,
    domain: ContactDomain,
    guess: Guess | None = None,
    *,
    tolerance: float = 1e-6,
    max_iterations: int = MAX_ITERATIONS,
) -> ContactSolution:
    """Solve for the pressure and rigid motion that satisfy contact conditions and balances.

    The unit displacement of a guess must belong to its pressure; tension in it is cut off and its
    balances are restored. Without a guess, or if it does not converge, the solve starts from the
    solution on a coarser grid, and on the coarsest from a Winkler foundation. The tolerance bounds
    the relative residual and the relative imbalance. ``converged`` is False if the iteration
    stagnates or uses up `max_iterations`.
    """
    problem = _above_rounding(problem, domain, tolerance)
    # Start from the guess.
    found = None
    if guess is not None:
        found = _solve_from(guess, problem, domain, tolerance, max_iterations)
        if found.converged:
            return found
    # Cold start: after a large change of the load, a guess can be worse than none.
    start = _cold_start(problem, domain)
    cold = _solve_from(start, problem, domain, tolerance, max_iterations)
    if found is None:
        return cold
    better = cold if cold.converged or cold.residual < found.residual else found
    return replace(
        better,
        iterations=found.iterations + cold.iterations,
        convolutions=found.convolutions + cold.convolutions,
    )


def _above_rounding(
    problem: ContactProblem, domain: ContactDomain, tolerance: float
) -> ContactProblem:
    """Same problem, with errors relative to no less than what rounding of the gap allows."""
    # Just after first touch, displacements are far smaller than the approach.
    height = domain.whole.plane.height(np.array(problem.constraints.motions))
    least = GAP_ROUNDING * height / tolerance
    return replace(problem, displacement_scale=max(problem.displacement_scale, least))


def _solve_from(
    start: Guess,
    problem: ContactProblem,
    domain: ContactDomain,
    tolerance: float,
    max_iterations: int,
) -> ContactSolution:
    """Search on patches until the residual on the whole grid meets the tolerance."""
    cells = start.pressure > 0
    iterations = convolutions = 0
    error = np.inf
    for _ in range(MAX_ROUNDS):
        # Search on a patch around the contact, in single precision.
        patch = domain.patch_around(cells)
        search = BoundedCG(problem.within(patch), patch, start.within(patch))
        search.run(tolerance, max_iterations - iterations)
        iterations += search.iterations
        convolutions += search.convolutions + 1
        # Check the returned pressure by a fresh convolution, not by the recurrence of the search.
        values = np.zeros((2, *domain.shape))
        pressure, unit_displacement = values
        patch.cut(pressure)[...] = search.iterate.pressure
        domain.convolution.apply(pressure, into=unit_displacement)
        checked = contact_residual(
            problem, domain.whole, Guess(pressure, unit_displacement, search.iterate.motion)
        )
        start = Guess(pressure, unit_displacement, checked.motion)
        converged = checked.error <= tolerance and _is_balanced(
            problem, domain, pressure, tolerance
        )
        stagnant = search.stagnated and checked.error > error / 2
        if converged or stagnant or iterations >= max_iterations:
            break
        # The next patch holds the contact and all cells that the body still overlaps.
        error = checked.error
        cells = (pressure > 0) | (checked.gap < 0)
    return ContactSolution(
        values, start.motion, checked.gap, checked.error, iterations, convolutions, converged
    )


def _is_balanced(
    problem: ContactProblem,
    domain: ContactDomain,
    pressure: NDArray[np.float64],
    tolerance: float,
) -> bool:
    """True if force and moments of a pressure meet the constraints."""
    whole = domain.whole
    off = problem.constraints.imbalance(whole.plane.sums(pressure) * whole.cell_area, whole.arm)
    return off <= tolerance


def _cold_start(problem: ContactProblem, domain: ContactDomain) -> Guess:
    """Nested iteration: the solution of a coarser grid, on the coarsest a Winkler foundation."""
    coarser = domain.coarser()
    # A body may be too narrow to lie under any four cells.
    if coarser is None or not np.isfinite((coarsened := problem.coarsened()).open_gap).any():
        return _winkler_guess(problem, domain)
    coarse = solve_contact(coarsened, coarser, tolerance=NESTED_TOLERANCE)
    # Each coarse pressure on its four cells. Smoother interpolation, and finer tolerances, take
    # more iterations rather than fewer, as they blur the rim.
    pressure = np.repeat(np.repeat(coarse.found.pressure, 2, axis=0), 2, axis=1)
    # The coarse cells may not touch at all, or not be able to carry the load.
    if not (coarse.converged and pressure.any()):
        return _winkler_guess(problem, domain)
    return Guess(pressure, domain.convolution.apply(pressure), coarse.found.motion)


def _winkler_guess(problem: ContactProblem, domain: ContactDomain) -> Guess:
    """Balanced pressure on a Winkler foundation, as a first guess."""
    whole = domain.whole
    pressure, motion = winkler_contact(
        problem.open_gap, problem.compliance, problem.constraints, whole.plane, whole.cell_area
    )
    return Guess(pressure, domain.convolution.apply(pressure), motion)
