"""Newton's step on the discs: a linear system on the free directions, by conjugate gradients."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Singles
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.directions import Directions
from viscontact.mechanics.contact.friction.problem import ShearBlock, SlipProblem
from viscontact.mechanics.contact.friction.residual import SlipResidual
from viscontact.mechanics.contact.friction.rigid_shift import pseudo_inverse

#: Least and largest part of the residual that the conjugate gradients leave, and its ratio to the
#: residual between them: far away, where cells that slip are found, more would be in vain.
LEAST_LEFT, MOST_LEFT, LEFT = 0.01, 0.3, 5.0

#: Imbalance over what friction carries that needs no restoring: that of balanced tractions.
RESTORED = 1e-12

#: Search directions of one step.
MAX_DIRECTIONS = 120

TINY = float(np.finfo(np.float64).tiny)

#: Displacement of a cell by its own unit traction, over the cell's edge [-].
OWN = 1.1


@dataclass(frozen=True, eq=False)
class NewtonSystem:
    """Matrix T + diagonal on the free directions, over compliance and the edge of a cell."""

    problem: SlipProblem
    block: ShearBlock
    directions: Directions

    @cached_property
    def unit(self) -> float:
        """Displacement per traction that the system counts in [m/Pa]."""
        return self.problem.compliance * self.block.edge

    @cached_property
    def normal(self) -> Singles:
        """Directions that are not free in cells that slip."""
        return self.directions.normal.astype(np.float32)

    @cached_property
    def held(self) -> Bools:
        """Cells under pressure."""
        return self.directions.sticks | self.directions.slips

    @cached_property
    def entry(self) -> Singles:
        """Compliance of cells that enter [-]."""
        return (self.problem.entry / self.unit).astype(np.float32)

    @cached_property
    def curvature(self) -> Singles:
        """λ/(μ p) of cells that slip [-]."""
        bound, directions = self.problem.bound, self.directions
        ratio = np.divide(
            directions.pull, bound * self.unit, out=np.zeros(bound.shape), where=directions.slips
        )
        return ratio.astype(np.float32)

    @cached_property
    def _diagonal(self) -> Singles:
        """Mean of the diagonal over the free directions of a cell [-]."""
        xx, xy, yy = self.entry
        x, y = self.normal
        tangent = yy * x * x - 2 * xy * x * y + xx * y * y + self.curvature
        return np.asarray(np.where(self.directions.slips, tangent, (xx + yy) / 2), np.float32)

    @cached_property
    def _share(self) -> Singles:
        """Root of the part of the half-space in the diagonal of each cell [-]."""
        return np.asarray(1 / np.sqrt(1 + self._diagonal / OWN), np.float32)

    @cached_property
    def _local(self) -> Singles:
        """Inverse of the diagonal times the part that is not the half-space's [-]."""
        return np.asarray((1 - self._share**2) / (self._diagonal + OWN), np.float32)

    def projected(self, fields: Singles) -> Singles:
        """Components along free directions."""
        x, y = self.normal
        along = x * fields[0] + y * fields[1]
        return np.asarray((fields - self.normal * along) * self.held)

    def apply(self, step: Singles) -> Singles:
        """The matrix times a step along free directions [-]."""
        found = np.asarray(self.block.search.apply(step) / self.block.edge, np.float32)
        if self.problem.enters:
            x, y = step
            xx, xy, yy = self.entry
            found[0] += xx * x + xy * y
            found[1] += xy * x + yy * y
        return np.asarray(self.projected(found) + self.curvature * step)

    def preconditioned(self, residual: Singles) -> Singles:
        """Approximate inverse: of the half-space where it is soft, of the diagonal elsewhere."""
        filtered: Singles = self.block.preconditioner.apply(self._share * residual)
        found: Singles = (
            self._share * filtered * np.float32(self.block.edge) + self._local * residual
        )
        return self.projected(found)


