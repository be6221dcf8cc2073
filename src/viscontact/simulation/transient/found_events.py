"""Problem of a load program after its events have been found."""

from __future__ import annotations

import logging
import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.bodies.cell_borders import with_borders_at
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import Condition, ForceHistory, LoadPoint, MixedHistory
from viscontact.bodies.loads.program import CONTROL_UNITS
from viscontact.mechanics.problem.kept_fields import NO_FIELDS, KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.time_integration.fixed_steps import KINK_TOLERANCE
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.simulation import meshing, transient
from viscontact.simulation.checks.adhesion import resolved_on
from viscontact.simulation.checks.problem_checks import check_mixed

_LOG = logging.getLogger("viscontact")

#: Cells along each axis and most steps of a rough march, and its tolerance of adaptive steps.
ROUGH_CELLS, ROUGH_STEPS, ROUGH_ERROR = 40, 80, 1e-2

#: Tolerance of the solver in a rough march.
ROUGH_TOLERANCE = 1e-4

#: Most rough marches in search of the size of the contact, and the factor between two sizes.
ROUGH_MARCHES, ENLARGED = 40, 2.0

#: Reach of a contact over half the size of the grid above which a rough march is not repeated on
#: a smaller one, and size of the smaller one over twice the reach.
WELL_FILLED, MARGIN = 0.3, 1.5


def carried_out(problem: Problem, threads: int = 1, *, roughly: bool = False) -> Problem:
    """Problem under the history that its load program comes to, by a coarse march if `roughly`."""
    load = problem.load
    if not (isinstance(load, MixedHistory) and load.awaits_events):
        return problem
    check_mixed(problem)
    latest = _latest_end(problem)
    grid = problem.grid
    if not isinstance(grid, Grid):
        found = _rough_march(problem, latest)
        grid = _grid_for(problem, found)
    elif roughly:
        few = with_borders_at(_coarse(grid), problem.planes)
        found = _search(resolved_on(_with_few_steps(problem), few), few, latest)
    if not roughly:
        found = _search(problem, grid, latest, threads)
    return _under_history(problem, grid, found, roughly=roughly)


def _latest_end(problem: Problem) -> float:
    """Latest end of the program [s]."""
    if problem.times is None:
        raise ValueError(
            "times: a load program needs given instants, the last one its latest end; write e.g. "
            "times=vc.uniform_times(10.0, 100)"
        )
    if problem.end <= 0:
        raise ValueError("times: the last one is the latest end of the program, later than 0 s")
    return problem.end


def _search(
    problem: Problem, grid: Grid, latest: float, threads: int = 1
) -> tuple[transient.EventSearch, MixedHistory]:
    """March the program of a problem on a grid; return the search and what it found."""
    assert isinstance(problem.load, MixedHistory)
    assert problem.load.program is not None
    instants = None if problem.adaptive else problem.instants
    adheres = problem.adhesion is not None
    course = transient.ProgramCourse(problem.load.program, latest, may_pull=adheres)
    search = transient.EventSearch(
        replace(problem, grid=grid),
        course,
        None if instants is None else lambda number, begin, end: instants,
        threads,
    )
    return search, search.carry_out()


def _rough_march(problem: Problem, latest: float) -> tuple[transient.EventSearch, MixedHistory]:
    """March a program on few cells and steps, on a grid about as large as its largest contact."""
    easy = _with_few_steps(problem)
    size = 2 * MARGIN * np.array(_first_reach(problem, latest))
    for _ in range(ROUGH_MARCHES):
        grid = Grid((ROUGH_CELLS, ROUGH_CELLS), (float(size[0]), float(size[1])))
        grid = with_borders_at(grid, problem.planes)
        try:
            found = _search(resolved_on(easy, grid), grid, latest)
        except (DomainError, ConvergenceError):  # too small, or cells of an awkward size
            size *= ENLARGED
            continue
        reach = np.add(found[0].reach, np.array(grid.cell_size) / 2)
        loose = reach < WELL_FILLED * size / 2
        if not loose.any():
            return found
        size = np.where(loose, 2 * MARGIN * reach, size)
    raise ValueError(
        "grid: no grid could be fitted to the contact of the load program, whose size varies too "
        "much; give a grid"
    )


