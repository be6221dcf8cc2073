"""What a run will warn of, as far as it can be told before its first step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.checks.half_space_theory import (
    Geometry,
    body_warnings,
    corner_warnings,
    strain_warnings,
)
from viscontact.checks.material import (
    data_warnings,
    early_warnings,
    law_warnings,
    passivity_warnings,
)
from viscontact.checks.sampling import Sampling, map_warnings, texture_warnings
from viscontact.checks.singularities import strain_of
from viscontact.checks.steps import release_warnings, touch_warnings
from viscontact.materials.material import Material
from viscontact.meshing.elastic_estimate import ContactEstimate
from viscontact.simulation.setup import RunSetup
from viscontact.time_integration.fixed_steps import plan_steps

#: So many of a run's first instants are looked at for a load that comes before the data do.
FIRST_INSTANTS = 200


def predicted_warnings(
    run: RunSetup, estimate: ContactEstimate | None, compliance: float
) -> dict[str, str]:
    """Doubts about the material, the steps and the estimated contact of a run.

    Parameters
    ----------
    run : RunSetup
        A run that has been checked.
    estimate : ContactEstimate or None
        Its largest contact, coarsely; None without a load.
    compliance : float
        The contact compliance of that estimate [1/Pa].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt, as a run would say them; empty if there is none. Those about
        a mesh that was given are left to who knows whether the grid fits.
    """
    warnings = _material_warnings(run) | _step_warnings(run)
    if run.mesh is not None:
        warnings |= run.mesh.warnings
    return warnings if estimate is None else warnings | _contact_warnings(run, estimate, compliance)


def _bodies(run: RunSetup) -> list[Material]:
    return [body for body in (run.material, run.indenter_material) if body is not None]


def _contact_warnings(run: RunSetup, found: ContactEstimate, compliance: float) -> dict[str, str]:
    geometry = Geometry(
        run.indenter,
        found.open_gap,
        found.rim.grid,
        thickness=min(body.thickness or math.inf for body in _bodies(run)),
        indenter_gives=run.indenter_material is not None,
        predicted=True,
    )
    on_grid = Sampling(run.indenter, run.open_gap, run.grid)
    within_x = np.abs(run.grid.x - found.centre_x) <= found.length / 2
    within_y = np.abs(run.grid.y - found.centre_y) <= found.width / 2
    missed = float(on_grid.missed[np.ix_(within_x, within_y)].max(initial=0.0))
    strain = 2 * found.approach / min(found.length, found.width)
    return (
        strain_warnings(geometry, found.rim, found.motion)
        | body_warnings(geometry, found.rim)
        | _corner_warnings(run, geometry, found, compliance)
        | map_warnings(missed, max(run.grid.cell_size), strain)
        | texture_warnings(run.indenter.period, max(run.grid.cell_size))
    )


def _corner_warnings(
    run: RunSetup, geometry: Geometry, found: ContactEstimate, compliance: float
) -> dict[str, str]:
    """Doubt about a peak at a corner; far coarser than the run's, a solve tells little of it."""
    coarse = found.rim.grid.cell_size
    finest = tuple(max(own, each / 4) for own, each in zip(run.grid.cell_size, coarse, strict=True))
    grid = replace(run.grid, size=(finest[0] * run.grid.shape[0], finest[1] * run.grid.shape[1]))
    strain = strain_of(found.peak_pressure, compliance)
    searched = (max(finest[0], coarse[0]), max(finest[1], coarse[1]))
    return corner_warnings(replace(geometry, grid=grid), found.peak_place, strain, searched)


def _material_warnings(run: RunSetup) -> dict[str, str]:
    end = float(run.times[-1])
    warnings = law_warnings(run.memory.error, run.compliance.inversion_error)
    for body in _bodies(run):
        warnings |= passivity_warnings(body.law, end)
    first = max(body.known_from for body in _bodies(run))
    kinks = run.load.kinks[run.load.kinks <= end]
    instants = np.union1d(kinks, run.times[:FIRST_INSTANTS])
    loaded = instants[run.load.level_at(instants) > 0] if first > 0 else instants[:0]
    for time in loaded.tolist():
        warnings = early_warnings(first, run.load, time) | warnings
    return warnings | data_warnings(end, run.measured_until)


def _step_warnings(run: RunSetup) -> dict[str, str]:
    """Of given steps that take much of the load on or off at once; adaptive ones see to it."""
    end, load = float(run.times[-1]), run.load
    if run.adaptive is not None or run.compliance(end) == run.compliance.instant:
        return {}
    warnings: dict[str, str] = {}
    steps = plan_steps(run.times, load)
    times = np.array([step.time for step in steps])
    before_jumps = np.array([step.before_jump for step in steps])
    # All at once: a load at a hundred thousand instants one by one takes seconds.
    levels = np.where(before_jumps, load.level_at(times, side="left"), load.level_at(times))
    comes_or_goes = np.flatnonzero((levels[:-1] <= 0) != (levels[1:] <= 0)) + 1
    for k in comes_or_goes.tolist():
        step, before, after = steps[k], float(levels[k - 1]), float(levels[k])
        if step.is_jump:
            continue
        if before <= 0:
            warnings = touch_warnings(step.duration, after / load.largest_level) | warnings
        elif load.control == "force":
            warnings = release_warnings(step.duration, before / load.largest_level) | warnings
    return warnings
