"""Passes of the search in C++."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers, Singles
from viscontact.mechanics.contact.passes.contract import (
    Gram,
    Measured,
    SearchPasses,
    StepAhead,
    Way,
)
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane


class CompiledPasses(SearchPasses):
    """Passes over the cells of a plane, by the compiled core; sums are in double precision."""

    def __init__(self, core: ModuleType, plane: RigidPlane) -> None:
        self._core, self._cells = core, plane.of_core or core.Plane(*plane.cells)

    def measure(
        self,
        values: Floats,
        motion: Floats,
        spring: tuple[Floats, float],
        constraints: Constraints,
        into: tuple[Bools, Numbers],
        unit: float = 1.0,
        step: StepAhead | None = None,
    ) -> Measured:
        """See `SearchPasses.measure`."""
        taken = None
        if step is not None:
            taken = step.ahead, step.step, step.change, float(step.part), float(step.unit)
        found, inverse, largest, error = self._core.measure(
            *(self._cells, *values, *spring, tuple(motion.tolist()), constraints.free_motions),
            *(unit, *into, taken),
        )
        return Measured(np.array(found), inverse, largest, error)

    def release(
        self, active: Bools, last: Bools, gap: Singles, constraints: Constraints
    ) -> tuple[int, Gram | None]:
        """See `SearchPasses.release`."""
        released, changed, inverse = self._core.release(
            self._cells, active, last, gap, constraints.free_motions
        )
        return changed, inverse if released else None

    def follow(self, stiffness: Singles, active: Bools, last: Bools, near: Singles) -> None:
        """See `SearchPasses.follow`."""
        self._core.follow(stiffness, active, last, near)

    def direct(
        self,
        found: Singles,
        last: tuple[Singles, Singles, float],
        residual: tuple[Singles, Bools],
        stiffness: tuple[Singles, float],
        inverse_gram: Gram,
        shift: float,
        *,
        changed: bool,
    ) -> float:
        """See `SearchPasses.direct`."""
        direction, last_gap, last_slope = last
        inverse = _plain(inverse_gram)
        slope: float = self._core.direct(
            *(self._cells, found, direction, residual[0], last_gap, residual[1]),
            *(*stiffness, shift, inverse, last_slope, changed),
        )
        return slope

    def advance(
        self,
        operators: tuple[Any, Singles],
        fields: tuple[tuple[Numbers, ...], ...],
        constraints: Constraints,
        size: tuple[float, float],
        inverse_gram: Gram,
        last: tuple[float, float],
        step: tuple[float, float],
    ) -> Way:
        """Release, precondition, `direct` and `trial` in one call, with products of the step.

        `operators` are those of the core with memory for their work; `fields` pressure and the one
        ahead; active cells and the last ones; residual and the last one; direction, spare field,
        unit displacement and stiffness. `last` is the correction of the stiffness and the last
        slope, `step` the length of a trial step and the unit of directions [Pa m]. The new
        direction is in the spare field, and the way to a projected pressure in that of the last
        direction.
        """
        balances = constraints.plain_targets, constraints.free_motions, *size
        found = self._core.advance(
            self._cells, *operators, *fields, *balances, _plain(inverse_gram), *last, *step
        )
        return Way(*found)

    def trial(
        self,
        pressure: Floats,
        direction: tuple[Singles, float],
        ahead: Floats,
        step: tuple[Singles, float],
        constraints: Constraints,
        size: tuple[float, float],
    ) -> bool:
        """See `SearchPasses.trial`."""
        balances = constraints.plain_targets, constraints.free_motions, *size
        way, unit = step
        given = *direction, ahead, *balances, 1 / unit, way
        return bool(self._core.trial(self._cells, pressure, *given))

    def balance(
        self, pressure: Floats, constraints: Constraints, cell_area: float, arm: float
    ) -> bool:
        """See `SearchPasses.balance`."""
        targets = constraints.plain_targets
        given = targets, constraints.free_motions, cell_area, arm
        return bool(self._core.balance(self._cells, pressure, *given))

    def weigh(
        self, pressure: Floats, constraints: Constraints, cell_area: float, arm: float
    ) -> tuple[float, float]:
        """See `SearchPasses.weigh`."""
        given = constraints.plain_targets, constraints.free_motions, cell_area, arm
        least, imbalance = self._core.weigh(self._cells, pressure, *given)
        return least, imbalance

    def difference(self, ahead: Floats, pressure: Floats, unit: float, step: Singles) -> None:
        """See `SearchPasses.difference`."""
        self._core.difference(self._cells, ahead, pressure, 1 / unit, step)

    def inner(self, field: Singles, first: Singles, second: Singles) -> tuple[float, float]:
        """See `SearchPasses.inner`."""
        one, other = self._core.inner(self._cells, field, first, second)
        return one, other

    def move(self, values: Floats, step: Singles, change: Singles, length: float) -> float:
        """See `SearchPasses.move`."""
        least: float = self._core.move(self._cells, *values, step, change, length)
        return least

    def sums(self, values: Floats) -> Floats:
        """See `SearchPasses.sums`."""
        return np.array(self._core.sums(self._cells, values))


def _plain(gram: Gram) -> tuple[tuple[float, float, float], ...]:
    """Rows of plain numbers of a matrix."""
    if isinstance(gram, tuple):
        return gram
    first, second, third = gram.tolist()
    return tuple(first), tuple(second), tuple(third)
