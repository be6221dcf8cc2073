"""Coarser runs of the same problem, for error estimation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.accuracy.coarser_grids import aligned_spacing, coarser_grid
from viscontact.accuracy.coarser_steps import (
    fewer_times,
    first_steps,
    parts_of_first_steps,
    parts_of_shared_steps,
)
from viscontact.accuracy.event_runs import OwnEvents, own_events
from viscontact.accuracy.moving_levels import (
    aligned_along,
    fewer_moving_times,
    whole_cell_ratios,
)
from viscontact.checks.mesh import cells_across_spots
from viscontact.checks.singularities import bend_at, cells_at_end, is_sharp, strain_of
from viscontact.contact.cell_fields import is_even
from viscontact.errors import ConvergenceError, DomainError
from viscontact.loads import MixedHistory
from viscontact.materials.compliance import ContactCompliance
from viscontact.results.variables import scalars_with_error
from viscontact.simulation.march import March
from viscontact.simulation.program_course import EventError
from viscontact.simulation.setup import RunSetup, plan_history
from viscontact.state import ContactState
from viscontact.time_integration.fixed_steps import plan_steps, step_ends

#: Cell sizes of the coarser runs, in cells of the run.
CELL_RATIOS = (1.5, 2.4)

#: Number of steps below which a third run estimates their errors, however small the estimated
#: time errors are: the first step behind a kink of the load has none.
FEW_STEPS = 16

#: Least number of steps of the run, and step sizes of its coarser runs, in steps of the run.
STEP_RATIOS = ((FEW_STEPS, (2, 4)), (7, (2, 2)), (0, (1, 1)))

#: Mean number of steps between two times of the run from which coarser runs have all these times.
STEPS_BETWEEN = 2

#: Estimated time error of the pressure up to which the two coarser runs show what the steps add.
SMALL_TIME_ERROR = 3e-3

#: Relative creep within the first step of a moving body behind a jump from which this is divided.
LITTLE_CREEP = 0.1

#: Peak pressure, over the largest one, from which the error of a step at whose beginning there was
#: no contact is large: it cannot be estimated from the steps before.
LARGE_FIRST_PEAK = 0.1

#: Least number of cells across the largest contact on the coarsest grid.
MIN_ACROSS = 4.5

#: Least ratio of the coarsest grid's cells to the run's.
MIN_COARSENING = 1.6

FloatArray = NDArray[np.float64]

#: Scalars over the instants of a run by name, including ``time``.
History = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class CoarserRun:
    """Setup of a coarser run."""

    spacing: float  # cell size, in cells of the original run
    divides_steps: bool  # divides steps that the coarsest run takes as the original run does
    run: RunSetup
    program_times: FloatArray | None = None  # of a load program: times of the run that it steps to


@dataclass(frozen=True, eq=False)
class CoarserResult:
    """Result of a coarser run."""

    spacing: float  # as in CoarserRun
    divides_steps: bool  # as in CoarserRun
    scalars: History
    end_pressures: NDArray[np.float64]  # over the instants, see `singularities.EndCells` [Pa]
    #: Growth of the largest pressure with the logarithm of the cells that the body's bend there can
    #: cause, over the mean pressure [-].
    bend_growth: NDArray[np.float64]
    spots: NDArray[np.float64]  # mean width of the contact spots, in cells of the original run
    peak_drops: FloatArray  # relative drop of pressure from the largest one to the cells next to it
    rises_to_ends: NDArray[np.bool_]  # pressure rises to both ends along x, y; shape (instants, 2)
    is_sharp: bool  # the largest pressure lies on a point or a ridge of the body
    #: Ends of the segments of a load program, NaN where they ended in another way than those of the
    #: run; none of other loads [s].
    segment_ends: FloatArray = field(default_factory=lambda: np.zeros(0))

    @property
    def at_end(self) -> NDArray[np.bool_]:
        """Instants at which the contact reaches the end of the body."""
        return np.asarray(self.end_pressures[:, 0] > 0)


def plan_coarser_runs(run: RunSetup, history: History) -> Iterator[CoarserRun]:
    """Yield the coarser runs of a completed run, the cheapest first.

    Two are coarser in cells and in steps. Where the time error is not known to be small, a third
    one divides the steps that these two take like the run: the first ones behind kinks and jumps of
    the load, and all of a run of few steps.
    """
    times, load = history["time"], run.problem.history
    own = step_ends(plan_steps(times, load))
    creeping = creeps(run.problem.surface.creep, times)
    few = len(own) < FEW_STEPS or _creeps_behind_jumps(run, own)
    divides = creeping and (few or not _has_small_time_error(history))
    step_ratios = _step_ratios(len(own))
    across = float(history["cells_across"].max(initial=0.0))
    spacings = _spacings(across, parities=_parities(run))
    if run.problem.motion is not None and (whole := whole_cell_ratios(across)):
        spacings = tuple((by, parity) for (by, _), (_, parity) in zip(whole, spacings, strict=True))
        step_ratios = (whole[0][1], whole[1][1])
    # Steps between two times become longer without leaving any of these out.
    leaves_out = len(own) < STEPS_BETWEEN * len(times)
    kept = (_kept_times(run, times, by) if leaves_out else times for by in step_ratios)
    levels = list(zip(spacings, step_ratios, kept, strict=True))
    for spacing, step_ratio, left in reversed(levels):
        yield _coarser_run(run, *spacing, step_ratio, left)
    if divides:
        spacing, step_ratio, left = levels[-1]
        parts = parts_of_shared_steps(own, step_ends(plan_steps(left, load, step_ratio)))
        if run.problem.motion is not None:
            parts = np.union1d(parts, parts_of_first_steps(own, load.jumps))
        divided = _coarser_run(run, *spacing, step_ratio, np.union1d(left, parts))
        yield replace(divided, divides_steps=True)


def _kept_times(run: RunSetup, times: FloatArray, step_ratio: int) -> FloatArray:
    """Times of a run of which about every `step_ratio`-th one is kept."""
    motion, stops = run.problem.motion, run.problem.history.stops
    if motion is None:
        return fewer_times(times, stops, step_ratio)
    return fewer_moving_times(times, stops, motion, run.grid, step_ratio)


def _has_small_time_error(history: History) -> bool:
    """Test whether the estimated time errors are small; there is none at the first touch."""
    peak, error = history["peak_pressure"], history["time_error"]
    begins = (peak[1:] > LARGE_FIRST_PEAK * peak.max(initial=0.0)) & (peak[:-1] == 0)
    return bool(np.nanmax(error) <= SMALL_TIME_ERROR and (error[1:][begins] > 0).all())


def _creeps_behind_jumps(run: RunSetup, ends: FloatArray) -> bool:
    """Test whether a moving body's first step behind a jump is long against the law."""
    if run.problem.motion is None:
        return False
    _, durations = first_steps(ends, run.problem.history.jumps)
    compliance = run.problem.compliance
    grown = compliance(durations.max()) if durations.size else compliance.instant
    return bool(grown > (1 + LITTLE_CREEP) * compliance.instant)


