"""The search for the pressure of one contact problem, on one patch of the half-space.

A preconditioned conjugate-gradient iteration that treats the bound p >= 0 and the balances
together. Each pass

1. finds approach and tilts by least squares of the gap under pressure, and measures the error;
2. releases the cells that the body overlaps, and preconditions the gap of the active cells;
3. projects what would change force or moments out of it and of the last direction;
4. makes both a Polak-Ribiere+ direction (not reset when cells come or go) and looks where a step of
   the length that is to be expected leads: where nothing loses its pressure there, it steps along
   the direction to the least energy;
5. else it cuts off tension, restores the balances by a plane factor, and steps straight towards
   that to the least energy, or all the way: one convolution, where cutting afterwards takes two. A
   step that turned out longer than expected is cut afterwards; where no plane factor restores the
   balances a plane is added.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.domain import Patch
from viscontact.contact.problem import ContactProblem, Guess
from viscontact.contact.rigid_balance import restore_balance
from viscontact.contact.winkler import project_onto_balance

#: Iterations without a new best error after which a search is called stagnant.
STAGNATION_ITERATIONS = 40

#: Moments and force of a guess within this are as good as balanced.
BALANCE_TOLERANCE = 1e-12

#: Length of a first step where the preconditioner, an inverse by waves, tells all: on cells that
#: carry pressure alone it sees a half-space stiffer than it is.
INITIAL_STEP_LENGTH = 0.4

#: Part of the length to be expected that is aimed at: from a point short of the best one nothing
#: is lost but the rest of the way, beyond it too much has been cut.
TRIAL_STEP_FACTOR = 0.85

#: Towards what was aimed at less than this part of the way leads nowhere.
MIN_STEP_FRACTION = 0.1


@dataclass(frozen=True, eq=False)
class ContactResidual:
    """How far a pressure is from equilibrium.

    Attributes
    ----------
    contact : ndarray of bool
        Cells under pressure.
    weight : ndarray
        One for these, zero elsewhere.
    inverse_gram : ndarray, shape (3, 3)
        Of the planes over these cells.
    motion : ndarray, shape (3,)
        Rigid motion that fits best.
    gap : ndarray
        Gap with that motion [m].
    gap_in_contact : ndarray
        The same under pressure, zero elsewhere [m].
    error : float
        Largest gap under pressure or penetration elsewhere, over the largest displacement.
    """

    contact: NDArray[np.bool_]
    weight: NDArray[np.float64]
    inverse_gram: NDArray[np.float64]
    motion: NDArray[np.float64]
    gap: NDArray[np.float64]
    gap_in_contact: NDArray[np.float64]
    error: float


def contact_residual(problem: ContactProblem, patch: Patch, iterate: Guess) -> ContactResidual:
    """Step 1: rigid motion by least squares over the contact, the gap, and its errors.

    Parameters
    ----------
    problem : ContactProblem
        Gap, compliance and constraints.
    patch : Patch
        The cells.
    iterate : Guess
        Pressure and unit_displacement.

    Returns
    -------
    ContactResidual
        Gap and error.
    """
    contact = iterate.pressure > 0
    gap = problem.compliance * iterate.unit_displacement
    scale = max(problem.displacement_scale, float(gap.max()))
    gap += problem.open_gap
    gap -= patch.plane.field(iterate.motion)
    gap_in_contact = np.where(contact, gap, 0.0)
    weight = contact.astype(float)
    inverse = patch.plane.inverse_gram(weight, problem.constraints.free)
    # A correction, so that a motion the contact does not determine stays as it was.
    correction = inverse @ patch.plane.sums(gap_in_contact)
    gap -= patch.plane.field(correction)
    np.copyto(gap_in_contact, gap, where=contact)
    error = max(float(gap_in_contact.max()), -float(gap.min()), 0.0) / scale
    return ContactResidual(
        contact, weight, inverse, iterate.motion + correction, gap, gap_in_contact, error
    )


class BoundedCG:
    """The iteration on one patch, with its working state.

    Parameters
    ----------
    problem : ContactProblem
        The problem on the patch.
    patch : Patch
        The cells.
    start : Guess
        Where it starts, on the patch.
    """

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
        """Iterate until the tolerance is met, or no progress is made.

        Parameters
        ----------
        tolerance : float
            Bound on the relative residual.
        max_iterations : int
            Most search directions.
        """
        best, since_best = np.inf, 0
        while not self.stagnated:
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
        """Steps 2 to 5: precondition, project, conjugate, step exactly, cut and rebalance."""
        released = checked.gap < 0
        released &= ~checked.contact
        active, weight, residual = checked.contact, checked.weight, checked.gap_in_contact
        inverse = checked.inverse_gram
        if released.any():
            active = active | released
            weight, residual = active.astype(float), np.where(active, checked.gap, 0.0)
            inverse = self.patch.plane.inverse_gram(weight, self.problem.constraints.free)
        direction = self._project(self.patch.preconditioner.apply(residual), weight, inverse)
        slope = _inner(direction, residual)
        if self._slope > 0:
            change = slope - _inner(direction, self._residual)
            before = self._direction
            if not np.array_equal(active, self._active):
                before = self._project(before, weight, inverse)
            # The sign: directions lead downhill, the preconditioned residual uphill.
            direction -= max(change / self._slope, 0.0) * before
        self._active, self._residual, self._slope = active, residual, slope
        self._direction = np.negative(direction, out=direction)
        self.iterations += 1
        self._step()

    def _project(
        self, vector: NDArray[np.float64], weight: NDArray[np.float64], inverse: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Remove from a direction what lies outside the active cells or changes resultants."""
        plane = self.patch.plane
        vector = weight * vector
        vector -= weight * plane.field(inverse @ plane.sums(vector))
        return vector

    def _step(self) -> None:
        """Steps 4 and 5: to the least energy along the direction, or towards where a cut leads."""
        projected = self._projected_trial()
        if projected is not None and self._step_to_projected(projected):
            return
        direction, before = self._direction, self.iterate
        change = self._unit_displacement_of(direction)
        curvature = self.problem.compliance * _inner(direction, change)
        if curvature <= 0:
            self._slope = 0.0
            return
        self._length = length = -_inner(self._residual, direction) / curvature
        self.iterate = _stepped(before, length, direction, change)
        if float(self.iterate.pressure.min()) >= 0 or self._project_to_feasible(
            self.iterate.pressure
        ):
            return
        # No plane factor balances what is left after the cut; adding a plane and cutting does, as
        # all active cells together can carry the load.
        self._slope = 0.0
        constraints, plane, area = self.problem.constraints, self.patch.plane, self.patch.cell_area
        nearest = project_onto_balance(
            self.iterate.pressure, self._active, constraints, plane, area
        )
        if not self._project_to_feasible(nearest):
            self._step_to_first_bound(before, length, change)

    def _projected_trial(self) -> NDArray[np.float64] | None:
        """Where a step of about the usual length leads, cut and balanced; None without a cut."""
        ahead = TRIAL_STEP_FACTOR * self._length * self._direction
        ahead += self.iterate.pressure
        return self._balanced(ahead) if float(ahead.min()) < 0 else None

    def _step_to_projected(self, projected: NDArray[np.float64]) -> bool:
        """Step to the least energy on the way to a pressure, or all the way; whether that helps."""
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
        """Go only as far as the first cells lose their pressure, and nothing is out of balance."""
        step = length * self._direction
        room = np.divide(before.pressure, -step, out=np.full(step.shape, np.inf), where=step < 0)
        part = float(room.min())
        moved = _stepped(before, length * part, self._direction, change)
        # Exactly none: with a trifle that rounding left them no later step would get anywhere.
        pressure = np.where(room == part, 0.0, np.maximum(moved.pressure, 0.0))
        self.iterate = Guess(pressure, moved.unit_displacement, moved.motion)

    def _is_feasible(self) -> bool:
        sums = self.patch.plane.sums(self.iterate.pressure) * self.patch.cell_area
        off = self.problem.constraints.imbalance(sums, self.patch.arm)
        return float(self.iterate.pressure.min()) >= 0 and off < BALANCE_TOLERANCE

    def _project_to_feasible(self, pressure: NDArray[np.float64]) -> bool:
        """Cut off tension and restore the balances; whether that could be done."""
        pressure = np.where(np.isfinite(self.problem.open_gap), pressure, 0.0)
        restored = self._balanced(pressure)
        if restored is None:
            return False
        change = self._unit_displacement_of(restored - self.iterate.pressure)
        self.iterate = Guess(restored, self.iterate.unit_displacement + change, self.iterate.motion)
        return True

    def _balanced(self, pressure: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """A pressure without its tension, balanced by a plane factor; None if none does it."""
        patch = self.patch
        return restore_balance(
            np.maximum(pressure, 0.0),
            self.problem.constraints,
            patch.plane,
            patch.cell_area,
            patch.arm,
        )

    def _unit_displacement_of(self, change: NDArray[np.float64]) -> NDArray[np.float64]:
        self.convolutions += 1
        return self.patch.convolution.apply(change)


def _stepped(
    iterate: Guess, length: float, direction: NDArray[np.float64], change: NDArray[np.float64]
) -> Guess:
    return Guess(
        iterate.pressure + length * direction,
        iterate.unit_displacement + length * change,
        iterate.motion,
    )


def _inner(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    # Not a dot product of BLAS, which would put threads to work.
    return float(np.einsum("ij,ij->", a, b))
