"""State of a contact in steady motion: resultants, rim, resistance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.mechanics.contact.body_edge import trace_outline
from viscontact.mechanics.contact.line_load import line_load, peak_line_load
from viscontact.mechanics.contact.resistance import is_even, reaches_end, resistance_by_slope
from viscontact.mechanics.contact.rim import Rim, trace_rim
from viscontact.mechanics.contact.rim_crossings import Recession
from viscontact.mechanics.contact.rim_extent import mean_chords
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.simulation.steady_motion.contact import SteadyContact
from viscontact.simulation.steady_motion.problem import SteadyProblem
from viscontact.simulation.steady_motion.resistance import Resistance, resistance


def rim_of(problem: SteadyProblem, contact: SteadyContact) -> Rim:
    """Rim of a contact between the cell centres."""
    outline = trace_outline(problem.body_on(contact.grid), contact.grid)
    # The material passes from the leading edge, at the end of the axis, to the rear one.
    opens, falls = (
        later(field, np.roll(field, -1, axis=problem.axis))
        for later, field in ((np.greater, contact.gap), (np.less, contact.pressure))
    )
    recession = Recession(contact.pressure, falls=falls, opens=opens, left=opens)
    return trace_rim(contact.grid, contact.in_contact, contact.gap, outline, recession)


def resistance_of(problem: SteadyProblem, contact: SteadyContact) -> Resistance:
    """Resistance along the motion."""
    axis, grid = problem.axis, contact.grid
    chord = mean_chords(contact.in_contact, periodic=grid.periodic)[axis] * grid.cell_size[axis]
    found = resistance(
        problem.body_on(grid),
        contact.domain,
        contact.solution.values[0],
        _tilts(contact),
        float(chord) / 2,
    )
    if contact.lift is None:
        return found
    # What moves the pressure of coupled bodies ahead is lost by slip, not in them.
    return replace(found, by_dissipation=found.by_slope, slope_weight=1.0, at_end=False)


def force_across(problem: SteadyProblem, contact: SteadyContact) -> float:
    """Force across the motion [N]; NaN where the body ends there, unless the contact is even."""
    across, grid, pressure = 1 - problem.axis, contact.grid, contact.pressure
    indenter = problem.body_on(grid)
    if reaches_end(pressure, grid, indenter)[across] and not is_even(pressure)[across]:
        return math.nan
    return resistance_by_slope(pressure, grid, indenter, _tilts(contact))[across]


def _tilts(contact: SteadyContact) -> tuple[float, float]:
    tilt_x, tilt_y = contact.solution.motion[1:].tolist()
    return tilt_x, tilt_y


def _eccentricities(contact: SteadyContact, force: float) -> tuple[float, float]:
    """Offsets of the force from the body's axis; NaN where the body repeats, without a centre."""
    whole, grid = contact.pressure * contact.grid.cell_area, contact.grid
    centre_x, centre_y = (math.nan if repeats else 1.0 for repeats in grid.periodic)
    offset_x = centre_x * float(whole.sum(axis=1) @ grid.x) / force
    return offset_x, centre_y * float(whole.sum(axis=0) @ grid.y) / force


def _resistances(
    problem: SteadyProblem, contact: SteadyContact, against: Resistance
) -> list[float]:
    """Forces of the half-space on the body against +x and +y [N]."""
    forces = [against.value, against.value]
    forces[1 - problem.axis] = force_across(problem, contact)
    return forces


def _dissipation(problem: SteadyProblem, contact: SteadyContact, resistance: float) -> float:
    """Power lost in the bodies but for that under tractions by themselves [W]."""
    if contact.along is None or contact.traction is None:
        return resistance * contact.speed
    if problem.contact.surface.creep.is_elastic:
        return 0.0
    # The work of the pressure and, with the rule of trapezoids over the way of a cell, of the
    # tractions on the displacement by the pressure.
    traction, stretch, axis = contact.traction, contact.stretch_over(problem.axis), problem.axis
    pair = np.stack([traction.traction_x[0], traction.traction_y[0]])
    mean = (pair + np.roll(pair, -1, axis=1 + axis)) / 2
    rate = contact.speed / contact.grid.cell_size[axis] * contact.grid.cell_area
    return resistance * contact.speed + float((mean * stretch).sum()) * rate


def state_of(
    problem: SteadyProblem, contact: SteadyContact, rim: Rim, against: Resistance, *, datum: bool
) -> ContactState:
    """State of a contact; time and cumulative values are NaN, without `datum` also the approach."""
    grid, solution, axis = contact.grid, contact.solution, problem.axis
    pressure, motion = contact.pressure, solution.motion
    force, peak = float((pressure * grid.cell_area).sum()), float(pressure.max())
    area, load = max(rim.area, force / peak), line_load(pressure, grid)
    forces = _resistances(problem, contact, against)
    offset_x, offset_y = _eccentricities(contact, force)
    return ContactState(
        time=math.nan,
        pressure=pressure,
        gap=contact.gap,
        displacement=contact.displacement,
        in_contact=contact.in_contact,
        line_load=load,
        grid=grid,
        force=force,
        eccentricity_x=offset_x,
        eccentricity_y=offset_y,
        approach=float(motion[0]) - problem.contact.thickening_at(0.0) if datum else math.nan,
        tilt_x=float(motion[1]),
        tilt_y=float(motion[2]),
        contact_area=area,
        contact_length=rim.length,
        contact_width=rim.width,
        peak_pressure=peak,
        mean_pressure=force / area,
        peak_line_load=peak_line_load(load, grid, rim.length),
        work=math.nan,
        loss_per_cycle=math.nan,
        time_error=math.nan,
        iterations=solution.iterations,
        residual=solution.residual,
        cells_across=rim.cells_across,
        outcome=Outcome.CONVERGED if solution.converged else Outcome.NOT_CONVERGED,
        resistance_x=forces[0],
        resistance_y=forces[1],
        friction_coefficient=forces[axis] / force,
        dissipation=_dissipation(problem, contact, forces[axis]),
        speed=contact.speed,
        temperature=problem.contact.constant_temperature,
    )