def usual_coarsening(steps: int) -> tuple[tuple[float, int], ...]:
    """Ratios of cells and of steps of the coarser runs of a run with a number of steps.

    Examples
    --------
    >>> usual_coarsening(60)
    ((1.5, 2), (2.4, 4))
    >>> usual_coarsening(7), usual_coarsening(6)
    (((1.5, 2), (2.4, 2)), ((1.5, 1), (2.4, 1)))
    """
    step_ratios = _step_ratios(steps)
    return tuple(
        (spacing, step_ratio) for spacing, step_ratio in zip(CELL_RATIOS, step_ratios, strict=True)
    )


def _step_ratios(steps: int) -> tuple[int, int]:
    return next(step_ratios for least, step_ratios in STEP_RATIOS if steps >= least)


def march_coarser_run(
    coarser_run: CoarserRun, on_step: Callable[[], None] | None = None
) -> CoarserResult | None:
    """Solve a coarser run; None if it stops before its end.

    `on_step` is called after each step, and may stop the run by an exception.
    """
    states, ends, bends, spots, drops = [], [], [], [], []
    rises: list[tuple[bool, bool]] = []
    peak = 0.0
    sharp = False
    events: OwnEvents | None = None
    try:
        coarser_run, events = _with_own_events(coarser_run)
        run = coarser_run.run
        at_end = cells_at_end(run.open_gap)
        for state in March(run, warns=False):
            if on_step is not None:
                on_step()
            if state is None:
                continue
            if events is not None:
                state = replace(state, time=events.instant_of(state.time))
                if math.isnan(state.time):
                    continue
            states.append(state.without_fields())
            ends.append(at_end.pressures(state.pressure))
            bends.append(_bend_growth(run, state))
            spots.append(cells_across_spots(state.pressure > 0, periodic=run.grid.periodic))
            drops.append(_drop_beside_peak(state.pressure))
            rises.append((_rises_to_ends(state.pressure), _rises_to_ends(state.pressure.T)))
            if state.peak_pressure > 1.1 * peak:
                peak = state.peak_pressure
                sharp = sharp or _peaks_at_point(coarser_run, state)
    except (ConvergenceError, DomainError, EventError):
        return None
    return CoarserResult(
        coarser_run.spacing,
        coarser_run.divides_steps,
        history_of(states),
        np.array(ends, dtype=float).reshape(-1, 2),
        np.array(bends, dtype=float),
        coarser_run.spacing * np.array(spots, dtype=float),
        np.array(drops, dtype=float),
        np.array(rises, dtype=bool).reshape(-1, 2),
        sharp,
        np.zeros(0) if events is None else events.ends,
    )


