"""Forecast of a run: memory, run time, estimated contact and expected warnings."""

from __future__ import annotations

import math
import time as clock
from functools import lru_cache

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import fast_length
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import LoadPoint, MixedHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.expected_warnings import predicted_warnings
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.run_memory import run_memory
from viscontact.simulation import checks
from viscontact.simulation.accuracy.coarser_ratios import usual_coarsening
from viscontact.simulation.meshing.contact_place import locate_contact
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate, estimate_period
from viscontact.simulation.transient.setup import RunSetup

#: Time of the first and of each later step at tolerance 1e-6, in times of a plain convolution, and
#: the overhead of a step [s]; measured on the shipped rollers and spheres.
FIRST_STEP, LATER_STEP, STEP_OVERHEAD = 30.0, 3.5, 3e-3

#: Steps of bodies that adhere beyond the given ones, which a way into contact and off it takes, in
#: the middle: without jumps, and what jumps add, in proportion to the Tabor number up to 1; time of
#: each step in times of a plain convolution, and its overhead [s]; measured on spheres, elastic and
#: creeping, and a rough surface. At large Tabor numbers of elastic bodies a step takes up to five
#: times as long.
ADHESIVE_STEPS, JUMPING_STEPS, ADHESIVE_STEP, ADHESIVE_OVERHEAD = 60.0, 120.0, 10.0, 4e-3

#: Cells up to which a convolution is timed; for larger grids the time is extrapolated.
_TIMED_CELLS = 2**18
#: Time after which a convolution is timed again [s].
_MEASURED_AGAIN = 60.0


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
        return estimate_period(problem.indenter, compliance, point, run.grid, response=response)
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
    steps, each = run.problem.step_count, convolution_time(run.grid)
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
    further = _further_steps(run.law, run.problem)
    return sum(_adhesive_seconds(count + further, one) for count, one in marches)


def _march_seconds(steps: float, convolution: float) -> float:
    """Duration of a march of a number of steps, by that of a convolution [s]."""
    return convolution * (FIRST_STEP + LATER_STEP * steps) + STEP_OVERHEAD * steps


def _adhesive_seconds(steps: float, convolution: float) -> float:
    """The same of bodies that adhere [s]."""
    return steps * (ADHESIVE_STEP * convolution + ADHESIVE_OVERHEAD)


def _further_steps(law: CohesiveLaw, problem: Problem) -> float:
    """Steps of bodies that adhere where their force changes much."""
    numbers = checks.adhesive_limits.tabor_numbers(law, problem)
    jumps = 1.0 if numbers is None else min(numbers[1], 1.0)
    return ADHESIVE_STEPS + jumps * JUMPING_STEPS


def convolution_time(grid: Grid) -> float:
    """Duration of a plain zero-padded convolution [s], the unit of work of a run."""
    return _convolution_time(grid.shape, int(clock.monotonic() / _MEASURED_AGAIN))


@lru_cache(maxsize=64)
def _convolution_time(cells: tuple[int, int], period: int) -> float:
    # Once in a while: a process has many runs on one grid, and the load of the machine changes.
    shrink = max(1.0, math.sqrt(cells[0] * cells[1] / _TIMED_CELLS))
    shape = [fast_length(max(4, int(2 * n / shrink))) for n in cells]
    field = np.ones(shape)
    np.fft.rfft2(field)  # plans and pages
    started = clock.perf_counter()
    np.fft.irfft2(np.fft.rfft2(field), s=shape)
    return (clock.perf_counter() - started) * shrink**2
