"""Scalars of a contact of bodies that adhere."""

from __future__ import annotations

import numpy as np

from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution

#: Part of the strength from which on cells outside the contact belong to the cohesive zone [-].
ZONE_SHARE = 0.01


def adhesion_scalars(run: RunSetup, solution: StepSolution) -> dict[str, float]:
    """Scalars of a state that only contacts with adhesion have, by name."""
    assert run.law is not None  # the caller has seen one
    pulled = ~solution.in_contact & (solution.pressure < -ZONE_SHARE * run.law.strength)
    return {
        "least_pressure": float(solution.pressure.min()),
        "tensile_area": np.count_nonzero(pulled) * run.grid.cell_area,
        "adhesion_energy": solution.adhesion_energy,
        "stability": solution.stability,
    }
