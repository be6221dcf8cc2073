"""Equilibrium of one instant: pressure >= 0, gap >= 0, one of them zero everywhere.

Minimise ½ p·Kc p + p·g over p >= 0 subject to the body's force and moment balances. Multipliers
of the balances are the rigid motion: approach and tilts. The search runs on the contact's own
patch of the grid; what it finds is checked on the whole.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.conjugate_gradients import BoundedCG, contact_residual
from viscontact.contact.domain import ContactDomain
from viscontact.contact.problem import ContactProblem, Guess
from viscontact.contact.winkler import winkler_contact

MAX_ITERATIONS = 400

#: How far a coarser grid's answer has to converge to start from.
NESTED_TOLERANCE = 1e-3

#: Rounds of search and check. A second one is due where a contact outgrows its patch, or where the
#: tolerance asks for more than single precision gives in one.
MAX_ROUNDS = 20


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """What a solve found.

    Attributes
    ----------
    values : ndarray, shape (2, nx, ny)
        Pressure [Pa], and unit_displacement by a fresh convolution [Pa m].
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].
    gap : ndarray, shape (nx, ny)
        Gap [m], +inf where the body has no surface.
    residual : float
        Largest gap under pressure or penetration elsewhere, over the largest displacement.
    iterations, convolutions : int
        Search directions used, and convolutions (on patches or the whole grid) spent; those on
        coarser grids, from which a solve without a guess starts, are not counted.
    converged : bool
        Whether residual and balances are within the tolerance.
    """

    values: NDArray[np.float64]
    motion: NDArray[np.float64]
    gap: NDArray[np.float64]
    residual: float
    iterations: int
    convolutions: int
    converged: bool

    @property
    def found(self) -> Guess:
        """Both together, for another solve to start from."""
        return Guess(self.values[0], self.values[1], self.motion)


def solve_contact(
    problem: ContactProblem,
    half_space: ContactDomain,
    guess: Guess | None = None,
    *,
    tolerance: float = 1e-6,
    max_iterations: int = MAX_ITERATIONS,
) -> ContactSolution:
    """Pressure and rigid motion that satisfy contact and balance.

    Parameters
    ----------
    problem : ContactProblem
        Gap, compliance and constraints.
    half_space : ContactDomain
        Grid and operators.
    guess : Guess, optional
        Start; its unit_displacement must belong to its pressure. Negative pressure is cut off,
        balances
        are restored. The answer of a coarser grid when left out, and on the coarsest a foundation
        of about the right stiffness.
    tolerance : float
        Bound on the relative residual of the returned pressure, and on the balances.
    max_iterations : int
        Give up after this many search directions.

    Returns
    -------
    ContactSolution
        With ``converged`` False if the iteration stagnated or ran out.

    Notes
    -----
    After Polonsky & Keer (1999), with these departures: a preconditioner, Polak-Ribiere+
    directions that are not reset when the contact set changes, the unit_displacement updated along
    the direction instead of convolved again, and both moments balanced (in pressure itself: scaled
    variables lose convergence).

    References
    ----------
    I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206.
    """
    found = None
    if guess is not None:
        found = _solve_from(guess, problem, half_space, tolerance, max_iterations)
        if found.converged:
            return found
    # A guess can be worse than none, after a load has changed beyond recognition.
    start = _cold_start(problem, half_space)
    cold = _solve_from(start, problem, half_space, tolerance, max_iterations)
    if found is None:
        return cold
    better = cold if cold.converged or cold.residual < found.residual else found
    return replace(
        better,
        iterations=found.iterations + cold.iterations,
        convolutions=found.convolutions + cold.convolutions,
    )


def _solve_from(
    start: Guess,
    problem: ContactProblem,
    half_space: ContactDomain,
    tolerance: float,
    max_iterations: int,
) -> ContactSolution:
    """Search on patches until the whole grid agrees."""
    cells = start.pressure > 0
    iterations = convolutions = 0
    error = np.inf
    for _ in range(MAX_ROUNDS):
        patch = half_space.patch_around(cells)
        search = BoundedCG(problem.within(patch), patch, start.within(patch))
        search.run(tolerance, max_iterations - iterations)
        iterations += search.iterations
        convolutions += search.convolutions + 1
        # Certify what is returned, by a fresh convolution: not what the recurrence believes.
        values = np.zeros((2, *half_space.shape))
        pressure, unit_displacement = values
        patch.cut(pressure)[...] = search.iterate.pressure
        half_space.convolution.apply(pressure, into=unit_displacement)
        checked = contact_residual(
            problem, half_space.whole, Guess(pressure, unit_displacement, search.iterate.motion)
        )
        start = Guess(pressure, unit_displacement, checked.motion)
        converged = checked.error <= tolerance and _is_balanced(
            problem, half_space, pressure, tolerance
        )
        stagnant = search.stagnated and checked.error > error / 2
        if converged or stagnant or iterations >= max_iterations:
            break
        error = checked.error
        cells = (pressure > 0) | (checked.gap < 0)
    return ContactSolution(
        values, start.motion, checked.gap, checked.error, iterations, convolutions, converged
    )


def _is_balanced(
    problem: ContactProblem,
    half_space: ContactDomain,
    pressure: NDArray[np.float64],
    tolerance: float,
) -> bool:
    whole = half_space.whole
    off = problem.constraints.imbalance(whole.plane.sums(pressure) * whole.cell_area, whole.arm)
    return off <= tolerance


def _cold_start(problem: ContactProblem, half_space: ContactDomain) -> Guess:
    """What a coarser grid says, and at the bottom of these a foundation."""
    coarser = half_space.coarser()
    # A body may be too narrow to lie under any four cells.
    if coarser is None or not np.isfinite((coarsened := problem.coarsened()).open_gap).any():
        return _winkler_guess(problem, half_space)
    coarse = solve_contact(coarsened, coarser, tolerance=NESTED_TOLERANCE)
    # Each cell's pressure on all four of it: smoother ways to hand it down, and finer tolerances,
    # take more directions rather than fewer, as they blur the rim.
    pressure = np.repeat(np.repeat(coarse.found.pressure, 2, axis=0), 2, axis=1)
    # Fewer cells may not touch at all, or not carry where the fine ones do.
    if not (coarse.converged and pressure.any()):
        return _winkler_guess(problem, half_space)
    return Guess(pressure, half_space.convolution.apply(pressure), coarse.found.motion)


def _winkler_guess(problem: ContactProblem, half_space: ContactDomain) -> Guess:
    whole = half_space.whole
    pressure, motion = winkler_contact(
        problem.open_gap, problem.compliance, problem.constraints, whole.plane, whole.cell_area
    )
    return Guess(pressure, half_space.convolution.apply(pressure), motion)