def _first_reach(problem: Problem, latest: float) -> tuple[float, float]:
    """First guess of the reach of the contact along x and y, from a load of the program [m]."""
    assert isinstance(problem.load, MixedHistory)
    program = problem.load.program
    assert program is not None
    named = [
        (condition.scalar, condition.value)
        for condition in (*(each.until for each in program.parts), *program.stop)
        if isinstance(condition, Condition) and condition.scalar in CONTROL_UNITS
    ]
    moved = [
        (each.control, each.rate * (each.duration or latest))
        for each in program.parts
        if each.rate > 0
    ]
    levels = [each for each in named if each[1] > 0] or moved
    if not levels:
        raise ValueError("grid: the load program never presses the body; give a grid")
    control, level = levels[0]
    point = LoadPoint(
        level if control == "force" else None,
        *(0.0, 0.0, program.tilt_x or 0.0, program.tilt_y or 0.0),
        level if control == "approach" else None,
    )
    compliance = float(problem.compliance(latest))
    response = problem.surface.response_at(latest)
    found = meshing.locate_contact(problem.cut_indenter, compliance, point, response=response)
    return found.reach_from((0.0, 0.0))


def _with_few_steps(problem: Problem) -> Problem:
    """The problem with fewer of its times, or a larger tolerance of adaptive ones."""
    solved = max(problem.tolerance, ROUGH_TOLERANCE)
    if problem.adaptive is not None:
        tolerance = max(problem.adaptive.tolerance, ROUGH_ERROR)
        times = replace(problem.adaptive, tolerance=tolerance)
        return replace(problem, times=times, kept=NO_FIELDS, tolerance=solved)
    instants = problem.instants
    kept = instants[:: math.ceil(len(instants) / ROUGH_STEPS)]
    return replace(problem, times=np.union1d(kept, instants[-1:]), kept=NO_FIELDS, tolerance=solved)


def _coarse(grid: Grid) -> Grid:
    """A grid of the same place and size with few cells."""
    nx, ny = (min(each, ROUGH_CELLS) for each in grid.shape)
    return Grid((nx, ny), grid.size, centre=grid.centre)


def _grid_for(problem: Problem, found: tuple[transient.EventSearch, MixedHistory]) -> Grid:
    """Automatic grid for the forces of a rough march, at the ends of its segments and the peak."""
    search, history = found
    forces = np.array([state.force for state in search.states])
    times = np.array([state.time for state in search.states])
    kept = np.isin(times, history.times)
    kept[forces.argmax()] = True
    places = {name: getattr(history, name) for name in ("eccentricity_x", "eccentricity_y")}
    tilts = {name: getattr(history, name) for name in ("tilt_x", "tilt_y")}
    load = ForceHistory(times[kept], forces[kept], **places, **tilts)
    mesh = meshing.choose_mesh(replace(problem, load=load), float(times[-1]))
    for text in mesh.warnings.values():
        _LOG.info("automatic grid: %s", text)
    return mesh.grid


def _under_history(
    problem: Problem,
    grid: Grid,
    found: tuple[transient.EventSearch, MixedHistory],
    *,
    roughly: bool,
) -> Problem:
    """The problem under a history that was found, with its events among the times."""
    search, history = found
    for event in history.events:
        _LOG.info("t = %.6g s: %s", event.time, event.condition)
    ends = np.array(history.times[1:])
    end, margin = float(ends[-1]), 3 * KINK_TOLERANCE * problem.end  # at most 2 in `_locate`
    times: Floats | AdaptiveTimes
    if problem.adaptive is None:
        kept = problem.instants[problem.instants < end * (1 - KINK_TOLERANCE)]
        beside = (np.abs(kept[:, None] - ends).min(axis=1) <= margin) & (kept > 0)
        times = np.union1d(kept[~beside], ends)
    elif roughly:
        times = replace(problem.adaptive, end=end)
    else:
        times = np.array([state.time for state in search.states])
    fields = _kept_until(problem.kept, ends, margin)
    return replace(problem, load=history, grid=grid, times=times, kept=fields)


def _kept_until(fields: KeptFields, ends: Floats, margin: float) -> KeptFields:
    """Instants whose fields are kept, or ends beside them; one after the last becomes the last."""
    if isinstance(fields.requested, str):
        return fields
    instants = np.asarray(fields.places)
    nearest = ends[np.abs(instants[:, None] - ends).argmin(axis=1)]
    beside = (np.abs(instants - nearest) <= margin) | (instants > ends[-1])
    return KeptFields(tuple(np.unique(np.where(beside, nearest, instants)).tolist()))
