"""Error bars of the scalars of a steady contact, from a contact in cells twice as long and wide."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.contact.rim import Rim
from viscontact.mechanics.state import MOTION, ContactState
from viscontact.results.variables import scalars_with_error
from viscontact.simulation.steady_motion.problem import SteadyProblem
from viscontact.simulation.steady_motion.resistance import Resistance

#: Scalars that have an error bar.
WITH_ERROR = tuple(scalars_with_error((MOTION,), "speed"))

#: Least relative errors of scalars, times the square of the cells across the contact.
LEAST_ERRORS = {
    "contact_area": 1.0,
    "mean_pressure": 1.0,
    "peak_pressure": 0.7,
    "peak_line_load": 4.0,
    "approach": 0.25,
    "resistance_x": 0.3,
    "resistance_y": 0.3,
}

#: The same of a free tilt; and of the force under a prescribed approach, which adds to that of the
#: resistance.
LEAST_TILT, LEAST_FORCE_ERROR = 0.5, 1.2

#: Least error of the area along the motion, in cells, and of extents along it: where all creep
#: within the contact takes many cells, and what is added where it happens within one.
AREA_CELLS, UNRESOLVED_AREA_CELLS = 0.04, 0.16
ALONG_CELLS, UNRESOLVED_ALONG_CELLS = 0.008, 0.492

#: Least error of extents across the motion, in cells, and of the place of the resultant, over the
#: extents and times the square of these cells.
ACROSS_CELLS, LEAST_ECCENTRICITY = 0.2, 0.1

#: Error of the resistance over the difference of its forms: both err where a retardation length is
#: shorter than a cell.
FORMS = 1.25

#: Error over the difference of two grids, where it is of the first order in the cells: of areas and
#: pressures as far as creep happens within a cell, and of all scalars on a law without instant
#: compliance, which always has retardation lengths shorter than a cell.
FIRST_ORDER = 2.0
OF_FIRST_ORDER = ("contact_area", "mean_pressure", "peak_pressure")

#: Error of an eccentricity over the difference: its strips on half-spaces err by up to 1.5 of it.
OF_ECCENTRICITY = 1.5

#: Cells from the leading edge of the contact in which the pressure may peak as it does not on finer
#: ones, error of such a peak over its excess over the others, and power of time with which a law
#: creeps at first from which the pressure has no limit there.
ENTRY_CELLS, ENTRY_EXCESS, SINGULAR_EXPONENT = 2, 1.5, 0.5

#: Least error of the rim on thin layers, in cells, over the cell's size in thicknesses.
THIN_RIM_CELLS = 0.24

#: Part of a period that a strip in contact fills.
WHOLE = 1 - 1e-9


@dataclass(frozen=True, eq=False)
class Measured:
    """State of a contact, its rim, and its resistance in both forms."""

    state: ContactState
    rim: Rim
    against: Resistance


def error_bars(
    problem: SteadyProblem,
    fine: Measured,
    coarse: Measured,
    *,
    singular: bool = False,
    ends: float = 0.0,
) -> dict[str, float]:
    """Half widths of the error bars of a contact, from one in cells twice as large."""
    # The difference of both grids counts, and at least an error by the rim's place in its cells and
    # by the solver; of a resistance by the slope also the difference of both forms.
    # `ends` is what the operator of free ends may miss [-].
    state, least = fine.state, _least_bars(problem, fine, ends)
    bars = {}
    at_once, unresolved = problem.contact.compliance.instant > 0, _unresolved(problem, fine)
    for name in WITH_ERROR:
        difference = abs(float(getattr(state, name)) - float(getattr(coarse.state, name)))
        factor = 1.0 if at_once else FIRST_ORDER
        if at_once and name in OF_FIRST_ORDER:
            factor += (FIRST_ORDER - 1) * unresolved
        if name.startswith("eccentricity"):
            factor *= OF_ECCENTRICITY
        bars[name] = max(factor * difference, least[name])
    along_motion = f"resistance_{problem.motion.along}"
    forces = bars[along_motion]
    if fine.against.slope_weight and not fine.against.at_end:
        forces = max(forces, FORMS * fine.against.difference)
    if math.isfinite(problem.contact.thinnest_layer) and fine.against.value:
        # The error of layers' compliance, of which the loss is a part only.
        splitting = problem.contact.surface.splitting_error
        forces += splitting / fine.against.loss_share * abs(fine.against.value)
        # The eccentricity is a moment of the pressure, as the resistance by the slope is.
        eccentricity = f"eccentricity_{problem.motion.along}"
        relative = max(forces, FORMS * fine.against.difference) / abs(fine.against.value)
        moment = relative * abs(float(getattr(state, eccentricity)))
        bars[eccentricity] = max(bars[eccentricity], moment)
    if singular:
        bars["peak_pressure"] = math.inf
    return bars | {
        along_motion: forces,
        "friction_coefficient": forces / state.force,
        "dissipation": forces / abs(fine.against.value) * abs(state.dissipation or 0.0)
        if fine.against.value
        else 0.0,
    }


def _least_bars(problem: SteadyProblem, fine: Measured, ends: float) -> dict[str, float]:
    """Errors by the rim's place in its cells and by the solver, however well two grids agree."""
    state, rim = fine.state, fine.rim
    cell, extents = rim.grid.cell_size, (rim.length, rim.width)
    free = [axis for axis in (0, 1) if not rim.grid.periodic[axis]] or [0, 1]
    square = max(min(extents[axis] / cell[axis] for axis in free), 1.0) ** 2
    solver, splitting = problem.contact.solver_error, problem.contact.surface.splitting_error
    relative = solver + splitting + ends
    least = {
        name: (LEAST_ERRORS.get(name, 0.0) / square + relative) * abs(float(getattr(state, name)))
        for name in WITH_ERROR
    }
    unresolved, thinnest = _unresolved(problem, fine), problem.contact.thinnest_layer
    along = ALONG_CELLS + UNRESOLVED_ALONG_CELLS * unresolved
    for axis, name in enumerate(("contact_length", "contact_width")):
        part = along if axis == problem.axis else ACROSS_CELLS
        least[name] = (part + THIN_RIM_CELLS * cell[axis] / thinnest) * cell[axis]
    if not _fills_period(rim, problem.axis):
        cells = AREA_CELLS + UNRESOLVED_AREA_CELLS * unresolved
        edges = _edge_error(problem, rim, least, cells)
        for name in ("contact_area", "mean_pressure"):
            least[name] = max(least[name], edges * float(getattr(state, name)))
        least["peak_pressure"] = max(least["peak_pressure"], _entry_excess(problem, fine))
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


