"""Error bars of tractions over the creepage, from those of a contact in cells twice as large."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.rolling_traction import RollingTraction
from viscontact.results.variables import curves_with_error
from viscontact.simulation.steady_motion.error_bars import Measured
from viscontact.simulation.steady_motion.problem import SteadyProblem

#: Least relative errors of forces and of the power lost in the bodies, times the square of the
#: cells along the contact; of the power of friction times the square of those that slip.
LEAST_FORCE, LEAST_LOSS, LEAST_POWER = 2.0, 4.0, 1.0

#: Error of the boundary between sticking and slipping cells along the motion, in cells.
BOUNDARY_CELLS = 1.0


def traction_bars(
    problem: SteadyProblem, fine: Measured, traction: RollingTraction, coarse: RollingTraction
) -> dict[str, Floats]:
    """Half widths of the error bars at each creepage."""
    state, cell = fine.state, fine.rim.grid.cell_size[problem.axis]
    along = (state.contact_length, state.contact_width)[problem.axis]
    cells, solver = max(along / cell, 1.0), problem.contact.solver_error
    square, slides = cells**2, traction.slip_fraction == 1
    # A boundary that is a cell off, where there is one.
    boundary = np.where(slides | (traction.slip_fraction == 0), 0.0, BOUNDARY_CELLS / cells)
    # A power that is a small part of what the traction brings in has its error.
    power = np.abs(traction.friction_power) + np.abs(traction.traction_dissipation)
    slipping = np.maximum(traction.slip_fraction * cells, 1.0) ** 2
    rubbed = LEAST_POWER / slipping * np.abs(traction.friction_power)
    sizes = {
        "stick_area": boundary * state.contact_area,
        "slip_fraction": boundary,
        "friction_power": (LEAST_LOSS / square + solver) * power + rubbed,
        "traction_dissipation": (LEAST_LOSS / square + solver) * power,
    }
    bars = {}
    for name in curves_with_error():
        value, other = getattr(traction, name), getattr(coarse, name)
        least = sizes.get(name, (LEAST_FORCE / square + solver) * np.abs(value))
        bars[name] = np.maximum(np.abs(value - other), least)
    return bars


def unknown_traction_bars(traction: RollingTraction | None) -> dict[str, Floats]:
    """Error bars of tractions without those of a coarser contact: NaN."""
    if traction is None:
        return {}
    return {name: np.full(traction.creepage.size, np.nan) for name in curves_with_error()}
