"""Stability of an adhesive contact: the factor by which a small change of the attraction returns.

A small change y of the attraction moves the surfaces by z = S y where they do not touch, with the
contact and the load held, and this changes the attraction by D z, D = -sigma'. The energy is least
where the largest eigenvalue of D S is below 1 (the change dies out in the descent), and a state
ends where it reaches 1. S is symmetric and positive: the eigenvalue is the largest one of D in the
metric of S, which the Rayleigh-Ritz method finds from few vectors, from below.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy  # its linear algebra is imported at its first use

from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.adhesion.newton import LinearStep
from viscontact.mechanics.contact.adhesion.problem import (
    AdhesiveProblem,
    AdhesiveResidual,
    Attraction,
    attraction,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.problem import Guess
from viscontact.mechanics.contact.rigid_balance import Constraints

#: Vectors of the Rayleigh-Ritz method for a law that decreases, and for one that rises first; each
#: costs the solution of a linear system. They leave an error below a percent of spheres; on a rough
#: surface, where many places compete, the factor is up to 17 % too small, 2 % in the median.
VECTORS, VECTORS_RISING = 2, 4

#: Part of a returned change that is new where the one before is the change sought; the error of the
#: factor is about the square of it.
RETURNS_ALIKE = 0.1

#: Reduction of the residual of these systems [-], and largest one of a system of a small part.
REDUCTION, LARGEST_REDUCTION = 1e-2, 0.3

#: Slopes below this part of the largest one are none [-].
NEGLIGIBLE_SLOPE = 1e-6


def stability(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    solution: ContactSolution,
    moved: Floats | None = None,
) -> tuple[float, Floats | None]:
    """Factor by which a small change of the attraction returns, < 1 if stable; and its moves.

    `moved` are those of a state before [m].
    """
    pulled = attraction(problem.law, solution.gap, domain.periodic)
    falls = np.where(solution.in_contact, 0.0, -pulled.slope)
    falls[~np.isfinite(solution.gap)] = 0.0
    if problem.contact.compliance == 0 or not falls.any():
        return 0.0, None  # the surfaces do not move, or do not attract each other
    vectors = VECTORS if problem.law.decreasing is problem.law else VECTORS_RISING
    change = np.where(falls > 0, falls, 0.0)
    if moved is not None and (falls * moved).any():
        change = falls * moved
    changes: list[Floats] = []
    moves: list[Floats] = []
    reduction = REDUCTION
    while True:
        changes.append(change * (problem.law.strength / np.abs(change).max()))
        moves.append(_opened_by(problem, domain, solution, changes[-1], reduction))
        moves[-1][falls == 0] = 0.0
        returned = falls * moves[-1]
        change, share = _apart(returned, changes)
        same = share < (NEGLIGIBLE_SLOPE if moved is None else RETURNS_ALIKE)
        if len(changes) == vectors or same:
            break
        # What is new is a small part, and its error a small part of that.
        reduction = min(REDUCTION / share, LARGEST_REDUCTION)
    return _largest_ratio(changes, moves, falls)


def _apart(change: Floats, known: list[Floats]) -> tuple[Floats, float]:
    """What a change has beside its share of known ones, and the part that this is of it."""
    size, left = np.sqrt(np.einsum("ij,ij->", change, change)), change
    for other in known:
        along = np.einsum("ij,ij->", left, other) / np.einsum("ij,ij->", other, other)
        left = left - along * other
    return left, float(np.sqrt(np.einsum("ij,ij->", left, left)) / size) if size else 0.0


def _largest_ratio(
    changes: list[Floats], moves: list[Floats], falls: Floats
) -> tuple[float, Floats]:
    """Largest eigenvalue of D S on the space of some changes y with moves S y, and its moves."""
    y, z = (np.array([each.ravel() for each in fields]) for fields in (changes, moves))
    metric = np.einsum("ik,jk->ij", y, z)
    matrix = np.einsum("ik,k,jk->ij", z, falls.ravel(), z)
    try:
        values, weights = scipy.linalg.eigh((matrix + matrix.T) / 2, (metric + metric.T) / 2)
    except np.linalg.LinAlgError:  # the changes are multiples of one another
        return float(matrix[0, 0] / metric[0, 0]), moves[0]
    pairs = zip(weights[:, -1], moves, strict=True)
    return float(values[-1]), np.asarray(sum(weight * each for weight, each in pairs))


def _opened_by(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    solution: ContactSolution,
    change: Floats,
    reduction: float,
) -> Floats:
    """How far the surfaces approach each other under a change of the attraction [m]."""
    # The equations of Newton's method for an attraction that does not depend on the gap.
    nothing = np.zeros(domain.shape)
    held = AdhesiveResidual(
        np.where(solution.in_contact, 0.0, 1.0),
        Attraction(change, nothing),
        solution.in_contact,
        *(0.0, 1.0, 0.0),
    )
    start = Guess(np.zeros((2, *domain.shape)), np.zeros(3))
    system = LinearStep.of(_unloaded(problem), domain, start, held, 1e-3)
    motion = system.solve(start, reduction)
    if not system.is_whole:
        domain.convolution.apply(start.pressure, into=start.unit_displacement)
    moved = problem.contact.compliance * start.unit_displacement
    moved -= domain.whole.plane.field(motion)
    return -moved


def _unloaded(problem: AdhesiveProblem) -> AdhesiveProblem:
    """The same body without load: what is free is in balance, what is given is held."""
    constraints = problem.contact.constraints
    force, moment_x, moment_y = (0.0 if free else None for free in constraints.free)
    held = Constraints((force, moment_x, moment_y))
    return replace(problem, contact=replace(problem.contact, constraints=held))
