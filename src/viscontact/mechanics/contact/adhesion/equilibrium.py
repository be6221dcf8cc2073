"""Adhesive contact of one time step: Newton's method, and the descent where a state ends.

1. Newton's method from a guess, extrapolated from earlier steps.
2. If it fails, or its state is far from the last one: descent from the last state until the
   attraction hardly changes, then Newton's method. That is a jump to the nearest stable state.
3. The solution is checked on the whole grid, in double precision, in every iteration.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.adhesion.descent import NEAR, Descended, Descent
from viscontact.mechanics.contact.adhesion.newton import (
    MAX_STEPS,
    NewtonSearch,
    newton_search,
)
from viscontact.mechanics.contact.adhesion.problem import (
    AdhesiveProblem,
    AdhesiveSolution,
    attraction,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.problem import Guess

#: Newton steps of a search from a descent, and of the last one, after which there is no other way.
TRIED_STEPS, LAST_STEPS = 12, 60

#: Newton steps of a search that a shorter time step can follow, and those after which it ends if it
#: has hardly come nearer, but for the front of a law that ends abruptly, which is found late.
NEAR_STEPS, NEAR_TRIED = 8, 4

#: Reduction of the residual by the first steps of a search from an extrapolated guess, where few
#: sets change [-].
REDUCTION_NEAR = 0.05

#: Fall of the changes of a descent from which on Newton's method is tried again [-].
FALLEN = 1e-2

#: Part of the attraction that is no change [-].
ROUNDING = 1e-6


def solve_near(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    guess: Guess,
    tolerance: float,
    *,
    is_last: bool = True,
) -> AdhesiveSolution:
    """Newton's method alone, from a guess whose memory is used; a few steps unless `is_last`."""
    steps, tried = (MAX_STEPS, None) if is_last else (NEAR_STEPS, NEAR_TRIED)
    if problem.law.is_abrupt:
        tried = None
    given = problem, domain, guess, tolerance, steps
    found = newton_search(*given, tried_steps=tried, afar=REDUCTION_NEAR)
    return _solution(problem, found, 0)


def solve_from(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    traction: Floats,
    tolerance: float,
    *,
    from_afar: bool = False,
) -> AdhesiveSolution | None:
    """Nearest stable state from an attraction [Pa]; None where the force is not carried.

    One that is far from all states, as that of undeformed bodies, may be followed less accurately.
    """
    descent = Descent(problem, domain, traction, from_afar=from_afar)
    spent, tried = 0, None
    while True:
        reached = descent.run()
        if reached.detached:
            return None
        if not (descent.is_spent or tried is None or _is_elsewhere(reached, tried, problem)):
            continue
        start = Guess(reached.guess.values.copy(), reached.guess.motion)
        steps = LAST_STEPS if descent.is_spent else TRIED_STEPS
        found = newton_search(problem, domain, start, tolerance, steps)
        spent += found.convolutions
        if (found.converged and _continues(found, reached)) or descent.is_spent:
            break
        tried = reached
    return _solution(problem, found, spent + descent.convolutions)


def traction_at(problem: AdhesiveProblem, domain: ContactDomain, gap: Floats) -> Floats:
    """Attraction at a gap [Pa]."""
    return attraction(problem.law, gap, domain.periodic).traction


def released(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    traction: Floats | None = None,
    motion: Floats | None = None,
) -> AdhesiveSolution:
    """Bodies that do not touch: far apart, or on a surface that does not yield to a traction."""
    pulled = np.zeros(domain.shape) if traction is None else traction
    values = np.stack([-pulled, domain.convolution.apply(-pulled)])
    if motion is None:
        motion = np.array([np.nan, *problem.contact.constraints.motions[1:]])
        gap = np.full(domain.shape, np.inf)
    else:
        gap = problem.contact.open_gap - domain.whole.plane.field(motion)
    nowhere = np.zeros(domain.shape, bool)
    return AdhesiveSolution(
        *(values, motion, gap, nowhere, 0.0, 0, 1), converged=True, traction=pulled
    )


def _is_elsewhere(reached: Descended, tried: Descended, problem: AdhesiveProblem) -> bool:
    """True if a search may find what it has not found from an earlier iterate."""
    # Iterates are slow where a state has just ceased to exist, which no search finds.
    if reached.change <= FALLEN * tried.change:
        return True
    moved = float(np.abs(reached.traction - tried.traction).max())
    return moved >= NEAR * problem.law.strength


def _continues(found: NewtonSearch, reached: Descended) -> bool:
    """True if Newton's method ended where the descent was going, not beside an unstable state."""
    # Iterates change one way, so the state that they end at lies on that side of all of them.
    before, after = float(reached.traction.mean()), float(found.checked.attraction.traction.mean())
    beyond = (after - before) * np.sign(reached.growth)
    return bool(beyond >= -max(ROUNDING * before, abs(reached.growth)))


def _solution(problem: AdhesiveProblem, found: NewtonSearch, convolutions: int) -> AdhesiveSolution:
    checked, iterate = found.checked, found.iterate
    return AdhesiveSolution(
        iterate.values,
        iterate.motion,
        checked.gap,
        checked.in_contact,
        checked.error,
        found.steps,
        convolutions + found.convolutions,
        found.converged,
        checked.attraction.traction,
        found.predicted,
    )
