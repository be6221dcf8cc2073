"""Accuracy warnings that can be predicted before a run."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation import checks
from viscontact.simulation.checks.contact_geometry import Geometry
from viscontact.simulation.checks.half_space_theory import (
    body_warnings,
    corner_warnings,
    strain_warnings,
    warnings_of_covers,
)
from viscontact.simulation.checks.material import (
    data_warnings,
    early_warnings,
)
from viscontact.simulation.checks.sampling import (
    Sampling,
    local_approach,
    map_warnings,
    texture_warnings,
)
from viscontact.simulation.checks.singularities import strain_of
from viscontact.simulation.checks.temperature import diffusion_warnings
from viscontact.simulation.checks.tested_limits import (
    Contact,
    limit_warnings,
    limited_bodies,
    loaded_since,
    repeated,
)
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.warning_rules import (
    contact_change_warnings,
    geometry_of,
    setup_warnings,
)

#: Number of first instants of a run that are searched for a load before the first measured time.
FIRST_INSTANTS = 200


def predicted_warnings(
    run: RunSetup, estimate: ContactEstimate | None, compliance: float
) -> dict[str, str]:
    """Warnings about the material, the steps and the estimated contact of a run, by kind.

    The estimate is None without a load; `compliance` is the one that it was made with [1/Pa].
    """
    warnings = setup_warnings(run) | _range_warnings(run.problem) | _step_warnings(run.problem)
    if run.law is not None:
        warnings |= checks.adhesive_limits.expected_tail_warnings(run.law, run.open_gap, run.grid)
    return warnings if estimate is None else warnings | _contact_warnings(run, estimate, compliance)


def _contact_warnings(run: RunSetup, found: ContactEstimate, compliance: float) -> dict[str, str]:
    geometry = geometry_of(run.problem, found.open_gap, found.rim.grid, predicted=True)
    on_grid = Sampling(geometry.indenter, run.open_gap, run.grid)
    within_x = np.abs(run.grid.x - found.centre_x) <= found.length / 2
    within_y = np.abs(run.grid.y - found.centre_y) <= found.width / 2
    missed = float(on_grid.missed[np.ix_(within_x, within_y)].max(initial=0.0))
    strain = 2 * local_approach(found.grid, found.motion) / min(found.length, found.width)
    # An automatic grid that was refined for the peak pressure shows that this has a limit.
    has_limit = run.mesh is not None and "peak_pressure" in run.mesh.errors
    return (
        strain_warnings(geometry, found.rim, found.motion)
        | body_warnings(geometry, found.rim, found.pressure, has_limit=has_limit)
        | warnings_of_covers(geometry, found.rim, found.motion, run.grid.cell_size)
        | _corner_warnings(run, geometry, found, compliance)
        | _limit_warnings(run.problem, found)
        | diffusion_warnings(run.problem, min(found.length, found.width) / 2)
        | map_warnings(missed, max(run.grid.cell_size), strain)
        | texture_warnings(geometry.indenter, run.grid)
    )


def _limit_warnings(problem: Problem, found: ContactEstimate) -> dict[str, str]:
    """Warnings about strains and stresses beyond those of the tests, at the largest load."""
    since = loaded_since(problem.contact_load)
    bodies = limited_bodies(problem.bodies, problem.clocks, since)
    peak = found.peak_pressure
    if not bodies or not peak > 0:
        return {}
    force = float(found.pressure.sum()) * found.grid.cell_area
    loaded = problem.end - since if problem.motion.stands else 0.0
    contact = Contact(
        force / max(found.rim.area, force / peak),
        min(found.length, found.width) / 2,
        float(found.motion[0]) if problem.has_datum(found.grid) else math.nan,
        loaded,
        "at the largest load",
        peak,
        found.grid.line_length is not None,
        repeated(problem),
    )
    return limit_warnings(bodies, contact)


def _corner_warnings(
    run: RunSetup, geometry: Geometry, found: ContactEstimate, compliance: float
) -> dict[str, str]:
    """Warning about a peak at a corner, on cells at most four times finer than the estimate's."""
    # An estimate on far coarser cells than the run's says little about the peak.
    coarse = found.rim.grid.cell_size
    finest = tuple(max(own, each / 4) for own, each in zip(run.grid.cell_size, coarse, strict=True))
    grid = replace(run.grid, size=(finest[0] * run.grid.shape[0], finest[1] * run.grid.shape[1]))
    strain = strain_of(found.peak_pressure, compliance)
    searched = (max(finest[0], coarse[0]), max(finest[1], coarse[1]))
    return corner_warnings(replace(geometry, grid=grid), found.peak_place, strain, searched)


def _range_warnings(problem: Problem) -> dict[str, str]:
    """Warnings about a load outside the times on which the laws rest on data."""
    load, end, measured = problem.contact_load, problem.end, problem.data_times
    instants = np.union1d(load.kinks[load.kinks <= end], problem.instants[:FIRST_INSTANTS])
    asked = any(each.first > 0 for each in measured)
    loaded = instants[load.level_at(instants) > 0] if asked else instants[:0]
    warnings: dict[str, str] = {}
    for time in loaded.tolist():
        warnings = early_warnings(measured, load, time) | warnings
    return warnings | data_warnings(end, measured)


def _step_warnings(problem: Problem) -> dict[str, str]:
    """Warnings about given steps in which contact begins or ends; adaptive ones are short there."""
    if problem.chosen_steps is not None:
        return {}
    load, steps = problem.contact_load, problem.planned_steps
    times = np.array([step.time for step in steps])
    before_jumps = np.array([step.before_jump for step in steps])
    # One call for all times: a hundred thousand single calls take seconds.
    levels = np.where(before_jumps, load.level_at(times, side="left"), load.level_at(times))
    loaded = levels > 0
    warnings: dict[str, str] = {}
    for k in (np.flatnonzero(loaded[:-1] != loaded[1:]) + 1).tolist():
        touches = bool(loaded[k])
        if touches or load.control == "force":  # an approach above 0 may be without contact
            found = contact_change_warnings(problem, steps[k], touched=not touches, touches=touches)
            warnings = found | warnings
    return warnings