def _unresolved(problem: SteadyProblem, fine: Measured) -> float:
    """Part of the creep on the way through the contact that happens within a cell [-].

    All of it on a law without instant compliance, which creeps on any way.
    """
    compliance, axis = problem.contact.compliance, problem.axis
    if not compliance.instant > 0:
        return 1.0
    extent = max((fine.rim.length, fine.rim.width)[axis], fine.rim.grid.cell_size[axis])
    ways = np.array([fine.rim.grid.cell_size[axis], extent])
    within, whole = (
        compliance(ways / float(fine.state.speed or 1.0)) - compliance.instant
    ).tolist()
    return within / whole if whole > 0 else 0.0


def _edge_error(
    problem: SteadyProblem, rim: Rim, least: Mapping[str, float], cells: float
) -> float:
    """Relative error of the area by its edges along the motion; a strip ends alike anywhere."""
    axis = problem.axis
    extent = (rim.length, rim.width)[axis]
    if _fills_period(rim, 1 - axis):
        return least[("contact_length", "contact_width")[axis]] / extent
    return cells * rim.grid.cell_size[axis] / extent


def _fills_period(rim: Rim, axis: int) -> bool:
    """Test whether the contact goes through a whole period along an axis."""
    extent = (rim.length, rim.width)[axis]
    return rim.grid.periodic[axis] and extent >= WHOLE * rim.grid.size[axis]


def _entry_excess(problem: SteadyProblem, fine: Measured) -> float:
    """Error of a peak in the first cells at the leading edge, by that behind them [Pa]."""
    fields = fine.state.pressure, fine.state.in_contact
    pressure, in_contact = (np.moveaxis(each, problem.axis, 0) for each in fields)
    inside = pressure[:-ENTRY_CELLS] * in_contact[ENTRY_CELLS:]
    return ENTRY_EXCESS * float(pressure.max() - inside.max(initial=0.0))


def entry_is_singular(compliance: ContactCompliance, passed: float) -> bool:
    """True if pressure has no limit at the leading edge, by the time to pass a cell [s]."""
    # At a distance d from the edge the pressure goes as d^(1/2 - α) on a law that creeps as t^α.
    if compliance.instant > 0:
        return False
    early, late = compliance(passed * np.array([0.01, 0.1])).tolist()
    return math.log10(late / early) > SINGULAR_EXPONENT


def unknown_bars(problem: SteadyProblem) -> dict[str, float]:
    """Error bars of a contact without one on a coarser grid: NaN, but for what is prescribed."""
    point, tolerance = problem.point, problem.contact.solver_error
    given = {"force": point.force, "approach": point.approach}
    given |= {"tilt_x": point.tilt_x, "tilt_y": point.tilt_y}
    known = {name: tolerance * abs(value) for name, value in given.items() if value is not None}
    return {name: known.get(name, math.nan) for name in WITH_ERROR}
