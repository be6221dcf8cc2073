"""Stability of an adhesive contact: the factor by which a small change of the attraction returns.

A small change y of the attraction moves the surfaces by z = S y where they do not touch, with the
contact and the load held, and this changes the attraction by D z, D = -sigma'. The energy is least
where the largest eigenvalue of D S is below 1 (the change dies out in the descent), and a state
ends where it reaches 1. S is symmetric and positive: the eigenvalue is the largest one of D in the
metric of S, which the Rayleigh-Ritz method finds from few vectors, from below.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy  # its linear algebra is imported at its first use

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.adhesion.linear_step import LinearStep
from viscontact.mechanics.contact.adhesion.problem import (
    AdhesiveProblem,
    AdhesiveResidual,
    Attraction,
    attraction,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.krylov import norm
from viscontact.mechanics.contact.problem import Guess
from viscontact.mechanics.contact.rigid_balance import Constraints

#: Vectors of the Rayleigh-Ritz method for a law that decreases, and for one that rises first; each
#: costs the solution of a linear system. Under a law that decreases they leave an error below a
#: percent of spheres; on a rough surface, where many places compete, the factor is up to 17 % too
#: small, 2 % in the median. Under one that rises first, changes of a ring compete: the factor of a
#: sphere is up to 15 % too small near its jumps and 40 % between them, and more where the search
#: begins with the change before.
VECTORS, VECTORS_RISING = 2, 4

#: Part of a returned change that is new where the one before is the change sought; the error of the
#: factor is about the square of it.
RETURNS_ALIKE = 0.1

#: Residual of these systems over the change [-], and largest one of a system of a small part. The
#: error of the factor is about the square of it.
REDUCTION, LARGEST_REDUCTION = 0.1, 0.3

#: The same of systems whose solution is about known from the state before, and of a law that rises
#: first: on spheres and on a rough surface the factor errs no more than with the ones above.
REDUCTION_LATER, LARGEST_REDUCTION_LATER = 0.3, 0.5

#: Slopes below this part of the largest one are none [-].
NEGLIGIBLE_SLOPE = 1e-6


def stability(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    solution: ContactSolution,
    known: Guess | None = None,
) -> tuple[float, Guess | None]:
    """Factor by which a small change of the attraction returns, < 1 if stable; and that change.

    The change is one of the pressure [Pa], with the motion under it over the compliance; `known` is
    that of a state before.
    """
    pulled = attraction(problem.law, solution.gap, domain.periodic)
    falls = np.where(solution.in_contact, 0.0, -pulled.slope)
    falls[~np.isfinite(solution.gap)] = 0.0
    if problem.contact.compliance == 0 or not falls.any():
        return 0.0, None  # the surfaces do not move, or do not attract each other
    decreases = problem.law.decreasing is problem.law
    solves = VECTORS if decreases else VECTORS_RISING
    change, found = np.where(falls > 0, falls, 0.0), []
    held = _Held(problem, domain, solution.in_contact)
    start, limit, reductions = None, NEGLIGIBLE_SLOPE, (REDUCTION, LARGEST_REDUCTION)
    if known is not None or not decreases:
        reductions = REDUCTION_LATER, LARGEST_REDUCTION_LATER
    if known is not None and decreases:
        before = held.answer(known, falls)
        if before.returned.any():
            change, start, limit = before.returned, before, RETURNS_ALIKE
    reduction = reductions[0]
    for _ in range(solves):
        change *= problem.law.strength / np.abs(change).max()
        found.append(held.answer_to(change, falls, reduction, start))
        change, share = _apart(found[-1].returned, [each.attraction for each in found])
        if share < limit:
            break
        # What is new is a small part, and its error a small part of that.
        start, reduction = None, min(reductions[0] / share, reductions[1])
    factor, weights = _largest_ratio(found, np.flatnonzero(solution.in_contact))
    if len(found) == 1:
        return factor, found[0].pressure
    pressures = _sum(weights, [each.pressure.values for each in found])
    return factor, Guess(pressures, _sum(weights, [each.pressure.motion for each in found]))


def _apart(change: Floats, known: list[Floats]) -> tuple[Floats, float]:
    """What a change has beside its share of known ones, and the part that this is of it."""
    size, left = norm(change.ravel()), change
    for other in known:
        along = np.einsum("ij,ij->", left, other) / np.einsum("ij,ij->", other, other)
        left = left - along * other
    return left, norm(left.ravel()) / size if size else 0.0


@dataclass(frozen=True, eq=False)
class _Answer:
    """Change of the attraction, and the surfaces' answer."""

    pressure: Guess  # that of the pressure, of cells in contact, too [Pa]; motion over compliance
    attraction: Floats  # that of the attraction, zero in contact [Pa]
    opened: Floats  # how far the surfaces approach each other; in contact an exact one's do not [m]
    returned: Floats  # the change of the attraction that this causes, zero in contact [Pa]


