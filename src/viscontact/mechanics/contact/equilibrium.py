"""Contact equilibrium of one time step: p >= 0, g >= 0, p g = 0, with force and moment balances.

The pressure minimises 1/2 p·J K p + p·g0 over p >= 0 subject to the balances, whose multipliers are
the rigid motion: approach and tilts. The search (`conjugate_gradients`) runs on a patch around the
contact; its result is checked on the whole grid.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.conjugate_gradients import BoundedCG
from viscontact.mechanics.contact.contact_residual import contact_residual
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.winkler import winkler_contact

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
    values: Floats
    motion: Floats  # approach [m] and tilts [rad]
    gap: Floats  # +inf outside the body [m]
    in_contact: Bools  # cells that touch: the active set of the search
    residual: float  # largest gap in contact or penetration over the largest displacement [-]
    iterations: int  # search directions, without those on coarser grids
    convolutions: int  # on patches or on all cells, without those on coarser grids
    converged: bool  # residual and balances are within the tolerance

    @property
    def found(self) -> Guess:
        """The solution as a guess for another solve."""
        return Guess(self.values, self.motion)


def solve_contact(
    problem: ContactProblem,
    domain: ContactDomain,
    guess: Guess | None = None,
    *,
    tolerance: float = 1e-6,
    max_iterations: int = MAX_ITERATIONS,
) -> ContactSolution:
    """Solve for the pressure and rigid motion that satisfy contact conditions and balances.

    The unit displacement of a guess must belong to its pressure; the solution is found in its
    memory. Without a guess, or if it does not converge, the solve starts from the solution on a
    coarser grid, and on the coarsest from a Winkler foundation. The tolerance bounds the relative
    residual and imbalance. ``converged`` is False if the iteration stagnates or uses up
    `max_iterations`.
    """
    problem = _above_rounding(problem, domain, tolerance)
    spent = 0, 0
    if guess is not None:
        found = _solve_from(guess, problem, domain, tolerance, max_iterations)
        if found.converged:
            return found
        spent = found.iterations, found.convolutions
        del found
    # Cold start: after a large change of the load, a guess can be worse than none.
    memory = np.empty((2, *domain.shape)) if guess is None else guess.values
    start = _cold_start(problem, domain, memory)
    found = _solve_from(start, problem, domain, tolerance, max_iterations)
    return replace(
        found,
        iterations=spent[0] + found.iterations,
        convolutions=spent[1] + found.convolutions,
    )


def _above_rounding(
    problem: ContactProblem, domain: ContactDomain, tolerance: float
) -> ContactProblem:
    """Same problem, with errors relative to no less than what rounding of the gap allows."""
    # Just after first touch, displacements are far smaller than the approach.
    height = domain.whole.plane.height(np.array(problem.constraints.motions))
    least = GAP_ROUNDING * height / tolerance
    if least <= problem.displacement_scale:
        return problem
    return replace(problem, displacement_scale=least)


def _solve_from(
    start: Guess,
    problem: ContactProblem,
    domain: ContactDomain,
    tolerance: float,
    max_iterations: int,
) -> ContactSolution:
    """Search on patches until the residual on the whole grid meets the tolerance."""
    pressure, unit_displacement = start.values
    cells = pressure > 0
    rounds = iterations = convolutions = 0
    error = np.inf
    while True:
        # Search on a patch around the contact, in single precision.
        patch = domain.patch_around(cells)
        searched = _search_on(patch, problem, start, tolerance, max_iterations - iterations)
        rounds += 1
        iterations += searched.iterations
        convolutions += searched.convolutions + 1
        # Check the returned pressure by a fresh convolution, not by the recurrence of the search.
        domain.convolution.apply(pressure, into=unit_displacement)
        checked = contact_residual(problem, domain.whole, Guess(start.values, searched.motion))
        start = Guess(start.values, checked.motion)
        converged = checked.error <= tolerance and _is_balanced(
            problem, domain, pressure, tolerance
        )
        stagnant = searched.stagnated and checked.error > error / 2
        is_last = rounds == MAX_ROUNDS or iterations >= max_iterations
        if converged or stagnant or is_last:
            spent = iterations, convolutions
            fields = checked.gap, checked.in_contact
            return ContactSolution(
                start.values, start.motion, *fields, checked.error, *spent, converged
            )
        # The next patch holds the contact and all cells that the body still overlaps.
        error = checked.error
        cells = checked.in_contact | (checked.gap < 0)
        del checked  # the search needs the memory


@dataclass(frozen=True)
class _PatchMotion:
    """Motion that a search on a patch has found, and its cost."""

    motion: Floats
    stagnated: bool
    iterations: int
    convolutions: int


def _search_on(
    patch: Patch, problem: ContactProblem, start: Guess, tolerance: float, max_iterations: int
) -> _PatchMotion:
    """Search from a guess, whose pressure becomes that found on the patch, 0 outside."""
    search = BoundedCG(problem.within(patch), patch, start.within(patch))
    search.run(tolerance, max_iterations)
    pressure = start.pressure
    if search.iterations and not search.stagnated:
        # Steps in single precision leave imbalances of up to 1e-8; the displacement of the balanced
        # pressure is that of the check.
        constraints, cell_area = problem.constraints, patch.cell_area
        patch.passes.balance(patch.cut(pressure), constraints, cell_area, patch.arm)
    for outside in (slice(patch.rows.start), slice(patch.rows.stop, None)):
        pressure[outside] = 0.0
    for outside in (slice(patch.columns.start), slice(patch.columns.stop, None)):
        pressure[:, outside] = 0.0
    return _PatchMotion(
        search.iterate.motion, search.stagnated, search.iterations, search.convolutions
    )


def _is_balanced(
    problem: ContactProblem,
    domain: ContactDomain,
    pressure: Floats,
    tolerance: float,
) -> bool:
    """True if force and moments of a pressure meet the constraints."""
    whole = domain.whole
    _, off = whole.passes.weigh(pressure, problem.constraints, whole.cell_area, whole.arm)
    return off <= tolerance


def _cold_start(problem: ContactProblem, domain: ContactDomain, memory: Floats) -> Guess:
    """Nested iteration from coarser grids, the coarsest a Winkler foundation; (2, nx, ny)."""
    coarser = domain.coarser()
    # A body may be too narrow to lie under any four cells.
    if coarser is None or not np.isfinite((coarsened := problem.coarsened()).open_gap).any():
        return _winkler_guess(problem, domain, memory)
    coarse = solve_contact(coarsened, coarser, tolerance=NESTED_TOLERANCE)
    # Each coarse pressure on its four cells. Smoother interpolation, and finer tolerances, take
    # more iterations rather than fewer, as they blur the rim.
    pressure = memory[0]
    for row, column in np.ndindex(2, 2):
        pressure[row::2, column::2] = coarse.found.pressure
    # The coarse cells may not touch at all, or not be able to carry the load.
    if not (coarse.converged and coarse.in_contact.any()):
        return _winkler_guess(problem, domain, memory)
    domain.convolution.apply(pressure, into=memory[1])
    return Guess(memory, coarse.found.motion)


def _winkler_guess(problem: ContactProblem, domain: ContactDomain, memory: Floats) -> Guess:
    """Balanced pressure on a Winkler foundation, as a first guess in the given memory."""
    whole = domain.whole
    pressure, motion = winkler_contact(
        problem.open_gap, problem.compliance, problem.constraints, whole.plane, whole.cell_area
    )
    memory[0] = pressure
    domain.convolution.apply(memory[0], into=memory[1])
    return Guess(memory, motion)
