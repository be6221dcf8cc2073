"""What a run will need and what it may find, before it is started."""

from __future__ import annotations

import math
import time as clock
from dataclasses import dataclass

import numpy as np
from scipy import fft

from viscontact.accuracy.coarser_runs import usual_coarsening
from viscontact.grid import Grid
from viscontact.loads import LoadPoint
from viscontact.meshing.elastic_estimate import ContactEstimate, estimate_contact, estimate_period
from viscontact.problem.problem import Problem
from viscontact.runs.expected_warnings import predicted_warnings
from viscontact.runs.free_memory import available_memory
from viscontact.runs.resources import run_memory
from viscontact.simulation.setup import RunSetup

#: Plain convolutions' time that the first step and each later one take at tolerance 1e-6, and
#: what a step takes besides [s]; measured on the shipped rollers and spheres.
FIRST_STEP, LATER_STEP, STEP_OVERHEAD = 30.0, 3.5, 3e-3

#: A larger grid is not timed but extrapolated.
_TIMED_CELLS = 2**18


@dataclass(frozen=True)
class Forecast:
    """What a run will need and what it may find.

    Parameters
    ----------
    memory : float
        Bytes that the run will hold.
    available : float
        Bytes that are free.
    seconds : float
        How long it will take on this machine, within a factor of two or three [s].
    estimate : ContactEstimate or None
        The contact under the largest load, by a coarse elastic solve; None without a load.
    compliance : str
        How much creep it has, in words: all of it under a force, none under an approach, that is,
        where the contact and where the pressure is largest.
    cells_along, cells_across : float
        Cells over the estimated length and width.
    fits : bool
        Whether the grid holds the estimated contact.
    warnings : dict of str to str
        What the run will warn of besides, as far as it can be told, by kind of doubt.
    """

    memory: float
    available: float
    seconds: float
    estimate: ContactEstimate | None
    compliance: str
    cells_along: float
    cells_across: float
    fits: bool
    warnings: dict[str, str]


def forecast(run: RunSetup, *, errors: bool = False) -> Forecast:
    """Foresee a run.

    Parameters
    ----------
    run : RunSetup
        A run that has been checked.
    errors : bool
        Whether the errors of its scalars are estimated as well.

    Returns
    -------
    Forecast
        What it will need and what it may find.

    Raises
    ------
    ValueError
        If the coarse solve finds no contact that can carry the load.

    Examples
    --------
    >>> import viscontact as vc
    >>> from viscontact.problem.problem import Problem
    >>> from viscontact.simulation.setup import prepare_run
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((64, 64), (2e-3, 2e-3))
    >>> run = prepare_run(Problem(vc.Sphere(0.01), rubber, vc.step(0.1), grid))
    >>> round(forecast(run).estimate.length / 2 * 1e3, 1)  # Hertz: (3 W R / (16 G))**(1/3) mm
    0.6
    """
    time, point = run.problem.largest_load
    compliance, named = _representative_compliance(run.problem, time)
    if point.level > 0:
        estimate = _estimate(run, compliance, point)
        extents, reach = (estimate.length, estimate.width), estimate.reach
    else:
        estimate, extents, reach = None, (0.0, 0.0), (0.0, 0.0)
    along, across = (
        extent / cell for extent, cell in zip(extents, run.grid.cell_size, strict=True)
    )
    return Forecast(
        memory=run_memory(run),
        available=available_memory(),
        seconds=_seconds(run, errors=errors),
        estimate=estimate,
        compliance=named,
        cells_along=along,
        cells_across=across,
        fits=run.grid.periodic
        or all(r < size / 2 for r, size in zip(reach, run.grid.size, strict=True)),
        warnings=predicted_warnings(run, estimate, compliance),
    )


def _estimate(run: RunSetup, compliance: float, point: LoadPoint) -> ContactEstimate:
    if run.grid.periodic:
        return estimate_period(run.problem.indenter, compliance, point, run.grid)
    return estimate_contact(run.problem.indenter, compliance, point)


def _representative_compliance(problem: Problem, time: float) -> tuple[float, str]:
    compliance = problem.compliance
    if problem.load.control == "force":
        return float(compliance(problem.end)), "creep as at the end of the run"
    if compliance.instant > 0:
        return float(compliance.instant), "before any creep"
    return float(compliance(time)), "creep as at that instant"


def _seconds(run: RunSetup, *, errors: bool) -> float:
    steps, each = run.problem.step_count, _convolution_time(run.grid)
    marches = [(steps, each)]
    if errors:
        marches += [
            (steps / step_ratio, each / spacing**2)
            for spacing, step_ratio in usual_coarsening(round(steps))
        ]
    return sum(
        one * (FIRST_STEP + LATER_STEP * count) + STEP_OVERHEAD * count for count, one in marches
    )


def _convolution_time(grid: Grid) -> float:
    """Seconds for a plain zero-padded convolution, the measure of all work in a run."""
    cells = grid.shape[0] * grid.shape[1]
    shrink = max(1.0, math.sqrt(cells / _TIMED_CELLS))
    shape = [fft.next_fast_len(max(4, int(2 * n / shrink)), real=True) for n in grid.shape]
    field = np.ones(shape)
    fft.rfft2(field)  # plans and pages
    started = clock.perf_counter()
    fft.irfft2(fft.rfft2(field), s=shape)
    return (clock.perf_counter() - started) * shrink**2
