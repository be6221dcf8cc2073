"""Residual of the contact conditions: the gap under pressure, and overlaps anywhere."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.passes.contract import Gram, StepAhead
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import ContactProblem, Guess


@dataclass(frozen=True, eq=False)
class ContactResidual:
    """Residual of the contact conditions for a given pressure."""

    in_contact: Bools  # cells under pressure
    inverse_gram: Gram  # inverse Gram matrix of the planes over these cells
    motion: Floats  # rigid motion that fits best: approach [m], tilts [rad]
    gap: Numbers  # gap with that motion, in the requested unit
    error: float  # largest gap in contact or penetration over the largest displacement [-]


def contact_residual(
    problem: ContactProblem,
    patch: Patch,
    iterate: Guess,
    into: tuple[Bools, Numbers] | None = None,
    unit: float = 1.0,
    step: StepAhead | None = None,
) -> ContactResidual:
    """Step 1: rigid motion by least squares over the contact, gap and residual.

    Cells under pressure and gap, in a `unit` [m], are written to `into`, after a `step` if there is
    one.
    """
    shape = iterate.pressure.shape
    contact, gap = into or (np.empty(shape, bool), np.empty(shape))
    spring = problem.open_gap, problem.compliance
    given = iterate.values, iterate.motion, spring, problem.constraints
    found = patch.passes.measure(*given, (contact, gap), unit, step)
    scale = max(problem.displacement_scale, found.largest)
    error = found.error * (unit / scale)
    return ContactResidual(contact, found.inverse_gram, found.motion, gap, error)
