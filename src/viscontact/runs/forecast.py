"""Forecast of a run: memory, run time, estimated contact and expected warnings."""

from __future__ import annotations

import math
import time as clock
from dataclasses import replace
from functools import lru_cache

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import fast_length
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import LoadPoint, MixedHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.adhesive_forecast import (
    adhesive_seconds,
    adhesive_steps,
    computed_shape,
)
from viscontact.runs.expected_warnings import predicted_warnings
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.run_memory import run_memory
from viscontact.simulation.accuracy.coarser_ratios import usual_coarsening
from viscontact.simulation.meshing.contact_place import locate_contact
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate, estimate_period
from viscontact.simulation.transient.setup import RunSetup

#: Time of the first and of each later step at tolerance 1e-6, in times of a plain convolution, and
#: the overhead of a step [s]; measured on the shipped rollers and spheres.
FIRST_STEP, LATER_STEP, STEP_OVERHEAD = 30.0, 3.5, 3e-3

#: Cells up to which a convolution is timed; for larger grids the time is extrapolated.
_TIMED_CELLS = 2**18
#: Time after which a convolution is timed again [s].
_MEASURED_AGAIN = 60.0

#: The same of bodies that adhere, whose steps work in memory that they keep: a larger convolution
#: gets its memory from the system each time.
_TIMED_ADHESIVE = 2**14


@dataclass(frozen=True)
class Forecast:
    """Requirements and expected results of a run."""

    memory: float  # required [bytes]
    available: float  # free memory [bytes]
    seconds: float  # run time on this machine, within a factor of two or three [s]
    estimate: ContactEstimate | None  # under the largest load; None without a load
    compliance: str  # creep of the estimate, in words: all under a force, none under an approach
    cells_along: float  # cells over the estimated length
    cells_across: float  # cells over the estimated width
    fits: bool  # the grid contains the estimated contact
    warnings: dict[str, str]  # predicted accuracy warnings, by kind


def forecast(run: RunSetup, *, errors: bool = False) -> Forecast:
    """Forecast a checked run, with coarser runs if `errors`; ValueError without contact."""
    time, point = run.problem.largest_load
    compliance, named = _representative_compliance(run.problem, time)
    if point.level > 0:
        estimate = _estimate(run, compliance, point)
        extents, reach = (estimate.length, estimate.width), estimate.reach_from(run.grid.centre)
    else:
        estimate, extents, reach = None, (0.0, 0.0), (0.0, 0.0)
    along, across = (
        extent / cell for extent, cell in zip(extents, run.grid.cell_size, strict=True)
    )
    return Forecast(
        memory=run_memory(run),
        available=available_memory(),
        seconds=run_seconds(run, errors=errors),
        estimate=estimate,
        compliance=named,
        cells_along=along,
        cells_across=across,
        fits=all(
            repeats or far < size / 2
            for far, size, repeats in zip(reach, run.grid.size, run.grid.periodic, strict=True)
        ),
        warnings=predicted_warnings(run, estimate, compliance),
    )


def _estimate(run: RunSetup, compliance: float, point: LoadPoint) -> ContactEstimate:
    problem = run.problem
    response = problem.surface.response_at(problem.end)
    if any(run.grid.periodic):
        return estimate_period(problem.cut_indenter, compliance, point, run.grid, response=response)
    return locate_contact(problem.cut_indenter, compliance, point, response=response)


def _representative_compliance(problem: Problem, time: float) -> tuple[float, str]:
    compliance = problem.compliance
    if problem.load.control == "force":
        return float(compliance(problem.end)), "creep as at the end of the run"
    if compliance.instant > 0:
        return float(compliance.instant), "before any creep"
    return float(compliance(time)), "creep as at that instant"


def run_seconds(run: RunSetup, *, errors: bool) -> float:
    """Run time on this machine, within a factor of two or three [s]; `errors` as in `forecast`."""
    steps, each = run.problem.step_count, 0.0
    if run.law is None:
        each = convolution_time(run.grid)
    else:
        steps = adhesive_steps(run, run.law)
        each = convolution_time(replace(run.grid, shape=computed_shape(run)), _TIMED_ADHESIVE)
    marches = [(steps, each)]
    if errors:
        across = min(run.grid.shape) / 2  # of a contact that fills half of its grid
        marches += [
            (steps / step_ratio, each / spacing**2)
            for spacing, step_ratio in usual_coarsening(round(steps), across)
        ]
    load = run.problem.load
    if isinstance(load, MixedHistory) and load.program is not None:
        marches.append(marches[0])  # the first time to find the events
    if run.law is None:
        return sum(_march_seconds(count, one) for count, one in marches)
    return sum(adhesive_seconds(run, run.law, count, one) for count, one in marches)


def _march_seconds(steps: float, convolution: float) -> float:
    """Duration of a march of a number of steps, by that of a convolution [s]."""
    return convolution * (FIRST_STEP + LATER_STEP * steps) + STEP_OVERHEAD * steps


def convolution_time(grid: Grid, timed_cells: int = _TIMED_CELLS) -> float:
    """Duration of a plain zero-padded convolution [s], the unit of work of a run."""
    return _convolution_time(grid.shape, timed_cells, int(clock.monotonic() / _MEASURED_AGAIN))


@lru_cache(maxsize=64)
def _convolution_time(cells: tuple[int, int], timed_cells: int, period: int) -> float:
    # Once in a while: a process has many runs on one grid, and the load of the machine changes.
    shrink = max(1.0, math.sqrt(cells[0] * cells[1] / timed_cells))
    shape = [fast_length(max(4, int(2 * n / shrink))) for n in cells]
    field = np.ones(shape)
    np.fft.rfft2(field)  # plans and pages
    started = clock.perf_counter()
    np.fft.irfft2(np.fft.rfft2(field), s=shape)
    return (clock.perf_counter() - started) * shrink**2
