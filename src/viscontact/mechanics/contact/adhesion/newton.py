"""Semismooth Newton method for an adhesive contact.

The unknowns are the pressure p on the cells in contact and on those that attract each other, and
the free rigid motions c. With the gap g = h + J K p - plane(c) and D = -sigma'(g) the equations of
a step (Hintermueller, Ito & Kunisch 2003, SIAM J. Optim. 13, 865) are

    in contact:   (J K dp - plane(dc))/(J d) = -g/(J d)
    attracted:    dp - D (J K dp - plane(dc)) = -(p + sigma(g))
    balances:     sums(dp) dA + k dc = what is lacking

with the cell size d, and k the spring of the stage. The front of a law that ends abruptly is as
wide as the gap changes over a cell, so D acts on these changes, too.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Bools
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.adhesion.linear_step import LinearStep
from viscontact.mechanics.contact.adhesion.problem import (
    AdhesiveProblem,
    AdhesiveResidual,
    residual_of,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.problem import Guess

#: Newton steps of one search; from an extrapolated guess 3 to 6 are needed.
MAX_STEPS = 20

#: Reduction of the residual at which it ends [-]: far from the solution, where sets of cells still
#: change, and from a residual of so many strengths on.
REDUCTION_AFAR, REDUCTION, NEAR = 7e-2, 1e-3, 1e-2

#: Part of the tolerance down to which a linear system is solved, in its norm, which is larger than
#: the largest residual.
INNER_TOLERANCE = 1.5

#: Reduction far from the solution, and that part, of a law that ends abruptly: near the end of a
#: state, where its front holds to cells, a search finds it or not by how it errs.
REDUCTION_ABRUPT, INNER_ABRUPT = 1e-1, 3.0

#: Growth of the residual over the least one at which a search is given up [-].
DIVERGED = 1e3

#: Part of the largest residual that it has fallen to in a search that ends soon.
FALLEN = 0.1

#: Part of the residual of two steps before, on the same cells in contact, from which on a search
#: goes in circles [-].
CYCLING = 0.5


@dataclass(frozen=True, eq=False)
class NewtonSearch:
    """Last pressure of a search, with its residual and cost."""

    iterate: Guess
    checked: AdhesiveResidual
    steps: int
    convolutions: int
    converged: bool
    predicted: float  # sum of the attraction at the start over the cells [Pa]


def newton_search(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    start: Guess,
    tolerance: float,
    max_steps: int = MAX_STEPS,
    *,
    tried_steps: int | None = None,
    afar: float = REDUCTION_AFAR,
) -> NewtonSearch:
    """Search from a pressure, whose memory is used, until the residual meets the tolerance.

    Its displacement may be a guess, too. After the tried steps it ends where the residual has not
    fallen to a tenth of the largest one.
    """
    iterate, convolutions = start, 0
    checked = residual_of(problem, domain, iterate)
    predicted = float(checked.attraction.traction.sum())
    is_guess = True  # the displacement is not convolved with the pressure
    course = SearchCourse(tolerance, tried_steps)
    for step in range(max_steps + 1):
        if is_guess and (checked.error <= tolerance or step == max_steps):
            domain.convolution.apply(iterate.pressure, into=iterate.unit_displacement)
            checked = residual_of(problem, domain, iterate)
            is_guess, convolutions = False, convolutions + 1
        converged = checked.error <= tolerance
        if converged or step == max_steps or course.leads_nowhere(step, checked):
            break
        iterate, is_guess, spent = _after_step(problem, domain, iterate, checked, tolerance, afar)
        checked = residual_of(problem, domain, iterate)
        convolutions += spent
    if is_guess:
        domain.convolution.apply(iterate.pressure, into=iterate.unit_displacement)
        convolutions += 1
    return NewtonSearch(iterate, checked, step, convolutions, converged, predicted)


def _after_step(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    iterate: Guess,
    checked: AdhesiveResidual,
    tolerance: float,
    afar: float,
) -> tuple[Guess, bool, int]:
    """Pressure after one step; True if its displacement is a guess; convolutions."""
    inner = INNER_TOLERANCE
    if problem.law.is_abrupt:
        afar, inner = REDUCTION_ABRUPT, INNER_ABRUPT
    system = LinearStep.of(problem, domain, iterate, checked, tolerance)
    reduction = REDUCTION if checked.error <= NEAR else afar
    motion = system.solve(iterate, reduction, inner * tolerance)
    # A step to the tolerance is checked at once.
    is_guess = system.is_whole and not system.meets_tolerance
    if not is_guess:
        domain.convolution.apply(iterate.pressure, into=iterate.unit_displacement)
    return Guess(iterate.values, motion), is_guess, system.convolutions + (not is_guess)


class SearchCourse:
    """Residuals of a search and its cells in contact, by which it is given up."""

    def __init__(self, tolerance: float, tried_steps: int | None) -> None:
        self._tolerance, self._tried_steps = tolerance, tried_steps
        self._least, self._largest, self._sets = math.inf, 0.0, CycleOfSets()

    def leads_nowhere(self, step: int, checked: AdhesiveResidual) -> bool:
        """True if the residual grows, does not fall within the tried steps, or goes in circles."""
        error = checked.error
        self._least, self._largest = min(self._least, error), max(self._largest, error)
        if not error <= DIVERGED * max(self._least, self._tolerance):
            return True
        tried = self._tried_steps is not None and step >= self._tried_steps
        return (tried and error > FALLEN * self._largest) or self._sets.repeats(checked)


class CycleOfSets:
    """Sets of cells in contact of a search, which goes in circles where a state has ended."""

    def __init__(self) -> None:
        self._known: list[tuple[Bools, float]] = []

    def repeats(self, checked: AdhesiveResidual) -> bool:
        """True if the set is that of two steps before, not that of the last one, and no better."""
        now = checked.in_contact, checked.error
        before, self._known = self._known, [*self._known[-1:], now]
        if len(before) < 2:
            return False
        (first, error), (last, _) = before
        back = np.array_equal(now[0], first) and not np.array_equal(now[0], last)
        return back and checked.error >= CYCLING * error
