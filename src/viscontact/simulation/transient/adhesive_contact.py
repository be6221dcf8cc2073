"""Contact of a run whose bodies attract each other: step by step along one stable state.

A step whose force changes little is solved by Newton's method. Where that fails, or the force
changes much, the step control asks for a shorter step; the shortest one is a jump, to the nearest
stable state that the descent finds.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.mechanics.contact.adhesion.equilibrium import (
    released,
    solve_from,
    solve_near,
    traction_at,
)
from viscontact.mechanics.contact.adhesion.problem import AdhesiveProblem, AdhesiveSolution
from viscontact.mechanics.contact.adhesion.stability import ReturnedChange, stability
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.state import Outcome
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.transient.grid_enlargement import GridEnlargement

#: Largest change of the force in a step, over the force or the attraction of the undeformed bodies
#: where they touch, 2 pi w R of a sphere; and where the surfaces meet or part without a jump, whose
#: instant and force the step tells.
LARGEST_CHANGE, CHANGE_WHERE_MET = 0.15, 0.005

#: The same where the pull is above this part of the largest one and grows by less than that part of
#: it in a step: a parabola through three states reads the largest one. On coarse cells the force
#: goes up and down as the contact crosses them, and steps of twice this change read the largest
#: pull with twice the scatter.
CHANGE_WHERE_PULLED, PULL_READ, LEAST_GROWTH = 0.045, 0.99, 0.02

#: Largest error of the predicted force in those, and power of the step with which it grows. A state
#: near the extrapolated one is on the same branch.
LARGEST_ERROR, ERROR_ORDER = 0.01, 3

#: The same where the pull may be the largest one: a parabola through states reads it, whose error
#: grows with the same power. Steps of the error above may miss 0.12 % of a sphere that is withdrawn
#: fast.
LARGEST_ERROR_PULLED = 0.0065

#: The same of bodies that are apart and go on parting, whose state does not end.
LARGEST_ERROR_APART = 0.05

#: Length of a solved step over the longest one up to which it is kept where the pull is below this
#: part of the largest one, whose value and instant need no steps there.
LONGEST_KEPT, PULL_KEPT = 1.25, 0.95

#: The same where the prediction is the state before, as behind a kink of the load: its error is the
#: change, which a shorter step divides. There the pull is not the largest one.
LARGEST_FIRST_CHANGE = 0.03

#: Largest change with a law that ends abruptly: its front crosses cell after cell, which no
#: extrapolation foresees. Spheres of Tabor numbers 0.3, 0.7 and 1 on 64² to 80² cells hold the same
#: in steps of a quarter of it, of it, and of twice as much, within 0.05 %; in steps four times as
#: long they hold up to 0.2 % more, in steps eight times as long 1 % less, which is what cells err.
ABRUPT_CHANGE = 0.02

#: Part of a change of the attraction that counts as one of the force [-].
ATTRACTION_SHARE = 0.5

#: Change of the force, over the same, from which on the shortest step is taken for a jump, and one
#: that ends a smooth part of the run.
JUMP, ENDS_SMOOTH = 0.03, 0.02


@dataclass(frozen=True, eq=False)
class AdhesiveStep:
    """Solution of a step, its outcome, and its length over the longest one allowed."""

    problem: AdhesiveProblem
    solution: AdhesiveSolution
    outcome: Outcome
    change: float  # inf of a jump [-]
    is_too_long: bool = False  # not solved, as a shorter one has to be taken
    jumped: bool = False  # found by descent, or in a step so short that it may pass a jump


class AdhesiveContact:
    """Solves adhesive contacts one after the other; keeps the attraction and force of the last."""

    def __init__(
        self, law: CohesiveLaw, domain: ContactDomain, open_gap: Floats, tolerance: float
    ) -> None:
        """Take the gap of the undeformed bodies on the computed cells [m]."""
        self._law, self._domain, self._tolerance = law, domain, tolerance
        self._traction: Floats | None = None
        self._force = self._attraction = self._largest_pull = 0.0
        self._touches = False
        self._returned: ReturnedChange | None = None  # the change whose factor is the stability
        touching = open_gap - open_gap.min()
        #: Force of the undeformed bodies where they touch [N].
        self._at_touch = self._sum(law.traction(touching, np.zeros(touching.shape)))

    def solve(
        self,
        step: TimeStep,
        contact: ContactProblem,
        guess: Guess | None,
        spring: float | None = None,
    ) -> AdhesiveStep:
        """Solve a step; under a spring [N/m] the prescribed approach is that of the stage."""
        problem = AdhesiveProblem(contact, self._law)
        if spring is not None:
            problem = problem.on_spring(
                spring / self._domain.symmetry_count, contact.constraints.motions[0]
            )
        if contact.compliance == 0:
            return self._stiff(problem)
        if guess is not None and self._traction is not None:
            motion = problem.contact.constraints.with_prescribed(guess.motion)
            predicted = self._sum(guess.pressure)
            start, is_last = Guess(guess.values, motion), step.is_shortest or step.is_jump
            near = solve_near(problem, self._domain, start, self._tolerance, is_last=is_last)
            is_near = near.converged
            change = self._length(near, predicted, smooth=step.smooth) if is_near else math.inf
            jumps = not near.converged or self._change(near) > JUMP
            if change <= self._longest_kept(near) or (step.is_shortest and not jumps):
                outcome, length = _outcome(near), min(change, 1.0)
                return AdhesiveStep(problem, near, outcome, length, jumped=step.is_shortest)
            if not is_last:
                return AdhesiveStep(problem, near, _outcome(near), change, is_too_long=True)
        return self._jumped(problem)

    def accept(self, step: AdhesiveStep) -> None:
        """Continue from the solution of a step."""
        self._traction = step.solution.traction
        self._force = self._sum(step.solution.found.pressure)
        self._largest_pull = max(self._largest_pull, -self._force)
        self._attraction = self._sum(step.solution.traction)
        self._touches = bool(step.solution.in_contact.any())
        if math.isinf(step.change):
            self._returned = None

    def stability(self, step: AdhesiveStep) -> float:
        """Factor by which a small change of the attraction in a step returns; NaN if unknown."""
        if step.outcome not in (Outcome.CONVERGED, Outcome.NO_CONTACT):
            return math.nan
        posed = step.problem, self._domain, step.solution
        factor, self._returned = stability(*posed, self._returned)
        return factor

    def restart_data(self) -> RestartData:
        """Return the attraction and force of the last step as plain data."""
        return {
            "traction": self._traction,
            "force": self._force,
            "attraction": self._attraction,
            "largest_pull": self._largest_pull,
            "touches": self._touches,
            "returned": self._returned and vars(self._returned),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same run."""
        self._traction, self._force = restart_data["traction"], restart_data["force"]
        self._attraction = restart_data["attraction"]
        self._largest_pull = restart_data["largest_pull"]
        self._touches, returned = restart_data["touches"], restart_data["returned"]
        self._returned = returned and ReturnedChange(**returned)

    def map_fields(self, enlargement: GridEnlargement) -> None:
        """Continue on a larger grid."""
        self._domain, self._returned = enlargement.large, None
        if self._traction is not None:
            self._traction = enlargement.pressure(self._traction)

    def _jumped(self, problem: AdhesiveProblem) -> AdhesiveStep:
        """Nearest stable state from the last one; of bodies that come from afar, at the start."""
        traction, from_afar = self._traction, False
        if traction is None:
            traction = self._at_first(problem)
            # Under a force, or where cells give up one by one, another way may end elsewhere.
            from_afar = not (problem.contact.constraints.free[0] or self._law.is_abrupt)
        given = problem, self._domain, traction, self._tolerance
        found = solve_from(*given, from_afar=from_afar)
        if found is None:
            apart = released(problem, self._domain)
            return AdhesiveStep(problem, apart, Outcome.PULLED_OFF, math.inf, jumped=True)
        change = math.inf if self._change(found) > ENDS_SMOOTH else 1.0
        return AdhesiveStep(problem, found, _outcome(found), change, jumped=True)

    def _at_first(self, problem: AdhesiveProblem) -> Floats:
        """Attraction from which the first contact is found [Pa]."""
        open_gap, constraints = problem.contact.open_gap, problem.contact.constraints
        if not constraints.free[0] or problem.spring:
            return np.zeros(open_gap.shape)
        # Under a force the bodies touch; one that pulls does so after they have come to rest.
        touching = open_gap - open_gap.min()
        traction = traction_at(problem, self._domain, touching)
        if constraints.targets[0] >= 0:
            return traction
        at_rest = solve_from(problem.without_force(), self._domain, traction, self._tolerance)
        return traction if at_rest is None else at_rest.traction

    def _stiff(self, problem: AdhesiveProblem) -> AdhesiveStep:
        """Contact of a body that does not yield at once, under an approach that does not press."""
        motion = np.array(problem.contact.constraints.motions)
        gap = problem.contact.open_gap - self._domain.whole.plane.field(motion)
        traction = traction_at(problem, self._domain, gap)
        found = released(problem, self._domain, traction, motion)
        return AdhesiveStep(problem, found, _outcome(found), 1.0)

    def _change(self, solution: AdhesiveSolution) -> float:
        """Change of the force since the last step, over the scale of forces [-]."""
        return self._apart(solution, self._force, self._attraction)

    def _length(self, solution: AdhesiveSolution, predicted: float, *, smooth: bool) -> float:
        """Length of a step over the longest one, from its change and the predicted force [N]."""
        if self._law.is_abrupt:
            return self._change(solution) / ABRUPT_CHANGE
        pulled = float(solution.predicted) * self._domain.whole.cell_area
        error = self._apart(solution, predicted, pulled * self._domain.symmetry_count)
        touches = bool(solution.in_contact.any())
        parts = not (touches or self._touches) and self._sum(solution.traction) < self._attraction
        largest_error = LARGEST_ERROR_APART if parts else LARGEST_ERROR
        if touches and self._pulls_most(solution):
            largest_error = LARGEST_ERROR_PULLED
        by_error = float(np.power(error / largest_error, 1 / ERROR_ORDER))
        if not smooth:
            by_error = error / LARGEST_FIRST_CHANGE
        largest = CHANGE_WHERE_PULLED if self._pulled_most(solution) else LARGEST_CHANGE
        if touches != self._touches:
            largest = CHANGE_WHERE_MET
        return max(by_error, self._change(solution) / largest)

    def _longest_kept(self, solution: AdhesiveSolution) -> float:
        """Length of a solved step over the longest one up to which it is not repeated."""
        exactly = self._law.is_abrupt or self._pulls_most(solution)
        return 1.0 if exactly else LONGEST_KEPT

    def _pulls_most(self, solution: AdhesiveSolution) -> bool:
        """True where the pull may be the largest one of the run."""
        return -self._sum(solution.found.pressure) > max(PULL_KEPT * self._largest_pull, 0.0)

    def _pulled_most(self, solution: AdhesiveSolution) -> bool:
        """True where the pull may have been the largest one of the run within the step."""
        before, now = -self._force, -self._sum(solution.found.pressure)
        grows = now - before > LEAST_GROWTH * now
        return not grows and max(before, now) > max(PULL_READ * self._largest_pull, 0.0)

    def _apart(self, solution: AdhesiveSolution, force: float, attraction: float) -> float:
        """Distance of a solution from a force and attraction [N], over the scale of forces [-]."""
        now, pulled = self._sum(solution.found.pressure), self._sum(solution.traction)
        # Where the pull is largest, the force hardly changes, but the attraction does.
        apart = max(abs(now - force), ATTRACTION_SHARE * abs(pulled - attraction))
        # On a rough surface the force is the small difference of pressure and attraction.
        share = ATTRACTION_SHARE * max(pulled, self._attraction)
        largest = max(abs(now), abs(self._force), self._at_touch, share)
        return apart / largest if largest else 0.0

    def _sum(self, pressure: Floats) -> float:
        """Force of a pressure on the computed cells, with their mirror images [N]."""
        return float(pressure.sum()) * self._domain.whole.cell_area * self._domain.symmetry_count


def _outcome(solution: AdhesiveSolution) -> Outcome:
    if not solution.converged:
        return Outcome.NOT_CONVERGED
    return Outcome.CONVERGED if solution.in_contact.any() else Outcome.NO_CONTACT