def _largest_ratio(found: list[_Answer], contact: Integers) -> tuple[float, Floats]:
    """Largest eigenvalue of D S on the space of some changes y with moves S y, and its weights."""
    # Twice the energy with the contact held is the work of the changes, less what the contact
    # yields: then an error of the answer counts by its square.
    metric, matrix = np.empty((2, len(found), len(found)))
    for column, other in enumerate(found):
        yielded = other.opened.ravel()[contact]
        for row, each in enumerate(found):
            metric[row, column] = np.einsum("ij,ij->", each.attraction, other.opened)
            pressed = each.pressure.pressure.ravel()[contact]
            metric[row, column] += np.einsum("i,i->", pressed, yielded)
            matrix[row, column] = np.einsum("ij,ij->", each.returned, other.opened)
    if len(found) == 1:
        return float(matrix[0, 0] / metric[0, 0]), np.ones(1)
    try:
        values, vectors = scipy.linalg.eigh((matrix + matrix.T) / 2, (metric + metric.T) / 2)
    except np.linalg.LinAlgError:  # the changes are multiples of one another
        return float(matrix[0, 0] / metric[0, 0]), np.eye(len(found))[0]
    return float(values[-1]), vectors[:, -1]


def _sum(weights: Floats, fields: Sequence[Floats]) -> Floats:
    """Weighted sum of fields."""
    total = weights[0] * fields[0]
    for weight, field in zip(weights[1:], fields[1:], strict=True):
        total += weight * field
    return np.asarray(total)


@dataclass(frozen=True, eq=False)
class _Held:
    """Bodies whose contact is held, under a load that does not change."""

    problem: AdhesiveProblem
    domain: ContactDomain
    in_contact: Bools

    def answer_to(
        self, change: Floats, falls: Floats, reduction: float, known: _Answer | None
    ) -> _Answer:
        """Answer to about a change of the attraction [Pa], beginning with a known one."""
        # The equations of Newton's method for an attraction that does not depend on the gap.
        domain, compliance = self.domain, self.problem.contact.compliance
        yielded: Floats | float = 0.0
        if known is None:
            start = Guess(np.zeros((2, *domain.shape)), np.zeros(3))
        else:
            before = known.attraction
            scale = np.einsum("ij,ij->", change, before) / np.einsum("ij,ij->", before, before)
            motion = scale * compliance * known.pressure.motion
            start, yielded = Guess(scale * known.pressure.values, motion), scale * known.opened
        posed = AdhesiveResidual(
            np.where(self.in_contact, -yielded, 1.0),
            Attraction(change, np.zeros(domain.shape)),
            self.in_contact,
            *(0.0, 1.0, 0.0),
        )
        system = LinearStep.of(_unloaded(self.problem), domain, start, posed, 1e-3)
        motion = system.solve(start, 0.0, reduction * norm(change.ravel()))
        if not system.is_whole:
            domain.convolution.apply(start.pressure, into=start.unit_displacement)
        return self.answer(Guess(start.values, motion / compliance), falls)

    def answer(self, pressure: Guess, falls: Floats) -> _Answer:
        """Answer that a change of the pressure is, with its motion over the compliance."""
        plane = self.domain.whole.plane.field(pressure.motion)
        opened = self.problem.contact.compliance * (plane - pressure.unit_displacement)
        change = -pressure.pressure
        change[self.in_contact] = 0.0
        return _Answer(pressure, change, opened, falls * opened)


def _unloaded(problem: AdhesiveProblem) -> AdhesiveProblem:
    """The same body without load: what is free is in balance, what is given is held."""
    constraints = problem.contact.constraints
    force, moment_x, moment_y = (0.0 if free else None for free in constraints.free)
    held = Constraints((force, moment_x, moment_y))
    return replace(problem, contact=replace(problem.contact, constraints=held))