class ConstrainedSteps:
    """Preconditioner of the system under the constraint of the resultants.

    Conjugate gradients with M^-1 r less the motions' M^-1 E that restore the resultants stay on the
    constraint (N. Gould, M. Hribar, J. Nocedal, SIAM J. Sci. Comput. 23 (2001) 1376).
    """

    def __init__(self, system: NewtonSystem) -> None:
        self._system, self._shift = system, system.block.shift
        constraints = system.problem.constraints
        #: A rotation counts as a shift at the arm.
        self._scales = np.array([1.0, 1.0, 1 / constraints.arm])
        self._motions = [
            system.preconditioned(system.projected(self._shift.field(unit).astype(np.float32)))
            if free
            else np.zeros(system.normal.shape, np.float32)
            for unit, free in zip(np.diag(self._scales), constraints.free, strict=True)
        ]
        gram = np.array([self._resultants(motion) for motion in self._motions])
        self._inverse = pseudo_inverse((gram + gram.T) / 2, constraints.free, 1.0)

    def _resultants(self, fields: Singles) -> Floats:
        return np.asarray(self._shift.resultants(fields) * self._scales)

    def restoring(self, lacking: Floats) -> Singles:
        """Step with given resultants [N, N, N m]."""
        return self._moved(self._inverse @ (lacking * self._scales))

    def preconditioned(self, residual: Singles) -> tuple[Singles, Floats]:
        """Step without resultants for a residual, and the motion that is taken out of it."""
        step = self._system.preconditioned(residual)
        motion = self._inverse @ self._resultants(step)
        return step - self._moved(motion), motion * self._scales

    def largest_left(self, residual: Singles, motion: Floats) -> float:
        """Largest component of a residual without a motion [-]."""
        rigid = self._shift.field(motion).astype(np.float32)
        return float(np.abs(residual - self._system.projected(rigid)).max())

    def _moved(self, coefficients: Floats) -> Singles:
        pairs = zip(coefficients.astype(np.float32), self._motions, strict=True)
        return np.asarray(sum(coefficient * motion for coefficient, motion in pairs))


@dataclass(frozen=True, eq=False)
class NewtonStep:
    """Step of Newton's method, and the search directions that it took."""

    traction: Floats  # change of the traction [Pa]
    motion: Floats  # change of the motion [m, m, rad]
    slips: Bools  # cells that are taken to slip
    iterations: int
    convolutions: int


def newton_step(
    problem: SlipProblem,
    block: ShearBlock,
    traction: Floats,
    found: SlipResidual,
    tolerance: float,
) -> NewtonStep:
    """Step from a traction with its residual."""
    directions = found.directions
    system = NewtonSystem(problem, block, directions)
    # Projected in double precision: most of the slip is along the traction.
    target = found.along / -system.unit
    largest = float(np.abs(target).max()) or 1.0
    residual = (target / largest).astype(np.float32)
    steps = ConstrainedSteps(system)
    # Resultants first, of which conjugate gradients change nothing.
    resultants = block.shift.resultants(traction)
    first = np.zeros(residual.shape, np.float32)
    carried, restores = float(problem.bound.sum()) * block.shift.cell_area, False
    if problem.constraints.imbalance(resultants, carried) > RESTORED:
        restores = True
        first = steps.restoring(problem.constraints.lacking(resultants) / largest)
        residual = residual - system.apply(first)
    least = _forcing(found.error, tolerance)
    step, motion, iterations = conjugate_gradients(system, steps, residual, least)
    # In double precision, as cells that slip must not leave their circles by rounding.
    along: Floats = (first + step).astype(np.float64) * largest
    moved = directions.projected(along)
    change = -motion * (largest * system.unit)
    return NewtonStep(moved, change, directions.slips, iterations, iterations + restores)


def _forcing(error: float, tolerance: float) -> float:
    """Part of a residual that conjugate gradients leave."""
    wanted = min(max(LEFT * error, LEAST_LEFT), MOST_LEFT)
    return max(wanted, min(MOST_LEFT, tolerance / max(error, TINY)))


def conjugate_gradients(
    system: NewtonSystem, steps: ConstrainedSteps, residual: Singles, least: float
) -> tuple[Singles, Floats, int]:
    """Step for a residual up to a part `least` of it, the motion taken out, and the directions."""
    step = np.zeros(residual.shape, np.float32)
    conjugate, motion = steps.preconditioned(residual)
    first = energy = _dot(residual, conjugate)
    direction, iterations = conjugate, 0
    while iterations < MAX_DIRECTIONS and (
        energy > least**2 * first or steps.largest_left(residual, motion) > least
    ):
        image = system.apply(direction)
        ratio = np.float32(energy / _dot(direction, image))
        step = step + ratio * direction
        residual = residual - ratio * image
        conjugate, motion = steps.preconditioned(residual)
        before, energy = energy, _dot(residual, conjugate)
        direction = conjugate + np.float32(energy / before) * direction
        iterations += 1
        if not energy > 0:  # nothing is left in single precision
            break
    return step, motion, iterations


def _dot(one: Singles, other: Singles) -> float:
    return float(np.einsum("kij,kij->", one, other, dtype=np.float64))
