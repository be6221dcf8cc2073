"""Displacement into the surface by tractions along it: the lift of a contact that couples them."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.transforms import transforms_by
from viscontact.mechanics.contact.friction.equilibrium import SINGLE
from viscontact.mechanics.halfspace.coupling_filter import CouplingSum, coupling_filter
from viscontact.simulation.transient.coupling_history import CouplingStep
from viscontact.simulation.transient.setup import RunSetup


class LiftOperator:
    """Lift of the computed cells of a run, those beyond its mirror planes."""

    def __init__(self, run: RunSetup) -> None:
        transforms = transforms_by(run.transforms, run.threads)
        parts = (
            coupling_filter(run.grid, transforms, run.mirrored, each)
            for each in run.problem.shear.coupled
        )
        self._operator = CouplingSum(tuple(parts))
        self._search = self._operator.in_single()
        self._rows, self._columns = (
            slice(count // 2 if even else 0, None)
            for count, even in zip(run.grid.shape, run.mirrored, strict=True)
        )

    def of(self, sums: tuple[Floats, ...]) -> Floats:
        """Lift by sums Q of all cells [m]."""
        return self._operator.normal(self._computed(sums))

    def change(self, sums: tuple[Floats, ...]) -> Floats:
        """The same of small changes of the sums, in single precision [m]."""
        return self._search.change(self._computed(sums))

    def within(self, shape: tuple[int, int]) -> CouplingSum:
        """Operator on a smaller block."""
        return self._operator.within(shape)

    def _computed(self, sums: tuple[Floats, ...]) -> list[Floats]:
        return [each[:, self._rows, self._columns] for each in sums]


class StepLift:
    """Lift by the new tractions of a step, which follows them in single precision."""

    def __init__(self, operator: LiftOperator, response: CouplingStep, traction: Floats) -> None:
        self._operator, self._response, self._traction = operator, response, traction
        self.field = operator.of(response.of_traction(traction))  # [m]
        self._rounding = 0.0  # of all changes since it was found in double precision [m]

    def follow(self, traction: Floats) -> None:
        """Go on to other tractions."""
        change = self._operator.change(self._response.of_traction(traction - self._traction))
        self.field, self._traction = self.field + change, traction
        self._rounding += SINGLE * float(np.abs(change).max())

    def refine(self, accuracy: float) -> bool:
        """Find it in double precision where rounding may exceed an accuracy [m]; True if it was."""
        if not self._rounding > accuracy:
            return False
        self.field = self._operator.of(self._response.of_traction(self._traction))
        self._rounding = 0.0
        return True
