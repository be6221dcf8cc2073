"""Error bars of the scalars of a steady contact, from a contact in cells twice as long and wide."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viscontact.contact.rim import Rim
from viscontact.state import ContactState
from viscontact.steady.dataset import WITH_ERROR
from viscontact.steady.problem import SteadyProblem
from viscontact.steady.resistance import Resistance

#: Least relative errors of scalars, times the square of the cells across the contact.
LEAST_ERRORS = {
    "contact_area": 1.0,
    "mean_pressure": 1.0,
    "peak_pressure": 1.0,
    "peak_line_load": 4.0,
    "approach": 0.25,
    "resistance_x": 0.3,
    "resistance_y": 0.3,
}

#: The same of a free tilt; and of the force under a prescribed approach, which adds to that of the
#: resistance.
LEAST_TILT, LEAST_FORCE_ERROR = 0.5, 1.2

#: Least error of extents along and across the motion, in cells, and of the place of the resultant,
#: over the extents and times the square of these cells.
ALONG_CELLS, ACROSS_CELLS, LEAST_ECCENTRICITY = 0.5, 0.1, 0.1

#: Error of the resistance over the difference of its forms: both err where a retardation length is
#: shorter than a cell.
FORMS = 1.25

#: Error over the difference of two grids, where it is of the first order in the cells.
FIRST_ORDER = {"contact_area": 2.0, "mean_pressure": 2.0, "peak_pressure": 2.0}


@dataclass(frozen=True, eq=False)
class Measured:
    """State of a contact, its rim, and its resistance in both forms."""

    state: ContactState
    rim: Rim
    against: Resistance


def error_bars(
    problem: SteadyProblem, fine: Measured, coarse: Measured, *, singular: bool = False
) -> dict[str, float]:
    """Half widths of the error bars of a contact, from one in cells twice as large.

    The difference of both grids counts, and at least an error by the rim's place in its cells and
    by the solver. Of a resistance by the slope, the difference of both forms counts as well. A
    `singular` peak pressure has no limit.
    """
    state, least = fine.state, _least_bars(problem, fine)
    bars = {}
    for name in WITH_ERROR:
        difference = abs(float(getattr(state, name)) - float(getattr(coarse.state, name)))
        bars[name] = max(FIRST_ORDER.get(name, 1.0) * difference, least[name])
    along_motion = f"resistance_{problem.along}"
    forces = bars[along_motion]
    if fine.against.slope_weight and not fine.against.at_end:
        forces = max(forces, FORMS * fine.against.difference)
    if singular:
        bars["peak_pressure"] = math.inf
    return bars | {
        along_motion: forces,
        "friction_coefficient": forces / state.force,
        "dissipation": forces / abs(fine.against.value) * abs(state.dissipation or 0.0)
        if fine.against.value
        else 0.0,
    }


def _least_bars(problem: SteadyProblem, fine: Measured) -> dict[str, float]:
    """Errors by the rim's place in its cells and by the solver, however well two grids agree."""
    state, rim = fine.state, fine.rim
    cell, extents = rim.grid.cell_size, (rim.length, rim.width)
    free = [axis for axis in (0, 1) if not rim.grid.periodic[axis]] or [0, 1]
    square = max(min(extents[axis] / cell[axis] for axis in free), 1.0) ** 2
    solver = problem.contact.solver_error
    least = {
        name: (LEAST_ERRORS.get(name, 0.0) / square + solver) * abs(float(getattr(state, name)))
        for name in WITH_ERROR
    }
    for axis, name in enumerate(("contact_length", "contact_width")):
        part = ALONG_CELLS if axis == problem.axis else ACROSS_CELLS
        least[name] = part * cell[axis]
    if problem.point.force is None:
        for name in ("force", "resistance_x", "resistance_y"):
            least[name] += LEAST_FORCE_ERROR / square * abs(float(getattr(state, name)))
    for axis, side in enumerate("xy"):
        if (problem.point.tilt_x, problem.point.tilt_y)[axis] is None:
            tilt, turned = f"tilt_{side}", float(state.displacement.max()) / extents[axis]
            least[tilt] += LEAST_TILT / square * abs(float(getattr(state, tilt))) + solver * turned
        across = (LEAST_ERRORS["resistance_x"] / square + solver) * abs(fine.against.value)
        least[f"resistance_{side}"] = max(least[f"resistance_{side}"], across)
        least[f"eccentricity_{side}"] = (LEAST_ECCENTRICITY / square + solver) * extents[axis]
    return least


def unknown_bars(problem: SteadyProblem) -> dict[str, float]:
    """Error bars of a contact without one on a coarser grid: NaN, but for what is prescribed."""
    point, tolerance = problem.point, problem.contact.solver_error
    given = {"force": point.force, "approach": point.approach}
    given |= {"tilt_x": point.tilt_x, "tilt_y": point.tilt_y}
    known = {name: tolerance * abs(value) for name, value in given.items() if value is not None}
    return {name: known.get(name, math.nan) for name in WITH_ERROR}
