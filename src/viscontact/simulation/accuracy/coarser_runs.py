"""Coarser runs of the same problem, for error estimation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cell_borders import with_borders_at
from viscontact.bodies.loads import MixedHistory
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.contact.mirror_symmetry import is_mirrored
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.state import ContactState
from viscontact.mechanics.time_integration.fixed_steps import plan_steps, step_ends
from viscontact.simulation import accuracy, transient
from viscontact.simulation.accuracy.coarser_grids import aligned_spacing, coarser_grid
from viscontact.simulation.accuracy.coarser_ratios import (
    FEW_STEPS,
    ratios_of_cells,
    ratios_of_steps,
)
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History, ObservedStates
from viscontact.simulation.accuracy.coarser_steps import (
    fewer_times,
    first_steps,
    parts_of_first_steps,
    parts_of_shared_steps,
)
from viscontact.simulation.accuracy.moving_levels import (
    aligned_along,
    fewer_moving_times,
    whole_cell_ratios,
)
from viscontact.simulation.transient.setup import RunSetup, plan_history

if TYPE_CHECKING:
    from viscontact.simulation.accuracy.event_runs import OwnEvents

#: Mean number of steps between two times of the run from which coarser runs have all these times.
STEPS_BETWEEN = 2

#: Estimated time error of the pressure up to which it serves where the two coarser runs do not show
#: what the steps add; and the same where the load jumps, as the error of the first step behind a
#: jump may be larger, and of a moving body, whose losses depend on the steps.
SMALL_TIME_ERROR, SMALL_WITH_JUMPS = 3e-2, 3e-3

#: Relative creep within the first step of a moving body behind a jump from which this is divided.
LITTLE_CREEP = 0.1

#: Peak pressure, over the largest one, from which the error of a step at whose beginning there was
#: no contact is large: it cannot be estimated from the steps before.
LARGE_FIRST_PEAK = 0.1

#: The same of the force for the first step of a run.
LARGE_FIRST_FORCE = 0.05

#: Least number of cells across the largest contact on the coarsest grid.
MIN_ACROSS = 4.5

#: Least ratio of the coarsest grid's cells to the run's.
MIN_COARSENING = 1.6


@dataclass(frozen=True, eq=False)
class CoarserRun:
    """Setup of a coarser run."""

    spacing: float  # cell size, in cells of the original run
    divides_steps: bool  # divides steps that the coarsest run takes as the original run does
    run: RunSetup
    program_times: Floats | None = None  # of a load program: times of the run that it steps to


def plan_coarser_runs(run: RunSetup, history: History) -> Iterator[CoarserRun]:
    """Yield the coarser runs of a completed run, the cheapest first."""
    # Two are coarser in cells and in steps. Where the time error is not known to be small, a third
    # one divides the steps that these two take like the run: the first ones behind kinks and jumps
    # of the load, and all of a run of few steps.
    times, load, clocks = history["time"], run.problem.history, run.problem.surface.clocks
    own = step_ends(plan_steps(times, load, clocks=clocks))
    creeping = creeps(run.problem.surface.creep, times)
    few = len(own) < FEW_STEPS or _creeps_behind_jumps(run, own)
    divides = creeping and (few or not _has_small_time_error(run, history))
    step_ratios = ratios_of_steps(len(own))
    across = float(history["cells_across"].max(initial=0.0))
    wanted = ratios_of_cells(across if _may_have_larger_cells(run) else 0.0)
    spacings = _spacings(across, wanted, parities=_parities(run))
    if not run.problem.motion.stands and (whole := whole_cell_ratios(across)):
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
        parts = parts_of_shared_steps(own, step_ends(plan_steps(left, load, step_ratio, clocks)))
        if not run.problem.motion.stands:
            parts = np.union1d(parts, parts_of_first_steps(own, load.jumps))
        divided = _coarser_run(run, *spacing, step_ratio, np.union1d(left, parts))
        yield replace(divided, divides_steps=True)


def _has_program(run: RunSetup) -> bool:
    """Test whether a load program gives the run its instants."""
    load = run.problem.load
    return isinstance(load, MixedHistory) and load.program is not None


def _kept_times(run: RunSetup, times: Floats, step_ratio: int) -> Floats:
    """Times of a run of which about every `step_ratio`-th one is kept."""
    motion, stops = run.problem.motion, run.problem.history.stops
    if motion.stands:
        return fewer_times(times, stops, step_ratio)
    return fewer_moving_times(times, stops, motion, run.grid, step_ratio)


def _has_small_time_error(run: RunSetup, history: History) -> bool:
    """Test whether the estimated time errors are small and no contact begins within a step."""
    if run.problem.surface.creep.is_elastic and run.problem.motion.stands:
        return True
    times, peak, error = history["time"], history["peak_pressure"], history["time_error"]
    begins = (peak[1:] > LARGE_FIRST_PEAK * peak.max(initial=0.0)) & (peak[:-1] == 0)
    # The first step of a ramp from zero has no estimate, but a small load where there are many.
    force = history["force"]
    begins &= (times[:-1] > 0) | (force[1:] > LARGE_FIRST_FORCE * force.max(initial=0.0))
    jumps = not run.problem.motion.stands or run.problem.history.jumps.size > 0
    small = SMALL_WITH_JUMPS if jumps else SMALL_TIME_ERROR
    return bool(np.nanmax(error) <= small and (error[1:][begins] > 0).all())


def _creeps_behind_jumps(run: RunSetup, ends: Floats) -> bool:
    """Test whether a moving body's first step behind a jump is long against the law."""
    if run.problem.motion.stands:
        return False
    _, durations = first_steps(ends, run.problem.history.jumps)
    compliance = run.problem.compliance
    grown = compliance(durations.max()) if durations.size else compliance.instant
    return bool(grown > (1 + LITTLE_CREEP) * compliance.instant)


