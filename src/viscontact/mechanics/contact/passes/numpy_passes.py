"""Passes of the search in NumPy, through blocks of rows that stay in the cache."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers, Singles
from viscontact.mechanics.contact.passes.contract import Gram, Measured, SearchPasses, StepAhead
from viscontact.mechanics.contact.rigid_balance import (
    Constraints,
    Moments,
    RigidPlane,
    added,
    balance,
)


class NumPyPasses(SearchPasses):
    """Passes over the cells of a plane, by its blocks and its threads."""

    def __init__(self, plane: RigidPlane) -> None:
        self._plane = plane

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
        (pressure, displacement), (open_gap, compliance) = values, spring
        contact, gap = into

        def opened(block: RigidPlane) -> tuple[float, Moments, Floats]:
            rows = block.rows
            if step is not None:
                _take(step, values, rows)
            here = compliance * displacement[rows]
            largest = float(here.max())
            here += open_gap[rows]
            here -= block.field(motion)
            touching = np.greater(pressure[rows], 0, out=contact[rows])
            if unit == 1.0:
                gap[rows] = here
            else:
                np.multiply(here, 1 / unit, out=gap[rows], casting="same_kind")
            np.copyto(here, 0.0, where=~touching)
            return (
                largest,
                block.moments_of_rows(touching, constraints.free),
                block.sums_of_rows(here),
            )

        largest, moments, sums = zip(*self._plane.each(opened), strict=True)
        inverse = self._plane.inverse_of(moments, constraints.free)
        # Fitted as a correction, so that a motion which the contact does not determine is
        # unchanged.
        correction = inverse @ added(sums)

        def fitted(block: RigidPlane) -> float:
            here = gap[block.rows]
            here -= block.field(correction / unit, gap.dtype)
            held = np.where(contact[block.rows], here, gap.dtype.type(0))
            return float(np.maximum(held.max(), -here.min()))

        # Not Python's `max`, which may pass over NaN.
        error = float(np.max([0.0, *self._plane.each(fitted)]))
        return Measured(motion + correction, inverse, max(largest), error)

    def release(
        self, active: Bools, last: Bools, gap: Singles, constraints: Constraints
    ) -> tuple[int, Floats | None]:
        """See `SearchPasses.release`."""

        def released(block: RigidPlane) -> tuple[bool, int]:
            here, gaps = active[block.rows], gap[block.rows]
            overlapped = gaps < 0
            overlapped &= ~here
            here |= overlapped
            np.copyto(gaps, 0.0, where=~here)
            return bool(overlapped.any()), int(np.count_nonzero(here != last[block.rows]))

        any_released, changed = zip(*self._plane.each(released), strict=True)
        inverse = self._plane.inverse_gram(active, constraints.free) if any(any_released) else None
        return sum(changed), inverse

    def follow(self, stiffness: Singles, active: Bools, last: Bools, near: Singles) -> None:
        """See `SearchPasses.follow`."""
        rows, columns = np.divmod(np.flatnonzero(active != last), active.shape[1])
        sign = np.where(active[rows, columns], np.float32(1), np.float32(-1))
        for down, right in np.ndindex(3, 3):
            near_rows, near_columns = rows + (down - 1), columns + (right - 1)
            inside = (near_rows >= 0) & (near_rows < active.shape[0])
            inside &= (near_columns >= 0) & (near_columns < active.shape[1])
            at = near_rows[inside], near_columns[inside]
            np.add.at(stiffness, at, sign[inside] * near[down, right])

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
        (gap, active), (direction, last_gap, last_slope) = residual, last
        inverse = np.asarray(inverse_gram)

        def corrected(block: RigidPlane) -> None:
            lacking = stiffness[1] * np.maximum(stiffness[0][block.rows], 0)
            lacking *= gap[block.rows]
            found[block.rows] -= lacking
            if shift:
                found[block.rows] += np.float32(shift)

        self._plane.each(corrected)
        self._project(found, active, inverse)
        slope, slope_before = self.inner(found, gap, last_gap)
        # beta = max(<z, r - r_old> / <z_old, r_old>, 0)
        factor = 0.0
        if last_slope > 0:
            factor = max((slope - slope_before) / last_slope, 0.0)
            if changed:
                self._project(direction, active, inverse)

        def conjugated(block: RigidPlane) -> None:
            here = found[block.rows]
            # Minus: directions point downhill, the preconditioned residual uphill.
            np.subtract(factor * direction[block.rows], here, out=here)

        self._plane.each(conjugated)
        return slope

    def _project(self, vector: Singles, active: Bools, inverse: Floats) -> None:
        """Restrict a direction to the active cells, and remove its force and moments."""

        def restricted(block: RigidPlane) -> Floats:
            here = vector[block.rows]
            here *= active[block.rows]
            return block.sums_of_rows(here)

        plane = inverse @ added(self._plane.each(restricted))

        def levelled(block: RigidPlane) -> None:
            here = vector[block.rows]
            # In double precision, so that what is left of the resultants is rounding of cells.
            here[...] = here - active[block.rows] * block.field(plane)

        self._plane.each(levelled)

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
        along, length = direction

        def stepped(block: RigidPlane) -> float:
            here = ahead[block.rows]
            np.multiply(along[block.rows], length, out=here, dtype=np.float64)
            here += pressure[block.rows]
            return float(here.min())

        if min(self._plane.each(stepped)) >= 0 or not self.balance(ahead, constraints, *size):
            return False
        way, unit = step
        self.difference(ahead, pressure, unit, way)
        return True

    def balance(
        self, pressure: Floats, constraints: Constraints, cell_area: float, arm: float
    ) -> bool:
        """See `SearchPasses.balance`."""
        return balance(pressure, constraints, self._plane, cell_area, arm)

    def weigh(
        self, pressure: Floats, constraints: Constraints, cell_area: float, arm: float
    ) -> tuple[float, float]:
        """See `SearchPasses.weigh`."""
        off = constraints.imbalance(self._plane.sums(pressure) * cell_area, arm)
        return float(pressure.min()), off

    def difference(self, ahead: Floats, pressure: Floats, unit: float, step: Singles) -> None:
        """See `SearchPasses.difference`."""

        def subtract(block: RigidPlane) -> None:
            here = ahead[block.rows] - pressure[block.rows]
            np.multiply(here, 1 / unit, out=step[block.rows], casting="same_kind")

        self._plane.each(subtract)

    def inner(self, field: Singles, first: Singles, second: Singles) -> tuple[float, float]:
        """See `SearchPasses.inner`; of each row in single precision."""
        # Not by BLAS, which would start threads.

        def of_rows(block: RigidPlane) -> Floats:
            here = field[block.rows]
            rows = [np.einsum("ij,ij->i", here, other[block.rows]) for other in (first, second)]
            return np.array([row.sum(dtype=np.float64) for row in rows])

        products = added(self._plane.each(of_rows))
        return float(products[0]), float(products[1])

    def move(self, values: Floats, step: Singles, change: Singles, length: float) -> float:
        """See `SearchPasses.move`."""

        def moved(block: RigidPlane) -> float:
            pressure, displacement = values[:, block.rows]
            pressure += np.multiply(step[block.rows], length, dtype=np.float64)
            displacement += np.multiply(change[block.rows], length, dtype=np.float64)
            return float(pressure.min())

        return min(self._plane.each(moved))

    def sums(self, values: Floats) -> Floats:
        """See `SearchPasses.sums`."""
        return self._plane.sums(values)


def _take(step: StepAhead, values: Floats, rows: slice) -> None:
    """Take a step on some rows."""
    length = min(step.part, 1.0) * step.unit
    pressure, displacement = values[:, rows]
    displacement += np.multiply(step.change[rows], length, dtype=np.float64)
    if step.part >= 1.0:
        pressure[...] = step.ahead[rows]
    else:
        pressure += np.multiply(step.step[rows], length, dtype=np.float64)
        np.maximum(pressure, 0.0, out=pressure)  # below zero by rounding
