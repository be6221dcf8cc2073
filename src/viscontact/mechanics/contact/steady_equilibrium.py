"""Contact equilibrium of a body in steady motion: p >= 0, g >= 0, p g = 0, with balances.

The operator of the moving load is monotone but not symmetric: there is one solution, but it
minimises no energy. It is found by the semismooth Newton method on nested grids. Where the loss
angle is so large that the set of cells in contact does not settle, the proximal point method
(Rockafellar 1976, SIAM J. Control Optim. 14, 877) takes over. With the pressure p' found last it
solves the contact problem of the operator K_V + s K, of a smaller loss angle, and the gap
h - s K p'; as p' converges, the terms with s cancel.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.moving_domain import MovingDomain
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import restore_balance
from viscontact.mechanics.contact.semismooth_newton import NewtonResult, newton_search
from viscontact.mechanics.contact.winkler import winkler_contact

#: Tolerance on coarser grids: their set of cells in contact is what shortens the search.
NESTED_TOLERANCE = 1e-4

#: Newton steps from a guess, before the search starts from a coarser grid.
STEPS_FROM_GUESS = 4

#: First added elastic compliance of the proximal point method, relative to that of a wave as long
#: as the grid, and its factors after a success and after a failure [-].
FIRST_SHARE, AFTER_SUCCESS, AFTER_FAILURE = 0.3, 0.5, 3.0

#: Accuracy of its problems, relative to the error before, and to the tolerance at the end [-].
PROXIMAL_ACCURACY, FINEST_ACCURACY = 0.1, 0.3

#: Problems of the proximal point method.
MAX_PROXIMAL = 60


@dataclass(frozen=True, eq=False)
class SteadySolution(ContactSolution):
    """Solution for a body in steady motion, with the cost of the whole solve."""

    #: Convolutions on all grids and patches, in those of all cells of this grid.
    work: float


def solve_steady_contact(
    problem: ContactProblem,
    domain: MovingDomain,
    guess: Guess | None = None,
    *,
    tolerance: float = 1e-6,
) -> SteadySolution:
    """Solve for the steady pressure and rigid motion, as `solve_contact` does at one instant."""
    # Without a guess, or if the search from it fails, it starts from the solution on a coarser
    # grid, and on the coarsest from a Winkler foundation.
    work = 0.0
    if guess is not None and (start := _balanced(guess, problem, domain)) is not None:
        found = newton_search(problem, domain, start, tolerance, max_steps=STEPS_FROM_GUESS)
        if found.error <= tolerance:
            return _solution(found, problem, domain, tolerance, found.convolutions)
        work = found.convolutions
    start, nested = _cold_start(problem, domain)
    found = newton_search(problem, domain, start, tolerance)
    work += nested + found.convolutions
    if found.error > tolerance:
        found = _proximal_search(problem, domain, found, tolerance)
        work += found.convolutions
    return _solution(found, problem, domain, tolerance, work)


def _balanced(guess: Guess, problem: ContactProblem, domain: MovingDomain) -> Guess | None:
    """Guess under the body with the prescribed force and moments; None if they do not fit."""
    whole = domain.whole
    under = np.where(np.isfinite(problem.open_gap), guess.pressure, 0.0)
    pressure = restore_balance(under, problem.constraints, whole.plane, whole.cell_area, whole.arm)
    if pressure is None:
        return None
    return Guess.of(pressure, guess.unit_displacement, guess.motion)


def _cold_start(problem: ContactProblem, domain: MovingDomain) -> tuple[Guess, float]:
    """Solution on a coarser grid, on the coarsest a Winkler foundation; and its cost."""
    coarser, work = domain.coarser(), 0.0
    if coarser is not None:
        coarse = solve_steady_contact(problem.coarsened(), coarser, tolerance=NESTED_TOLERANCE)
        # Each coarse pressure on its cells.
        pressure = coarse.values[0]
        for axis in (0, 1):
            pressure = np.repeat(pressure, domain.shape[axis] // pressure.shape[axis], axis)
        work = coarse.work * coarse.values[0].size / pressure.size
        start = _balanced(Guess.of(pressure, pressure, coarse.motion), problem, domain)
        if start is not None:
            return start, work
    whole, constraints = domain.whole, problem.constraints
    others = constraints, whole.plane, whole.cell_area
    pressure, motion = winkler_contact(problem.open_gap, problem.compliance, *others)
    balanced = restore_balance(pressure, *others, whole.arm)
    return Guess.of(pressure if balanced is None else balanced, pressure, motion), work


def _proximal_search(
    problem: ContactProblem, domain: MovingDomain, start: NewtonResult, tolerance: float
) -> NewtonResult:
    """Proximal point method from a pressure; each of its problems by the Newton method."""
    best, iterate, work = start, start.iterate, 0.0
    error, share = start.error, FIRST_SHARE
    for _ in range(MAX_PROXIMAL):
        if best.error <= tolerance:
            break
        added = share * domain.compliance
        before = added * domain.elastic.apply(iterate.pressure)
        shifted = replace(problem, open_gap=problem.open_gap - before)
        accuracy = max(PROXIMAL_ACCURACY * error, FINEST_ACCURACY * tolerance)
        inner = newton_search(shifted, domain.with_elastic(added), iterate, accuracy)
        work += inner.convolutions + 1
        if inner.error > accuracy:
            share *= AFTER_FAILURE
            continue
        share *= AFTER_SUCCESS
        measured = newton_search(problem, domain, inner.iterate, tolerance, max_steps=0)
        iterate, error = measured.iterate, measured.error
        work += measured.convolutions
        best = measured if error < best.error else best
    return replace(best, convolutions=work)


def _solution(
    found: NewtonResult,
    problem: ContactProblem,
    domain: MovingDomain,
    tolerance: float,
    work: float,
) -> SteadySolution:
    iterate = found.iterate
    sums = domain.whole.plane.sums(iterate.pressure) * domain.whole.cell_area
    off = problem.constraints.imbalance(sums, domain.whole.arm)
    return SteadySolution(
        values=np.stack([iterate.pressure, iterate.unit_displacement]),
        motion=iterate.motion,
        gap=found.checked.gap,
        in_contact=found.checked.in_contact,
        residual=found.error,
        iterations=found.steps,
        convolutions=round(found.convolutions),
        converged=found.error <= tolerance and off <= tolerance,
        work=work,
    )