def _with_own_events(coarser_run: CoarserRun) -> tuple[CoarserRun, OwnEvents | None]:
    """A coarser run of a load program under the history that it has on its own cells and steps."""
    times, run = coarser_run.program_times, coarser_run.run
    if times is None:
        return coarser_run, None
    events = own_events(run, times)
    problem = replace(run.problem, load=events.load, times=events.times)
    plan, *others = plan_history(problem, run.open_gap, run.grid)
    run = replace(run, problem=problem, hereditary=plan, other_terms=tuple(others))
    return replace(coarser_run, run=run), events


def history_of(states: Sequence[ContactState]) -> History:
    """Scalars of states that are used to estimate their errors, over their instants."""
    scalars = scalars_with_error(moving=bool(states) and states[0].moving)
    names = ("time", *scalars, "cells_across", "time_error")
    return {name: np.array([getattr(state, name) for state in states], float) for name in names}


def _parities(run: RunSetup) -> tuple[bool, bool]:
    """Grids that keep the parity of the run's numbers of cells, the finer one first.

    Of a run that is symmetric on even numbers of cells only a quarter is solved: also on grids that
    keep the parity. They all do where the body does not end, else the larger one.
    """
    free = [axis for axis, repeats in enumerate(run.grid.periodic) if not repeats]
    if not all(is_even(run.open_gap, axis) for axis in free):
        return False, True
    return True, bool(np.isfinite(run.open_gap).all())


def _spacings(across: float, *, parities: tuple[bool, bool]) -> tuple[tuple[float, bool], ...]:
    """Ratios of cells, closer to 1 if the run has few cells across its contact, and parities."""
    coarsest = CELL_RATIOS[-1]
    most = min(coarsest, max(across / MIN_ACROSS, MIN_COARSENING))
    closer = (most - 1) / (coarsest - 1)
    ratios = (1 + (spacing - 1) * closer for spacing in CELL_RATIOS)
    return tuple(zip(ratios, parities, strict=True))


def creeps(compliance: ContactCompliance, times: FloatArray) -> bool:
    """Test whether the bodies creep within the times of a run."""
    return bool(compliance(float(times[-1])) != compliance.instant)


def _coarser_run(
    run: RunSetup, spacing: float, parity: bool, step_ratio: int, times: FloatArray
) -> CoarserRun:
    if (motion := run.problem.motion) is None:
        ratios = aligned_spacing(run, spacing, parity)
        coarse = run.on(coarser_grid(run.grid, ratios, parity))
    else:
        ratios = spacing, spacing
        grid = coarser_grid(run.grid, ratios, parity)
        coarse = run.on(aligned_along(grid, run.grid, motion))
    problem = replace(
        run.problem, grid=coarse.grid, times=times, fields="none", step_ratio=float(step_ratio)
    )
    plan, *others = plan_history(problem, coarse.open_gap, coarse.grid)
    setup = replace(coarse, problem=problem, hereditary=plan, other_terms=tuple(others))
    spacing = math.sqrt(ratios[0] * ratios[1])
    load = problem.load
    has_program = isinstance(load, MixedHistory) and load.program is not None
    return CoarserRun(spacing, False, setup, times if has_program else None)


def _drop_beside_peak(pressure: FloatArray) -> float:
    """Largest relative drop from the largest pressure to the neighbouring cells in contact."""
    i, j = np.unravel_index(int(pressure.argmax()), pressure.shape)
    around = pressure[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2]
    peak = float(pressure[i, j])
    return float(1 - around.min(where=around > 0, initial=peak) / peak) if peak > 0 else 0.0


def _rises_to_ends(pressure: FloatArray) -> bool:
    """Test whether the largest pressures across the first axis rise to both ends of the contact."""
    lines = pressure.max(axis=1)
    pressed = lines[lines > 0]
    return len(pressed) > 1 and bool(pressed[0] >= pressed[1] and pressed[-1] >= pressed[-2])


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
