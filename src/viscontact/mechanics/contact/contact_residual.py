"""Residual of the contact conditions: the gap under pressure, and overlaps anywhere."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Moments, RigidPlane, added


@dataclass(frozen=True, eq=False)
class ContactResidual:
    """Residual of the contact conditions for a given pressure."""

    in_contact: Bools  # cells under pressure
    inverse_gram: Floats  # inverse Gram matrix of the planes over these cells
    motion: Floats  # rigid motion that fits best: approach [m], tilts [rad]
    gap: Numbers  # gap with that motion, in the requested unit
    error: float  # largest gap in contact or penetration over the largest displacement [-]


def contact_residual(
    problem: ContactProblem,
    patch: Patch,
    iterate: Guess,
    into: tuple[Bools, Numbers] | None = None,
    unit: float = 1.0,
    first: Callable[[RigidPlane], None] | None = None,
) -> ContactResidual:
    """Step 1: rigid motion by least squares over the contact, gap and residual.

    Cells under pressure and gap, in a `unit` [m], are written to `into`; `first` works on each
    block.
    """
    shape = iterate.pressure.shape
    contact, gap = into or (np.empty(shape, bool), np.empty(shape))

    def opened(block: RigidPlane) -> tuple[float, Moments, Floats]:
        rows = block.rows
        if first:
            first(block)
        here = problem.compliance * iterate.unit_displacement[rows]
        largest = float(here.max())
        here += problem.open_gap[rows]
        here -= block.field(iterate.motion)
        touching = np.greater(iterate.pressure[rows], 0, out=contact[rows])
        if unit == 1.0:
            gap[rows] = here
        else:
            np.multiply(here, 1 / unit, out=gap[rows], casting="same_kind")
        np.copyto(here, 0.0, where=~touching)
        return largest, block.moments_of_rows(touching), block.sums_of_rows(here)

    largest, moments, sums = zip(*patch.plane.each(opened), strict=True)
    inverse = patch.plane.inverse_of(moments, problem.constraints.free)
    # Fitted as a correction, so that a motion which the contact does not determine is unchanged.
    correction = inverse @ added(sums)

    def fitted(block: RigidPlane) -> float:
        here = gap[block.rows]
        here -= block.field(correction / unit, gap.dtype)
        held = np.where(contact[block.rows], here, gap.dtype.type(0))
        return max(float(held.max()), -float(here.min()))

    scale = max(problem.displacement_scale, *largest)
    error = max(0.0, *patch.plane.each(fitted)) * (unit / scale)
    return ContactResidual(contact, inverse, iterate.motion + correction, gap, error)
