"""Forecast of a run over speed: memory, run time, and the estimated contact."""

from __future__ import annotations

import math
from collections import Counter

from viscontact.bodies.grid import Grid
from viscontact.runs.forecast import Forecast, convolution_time
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.run_memory import PROGRAM
from viscontact.simulation.checks.half_space_theory import warnings_of_covers
from viscontact.simulation.checks.material import passage_warnings
from viscontact.simulation.checks.tested_limits import Contact, limit_warnings, limited_bodies
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate, estimate_period
from viscontact.simulation.steady_motion.curve import geometry_of, run_warnings
from viscontact.simulation.steady_motion.preparation import SteadySetup, estimate_at
from viscontact.units.formatting import format_quantity

#: Time at a speed in times of a plain convolution on its grid, with that of the coarser contact,
#: and the overhead of a speed [s]; measured on balls and rollers at a tolerance of 1e-6.
AT_A_SPEED, SPEED_OVERHEAD = 150.0, 0.05

#: Arrays of a run over speed, of each further term of layers, and of a state on the grid of all
#: speeds.
ARRAYS_OF_CURVE, ARRAYS_OF_TERM, ARRAYS_OF_STATE = 60.0, 6.0, 4.0


def steady_forecast(run: SteadySetup, *, errors: bool) -> Forecast:
    """Forecast a checked run by the contact at the slowest speed; ValueError without contact."""
    speed = float(run.problem.speeds.min())
    found, grid = _estimate(run, speed), run.grids[int(run.problem.speeds.argmin())]
    extents, reach = (found.length, found.width), found.reach_from(grid.centre)
    along, across = (extent / cell for extent, cell in zip(extents, grid.cell_size, strict=True))
    chosen = run.problem.contact.automatic_grid is not None
    return Forecast(
        memory=curve_memory(run),
        available=available_memory(),
        seconds=curve_seconds(run, errors=errors),
        estimate=found,
        compliance=f"creep while half the contact passes at {format_quantity(speed, 'm/s')}",
        cells_along=along,
        cells_across=across,
        fits=chosen
        or all(
            repeats or far < size / 2
            for far, size, repeats in zip(reach, grid.size, grid.periodic, strict=True)
        ),
        warnings=run_warnings(run)
        | _cover_warnings(run, found, grid, speed)
        | _limit_warnings(run, found, speed),
    )


def curve_memory(run: SteadySetup) -> float:
    """Memory of a checked run over speed [bytes]; its fields are written as they are found."""
    terms = len(run.problem.contact.surface.terms)
    largest = max(grid.shape[0] * grid.shape[1] for grid in run.grids)
    each = ARRAYS_OF_CURVE + ARRAYS_OF_TERM * (terms - 1)
    kept = ARRAYS_OF_STATE * run.grid.shape[0] * run.grid.shape[1]
    return PROGRAM + 8.0 * (largest * each + kept)


def curve_seconds(run: SteadySetup, *, errors: bool) -> float:
    """Run time on this machine, within a factor of two or three [s]; `errors` as in the run."""
    factor = AT_A_SPEED if errors else AT_A_SPEED / 1.25  # a contact on a quarter of the cells
    counts = Counter(grid.shape for grid in run.grids)
    grids = {grid.shape: grid for grid in run.grids}
    return sum(
        count * (factor * convolution_time(grids[shape]) + SPEED_OVERHEAD)
        for shape, count in counts.items()
    )


def _estimate(run: SteadySetup, speed: float) -> ContactEstimate:
    """Elastic contact with the compliance of the time in which half of it is passed."""
    problem, grid = run.problem, run.grids[0]
    if not any(grid.periodic):
        return estimate_at(problem, speed)
    time = grid.size[problem.axis] / (2 * speed)
    contact = problem.contact
    compliance, response = float(contact.compliance(time)), contact.surface.response_at(time)
    return estimate_period(contact.indenter, compliance, problem.point, grid, response=response)


def _cover_warnings(
    run: SteadySetup, found: ContactEstimate, grid: Grid, speed: float
) -> dict[str, str]:
    """Warnings about layers under the estimated contact, in the cells of the run."""
    passed = (found.length, found.width)[run.problem.axis] / speed
    geometry = geometry_of(run.problem, found.open_gap, found.rim.grid, passed, predicted=True)
    return warnings_of_covers(geometry, found.rim, found.motion, grid.cell_size)


def _limit_warnings(run: SteadySetup, found: ContactEstimate, speed: float) -> dict[str, str]:
    """Warnings about strains and times beyond those of the tests, in the estimated contact."""
    contact, peak = run.problem.contact, found.peak_pressure
    passed = (found.length, found.width)[run.problem.axis] / speed
    warnings = passage_warnings(passed, contact.data_times)
    if not peak > 0:
        return warnings
    force = float(found.pressure.sum()) * found.grid.cell_area
    load = Contact(
        force / max(found.rim.area, force / peak),
        min(found.length, found.width) / 2,
        float(found.motion[0]) if contact.has_datum(found.grid) else math.nan,
        passed,
        f"at {format_quantity(speed, 'm/s')}",
        peak,
        found.grid.line_length is not None,
        True,
    )
    return warnings | limit_warnings(limited_bodies(contact.bodies), load)
