"""Errors of the instants of events, and bars at these."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import methodcaller
from typing import Any, get_args

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import Condition, MixedHistory
from viscontact.mechanics.problem.problem import SHORTEST_ADHESIVE_STEP
from viscontact.mechanics.state import EventKind
from viscontact.mechanics.time_integration.load_stretches import stretch_at
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History
from viscontact.simulation.accuracy.error_models import (
    INSTANTS,
    PULL_OFF,
    PULL_OFF_READING,
)
from viscontact.simulation.accuracy.least_bars import TINY
from viscontact.simulation.accuracy.refinement_levels import DIVIDED_STEP_FACTOR, RefinementLevels
from viscontact.simulation.checks.adhesive_limits import effective_radius
from viscontact.simulation.transient.provenance import JUMP_TIME_ERRORS, event_attributes
from viscontact.simulation.transient.setup import RunSetup


def segment_end_errors(run: RunSetup, results: list[CoarserResult]) -> Floats:
    """Errors of the ends of a program's segments from coarser runs [s].

    NaN where coarser runs end them in another way; empty for other loads.
    """
    load = run.problem.load
    if not isinstance(load, MixedHistory) or load.program is None:
        return np.zeros(0)
    grids = [each for each in results if not each.divides_steps]
    own = np.array(load.times[1:])
    rows = np.stack([own, *(each.segment_ends for each in grids)])
    by_steps = np.zeros(len(own))
    for divided in (each for each in results if each.divides_steps):
        for grid in (each for each in grids if each.spacing == divided.spacing):
            apart = np.abs(grid.segment_ends - divided.segment_ends)
            by_steps = DIVIDED_STEP_FACTOR * np.nan_to_num(apart)
    spacings = (1.0, *(each.spacing for each in grids))
    levels = RefinementLevels(spacings, rows, by_steps, np.isfinite(rows).all(axis=0))
    methods = run.problem.solver_error + max(plan.error for plan in run.plans)
    methods += run.problem.surface.splitting_error + run.problem.compliance.inversion_error
    methods += run.error_of_ends
    return np.asarray(INSTANTS.of(levels) + levels.by_steps + methods * own)


def with_least_errors(
    errors: Floats, values: dict[str, Floats], run: RunSetup, history: History
) -> Floats:
    """Raise errors of the ends of segments to what the scalars of their conditions cause [s]."""
    # All grids meet a condition too early alike, as a force is too large on any cells. A segment
    # that begins late ends late.
    load, raised = run.problem.load, errors.copy()
    for event in load.events if isinstance(load, MixedHistory) else ():
        at = int(np.searchsorted(history["time"], event.time))
        if event.scalar in values and 0 < at < len(history["time"]):
            steps = (np.diff(history[each][at - 1 : at + 1])[0] for each in (event.scalar, "time"))
            change, duration = steps
            least = values[event.scalar][at] * duration / max(abs(change), TINY)
            raised[event.segment - 1] = np.fmax(errors[event.segment - 1], least)
    return np.where(np.isnan(errors), errors, np.fmax.accumulate(raised))


def pull_off_errors(run: RunSetup, results: list[CoarserResult]) -> dict[str, Any]:
    """Errors of pull-off force [N] and time, and of jumps [s], as attributes.

    NaN, or none of a kind of jumps, where coarser runs have others.
    """
    if run.law is None:
        return {}
    read = np.abs(np.mean([each.pull_off for each in results], axis=0)) * PULL_OFF_READING
    force, time = _from_grids(results, lambda each: each.pull_off) + read
    # A pull that is wrong by this may be largest wherever it is as near to its largest value.
    flat = math.sqrt(force / min(each.pull_bend for each in results))
    found: dict[str, Any] = {
        "pull_off_force_error": float(force),
        "pull_off_time_error": float(np.fmax(time, flat)),
    }
    load, end = run.problem.contact_load, run.problem.end
    errors: dict[str, list[float]] = {}
    for kind in get_args(EventKind):
        if len({len(each.times_of(kind)) for each in results}) == 1:
            times = results[0].times_of(kind)
            steps = [SHORTEST_ADHESIVE_STEP * stretch_at(load, each, end) for each in times]
            by_cells = _from_grids(results, methodcaller("times_of", kind)) + steps
            if kind == "pull_off":
                pairs = zip(times, steps, strict=True)
                by_cells += [_cell_time(run, time, step) for time, step in pairs]
            errors[kind] = by_cells.tolist()
    return found | {JUMP_TIME_ERRORS: errors}


def _cell_time(run: RunSetup, time: float, step: float) -> float:
    """Time in which a given approach passes the gap of the cells nearest to an apex [s]."""
    # Where the contact shrinks to nothing without a jump, all grids lose it as they lose a cell.
    radius = effective_radius(run.problem.indenter)
    load = run.problem.contact_load
    before, at = (load.at(each, side="left").approach for each in (time - step, time))
    if radius is None or before is None or at is None or at == before:
        return 0.0
    return run.grid.cell_area / (4 * radius) * step / abs(at - before)


def _from_grids(
    results: list[CoarserResult], values_of: Callable[[CoarserResult], Sequence[float]]
) -> Floats:
    """Errors of some values that the coarser runs have once each."""
    # The run's own values are not among them: the coarser grids tell how far it is off, too.
    grids = [each for each in results if not each.divides_steps]
    rows = np.array([values_of(each) for each in grids], dtype=float)
    by_steps = np.zeros(rows.shape[1:])
    for divided in (each for each in results if each.divides_steps):
        for grid, row in zip(grids, rows, strict=True):
            if grid.spacing == divided.spacing:
                by_steps = DIVIDED_STEP_FACTOR * np.abs(row - np.array(values_of(divided)))
    spacings = tuple(each.spacing for each in grids)
    levels = RefinementLevels(spacings, rows, by_steps, np.isfinite(rows).all(axis=0))
    return np.asarray(PULL_OFF.of(levels) + np.nan_to_num(by_steps))


def event_errors(run: RunSetup, errors: Floats) -> dict[str, str | list[float]]:
    """Errors of the instants of events as attributes, from those of the ends of segments."""
    load = run.problem.load
    if not isinstance(load, MixedHistory) or load.program is None:
        return {}
    return event_attributes(load, [float(errors[each.segment - 1]) for each in load.events])


def widen_after_events(
    values: dict[str, Floats], run: RunSetup, history: History, errors: Floats
) -> None:
    """Add the error of the instant at which a segment began, times the rate of each scalar."""
    # Coarser runs are compared at equal times after it; at it, the body may already move on.
    load, times = run.problem.load, history["time"]
    if not isinstance(load, MixedHistory):
        return
    for number, error in enumerate(np.nan_to_num(errors[:-1]), start=1):
        begin, end = load.times[number : number + 2]
        at = np.flatnonzero((times >= begin) & (times <= end))
        if len(at) < 2 or not error > 0:
            continue
        # Just before it, the next segment may have begun, of which the first step is known.
        before = np.flatnonzero((times >= begin - error) & (times < begin))
        for name in values:
            step = np.abs(history[name][at[1]] - history[name][at[0]])
            values[name][before] += np.nan_to_num(step)
            rates = np.abs(np.diff(history[name][at]) / np.diff(times[at]))
            fastest = np.fmax(np.append(rates, 0.0), np.append(0.0, rates))
            values[name][at] += error * np.nan_to_num(fastest)


def set_bars_at_events(values: dict[str, Floats], run: RunSetup, history: History) -> None:
    """Set the bars of scalars where an event gives them their value: the solver's error remains."""
    load = run.problem.load
    if not isinstance(load, MixedHistory):
        return
    for event in load.events:
        if event.scalar in values:
            at = history["time"] == event.time
            found = history[event.scalar][at]
            values[event.scalar][at] = run.problem.solver_error * np.abs(found)
            if run.law is not None:  # takes other steps than the search for the event
                values[event.scalar][at] += np.abs(
                    found - _value_at(load, event.segment, event.condition)
                )


def _value_at(load: MixedHistory, segment: int, met: str) -> float:
    """Value of a condition of a segment, from 1, by its text [SI unit of its scalar]."""
    assert load.program is not None
    own = load.program.parts[segment - 1].until
    conditions = [each for each in (own, *load.program.stop) if isinstance(each, Condition)]
    return next(each.value for each in conditions if met.endswith(str(each)))
