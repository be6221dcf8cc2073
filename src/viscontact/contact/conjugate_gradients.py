"""Bound-constrained conjugate gradients for the pressure of one contact problem, on one patch.

The method follows Polonsky & Keer (1999), Wear 231, 206, and differs from it in:

1. The residual is preconditioned by an approximate inverse of the half-space operator.
2. Directions are conjugated by Polak & Ribiere's formula, with a negative factor set to zero; they
   are not reset when the contact set changes.
3. The displacement is updated along the direction instead of convolved again.
4. Force and both moments are balanced, by planes, in the pressure itself (scaled variables lose
   convergence). Directions are projected so that they change no resultant.
5. Where a step would leave cells in tension, the trial pressure is first cut off and rebalanced,
   and the step is taken straight towards that: one convolution, where cutting afterwards takes two.

The comments in `BoundedCG` number the steps of an iteration:

1. Fit approach and tilts to the gap under pressure by least squares; measure the residual.
2. Add the cells that the body overlaps to the active set; precondition the gap of the active cells.
3. Project the result, and the last direction, so that force and moments do not change.
4. Conjugate both, and step to the least energy along the direction.
5. Cut off tension and restore the balances: by a plane factor, or by adding a plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.domain import Patch
from viscontact.contact.problem import ContactProblem, Guess
from viscontact.contact.rigid_balance import restore_balance
from viscontact.contact.winkler import project_onto_balance

#: Iterations without a new least residual after which the search counts as stagnant.
STAGNATION_ITERATIONS = 40

#: Relative imbalance below which a guess counts as balanced.
BALANCE_TOLERANCE = 1e-12

#: First step length, in 1/compliance. Below 1, as the preconditioner, a spectral inverse,
#: overestimates the stiffness where only some cells carry pressure.
INITIAL_STEP_LENGTH = 0.4

#: Length of a trial step, in expected lengths. A shorter step only loses the remaining way; a
#: longer one cuts off too many cells.
TRIAL_STEP_FACTOR = 0.85

#: A step of less than this part of the way to the trial pressure is not taken.
MIN_STEP_FRACTION = 0.1


@dataclass(frozen=True, eq=False)
class ContactResidual:
    """Residual of the contact conditions for a given pressure."""

    contact: NDArray[np.bool_]  # cells under pressure
    weight: NDArray[np.float64]  # 1 for these, 0 elsewhere
    inverse_gram: NDArray[np.float64]  # inverse Gram matrix of the planes over these cells
    motion: NDArray[np.float64]  # rigid motion that fits best: approach [m], tilts [rad]
    gap: NDArray[np.float64]  # gap with that motion [m]
    gap_in_contact: NDArray[np.float64]  # the same under pressure, 0 elsewhere [m]
    error: float  # largest gap in contact or penetration over the largest displacement [-]


def contact_residual(problem: ContactProblem, patch: Patch, iterate: Guess) -> ContactResidual:
    """Step 1: rigid motion by least squares over the contact, gap and residual."""
    contact = iterate.pressure > 0
    gap = problem.compliance * iterate.unit_displacement
    scale = max(problem.displacement_scale, float(gap.max()))
    gap += problem.open_gap
    gap -= patch.plane.field(iterate.motion)
    gap_in_contact = np.where(contact, gap, 0.0)
    weight = contact.astype(float)
    inverse = patch.plane.inverse_gram(weight, problem.constraints.free)
    # Fitted as a correction, so that a motion which the contact does not determine is unchanged.
    correction = inverse @ patch.plane.sums(gap_in_contact)
    gap -= patch.plane.field(correction)
    np.copyto(gap_in_contact, gap, where=contact)
    error = max(float(gap_in_contact.max()), -float(gap.min()), 0.0) / scale
    return ContactResidual(
        contact, weight, inverse, iterate.motion + correction, gap, gap_in_contact, error
    )


class BoundedCG:
    """Bound-constrained conjugate gradients on one patch, from a guess on that patch."""

    def __init__(self, problem: ContactProblem, patch: Patch, start: Guess) -> None:
        self.problem, self.patch = problem, patch
        self.iterations = self.convolutions = 0
        motion = problem.constraints.with_prescribed(start.motion)
        self.iterate = Guess(start.pressure, start.unit_displacement, motion)
        self._active = np.zeros(0, dtype=bool)
        self._residual = self._direction = np.zeros(0)
        self._slope = 0.0
        self._length = INITIAL_STEP_LENGTH / problem.compliance
        self.stagnated = not (self._is_feasible() or self._project_to_feasible(start.pressure))

    def run(self, tolerance: float, max_iterations: int) -> None:
        """Iterate until the relative residual meets the tolerance, or no progress is made."""
        best, since_best = np.inf, 0
        while not self.stagnated:
            # Step 1: measure the residual.
            checked = contact_residual(self.problem, self.patch, self.iterate)
            self.iterate = Guess(
                self.iterate.pressure, self.iterate.unit_displacement, checked.motion
            )
            if checked.error <= tolerance:
                return
            since_best = 0 if checked.error < best else since_best + 1
            best = min(best, checked.error)
            self.stagnated = self.iterations >= max_iterations or since_best > STAGNATION_ITERATIONS
            if not self.stagnated:
                self._advance(checked)

    def _advance(self, checked: ContactResidual) -> None:
        """Steps 2 to 5: one conjugate-gradient iteration from a measured residual."""
        # Step 2: release the cells that the body overlaps, and precondition.
        released = checked.gap < 0
        released &= ~checked.contact
        active, weight, residual = checked.contact, checked.weight, checked.gap_in_contact
        inverse = checked.inverse_gram
        if released.any():
            active = active | released
            weight, residual = active.astype(float), np.where(active, checked.gap, 0.0)
            inverse = self.patch.plane.inverse_gram(weight, self.problem.constraints.free)
        # Step 3: project.
        direction = self._project(self.patch.preconditioner.apply(residual), weight, inverse)
        slope = _inner(direction, residual)
        # Step 4: conjugate; beta = max(<z, r - r_old> / <z_old, r_old>, 0) (Polak & Ribiere).
        if self._slope > 0:
            change = slope - _inner(direction, self._residual)
            before = self._direction
            if not np.array_equal(active, self._active):
                before = self._project(before, weight, inverse)
            # Minus: directions point downhill, the preconditioned residual uphill.
            direction -= max(change / self._slope, 0.0) * before
        self._active, self._residual, self._slope = active, residual, slope
        self._direction = np.negative(direction, out=direction)
        self.iterations += 1
        self._step()

    def _project(
        self, vector: NDArray[np.float64], weight: NDArray[np.float64], inverse: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Step 3: restrict a direction to the active cells, and remove its force and moments."""
        plane = self.patch.plane
        vector = weight * vector
        vector -= weight * plane.field(inverse @ plane.sums(vector))
        return vector

    def _step(self) -> None:
        """Steps 4 and 5: step to the least energy on the direction, or towards the cut pressure."""
        # Step 5: where a step of about the last length leads to tension, step towards the cut and
        # balanced pressure instead of cutting afterwards.
        projected = self._projected_trial()
        if projected is not None and self._step_to_projected(projected):
            return
        # Step 4: exact line search, length = -<r, d> / <d, J K d>.
        direction, before = self._direction, self.iterate
        change = self._unit_displacement_of(direction)
        curvature = self.problem.compliance * _inner(direction, change)
        if curvature <= 0:
            self._slope = 0.0
            return
        self._length = length = -_inner(self._residual, direction) / curvature
        self.iterate = _stepped(before, length, direction, change)
        # Step 5: cut off tension; a plane factor restores the balances.
        if float(self.iterate.pressure.min()) >= 0 or self._project_to_feasible(
            self.iterate.pressure
        ):
            return
        # No plane factor balances the cut pressure. Adding a plane and cutting does, as all active
        # cells together can carry the load.
        self._slope = 0.0
        constraints, plane, area = self.problem.constraints, self.patch.plane, self.patch.cell_area
        nearest = project_onto_balance(
            self.iterate.pressure, self._active, constraints, plane, area
        )
        if not self._project_to_feasible(nearest):
            self._step_to_first_bound(before, length, change)

    def _projected_trial(self) -> NDArray[np.float64] | None:
        """Pressure after a step of about the last length, cut and balanced; None without a cut."""
        ahead = TRIAL_STEP_FACTOR * self._length * self._direction
        ahead += self.iterate.pressure
        return self._balanced(ahead) if float(ahead.min()) < 0 else None

    def _step_to_projected(self, projected: NDArray[np.float64]) -> bool:
        """Step towards a feasible pressure, at most all the way; whether that is far enough."""
        # Exact line search on the segment from the iterate to the projected pressure.
        before, step = self.iterate, projected - self.iterate.pressure
        change = self._unit_displacement_of(step)
        curvature = self.problem.compliance * _inner(step, change)
        best = -_inner(self._residual, step) / curvature if curvature > 0 else 0.0
        if best < MIN_STEP_FRACTION:
            return False
        self._length *= TRIAL_STEP_FACTOR * min(max(best, 0.5), 2.0)
        moved = _stepped(before, min(best, 1.0), step, change)
        self.iterate = (
            moved if best < 1 else Guess(projected, moved.unit_displacement, moved.motion)
        )
        return True

    def _step_to_first_bound(
        self, before: Guess, length: float, change: NDArray[np.float64]
    ) -> None:
        """Step until the first cell loses its pressure, which keeps the balances."""
        step = length * self._direction
        room = np.divide(before.pressure, -step, out=np.full(step.shape, np.inf), where=step < 0)
        part = float(room.min())
        moved = _stepped(before, length * part, self._direction, change)
        # Exactly zero: a remainder from rounding would keep all later steps as short.
        pressure = np.where(room == part, 0.0, np.maximum(moved.pressure, 0.0))
        self.iterate = Guess(pressure, moved.unit_displacement, moved.motion)

    def _is_feasible(self) -> bool:
        """True if the pressure is non-negative and balanced to rounding."""
        sums = self.patch.plane.sums(self.iterate.pressure) * self.patch.cell_area
        off = self.problem.constraints.imbalance(sums, self.patch.arm)
        return float(self.iterate.pressure.min()) >= 0 and off < BALANCE_TOLERANCE

    def _project_to_feasible(self, pressure: NDArray[np.float64]) -> bool:
        """Cut off tension and restore the balances; whether that was possible."""
        pressure = np.where(np.isfinite(self.problem.open_gap), pressure, 0.0)
        restored = self._balanced(pressure)
        if restored is None:
            return False
        change = self._unit_displacement_of(restored - self.iterate.pressure)
        self.iterate = Guess(restored, self.iterate.unit_displacement + change, self.iterate.motion)
        return True

    def _balanced(self, pressure: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Pressure without tension, balanced by a plane factor; None where no factor does it."""
        patch = self.patch
        return restore_balance(
            np.maximum(pressure, 0.0),
            self.problem.constraints,
            patch.plane,
            patch.cell_area,
            patch.arm,
        )

    def _unit_displacement_of(self, change: NDArray[np.float64]) -> NDArray[np.float64]:
        """Unit displacement ``K change`` by a convolution on the patch [Pa m]."""
        self.convolutions += 1
        return self.patch.convolution.apply(change)


def _stepped(
    iterate: Guess, length: float, direction: NDArray[np.float64], change: NDArray[np.float64]
) -> Guess:
    """Iterate after a step along a direction of known unit displacement."""
    return Guess(
        iterate.pressure + length * direction,
        iterate.unit_displacement + length * change,
        iterate.motion,
    )


def _inner(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    # Not a dot product of BLAS, which would put threads to work.
    """Inner product, not by BLAS, which would start threads."""
    return float(np.einsum("ij,ij->", a, b))
