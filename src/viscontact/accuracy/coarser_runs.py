"""Coarser companions of a run, whose differences from it tell how far it is off."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.checks.mesh import cells_across_spots
from viscontact.checks.singularities import is_sharp, strain_of, touches_end
from viscontact.errors import ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.materials.compliance import ContactCompliance
from viscontact.results.variables import scalars_with_error
from viscontact.simulation.march import March
from viscontact.simulation.setup import RunSetup, plan_memory
from viscontact.state import ContactState
from viscontact.time_integration.fixed_steps import plan_steps

#: Cells of the companions, in cells of the run, and whether they lie about the origin as the run's
#: do: where a cell's centre was, there may be an edge between two.
CELL_RATIOS = ((1.5, False), (2.4, True))

#: Their steps, in steps of the run, and how many steps the run must have for that.
STEP_RATIOS = ((16, (2, 4)), (7, (2, 2)), (0, (1, 1)))

#: Cells that the coarsest companion has across the largest contact; fewer are no contact.
MIN_ACROSS = 4.5

#: The least difference that is worth a run.
MIN_COARSENING = 1.6

#: Scalars of a history by name, each over its instants, among them ``time``.
History = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class CoarserRun:
    """A run beside a run.

    Attributes
    ----------
    spacing : float
        Its cells, in cells of the run.
    step_ratio : float
        Its steps, in steps of the run: 2 for every second one, 0.5 for halves.
    run : RunSetup
        What is marched.
    """

    spacing: float
    step_ratio: float
    run: RunSetup


@dataclass(frozen=True, eq=False)
class CoarserResult:
    """What a companion has come to.

    Attributes
    ----------
    spacing, step_ratio : float
        As of the companion.
    scalars : mapping of str to ndarray
        The scalars over its instants, ``time`` among them.
    at_end : ndarray of bool
        Where contact reaches the end of the body.
    spots : ndarray
        Cells of the run across the spots of which contact consists, in the mean.
    is_sharp : bool
        Whether the largest pressure lies on a point or a ridge of the body.
    """

    spacing: float
    step_ratio: float
    scalars: History
    at_end: NDArray[np.bool_]
    spots: NDArray[np.float64]
    is_sharp: bool


def plan_coarser_runs(run: RunSetup, history: History) -> Iterator[CoarserRun]:
    """Yield the companions of a run that is over, the cheapest first.

    Parameters
    ----------
    run : RunSetup
        The run.
    history : mapping of str to ndarray
        Its ``time`` [s] and its ``cells_across``.

    Yields
    ------
    CoarserRun
        Two that are coarser in cells and in steps. Where steps are so few that none can be left
        out, and the bodies creep, one more with halved steps on the coarsest grid.
    """
    times = history["time"]
    paces = _paces(len(plan_steps(times, run.problem.load)))
    spacings = _spacings(float(history["cells_across"].max(initial=0.0)))
    for (spacing, alike), step_ratio in zip(reversed(spacings), reversed(paces), strict=True):
        kept = times[::-1][::step_ratio][::-1]
        yield _coarser_run(run, spacing, alike, float(step_ratio), kept)
    if paces[-1] == 1 and _creeps(run.problem.compliance, times):
        instants = np.unique([0.0, *(step.time for step in plan_steps(times, run.problem.load))])
        middles = (instants[1:] + instants[:-1]) / 2
        yield _coarser_run(run, *spacings[-1], 0.5, np.union1d(times, middles))


def usual_coarsening(steps: int) -> tuple[tuple[float, int], ...]:
    """Return spacings and paces of the companions that a run of so many steps has.

    Parameters
    ----------
    steps : int
        Its steps.

    Examples
    --------
    >>> usual_coarsening(60)
    ((1.5, 2), (2.4, 4))
    """
    paces = _paces(steps)
    return tuple(
        (spacing, step_ratio) for (spacing, _), step_ratio in zip(CELL_RATIOS, paces, strict=True)
    )


def _paces(steps: int) -> tuple[int, int]:
    return next(paces for least, paces in STEP_RATIOS if steps >= least)


def coarser_grid(grid: Grid, spacing: float, alike: bool) -> Grid:
    """Return a grid of larger cells over the same region and a little more.

    Parameters
    ----------
    grid : Grid
        The finer one.
    spacing : float
        Cells of the coarser one, in its cells.
    alike : bool
        Whether numbers of cells stay even or odd.

    Returns
    -------
    Grid
        A cell larger than the other at least, lest the contact touch its rim; of the same size if
        periodic.

    Examples
    --------
    >>> coarser_grid(Grid((30, 31), (30.0, 31.0)), 2.0, alike=True)
    Grid(shape=(16, 17), size=(32.0, 34.0), periodic=False)
    """
    if grid.periodic:
        counts = [max(4, round(count / spacing)) for count in grid.shape]
        return replace(grid, shape=(counts[0], counts[1]))
    shape = []
    for count in grid.shape:
        coarse = max(4, int(np.ceil(count / spacing - 1e-9)) + 1)
        shape.append(coarse + ((coarse - count) % 2 == alike))
    cells = [spacing * cell for cell in grid.cell_size]
    size = (shape[0] * cells[0], shape[1] * cells[1])
    return replace(grid, shape=(shape[0], shape[1]), size=size)


def march_coarser_run(
    coarser_run: CoarserRun, on_step: Callable[[], None] | None = None
) -> CoarserResult | None:
    """March a companion.

    Parameters
    ----------
    coarser_run : CoarserRun
        What to march.
    on_step : callable, optional
        Called after each of its steps; what it raises ends the march.

    Returns
    -------
    CoarserResult or None
        None if it could not be marched to its end: it tells nothing then.
    """
    run, states, ends, spots = coarser_run.run, [], [], []
    peak = 0.0
    sharp = False
    try:
        for state in March(run):
            if on_step is not None:
                on_step()
            if state is None:
                continue
            states.append(state.without_fields())
            contact = state.pressure > 0
            ends.append(touches_end(run.open_gap, contact))
            spots.append(cells_across_spots(contact, periodic=run.grid.periodic))
            if state.peak_pressure > 1.1 * peak:
                peak = state.peak_pressure
                sharp = sharp or _peaks_at_point(coarser_run, state)
    except (ConvergenceError, DomainError):
        return None
    return CoarserResult(
        coarser_run.spacing,
        coarser_run.step_ratio,
        history_of(states),
        np.array(ends, dtype=bool),
        coarser_run.spacing * np.array(spots, dtype=float),
        sharp,
    )


#: Scalars of a state from which its errors are estimated.
SCALARS = ("time", *scalars_with_error(), "cells_across")


def history_of(states: Sequence[ContactState]) -> History:
    """Return the scalars of states over their instants."""
    return {name: np.array([getattr(state, name) for state in states], float) for name in SCALARS}


def _spacings(across: float) -> tuple[tuple[float, bool], ...]:
    """The spacings, closer together where the run has few cells across its contact."""
    coarsest = CELL_RATIOS[-1][0]
    most = min(coarsest, max(across / MIN_ACROSS, MIN_COARSENING))
    closer = (most - 1) / (coarsest - 1)
    return tuple((1 + (spacing - 1) * closer, alike) for spacing, alike in CELL_RATIOS)


def _creeps(compliance: ContactCompliance, times: NDArray[np.float64]) -> bool:
    return bool(compliance(float(times[-1])) != compliance.instant)


def _coarser_run(
    run: RunSetup, spacing: float, alike: bool, step_ratio: float, times: NDArray[np.float64]
) -> CoarserRun:
    coarse = run.on(coarser_grid(run.grid, spacing, alike))
    problem = replace(
        run.problem, grid=coarse.grid, times=times, fields="none", step_ratio=max(1.0, step_ratio)
    )
    memory = plan_memory(problem, coarse.open_gap, coarse.grid)
    return CoarserRun(spacing, step_ratio, replace(coarse, problem=problem, memory=memory))


def _peaks_at_point(coarser_run: CoarserRun, state: ContactState) -> bool:
    """Whether its largest pressure lies at what is sharp to the cells of the run beside it."""
    run = coarser_run.run
    place = run.grid.largest_at(state.pressure)
    dx, dy = run.grid.cell_size
    cell = (dx / coarser_run.spacing, dy / coarser_run.spacing)
    strain = strain_of(state.peak_pressure, float(run.problem.compliance(state.time)))
    return is_sharp(run.problem.indenter, place, (1.5 * dx, 1.5 * dy), cell, strain)
