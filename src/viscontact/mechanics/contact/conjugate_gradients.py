"""Bound-constrained conjugate gradients for the pressure of one contact problem, on one patch.

The method follows Polonsky & Keer (1999), Wear 231, 206, and differs from it in:

1. The residual is preconditioned by an approximate inverse of the half-space operator, corrected
   at the rim of the contact.
2. Directions are conjugated by Polak & Ribiere's formula, with a negative factor set to zero; they
   are not reset when the contact set changes.
3. The displacement is updated along the direction instead of convolved again.
4. Force and both moments are balanced, by planes, in the pressure itself (scaled variables lose
   convergence). Directions are projected so that they change no resultant.
5. Where a step would leave cells in tension, the trial pressure is first cut off and rebalanced,
   and the step is taken straight towards that: one convolution, where cutting afterwards takes two.

What is done cell by cell are the patch's `SearchPasses`, which work in a few fields that are kept.
Residual and directions are in single precision, as the operators of the search are: the
residual as a part of the largest displacement, so that it is of order one in any units. Pressure
and displacement, which the steps are added to, are in double precision, and so are all sums that
restore a balance. The comments in `BoundedCG` number the steps of an iteration:

1. Fit approach and tilts to the gap under pressure by least squares; measure the residual.
2. Add the cells that the body overlaps to the active set; precondition the gap of the active cells.
3. Project the result, and the last direction, so that force and moments do not change.
4. Conjugate both, and step to the least energy along the direction.
5. Cut off tension and restore the balances: by a plane factor, or by adding a plane.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats, Singles
from viscontact.backend.team import Workspace
from viscontact.mechanics.contact.contact_residual import ContactResidual, contact_residual
from viscontact.mechanics.contact.passes.compiled_passes import CompiledPasses
from viscontact.mechanics.contact.passes.contract import StepAhead, Way
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rim_stiffness import CORRECTION, RimStiffness
from viscontact.mechanics.contact.winkler import project_onto_balance
from viscontact.mechanics.halfspace.spectral import PeriodicConvolution

#: Iterations without a new least residual after which the search counts as stagnant.
STAGNATION_ITERATIONS = 40

#: Relative imbalance below which a guess counts as balanced.
BALANCE_TOLERANCE = 1e-12

#: First step length, in 1/compliance. Below 1, as the preconditioner still overestimates the
#: stiffness where only some cells carry pressure.
INITIAL_STEP_LENGTH = 0.8

#: Length of a trial step, in expected lengths. A shorter step only loses the remaining way; a
#: longer one cuts off too many cells.
TRIAL_STEP_FACTOR = 0.85

#: Length of a step above which a direction counts as one without stiffness.
LONGEST_STEP = 1e5

#: A step of less than this part of the way to the trial pressure is not taken.
MIN_STEP_FRACTION = 0.1


class BoundedCG:
    """Bound-constrained conjugate gradients on one patch, from a guess, which is overwritten."""

    def __init__(self, problem: ContactProblem, patch: Patch, start: Guess) -> None:
        self.problem, self.patch = problem, patch
        self.iterations = self.convolutions = 0
        self.iterate = Guess(start.values, problem.constraints.with_prescribed(start.motion))
        shape, single = start.pressure.shape, np.float32
        #: Unit of the residual [m], and of the pressure for directions [Pa m], which are in 1/m.
        self._unit = _largest_displacement(problem, start)
        self._force_unit = self._unit / problem.compliance
        #: Cells of the last direction and of the next; gap in these, and the same to come.
        self._active, self._next_active = np.zeros(shape, bool), np.empty(shape, bool)
        self._residual, self._next_residual = np.zeros(shape, single), np.empty(shape, single)
        self._direction, self._spare = np.zeros(shape, single), np.empty(shape, single)
        self._change = np.empty(shape, single)  # unit displacement of a step [-]
        self._ahead = np.empty(shape)  # pressure to step towards [Pa]
        self._passes = patch.passes
        #: Taken while the residual is measured, which saves a pass over the iterate.
        self._next_step: StepAhead | None = None
        self._rim_stiffness = RimStiffness(patch)
        self._slope = 0.0
        self._length = INITIAL_STEP_LENGTH
        #: Under a given approach bodies may touch everywhere in the course of the search.
        is_periodic = isinstance(patch.convolution, PeriodicConvolution)
        self._may_keep_mean = is_periodic and not problem.constraints.free[0]
        self.stagnated = not (self._is_feasible() or self._project_to_feasible())

    def run(self, tolerance: float, max_iterations: int) -> None:
        """Iterate until the relative residual meets the tolerance, or no progress is made."""
        # The pressure is balanced to the rounding of its steps, which are in single precision.
        best, since_best = np.inf, 0
        while not self.stagnated:
            # Step 1: measure the residual.
            into = self._next_active, self._next_residual
            given = self.iterate, into, self._unit, self._next_step
            checked = contact_residual(self.problem, self.patch, *given)
            self._next_step = None
            self.iterate = Guess(self.iterate.values, checked.motion)
            if checked.error <= tolerance:
                return
            since_best = 0 if checked.error < best else since_best + 1
            best = min(best, checked.error)
            self.stagnated = self.iterations >= max_iterations or since_best > STAGNATION_ITERATIONS
            if not self.stagnated:
                self._advance(checked)

    def _advance(self, checked: ContactResidual) -> None:
        """Steps 2 to 5: one conjugate-gradient iteration from a measured residual."""
        # The preconditioner drops the mean, which the core has no correction of.
        operators = None if self._may_keep_mean else self.patch.operators.compiled
        passes, active, residual = self._passes, self._next_active, self._next_residual
        if operators is not None and isinstance(passes, CompiledPasses):
            way = self._compiled_way(checked, passes, *operators)
        else:
            way = self._way(checked)
        self._direction, self._spare = self._spare, self._direction
        self._active, self._next_active = active, self._active
        self._residual, self._next_residual = residual, self._residual
        self._slope = way.slope
        self.iterations += 1
        self._take(way)

    def _way(self, checked: ContactResidual) -> Way:
        """Steps 2 to 4 by the passes, and the pressure that step 5 would cut off.

        The next direction comes into the spare field, and the way to a pressure that is cut off
        and balanced in place of the last direction.
        """
        active, residual, found = self._next_active, self._next_residual, self._spare
        # Step 2: release the cells that the body overlaps, and precondition.
        given = active, self._active, residual
        changed, inverse = self._passes.release(*given, self.problem.constraints)
        if changed:
            self._rim_stiffness.follow(active, self._active, changed, found)
        self.patch.preconditioner.apply(residual, into=found)
        shift = 0.0
        if self._may_keep_mean and active.all():
            # The preconditioner drops the mean: that of the longest wave.
            shift = float(residual.mean() * np.float32(np.pi / self.patch.arm))
        # Steps 3 and 4: project and conjugate.
        slope = self._passes.direct(
            found,
            (self._direction, self._residual, self._slope),
            (residual, active),
            (self._rim_stiffness.values, CORRECTION),
            checked.inverse_gram if inverse is None else inverse,
            shift,
            changed=bool(changed),
        )
        # Step 5: where a step of about the last length leads to tension, step towards the cut and
        # balanced pressure instead of cutting afterwards.
        is_projected = self._passes.trial(
            self.iterate.pressure,
            (found, self._trial_length),
            self._ahead,
            (self._direction, self._force_unit),
            self.problem.constraints,
            (self.patch.cell_area, self.patch.arm),
        )
        step = self._direction if is_projected else found
        products = self._passes.inner(step, self._unit_displacement_of(step), residual)
        return Way(slope, is_projected, *products)

    def _compiled_way(
        self, checked: ContactResidual, passes: CompiledPasses, operators: Any, memory: Workspace
    ) -> Way:
        """The same in one call of the compiled core."""
        self.convolutions += 1
        work = memory.array((operators.work,), self._spare.dtype)
        fields = (
            (self.iterate.pressure, self._ahead),
            (self._next_active, self._active),
            (self._next_residual, self._residual),
            (self._direction, self._spare, self._change, self._rim_stiffness.values),
        )
        return passes.advance(
            (operators, work),
            fields,
            self.problem.constraints,
            (self.patch.cell_area, self.patch.arm),
            checked.inverse_gram,
            (CORRECTION, self._slope),
            (self._trial_length, self._force_unit),
        )

    @property
    def _trial_length(self) -> float:
        """Length of a trial step along a direction [Pa m]."""
        return TRIAL_STEP_FACTOR * self._length * self._force_unit

    def _take(self, way: Way) -> None:
        """Steps 4 and 5: step to the least energy on the direction, or towards the cut pressure."""
        if way.is_projected and self._steps_to_projected(way):
            return
        # Step 4: exact line search, length = -<r, d> / <d, K d>; the units hold the compliance.
        direction, curvature, slope = self._direction, way.curvature, way.along
        if way.is_projected:
            change = self._unit_displacement_of(direction)
            curvature, slope = self._passes.inner(direction, change, self._residual)
        if curvature <= -slope / LONGEST_STEP:
            # A uniform pressure on a periodic grid displaces nothing: only a bound ends the step.
            self._slope = 0.0
            self._step_to_first_bound(LONGEST_STEP)
            return
        self._length = length = -slope / curvature
        # Step 5: cut off tension; a plane factor restores the balances.
        if self._move(length, direction) >= 0 or self._project_to_feasible():
            return
        # No plane factor balances the cut pressure. Adding a plane and cutting does, as all active
        # cells together can carry the load.
        self._slope = 0.0
        others = self.problem.constraints, self.patch.plane, self.patch.cell_area
        self._ahead[...] = project_onto_balance(self.iterate.pressure, self._active, *others)
        if not self._project_to_feasible(is_ahead=True):
            self._move(-length, self._direction)
            self._step_to_first_bound(length)

    def _steps_to_projected(self, way: Way) -> bool:
        """Step towards the feasible pressure set aside, at most all the way; whether far enough."""
        # Exact line search on the segment from the iterate to the projected pressure.
        best = -way.along / way.curvature if way.curvature > 0 else 0.0
        if best < MIN_STEP_FRACTION:
            return False
        self._length *= TRIAL_STEP_FACTOR * min(max(best, 0.5), 2.0)
        step = self._spare
        self._next_step = StepAhead(self._ahead, step, self._change, best, self._force_unit)
        return True

    def _step_ahead(self) -> Singles:
        """Step from the iterate to the pressure set aside."""
        given = self._ahead, self.iterate.pressure, self._force_unit
        self._passes.difference(*given, self._spare)
        return self._spare

    def _move(self, length: float, step: Singles) -> float:
        """Move the iterate along a step of known unit displacement; return its least pressure."""
        values, length = self.iterate.values, length * self._force_unit
        return self._passes.move(values, step, self._change, length)

    def _step_to_first_bound(self, length: float) -> None:
        """Step until the first cell loses its pressure, which keeps the balances."""
        pressure = self.iterate.pressure
        step = np.multiply(self._direction, length * self._force_unit, dtype=np.float64)
        room = np.divide(pressure, -step, out=np.full(step.shape, np.inf), where=step < 0)
        part = float(room.min(initial=1.0))
        self._move(length * part, self._direction)
        # Exactly zero: a remainder from rounding would keep all later steps as short.
        pressure[room == part] = 0.0
        np.maximum(pressure, 0.0, out=pressure)

    def _is_feasible(self) -> bool:
        """True if the pressure is non-negative and balanced to rounding."""
        given = self.problem.constraints, self.patch.cell_area, self.patch.arm
        least, off = self._passes.weigh(self.iterate.pressure, *given)
        return least >= 0 and off < BALANCE_TOLERANCE

    def _project_to_feasible(self, *, is_ahead: bool = False) -> bool:
        """Cut off tension of a pressure and restore the balances; whether that was possible."""
        ahead = self._ahead
        if not is_ahead:
            ahead[...] = self.iterate.pressure
        np.copyto(ahead, 0.0, where=np.isinf(self.problem.open_gap))
        if not self._is_balanced(ahead):
            return False
        step = self._step_ahead()
        self._unit_displacement_of(step)
        self._move(1.0, step)
        self.iterate.pressure[...] = ahead
        return True

    def _is_balanced(self, pressure: Floats) -> bool:
        """Cut off tension and balance by a plane factor; False where no factor does it."""
        given = self.problem.constraints, self.patch.cell_area, self.patch.arm
        return self._passes.balance(pressure, *given)

    def _unit_displacement_of(self, step: Singles) -> Singles:
        """Unit displacement ``K step`` by a convolution on the patch [-], in kept memory."""
        self.convolutions += 1
        return self.patch.convolution.apply(step, into=self._change)


def _largest_displacement(problem: ContactProblem, iterate: Guess) -> float:
    """Largest displacement [m], or the least that errors are relative to; 1 where both are zero."""
    largest = problem.compliance * float(iterate.unit_displacement.max())
    return max(problem.displacement_scale, largest) or 1.0
