"""Descent of an adhesive contact to the nearest stable state.

With the attraction of the last iterate held, what remains is a contact under p >= 0, whose gap
gives the next attraction. For a law that decreases, the work of the attraction is a concave
function of its gap, which this replaces by its tangent: the energy falls in each iteration. Under a
given approach the iterates of a body that approaches, or is withdrawn, change one way only: they
end at the nearest state on their way, which is the one that a body takes where its state ceases to
exist.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.adhesion.newton import newton_search
from viscontact.mechanics.contact.adhesion.problem import AdhesiveProblem, attraction
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.problem import ContactProblem, Guess

#: Tolerance of the contacts of a descent, and the largest one of a descent from afar, where it is a
#: part of the change of the attraction, in strengths: iterates of small changes keep their way.
#: Those with a tolerance of so many times this part are repeated.
CONTACT_TOLERANCE, LARGEST_TOLERANCE, PART_OF_CHANGE, ROUGH = 1e-7, 1e-2, 1e-2, 10.0

#: Iterations of one call.
MAX_ITERATIONS = 600

#: Change of the attraction in one iteration, in strengths, below which the iterates are near a
#: state, or pass the place of one that has just ceased to exist; those are passed in steps of this
#: length. Ratio of successive changes up to which they approach a state [-].
NEAR, CONVERGES = 3e-2, 0.8

#: Change from which on iterates from afar that approach a state are near it.
NEAR_FROM_AFAR = 1e-1

#: The length where the law ends abruptly, as its front changes the cells that it crosses alone: a
#: change of the strength takes it over one cell.
LONGEST_ABRUPT = 0.3

#: Factors by which the longest step shrinks where it led beyond a state, and grows again; least of
#: what a step may be lengthened by, which shrinks and grows with it.
SHORTENED, GROWING, LEAST_FACTOR = 4.0, 1.5, 8.0


@dataclass(frozen=True, eq=False)
class Descended:
    """Iterate of a descent."""

    guess: Guess  # pressure with its displacement, and motion
    traction: Floats  # attraction that the next iteration begins with [Pa]
    change: float  # largest change of the attraction in the last iteration [Pa]
    growth: float  # mean change in the last iteration [Pa]
    way: Floats | None = None  # change of the attraction in the last iteration [Pa]
    detached: bool = False  # True if the attraction does not carry the force any more


class Descent:
    """Iterations from an attraction to the nearest stable state."""

    def __init__(
        self,
        problem: AdhesiveProblem,
        domain: ContactDomain,
        traction: Floats,
        *,
        from_afar: bool = False,
    ) -> None:
        """Begin with an attraction [Pa], far from a state or near one."""
        self._tolerance = LARGEST_TOLERANCE if from_afar else CONTACT_TOLERANCE
        self._near = NEAR_FROM_AFAR if from_afar else NEAR
        self._problem, self._domain, self._law = problem, domain, problem.law.decreasing
        self._traction = traction
        self._pressed: Guess | None = None
        self._most = problem.law.strength * (LONGEST_ABRUPT if problem.law.is_abrupt else NEAR)
        self._longest, self._factor = self._most, LEAST_FACTOR
        self.convolutions = self.iterations = 0
        self._last: Descended | None = None

    @property
    def is_spent(self) -> bool:
        """True if no iteration is left."""
        return self.iterations >= MAX_ITERATIONS

    def run(self) -> Descended:
        """Iterate until the attraction approaches a state, or turns back from one it has passed."""
        near = self._near * self._problem.law.strength
        while True:
            before, last = self._traction, self._last
            found = self._iterate()
            if self._tolerance > CONTACT_TOLERANCE and not found.detached:
                found = self._improved(before, found)
            self._last = found
            self.iterations += 1
            if found.detached or self.is_spent:
                return found
            if last is None:
                continue
            turns = _turns(last, found)
            grown = 1 / SHORTENED if turns else GROWING
            self._longest = min(self._longest * grown, self._most)
            self._factor = max(self._factor * grown, LEAST_FACTOR)
            slows = turns or found.change <= CONVERGES * last.change or found.change == 0
            if slows and found.change <= near:
                return found
            if not slows and found.change < self._longest:  # a longer step along the same way
                way, factor = found.traction - before, self._longest / found.change
                self._traction = np.maximum(before + min(factor, self._factor) * way, 0.0)

    def _improved(self, before: Floats, found: Descended) -> Descended:
        """Iterate from afar, repeated if its change is too small for its tolerance."""
        asked = PART_OF_CHANGE * found.change / self._problem.law.strength
        asked = min(max(asked, CONTACT_TOLERANCE), LARGEST_TOLERANCE)
        is_rough, self._tolerance = self._tolerance > ROUGH * asked, asked
        if not is_rough:
            return found
        self._traction = before
        return self._iterate()

    def _iterate(self) -> Descended:
        """Contact under the attraction so far, and that of its gap."""
        problem, domain = self._problem, self._domain
        pulled = np.empty((2, *domain.shape))
        pulled[0] = self._traction
        domain.convolution.apply(pulled[0], into=pulled[1])
        self.convolutions += 1
        contact = problem.contact
        open_gap = contact.open_gap - contact.compliance * pulled[1]
        resultants = domain.whole.plane.sums(self._traction) * domain.whole.cell_area
        free = contact.constraints.free
        targets = contact.constraints.targets + resultants
        if free[0] and problem.spring == 0 and targets[0] <= 0:
            given = contact.constraints.with_prescribed(np.zeros(3))
            nothing = Guess(np.zeros((2, *domain.shape)), given)
            return Descended(nothing, self._traction, np.inf, -np.inf, detached=True)
        pressed = self._pressed_under(open_gap, targets)
        self._pressed = pressed
        gap = open_gap + contact.compliance * pressed.unit_displacement
        gap -= domain.whole.plane.field(pressed.motion)
        traction = attraction(self._law, gap, domain.periodic).traction
        change = traction - self._traction
        guess = Guess(pressed.values - pulled, pressed.motion)
        self._traction = traction
        largest, mean = float(np.abs(change).max()), float(change.mean())
        return Descended(guess, traction, largest, mean, change)

    def _pressed_under(self, open_gap: Floats, targets: Floats) -> Guess:
        """Contact under p >= 0 by itself, with the resultants that include the attraction's."""
        contact = replace(self._problem.contact, open_gap=open_gap)
        given = contact.constraints
        force, moment_x, moment_y = (
            float(target) if free else None
            for target, free in zip(targets, given.free, strict=True)
        )
        resultants = force, moment_x, moment_y
        contact = replace(contact, constraints=replace(given, resultants=resultants))
        if self._problem.spring or self._problem.law.decreasing is not self._problem.law:
            found = self._by_newton(contact)
            if found is not None:
                return found
        return self._solved(contact)

    def _by_newton(self, contact: ContactProblem) -> Guess | None:
        """The same with a spring, and with what the law lacks of its decreasing one.

        That is a convex problem, too: Newton's method finds its state from afar. None if not.
        """
        problem, domain = self._problem, self._domain
        convex = replace(problem, contact=contact, law=problem.law.remainder)
        if self._pressed is not None:
            motion = contact.constraints.with_prescribed(self._pressed.motion)
            start = Guess(self._pressed.values.copy(), motion)
        elif problem.spring:
            position = contact.constraints.targets[0] / problem.spring
            start = Guess(np.zeros((2, *domain.shape)), np.array([position, 0.0, 0.0]))
        else:
            start = self._solved(contact)
        found = newton_search(convex, domain, start, self._tolerance)
        self.convolutions += found.convolutions
        return found.iterate if found.converged or problem.spring else None

    def _solved(self, contact: ContactProblem) -> Guess:
        domain, constraints = self._domain, contact.constraints
        motion = constraints.with_prescribed(
            np.zeros(3) if self._pressed is None else self._pressed.motion
        )
        apart = not constraints.free[0] and not constraints.free.any()
        if apart and (contact.open_gap >= domain.whole.plane.field(motion)).all():
            return Guess(np.zeros((2, *domain.shape)), motion)
        guess = None
        if self._pressed is not None and self._pressed.pressure.any():
            guess = Guess(self._pressed.values.copy(), motion)
        found = solve_contact(contact, domain, guess, tolerance=self._tolerance)
        self.convolutions += found.convolutions
        return found.found


def _turns(last: Descended, now: Descended) -> bool:
    """True if an iteration leads back, in the mean or where the attraction changes most."""
    if last.way is None or now.way is None:
        return False
    along = float(np.einsum("ij,ij->", last.way, now.way))
    return along < 0 or last.growth * now.growth < 0
