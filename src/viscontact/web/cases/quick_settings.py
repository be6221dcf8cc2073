"""Settings with fewer cells and steps, for an approximate answer in seconds."""

from __future__ import annotations

import math
from collections.abc import Iterator

from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.case import Case
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.runs.forecast import Forecast
from viscontact.runs.preparation import PreparedRun

#: Largest numbers of steps or speeds and of cells, and least number of cells over each extent of
#: the contact.
STEPS, CELLS, LEAST_ACROSS = 24, 6000, 16

#: Tolerances of adaptive steps, the automatic grid and the solver.
STEP_ERROR, GRID_ERROR, SOLVER_ERROR = 1e-2, 0.1, 1e-4


def coarse_settings(prepared: PreparedRun, expected: Forecast) -> tuple[str, ...]:
    """Return the settings that make a case coarse."""
    case = prepared.case
    settings = [*_steps(case), *_cells(case, expected)]
    if case.errors:
        settings.append("output.errors=false")
    if case.tolerance < SOLVER_ERROR:
        settings.append(f"tolerance={SOLVER_ERROR:g}")
    return tuple(settings)


def without_cells(settings: tuple[str, ...]) -> tuple[str, ...]:
    """Return the settings without those of the grid, for a case that needs all its cells."""
    return tuple(each for each in settings if not each.startswith("grid."))


def _steps(case: Case) -> Iterator[str]:
    if isinstance(case.motion, SteadyMotion):
        speed, given = case.document.data["motion"]["speed"], case.document.data.get("output") or {}
        # Fields requested at some of the speeds need these.
        if isinstance(speed, dict) and speed["count"] > STEPS and "fields" not in given:
            yield f"motion.speed.count={STEPS}"
        return
    if isinstance(case.times, AdaptiveTimes):
        if case.times.tolerance < STEP_ERROR:
            yield f"time.tolerance={STEP_ERROR:g}"
        return
    steps = case.document.data["time"].get("steps")
    if isinstance(steps, int) and steps > STEPS:
        yield f"time.steps={STEPS}"


def _cells(case: Case, expected: Forecast) -> Iterator[str]:
    if isinstance(case.grid, Grid):
        shape = _coarser(case.grid, expected)
        if shape != case.grid.shape:
            yield f"grid.shape=[{shape[0]}, {shape[1]}]"
    elif case.grid is None or case.grid.tolerance < GRID_ERROR:
        yield f"grid.tolerance={GRID_ERROR:g}"


def _coarser(grid: Grid, expected: Forecast) -> tuple[int, int]:
    """Shape reduced by the same factor both ways, with enough cells across the contact."""
    part = math.sqrt(CELLS / (grid.shape[0] * grid.shape[1]))
    for across in (expected.cells_along, expected.cells_across):
        if across > 0:
            part = max(part, LEAST_ACROSS / across)
    if part >= 1:
        return grid.shape
    # Even or odd as before, which decides whether there is a cell at the centre.
    nx, ny = (2 * math.ceil(n * part / 2) + n % 2 for n in grid.shape)
    return min(nx, grid.shape[0]), min(ny, grid.shape[1])
