"""State of a contact, with its resultants, from the solution of a step."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscontact.backend.team import Team
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.line_load import line_load, peak_line_load
from viscontact.mechanics.contact.rim import Rim
from viscontact.mechanics.state import ContactState
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution

#: Force of bodies that adhere, over that without signs, below which it has no place [-].
NO_FORCE = 1e-6


def solved_state(
    run: RunSetup,
    step: TimeStep,
    solution: StepSolution,
    rim: Rim,
    totals: tuple[float, float],
    moved: dict[str, Any],
    team: Team,
) -> ContactState:
    """State of a solution: `totals` are the work and the loss of a cycle [J].

    `moved` are the scalars of motion, clocks and adhesion.
    """
    adheres, has_datum = run.law is not None, run.has_datum
    grown = run.problem.thickening_at(step.time)
    force = float(solution.resultants[0])
    touching = bool(solution.in_contact.any()) if adheres else force > 0
    eccentricity_x, eccentricity_y = (
        _eccentricities(solution, rim.grid, adheres=adheres) if touching else (math.nan,) * 2
    )
    peak = max(solution.peak, 0.0)
    # A few cells enclose next to nothing; but no mean pressure exceeds the peak.
    area = max(rim.area, force / peak if peak > 0 else 0.0) if touching else 0.0
    load = line_load(solution.pressure, rim.grid)
    return ContactState(
        time=step.time if step.requested is None else step.requested,
        pressure=solution.pressure,
        gap=solution.gap,
        displacement=solution.displacement,
        in_contact=solution.in_contact,
        line_load=load,
        grid=rim.grid,
        force=force,
        eccentricity_x=eccentricity_x,
        eccentricity_y=eccentricity_y,
        approach=float(solution.motion[0]) - grown if has_datum else math.nan,
        tilt_x=float(solution.motion[1]) if run.tilts_from_datum else math.nan,
        tilt_y=float(solution.motion[2]),
        contact_area=area,
        contact_length=rim.length,
        contact_width=rim.width,
        peak_pressure=peak,
        mean_pressure=min(force / area, peak) if area > 0 else 0.0,  # rounded
        peak_line_load=peak_line_load(load, rim.grid, rim.length, team),
        work=totals[0],
        loss_per_cycle=totals[1],
        time_error=solution.time_error,
        iterations=solution.iterations,
        residual=solution.residual,
        cells_across=rim.cells_across,
        outcome=solution.outcome,
        **moved,
    )


def _eccentricities(solution: StepSolution, grid: Grid, *, adheres: bool) -> tuple[float, float]:
    """Places of the force along x and y [m]; NaN where it has none."""
    force, *moments = (float(resultant) for resultant in solution.resultants)
    # Pressure and attraction that cancel have a moment, but no place where a force acts.
    borne = float(np.abs(solution.pressure).sum()) * grid.cell_area if adheres else 0.0
    if abs(force) <= NO_FORCE * borne:
        return math.nan, math.nan
    # Along its period a surface has no centre from which the force could be offset.
    along_x, along_y = (
        math.nan if repeats else moment / force
        for moment, repeats in zip(moments, grid.periodic, strict=True)
    )
    return along_x, along_y
