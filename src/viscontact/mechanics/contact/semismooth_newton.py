"""Semismooth Newton method for the contact problem of a body in steady motion.

The operator of a moving contact is not symmetric, and there is no energy that conjugate gradients
could minimise. The method is an active set strategy (Hintermueller, Ito & Kunisch 2003, SIAM J.
Optim. 13, 865): all cells of the set are brought into contact at once, by GMRES (Saad & Schultz
1986), and the set follows from this pressure before tension is cut off. The comments in
`newton_search` number the steps:

1. Measure the residual of the pressure, which is balanced and without tension.
2. Solve for the change of pressure that closes the gap on the set, without force or moments.
3. New set: its cells under pressure, and those beside it that the body overlaps.
4. Cut off tension, restore the balances by a plane factor, and convolve the pressure.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.contact_residual import ContactResidual, contact_residual
from viscontact.mechanics.contact.moving_domain import MovingDomain
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import restore_balance
from viscontact.mechanics.contact.winkler import project_onto_balance

#: Newton steps of one search. Where the method converges, it mostly takes fewer than ten.
MAX_STEPS = 12

#: Vectors of GMRES, and the reduction of the residual at which it ends [-]. A set from a less
#: accurate solution may cycle.
MAX_VECTORS, REDUCTION = 15, 2e-2

#: Residual of the linear system that is accurate enough, as a part of the tolerance.
INNER_TOLERANCE = 0.1


@dataclass(frozen=True, eq=False)
class NewtonResult:
    """Best pressure of a search, with its residual and the cost."""

    iterate: Guess
    checked: ContactResidual
    steps: int
    convolutions: float  # in those of the whole grid

    @property
    def error(self) -> float:
        """Relative residual of the contact conditions [-]."""
        return self.checked.error


def newton_search(
    problem: ContactProblem,
    domain: MovingDomain,
    start: Guess,
    tolerance: float,
    max_steps: int = MAX_STEPS,
) -> NewtonResult:
    """Search from a balanced pressure until the residual on the whole grid meets the tolerance."""
    iterate, checked = _balance(problem, domain, start.pressure, start)
    best, work = NewtonResult(iterate, checked, 0, 1.0), 1.0
    active = checked.in_contact | (checked.gap < 0)
    for step in range(1, max_steps + 1):
        if best.error <= tolerance:
            break
        # Steps 2 and 3: close the gap on the set, and find the next set.
        patch = domain.patch_around(active)
        system = _LinearSystem(problem, patch, patch.cut(active))
        accuracy = INNER_TOLERANCE * tolerance * _displacement(problem, iterate)
        change, gap = system.closed(patch.cut(checked.gap), accuracy)
        pressure = iterate.pressure.copy()
        patch.cut(pressure)[...] += change
        pressed = pressure > 0
        active = np.where(active, pressed, checked.gap < 0)
        patch.cut(active)[...] = np.where(system.cells, patch.cut(pressed), gap < 0)
        # Step 4: cut off tension, balance, and convolve.
        balanced = _feasible(pressure, problem, domain, active | pressed)
        if balanced is None:
            break
        # Step 1: measure.
        iterate, checked = _balance(problem, domain, balanced, iterate)
        work += 1 + system.convolutions * change.size / pressure.size
        if checked.error < best.error:
            best = NewtonResult(iterate, checked, step, work)
    return replace(best, convolutions=work)


def _balance(
    problem: ContactProblem, domain: MovingDomain, pressure: Floats, before: Guess
) -> tuple[Guess, ContactResidual]:
    """Balanced pressure with its displacement and best motion, and its residual."""
    convolved = Guess.of(pressure, domain.convolution.apply(pressure), before.motion)
    checked = contact_residual(problem, domain.whole, convolved)
    return replace(convolved, motion=checked.motion), checked


def _displacement(problem: ContactProblem, iterate: Guess) -> float:
    """Displacement that errors are relative to [m]."""
    largest = problem.compliance * float(iterate.unit_displacement.max())
    return max(problem.displacement_scale, largest)


class _LinearSystem:
    """Equations of a set of cells in contact on a patch, on changes without force or moments."""

    def __init__(self, problem: ContactProblem, patch: Patch, cells: Bools) -> None:
        self.cells, self.convolutions = cells, 0
        self._patch, self._compliance = patch, problem.compliance
        self._weight = cells.astype(float)
        self._inverse = patch.plane.inverse_gram(self._weight, problem.constraints.free)

    def closed(self, gap: Floats, accuracy: float) -> tuple[Floats, Floats]:
        """Change of pressure that closes the gap on the set, and the gap after it."""
        # By GMRES, preconditioned from the right, until the norm of the gap on the set is down to
        # an accuracy [m] or a fiftieth.
        cells = self.cells
        residual = self._projected(gap)[cells]
        norm = _norm(residual)
        goal = max(REDUCTION * norm, accuracy)
        factors: Floats = np.empty(0)
        basis = [residual / norm] if norm else []
        directions: list[Floats] = []
        images: list[Floats] = []
        hessenberg = np.zeros((MAX_VECTORS + 1, MAX_VECTORS))
        left = norm
        while left > goal and len(directions) < MAX_VECTORS:
            column = len(directions)
            direction, image = self._direction(basis[-1])
            directions.append(direction[cells])
            images.append(image)
            # Modified Gram-Schmidt.
            new = self._projected(image)[cells]
            for row, known in enumerate(basis):
                hessenberg[row, column] = along = float(np.einsum("i,i->", known, new))
                new = new - along * known
            hessenberg[column + 1, column] = length = _norm(new)
            factors, left = _least_squares(hessenberg[: column + 2, : column + 1], norm)
            if length == 0:
                break
            basis.append(new / length)
        change = np.zeros(gap.shape)
        gap = gap.copy()
        for factor, direction, image in zip(factors, directions, images, strict=True):
            change[cells] -= factor * direction
            gap -= factor * image
        # The rigid motion that fits the new gap on the set.
        plane = self._patch.plane
        gap -= plane.field(self._inverse @ plane.sums(np.where(cells, gap, 0.0)))
        return change, gap

    def _direction(self, vector: Floats) -> tuple[Floats, Floats]:
        """Preconditioned direction of pressure [Pa], and its displacement [m]."""
        field = np.zeros(self.cells.shape)
        field[self.cells] = vector
        direction = self._projected(self._patch.preconditioner.apply(field)) / self._compliance
        self.convolutions += 1
        return direction, self._compliance * self._patch.convolution.apply(direction)

    def _projected(self, field: Floats) -> Floats:
        """Part of a field on the set that has no force and moments."""
        plane, weight = self._patch.plane, self._weight
        field = np.where(self.cells, field, 0.0)
        field -= weight * plane.field(self._inverse @ plane.sums(field))
        return field


def _least_squares(hessenberg: Floats, norm: float) -> tuple[Floats, float]:
    """Factors of the directions with the least residual, and its norm."""
    right = np.zeros(len(hessenberg))
    right[0] = norm
    factors = np.linalg.lstsq(hessenberg, right, rcond=None)[0].astype(np.float64)
    return factors, _norm(hessenberg @ factors - right)


def _feasible(
    pressure: Floats,
    problem: ContactProblem,
    domain: MovingDomain,
    cells: Bools,
) -> Floats | None:
    """Pressure without tension, balanced by a plane factor, else by adding a plane on cells."""
    whole, constraints = domain.whole, problem.constraints
    others = constraints, whole.plane, whole.cell_area
    balanced = restore_balance(np.maximum(pressure, 0.0), *others, whole.arm)
    if balanced is None:
        nearest = project_onto_balance(pressure, cells, *others)
        balanced = restore_balance(nearest, *others, whole.arm)
    return balanced


def _norm(field: Floats) -> float:
    # Not by BLAS, which would start threads.
    """Euclidean norm."""
    flat = field.ravel()
    return float(np.sqrt(np.einsum("i,i->", flat, flat)))
