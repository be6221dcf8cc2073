"""Error bars of tractions over the creepage, from those of a contact in cells twice as large."""

from __future__ import annotations

from collections.abc import Mapping

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

#: Of coupled bodies, which slip forth and back, and whose force passes through zero under a
#: creepage of its own: errors of the force over what friction carries and of the power over that
#: times a creepage of μ a/R, times the square of the cells along the contact (at most 9 and 8 where
#: half of 14 to 40 cells stick), and of the boundaries in cells, where all cells slip, too.
COUPLED_FORCE, COUPLED_POWER, COUPLED_BOUNDARY_CELLS = 10.0, 8.0, 2.0

#: Bars of the extents of their contact over those without friction, and least error of the
#: resistance over μ W a/R, times the square of the cells (at most 4.4 in 26 contacts).
COUPLED_EXTENTS, COUPLED_RESISTANCE = 3.0, 4.0

#: Least error of the power lost in them over μ W V times the creepage μ a/R, likewise: it is what
#: the resistance takes less than slip, and is not zero on a grid where no body creeps.
COUPLED_LOSS = 12.0


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
    floors: dict[str, float] = {}
    if problem.contact.is_coupled:
        boundary = np.full(slides.shape, COUPLED_BOUNDARY_CELLS / cells)
        floors = _coupled_floors(problem, fine, along, square)
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
        bars[name] = np.maximum(np.abs(value - other), np.maximum(least, floors.get(name, 0.0)))
    return bars


def _coupled_floors(
    problem: SteadyProblem, fine: Measured, along: float, square: float
) -> dict[str, float]:
    """Least bars of coupled bodies, of a contact as long as `along` [m]."""
    friction, axis, speed = problem.contact.friction, problem.axis, fine.state.speed
    assert friction is not None  # of a problem with creepages
    assert speed is not None  # in motion
    carried = friction.coefficient * fine.state.force
    force, curvature = COUPLED_FORCE / square * carried, problem.contact.indenter.curvatures[axis]
    slip = friction.coefficient * along / 2 * curvature  # the creepage at which a body slides
    return {
        f"tangential_force_{'xy'[axis]}": force,
        "drive_torque": force / curvature if curvature > 0 else 0.0,
        "friction_power": COUPLED_POWER / square * carried * slip * speed,
    }


def coupled_bars(
    problem: SteadyProblem, fine: Measured, bars: Mapping[str, float | Floats]
) -> dict[str, float | Floats]:
    """Bars of a contact of coupled bodies, whose rims err more than without friction."""
    friction, axis, state = problem.contact.friction, problem.axis, fine.state
    assert friction is not None  # of a problem with creepages
    extents = ("contact_length", "contact_width", "contact_area")
    found = {name: COUPLED_EXTENTS * bars[name] for name in extents if name in bars}
    along = (state.contact_length, state.contact_width)[axis]
    square = max(along / fine.rim.grid.cell_size[axis], 1.0) ** 2
    slope = along / 2 * problem.contact.indenter.curvatures[axis]
    least = COUPLED_RESISTANCE / square * friction.coefficient * slope
    for name, scale in ((f"resistance_{'xy'[axis]}", state.force), ("friction_coefficient", 1.0)):
        found[name] = np.maximum(bars[name], least * scale)
    if not problem.contact.surface.creep.is_elastic:
        slid = friction.coefficient * state.force * friction.coefficient * slope
        lost = COUPLED_LOSS / square * slid + found[f"resistance_{'xy'[axis]}"]
        found["dissipation"] = np.maximum(bars["dissipation"], lost * (state.speed or 0.0))
    return found


def unknown_traction_bars(traction: RollingTraction | None) -> dict[str, Floats]:
    """Error bars of tractions without those of a coarser contact: NaN."""
    if traction is None:
        return {}
    return {name: np.full(traction.creepage.size, np.nan) for name in curves_with_error()}
