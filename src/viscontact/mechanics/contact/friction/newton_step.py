"""Newton's step on the discs: a linear system on the free directions, by conjugate gradients."""

from __future__ import annotations

from collections.abc import Sequence
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
LEAST_LEFT, MOST_LEFT, LEFT = 0.01, 0.3, 20.0

#: Factor by which they leave less than that, if the step is then the last one: another one takes as
#: long as two search directions.
WITHIN_REACH = 3.0

#: Imbalance over what friction carries that needs no restoring: that of balanced tractions.
RESTORED = 1e-12

#: Product of a motion with tractions, over the cells, below which these do not restore it [-].
DETERMINED = 1e-12

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
    def held(self) -> Singles:
        """1 in cells under pressure, 0 elsewhere."""
        return self.directions.held.astype(np.float32)

    @cached_property
    def entry(self) -> Singles:
        """Compliance of cells that enter [-]."""
        return (self.problem.entry / self.unit).astype(np.float32)

    @cached_property
    def curvature(self) -> Singles:
        """λ/(μ p) of cells that slip [-]."""
        stiff = self.problem.inverse_bound / self.unit
        return (self.directions.pull * stiff).astype(np.float32)

    @cached_property
    def _diagonal(self) -> Singles:
        """Mean of the diagonal over the free directions of a cell [-]."""
        if not self.problem.enters:
            return self.curvature
        xx, xy, yy = self.entry
        x, y = self.normal
        tangent = yy * x * x - 2 * xy * x * y + xx * y * y + self.curvature
        return np.asarray(np.where(self.directions.slips, tangent, (xx + yy) / 2), np.float32)

    @cached_property
    def softness(self) -> Singles:
        """Part of the half-space in the diagonal of each cell [-]."""
        return np.asarray(1 / (1 + self._diagonal / OWN), np.float32)

    @cached_property
    def _share(self) -> Singles:
        """Its root [-]."""
        return np.sqrt(self.softness)

    @cached_property
    def _local(self) -> Singles:
        """Inverse of the diagonal times the part that is not the half-space's [-]."""
        return np.asarray((1 - self.softness) / (self._diagonal + OWN), np.float32)

    def projected(self, fields: Singles) -> Singles:
        """Components along free directions."""
        x, y = self.normal
        found = self.normal * (x * fields[0] + y * fields[1])
        np.subtract(fields, found, out=found)
        found *= self.held
        return np.asarray(found)

    def apply(self, step: Singles) -> Singles:
        """The matrix times a step along free directions [-]."""
        found: Singles = self.block.search.apply(step) * np.float32(1 / self.block.edge)
        if self.problem.enters:
            x, y = step
            xx, xy, yy = self.entry
            found[0] += xx * x + xy * y
            found[1] += xy * x + yy * y
        found = self.projected(found)
        found += self.curvature * step
        return found

    def preconditioned(self, residual: Singles) -> Singles:
        """Approximate inverse: of the half-space where it is soft, of the diagonal elsewhere."""
        found: Singles = self.block.preconditioner.apply(self._share * residual)
        found *= self._share * np.float32(self.block.edge)
        found += self._local * residual
        return self.projected(found)


class ConstrainedSteps:
    """Preconditioner of the system under the constraint of the resultants.

    Steps Q M^-1 Q^T r with Q = 1 - Z (E^T Z)^-1 E^T of the rigid motions E have no resultants, and
    the matrix is symmetric, whatever tractions Z restore these. Z = M^-1 E is the choice of N.
    Gould, M. Hribar, J. Nocedal, SIAM J. Sci. Comput. 23 (2001) 1376, and takes a filter for each
    motion. Motions over the diagonal, taken here, take none, and no more search directions.
    """

    def __init__(self, system: NewtonSystem) -> None:
        self._system, self._shift = system, system.block.shift
        constraints = system.problem.constraints
        #: A rotation counts as a shift at the arm.
        self._scales = np.array([1.0, 1.0, 1 / constraints.arm])
        units = np.diag(self._scales)
        self._modes = [mode for mode in range(3) if constraints.free[mode]]
        self._rigid = [
            system.projected(self._shift.field(units[mode]).astype(np.float32))
            for mode in self._modes
        ]
        self._restoring = [rigid * system.softness for rigid in self._rigid]
        self._fitting, self._inverse = (
            self._inverse_of(each) for each in (self._rigid, self._restoring)
        )

    def _inverse_of(self, fields: Sequence[Singles]) -> Floats:
        """Inverse of products of the rigid motions with fields, 0 for motions that are held."""
        found, free = np.zeros((3, 3)), np.zeros(3, bool)
        for column, field in zip(self._modes, fields, strict=True):
            found[:, column] = self._along(self._rigid, field)
            # Where all cells slip along a motion, what is left of it is rounding.
            free[column] = found[column, column] > DETERMINED * np.count_nonzero(self._system.held)
        return pseudo_inverse(found, free, 1.0)

    def _along(self, fields: Sequence[Singles], given: Singles) -> Floats:
        """Products of fields with a given one."""
        found = np.zeros(3)
        for mode, field in zip(self._modes, fields, strict=True):
            found[mode] = _dot(field, given)
        return found

    def _less(self, given: Singles, coefficients: Floats, fields: Sequence[Singles]) -> Singles:
        """A field less multiples of others."""
        for mode, field in zip(self._modes, fields, strict=True):
            given = given - np.float32(coefficients[mode]) * field
        return given

    def restoring(self, lacking: Floats) -> Singles:
        """Step with given resultants [N, N, N m]."""
        wanted = lacking * self._scales / self._shift.cell_area
        nothing = np.zeros(self._system.normal.shape, np.float32)
        return self._less(nothing, -(self._inverse @ wanted), self._restoring)

    def preconditioned(self, residual: Singles) -> Singles:
        """Step without resultants for a residual."""
        motion = self._inverse @ self._along(self._restoring, residual)
        step = self._system.preconditioned(self._less(residual, motion, self._rigid))
        return self._less(step, self._inverse @ self._along(self._rigid, step), self._restoring)

    def fitted(self, residual: Singles) -> tuple[Floats, float]:
        """Motion that fits a residual best, and the largest component that it leaves [-]."""
        motion = self._fitting @ self._along(self._rigid, residual)
        left = self._less(residual, motion, self._rigid)
        return motion * self._scales, float(np.abs(left).max())


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
    last = tolerance / max(error, TINY)
    return min(last, MOST_LEFT) if last * WITHIN_REACH >= wanted else wanted


def conjugate_gradients(
    system: NewtonSystem, steps: ConstrainedSteps, residual: Singles, least: float
) -> tuple[Singles, Floats, int]:
    """Step for a residual up to a part `least` of it, the motion taken out, and the directions."""
    step = np.zeros(residual.shape, np.float32)
    motion, left = steps.fitted(residual)
    direction, energy, iterations = step, 1.0, 0
    while left > least and iterations < MAX_DIRECTIONS:
        conjugate = steps.preconditioned(residual)
        before, energy = energy, _dot(residual, conjugate)
        if not energy > 0:  # nothing is left in single precision
            break
        direction = conjugate + np.float32(energy / before) * direction
        image = system.apply(direction)
        ratio = np.float32(energy / _dot(direction, image))
        step = step + ratio * direction
        residual = residual - ratio * image
        motion, left = steps.fitted(residual)
        iterations += 1
    return step, motion, iterations


def _dot(one: Singles, other: Singles) -> float:
    # Sums in double precision would take three times as long.
    return float(np.einsum("kij,kij->", one, other))