def _may_have_larger_cells(run: RunSetup) -> bool:
    """Test whether the coarser runs of a contact of many cells may have larger ones than others."""
    # The rims of a strip lie alike among the cells all along it, so that their errors do not
    # cancel; on layers, errors depend on the cells within their thickness as well.
    return run.grid.has_datum and not np.isfinite(run.problem.thinnest_layer)


def march_coarser_run(
    coarser_run: CoarserRun, on_step: Callable[[], None] | None = None
) -> CoarserResult | None:
    """Solve a coarser run; None if it stops before its end, as by an exception of `on_step`."""
    run, program_times = coarser_run.run, coarser_run.program_times
    observed = ObservedStates(run, coarser_run.spacing)
    events: OwnEvents | None = None

    def after_step(state: ContactState | None) -> None:
        if on_step is not None:
            on_step()
        if state is not None:
            observed.add(state)

    try:
        if program_times is not None:
            events = accuracy.own_events(run, program_times, after_step)
        else:
            for state in transient.March(run, warns=False):
                after_step(state)
    except (ConvergenceError, DomainError, transient.EventError):
        return None
    result = observed.result(divides_steps=coarser_run.divides_steps)
    return result if events is None else result.at(events.own, segment_ends=events.ends)


def _parities(run: RunSetup) -> tuple[bool, bool]:
    """Grids that keep the parity of the run's numbers of cells, the finer one first."""
    # Of a run that is symmetric on even numbers of cells only a quarter is solved: also on grids
    # that keep the parity. They all do where the body does not end, else the larger one.
    free = [axis for axis, repeats in enumerate(run.grid.periodic) if not repeats]
    if not all(is_mirrored(run.open_gap, axis) for axis in free):
        return False, True
    return True, bool(np.isfinite(run.open_gap).all())


def _spacings(
    across: float, wanted: tuple[float, float], *, parities: tuple[bool, bool]
) -> tuple[tuple[float, bool], ...]:
    """Ratios of cells, closer to 1 if the run has few cells across its contact, and parities."""
    coarsest = wanted[-1]
    most = min(coarsest, max(across / MIN_ACROSS, MIN_COARSENING))
    closer = (most - 1) / (coarsest - 1)
    ratios = (1 + (spacing - 1) * closer for spacing in wanted)
    return tuple(zip(ratios, parities, strict=True))


def creeps(compliance: ContactCompliance, times: Floats) -> bool:
    """Test whether the bodies creep within the times of a run."""
    return bool(compliance(float(times[-1])) != compliance.instant)


def _coarser_run(
    run: RunSetup, spacing: float, parity: bool, step_ratio: int, times: Floats
) -> CoarserRun:
    if (motion := run.problem.motion).stands:
        ratios = aligned_spacing(run, spacing, parity)
        grid = coarser_grid(run.grid, ratios, parity)
        coarse = run.on(with_borders_at(grid, run.problem.planes))
    else:
        ratios = spacing, spacing
        grid = coarser_grid(run.grid, ratios, parity)
        aligned = aligned_along(grid, run.grid, motion)
        coarse = run.on(with_borders_at(aligned, run.problem.planes))
    if run.law is not None:  # a run that ends where its bodies are pulled off may end earlier
        times = np.union1d(times, run.problem.end)
    problem = replace(
        run.problem, grid=coarse.grid, times=times, kept=NO_FIELDS, step_ratio=float(step_ratio)
    )
    plan, *others = plan_history(problem, coarse.open_gap, coarse.grid)
    setup = replace(coarse, problem=problem, hereditary=plan, other_terms=tuple(others))
    spacing = math.sqrt(ratios[0] * ratios[1])
    return CoarserRun(spacing, False, setup, times if _has_program(run) else None)
