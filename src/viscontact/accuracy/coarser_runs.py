"""Coarser runs of the same problem, for error estimation."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.checks.mesh import cells_across_spots
from viscontact.checks.singularities import bend_at, end_pressures, is_sharp, strain_of
from viscontact.errors import ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.materials.compliance import ContactCompliance
from viscontact.results.variables import scalars_with_error
from viscontact.simulation.march import March
from viscontact.simulation.setup import RunSetup, plan_history
from viscontact.state import ContactState
from viscontact.time_integration.fixed_steps import plan_steps

#: Cell sizes of the coarser runs, in cells of the run, and whether their numbers of cells keep the
#: parity of the run's: otherwise an edge may lie where a cell's centre was.
CELL_RATIOS = ((1.5, False), (2.4, True))

#: Least number of steps of the run, and step sizes of its coarser runs, in steps of the run.
STEP_RATIOS = ((16, (2, 4)), (7, (2, 2)), (0, (1, 1)))

#: Least number of cells across the largest contact on the coarsest grid.
MIN_ACROSS = 4.5

#: Least ratio of the coarsest grid's cells to the run's.
MIN_COARSENING = 1.6

#: Scalars over the instants of a run by name, including ``time``.
History = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class CoarserRun:
    """Setup of a coarser run."""

    spacing: float  # cell size, in cells of the original run
    step_ratio: float  # steps, in steps of the original run: 2 for every second, 0.5 for halves
    run: RunSetup


@dataclass(frozen=True, eq=False)
class CoarserResult:
    """Result of a coarser run."""

    spacing: float  # as in CoarserRun
    step_ratio: float  # as in CoarserRun
    scalars: History
    end_pressures: NDArray[np.float64]  # over the instants, see `singularities.end_pressures` [Pa]
    #: Growth of the largest pressure with the logarithm of the cells that the body's bend there can
    #: cause, over the mean pressure [-].
    bend_growth: NDArray[np.float64]
    spots: NDArray[np.float64]  # mean width of the contact spots, in cells of the original run
    is_sharp: bool  # the largest pressure lies on a point or a ridge of the body

    @property
    def at_end(self) -> NDArray[np.bool_]:
        """Instants at which the contact reaches the end of the body."""
        return np.asarray(self.end_pressures[:, 0] > 0)


def plan_coarser_runs(run: RunSetup, history: History) -> Iterator[CoarserRun]:
    """Yield the coarser runs of a completed run, the cheapest first.

    Two are coarser in cells and in steps. If the run has too few steps to leave any out, and the
    bodies creep, a third one has halved steps on the coarsest grid.
    """
    times = history["time"]
    step_ratios = _step_ratios(len(plan_steps(times, run.problem.load)))
    spacings = _spacings(float(history["cells_across"].max(initial=0.0)))
    for (spacing, parity), step_ratio in zip(
        reversed(spacings), reversed(step_ratios), strict=True
    ):
        kept = times[::-1][::step_ratio][::-1]
        yield _coarser_run(run, spacing, parity, float(step_ratio), kept)
    if step_ratios[-1] == 1 and _creeps(run.problem.compliance, times):
        instants = np.unique([0.0, *(step.time for step in plan_steps(times, run.problem.load))])
        middles = (instants[1:] + instants[:-1]) / 2
        yield _coarser_run(run, *spacings[-1], 0.5, np.union1d(times, middles))


def usual_coarsening(steps: int) -> tuple[tuple[float, int], ...]:
    """Ratios of cells and of steps of the coarser runs of a run with a number of steps.

    Examples
    --------
    >>> usual_coarsening(60)
    ((1.5, 2), (2.4, 4))
    """
    step_ratios = _step_ratios(steps)
    return tuple(
        (spacing, step_ratio)
        for (spacing, _), step_ratio in zip(CELL_RATIOS, step_ratios, strict=True)
    )


def _step_ratios(steps: int) -> tuple[int, int]:
    return next(step_ratios for least, step_ratios in STEP_RATIOS if steps >= least)


def coarser_grid(grid: Grid, spacing: float, parity: bool) -> Grid:
    """Grid of cells larger by a factor over the same region; `parity`: even numbers stay even.

    It extends at least one cell further, so that the contact does not touch its rim; a period keeps
    its size.

    Examples
    --------
    >>> coarser_grid(Grid((30, 31), (30.0, 31.0)), 2.0, parity=True)
    Grid(shape=(16, 17), size=(32.0, 34.0), periodic=False)
    """
    if grid.periodic:
        counts = [max(4, round(count / spacing)) for count in grid.shape]
        return replace(grid, shape=(counts[0], counts[1]))
    shape = []
    for count in grid.shape:
        coarse = max(4, int(np.ceil(count / spacing - 1e-9)) + 1)
        shape.append(coarse + ((coarse - count) % 2 == parity))
    cells = [spacing * cell for cell in grid.cell_size]
    size = (shape[0] * cells[0], shape[1] * cells[1])
    return replace(grid, shape=(shape[0], shape[1]), size=size)


def march_coarser_run(
    coarser_run: CoarserRun, on_step: Callable[[], None] | None = None
) -> CoarserResult | None:
    """Solve a coarser run; None if it stops before its end.

    `on_step` is called after each step, and may stop the run by an exception.
    """
    run, states, ends, bends, spots = coarser_run.run, [], [], [], []
    peak = 0.0
    sharp = False
    try:
        for state in March(run):
            if on_step is not None:
                on_step()
            if state is None:
                continue
            states.append(state.without_fields())
            ends.append(end_pressures(run.open_gap, state.pressure))
            bends.append(_bend_growth(run, state))
            spots.append(cells_across_spots(state.pressure > 0, periodic=run.grid.periodic))
            if state.peak_pressure > 1.1 * peak:
                peak = state.peak_pressure
                sharp = sharp or _peaks_at_point(coarser_run, state)
    except (ConvergenceError, DomainError):
        return None
    return CoarserResult(
        coarser_run.spacing,
        coarser_run.step_ratio,
        history_of(states),
        np.array(ends, dtype=float).reshape(-1, 2),
        np.array(bends, dtype=float),
        coarser_run.spacing * np.array(spots, dtype=float),
        sharp,
    )


#: Scalars of a state that are used to estimate its errors.
HISTORY_NAMES = ("time", *scalars_with_error(), "cells_across")


def history_of(states: Sequence[ContactState]) -> History:
    """Scalars of states over their instants."""
    return {
        name: np.array([getattr(state, name) for state in states], float) for name in HISTORY_NAMES
    }


def _spacings(across: float) -> tuple[tuple[float, bool], ...]:
    """Ratios of cells, closer to 1 if the run has few cells across its contact."""
    coarsest = CELL_RATIOS[-1][0]
    most = min(coarsest, max(across / MIN_ACROSS, MIN_COARSENING))
    closer = (most - 1) / (coarsest - 1)
    return tuple((1 + (spacing - 1) * closer, parity) for spacing, parity in CELL_RATIOS)


def _creeps(compliance: ContactCompliance, times: NDArray[np.float64]) -> bool:
    return bool(compliance(float(times[-1])) != compliance.instant)


def _coarser_run(
    run: RunSetup, spacing: float, parity: bool, step_ratio: float, times: NDArray[np.float64]
) -> CoarserRun:
    coarse = run.on(coarser_grid(run.grid, spacing, parity))
    problem = replace(
        run.problem, grid=coarse.grid, times=times, fields="none", step_ratio=max(1.0, step_ratio)
    )
    plan = plan_history(problem, coarse.open_gap, coarse.grid)
    return CoarserRun(spacing, step_ratio, replace(coarse, problem=problem, hereditary=plan))


def _peaks_at_point(coarser_run: CoarserRun, state: ContactState) -> bool:
    """Test whether the largest pressure lies at a point that is sharp on the original cells."""
    run = coarser_run.run
    place = run.grid.largest_at(state.pressure)
    dx, dy = run.grid.cell_size
    cell = (dx / coarser_run.spacing, dy / coarser_run.spacing)
    strain = strain_of(state.peak_pressure, float(run.problem.compliance(state.time)))
    return is_sharp(run.problem.indenter, place, (1.5 * dx, 1.5 * dy), cell, strain)


def _bend_growth(run: RunSetup, state: ContactState) -> float:
    """Growth of the largest pressure that the body's bend can cause, over the mean pressure [-]."""
    peak = np.unravel_index(int(state.pressure.argmax()), state.pressure.shape)
    bend = bend_at(run.open_gap, run.grid, (int(peak[0]), int(peak[1])))
    strain = 2 * np.pi * float(run.problem.compliance(state.time)) * state.mean_pressure
    return bend / strain if strain > 0 else 0.0
