"""Stability of an adhesive contact: the factor by which a small change of the attraction returns.

A small change y of the attraction moves the surfaces by z = S y where they do not touch, with the
contact and the load held, and this changes the attraction by D z, D = -sigma'. The energy is least
where the largest eigenvalue of D S is below 1 (the change dies out in the descent), and a state
ends where it reaches 1. S is symmetric and positive: the eigenvalue is the largest one of D in the
metric of S, which the Rayleigh-Ritz method finds from few vectors.
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

#: Most vectors of the Rayleigh-Ritz method: from no known change, under a law that rises first, and
#: with the change of the state before; each costs the solution of a linear system. Spheres need 2,
#: contacts around which places compete, as the ends and sides of a long one, up to 6. Under a law
#: that rises first, changes of a ring compete: the factor of a sphere is up to 15 % too small near
#: its jumps and 40 % between them, and of a long contact down to half. It would err by more from
#: the change before, which is not used.
VECTORS, VECTORS_RISING, VECTORS_CARRIED = 6, 4, 2

#: Slopes of the first change over half of the grid, along x and y: from one as symmetric as the
#: contact, those that are not would never be found.
SKEWNESS = 0.5, 0.3

#: Part of a returned change that is new, up to which the one from the state before is the change
#: sought; the same of a law that ends abruptly, where the change is one of a narrow front.
RETURNS_ALIKE, RETURNS_ALIKE_ABRUPT = 0.2, 0.05

#: Residual of these systems over the change [-], and largest one of a system of a small part. The
#: error of the factor is about the square of it.
REDUCTION, LARGEST_REDUCTION = 0.1, 0.3

#: The same of a law that rises first.
REDUCTION_RISING, LARGEST_REDUCTION_RISING = 0.3, 0.5

#: Reduction of the residual of a system whose solution is about known, and part of the work of a
#: change that its contact yields at most; the error of the factor is about half of that.
REDUCTION_CARRIED, LARGEST_YIELD, TRIALS = 0.3, 0.1, 4

#: Slopes below this part of the largest one are none [-].
NEGLIGIBLE_SLOPE = 1e-6


@dataclass(frozen=True, eq=False)
class ReturnedChange:
    """Change of the attraction of a state that returns with the largest factor."""

    values: Floats  # pressure, of cells in contact, too [Pa], and its unit displacement [Pa m]
    motion: Floats  # over the compliance
    in_contact: Bools
    free: Bools  # motions that balances determined

    @property
    def pressure(self) -> Guess:
        """Pressure with its displacement, and motion over the compliance."""
        return Guess(self.values, self.motion)


def stability(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    solution: ContactSolution,
    known: ReturnedChange | None = None,
) -> tuple[float, ReturnedChange | None]:
    """Factor by which a small change of the attraction returns, < 1 if stable; and that change.

    `known` is that of a state before; of a law that rises first it is of no use, and not returned.
    """
    pulled = attraction(problem.law, solution.gap, domain.periodic)
    falls = np.where(solution.in_contact, 0.0, -pulled.slope)
    falls[~np.isfinite(solution.gap)] = 0.0
    if problem.contact.compliance == 0 or not falls.any():
        return 0.0, None  # the surfaces do not move, or do not attract each other
    decreases = problem.law.decreasing is problem.law
    held = _Held(problem, domain, solution.in_contact)
    # Of a body that was free to move otherwise the change is another one.
    carries = known is not None and decreases and np.array_equal(known.free, held.free)
    found = [held.carried(known, falls)] if known is not None and carries else []
    change, limit = np.where(falls > 0, falls, 0.0) * _skewed(falls.shape), NEGLIGIBLE_SLOPE
    solves, reductions = VECTORS, (REDUCTION, LARGEST_REDUCTION)
    if not decreases:
        solves, reductions = VECTORS_RISING, (REDUCTION_RISING, LARGEST_REDUCTION_RISING)
    reduction, share = reductions[0], 1.0
    if found:
        change, share = _apart(found[0].returned, [found[0].attraction])
        limit = RETURNS_ALIKE_ABRUPT if problem.law.is_abrupt else RETURNS_ALIKE
        solves = VECTORS_CARRIED
    while len(found) < solves and share >= limit:
        # What is new is a small part, and its error a small part of that.
        reduction = min(reductions[0] / share, reductions[1])
        change *= problem.law.strength / np.abs(change).max()
        found.append(held.answer_to(change, falls, reduction))
        change, share = _apart(found[-1].returned, [each.attraction for each in found])
        limit = NEGLIGIBLE_SLOPE
    factor, weights = _largest_ratio(found, np.flatnonzero(solution.in_contact))
    if not decreases:
        return factor, None
    values = _sum(weights, [each.pressure.values for each in found])
    motion = _sum(weights, [each.pressure.motion for each in found])
    return factor, ReturnedChange(values, motion, solution.in_contact, held.free)


def _skewed(shape: tuple[int, ...]) -> Floats:
    """Plane over a grid, of mean 1."""
    along_x, along_y = (
        slope * np.linspace(-1, 1, cells) for slope, cells in zip(SKEWNESS, shape, strict=True)
    )
    return 1 + along_x[:, None] + along_y


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
        for row, each in enumerate(found):
            metric[row, column] = sum(_works(each, other, contact))
            matrix[row, column] = np.einsum("ij,ij->", each.returned, other.opened)
    if len(found) == 1:
        return float(matrix[0, 0] / metric[0, 0]), np.ones(1)
    try:
        values, vectors = scipy.linalg.eigh((matrix + matrix.T) / 2, (metric + metric.T) / 2)
    except np.linalg.LinAlgError:  # the changes are multiples of one another
        return float(matrix[0, 0] / metric[0, 0]), np.eye(len(found))[0]
    return float(values[-1]), vectors[:, -1]


def _works(each: _Answer, other: _Answer, contact: Integers) -> tuple[float, float]:
    """Work of a change on what another opens, and of its contact on what that yields, per area."""
    work = np.einsum("ij,ij->", each.attraction, other.opened)
    pressed, yielded = each.pressure.pressure.ravel()[contact], other.opened.ravel()[contact]
    return float(work), float(np.einsum("i,i->", pressed, yielded))


def _filled(field: Floats, lost: Bools, wanted: Bools) -> Floats:
    """Field with values in cells that are lost no more: the mean of neighbours that never were."""
    # `field` is zero in the `lost` cells; those that are `wanted` may remain so.
    cells = np.flatnonzero(lost & ~wanted)
    if not cells.size:
        return field
    rows, columns = np.unravel_index(cells, field.shape)
    total, number = np.zeros((2, cells.size))
    for down, right in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        beside = (
            np.clip(rows + down, 0, field.shape[0] - 1),
            np.clip(columns + right, 0, field.shape[1] - 1),
        )
        total += field[beside]
        number += ~lost[beside]
    filled = field.copy()
    filled[rows, columns] = total / np.maximum(number, 1)
    return filled


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

    def answer_to(self, change: Floats, falls: Floats, reduction: float) -> _Answer:
        """Answer to about a change of the attraction [Pa]."""
        # The equations of Newton's method for an attraction that does not depend on the gap.
        start = Guess(np.zeros((2, *self.domain.shape)), np.zeros(3))
        goal = reduction * norm(change.ravel()) / self.problem.law.strength
        return self._solved(start, change, falls, (0.0, goal))

    def carried(self, known: ReturnedChange, falls: Floats) -> _Answer:
        """Answer to about the change that one of a state before returns."""
        opened, contact = self._opened_by(known.pressure), self.in_contact
        # Cells that have parted open about as far as those beside them, and those that have met
        # are pressed as those.
        opened[known.in_contact] = 0.0
        opened = _filled(opened, known.in_contact, contact)
        change = falls * opened
        if not change.any():  # the front of a law that ends abruptly has left all of its cells
            change = falls.copy()
        change *= self.problem.law.strength / np.abs(change).max()
        last = np.where(known.in_contact, 0.0, known.pressure.pressure)
        scale = -np.einsum("ij,ij->", change, last) / np.einsum("ij,ij->", last, last)
        pressed = _filled(
            np.where(known.in_contact, known.pressure.pressure, 0.0), ~known.in_contact, ~contact
        )
        values = np.empty((2, *contact.shape))
        np.multiply(pressed, scale, out=values[0])
        np.copyto(values[0], -change, where=~contact)
        # Single precision is enough, as the answer is one to percents.
        self.domain.whole.convolution.apply(values[0].astype(np.float32), into=values[1])
        found = self.answer(Guess(values, scale * known.motion), falls)
        touching = np.flatnonzero(contact)
        is_balanced = not (self.free.any() or touching.size)
        for _ in range(TRIALS):
            work = np.einsum("ij,ij->", found.attraction, found.opened)
            yielded = (found.pressure.pressure * found.opened).ravel()[touching]
            if is_balanced and np.abs(yielded).sum() <= LARGEST_YIELD * work:
                break
            if self.free.any():
                start = Guess(found.pressure.values, found.pressure.motion * self._compliance)
                found = self._solved(start, change, falls, (REDUCTION_CARRIED, 0.0))
            else:
                found = self._descended(found, falls)
            is_balanced = True
        return found

    def _descended(self, found: _Answer, falls: Floats) -> _Answer:
        """Answer whose contact yields less: to the least energy along the preconditioned yield."""
        whole = self.domain.whole
        values = found.pressure.values
        yielded = np.where(self.in_contact, values[1], 0.0).astype(np.float32)
        way = np.empty((2, *yielded.shape), np.float32)
        whole.preconditioner.apply(yielded, into=way[0])
        way[0] *= self.in_contact
        whole.convolution.apply(way[0], into=way[1])
        slope, bend = (float(np.einsum("ij,ij->", way[0], each)) for each in (yielded, way[1]))
        if bend > 0:
            values = values - (slope / bend) * way
        return self.answer(Guess(values, found.pressure.motion), falls)

    @property
    def free(self) -> Bools:
        """The motions that balances determine."""
        return self.problem.contact.constraints.free

    @property
    def _compliance(self) -> float:
        return self.problem.contact.compliance

    def _solved(
        self, start: Guess, change: Floats, falls: Floats, goals: tuple[float, float]
    ) -> _Answer:
        """Answer to a change [Pa] from a start, whose memory is used, to a reduction and a goal."""
        held = Guess(start.values, start.motion / self._compliance)
        yielded = self._opened_by(held) if start.pressure.any() else 0.0
        posed = AdhesiveResidual(
            np.where(self.in_contact, -yielded, 1.0),
            Attraction(change, np.zeros(self.domain.shape)),
            self.in_contact,
            *(0.0, 1.0, 0.0),
        )
        unloaded = _unloaded(self.problem)
        system = LinearStep.of(unloaded, self.domain, start, posed, 1e-3)
        motion = system.solve(start, *goals)
        if not system.is_whole:
            self.domain.convolution.apply(start.pressure, into=start.unit_displacement)
        return self.answer(Guess(start.values, motion / self._compliance), falls)

    def _opened_by(self, pressure: Guess) -> Floats:
        """How far surfaces approach each other under a pressure, and motion over compliance [m]."""
        opened = self.domain.whole.plane.field(pressure.motion) - pressure.unit_displacement
        opened *= self._compliance
        return np.asarray(opened)

    def answer(self, pressure: Guess, falls: Floats) -> _Answer:
        """Answer that a change of the pressure is, with its motion over the compliance."""
        opened, change = self._opened_by(pressure), -pressure.pressure
        change[self.in_contact] = 0.0
        return _Answer(pressure, change, opened, falls * opened)


def _unloaded(problem: AdhesiveProblem) -> AdhesiveProblem:
    """The same body without load: what is free is in balance, what is given is held."""
    constraints = problem.contact.constraints
    force, moment_x, moment_y = (0.0 if free else None for free in constraints.free)
    held = Constraints((force, moment_x, moment_y))
    return replace(problem, contact=replace(problem.contact, constraints=held))
