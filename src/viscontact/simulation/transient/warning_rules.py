"""Warning rules of a run: one list, applied before its first step and after each step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.materials.layers import materials_of
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import Outcome
from viscontact.mechanics.time_integration.fixed_steps import KINK_TOLERANCE, TimeStep
from viscontact.simulation import checks
from viscontact.simulation.checks.contact_geometry import Geometry
from viscontact.simulation.checks.covers import covers_of
from viscontact.simulation.checks.ends import datum_of_ends_warnings
from viscontact.simulation.checks.friction import coupling_warnings, rise_warnings
from viscontact.simulation.checks.material import (
    expansion_warnings,
    law_warnings,
    origin_warnings,
    passivity_warnings,
    splitting_warnings,
)
from viscontact.simulation.checks.mesh import layer_warnings
from viscontact.simulation.checks.motion import (
    axle_warnings,
    heat_warnings,
    row_warnings,
    turn_warnings,
)
from viscontact.simulation.checks.periodicity import datum_warnings
from viscontact.simulation.checks.steps import (
    relative_change,
    release_warnings,
    step_warnings,
    touch_warnings,
)
from viscontact.simulation.checks.temperature import shift_warnings
from viscontact.simulation.checks.tested_limits import temperature_warnings
from viscontact.simulation.transient.setup import RunSetup

if TYPE_CHECKING:
    from viscontact.simulation.transient.step_solution import StepSolution


def setup_warnings(run: RunSetup) -> dict[str, str]:
    """Return the warnings, by kind, that hold for a whole run: law, conversion, chosen mesh."""
    problem = run.problem
    memory_error = max(plan.error for plan in run.plans)
    warnings = law_warnings(memory_error, problem.compliance.inversion_error)
    warnings |= splitting_warnings(problem.surface.splitting_error)
    warnings |= origin_warnings(problem.materials)
    warnings |= temperature_warnings(problem.materials, problem.temperature)
    warnings |= shift_warnings(problem)
    if run.law is not None:
        warnings |= checks.adhesive_limits.zone_warnings(run.law, problem, run.grid)
    warnings |= coupling_warnings(problem) | rise_warnings(problem, run.grid)
    lost = () if problem.motion.stands else ("dissipation", "heat")
    undefined = ("approach", "work", *lost, "loss per cycle")
    warnings |= datum_warnings(run.grid, undefined, supported=problem.surface.is_supported)
    warnings |= datum_of_ends_warnings(problem, undefined, tilts=run.tilts_from_datum)
    warnings |= layer_warnings(problem.thinnest_layer, run.grid.cell_size)
    if run.mesh is not None:
        warnings |= run.mesh.warnings
    warnings |= axle_warnings(problem) | turn_warnings(problem) | row_warnings(problem)
    warnings |= heat_warnings(problem, run.grid, [plan.compliance for plan in run.plans])
    if problem.thickening is not None:
        warnings |= expansion_warnings(problem.thickening.surplus)
    for body, clock in zip(problem.bodies, problem.clocks, strict=True):
        end = float(clock.reduced(np.array(problem.end)))
        for material in materials_of(body):
            warnings |= passivity_warnings(material.law, end)
    return warnings


def geometry_of(
    problem: Problem,
    open_gap: Floats,
    grid: Grid,
    *,
    predicted: bool = False,
    indenter: Indenter | None = None,
) -> Geometry:
    """Geometry for warnings about a contact; `indenter` is a moving one at its position."""
    return Geometry(
        indenter or problem.indenter,
        open_gap,
        grid,
        thickness=problem.thickness,
        indenter_gives=problem.indenter_material is not None
        and "indenter_material" not in problem.ended_bodies,
        planes=problem.planes,
        covers=covers_of(problem.bodies, problem.end, problem.clocks),
        is_supported=problem.surface.is_supported,
        predicted=predicted,
    )


def contact_change_warnings(
    problem: Problem, step: TimeStep, *, touched: bool, touches: bool
) -> dict[str, str]:
    """Return warnings, by kind, about a step in which a creeping body gains or loses contact."""
    compliance = problem.surface.creep
    if step.is_jump or touched == touches or compliance(step.duration) == compliance.instant:
        return {}  # an elastic body does not depend on how the force arrives
    begin, end, largest = _levels(problem, step)
    if touches:
        # From nothing under a force; but an indentation may be met at an approach far from 0,
        # and only the part of the step beyond its begin counts.
        return touch_warnings(step.duration, (end - max(begin, 0.0)) / largest)
    return release_warnings(step.duration, (begin - max(end, 0.0)) / largest)


def loading_warnings(
    run: RunSetup, step: TimeStep, before: StepSolution | None, after: StepSolution
) -> dict[str, str]:
    """Return warnings, by kind, about a step from one solution (None: the first) to the next."""
    if before is None or step.is_jump or run.law is not None:
        return {}  # the steps of bodies that adhere follow the changes of the force
    touched, touches = (end.outcome is not Outcome.NO_CONTACT for end in (before, after))
    if not (touched and touches):
        return contact_change_warnings(run.problem, step, touched=touched, touches=touches)
    if after.resolved:
        return {}
    peaks = [end.peak for end in (before, after)]
    forces = [float(end.pressure.sum()) * run.grid.cell_area for end in (before, after)]
    return step_warnings(step.duration, max(relative_change(*peaks), relative_change(*forces)))


def _levels(problem: Problem, step: TimeStep) -> tuple[float, float, float]:
    """The load just after a step's begin, at its end, and the largest of the run [N or m]."""
    load, begin = problem.contact_load, step.time - step.duration * (1 - KINK_TOLERANCE)
    # A clamped tilt can press with no approach at all.
    largest = max(load.largest_level, np.finfo(float).tiny)
    end = load.level_at(step.time, side=step.side)
    return float(load.level_at(begin)), float(end), float(largest)
