"""Errors of the instants of events, and bars at these."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import MixedHistory
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History
from viscontact.simulation.accuracy.error_models import ERROR_MODELS
from viscontact.simulation.accuracy.refinement_levels import DIVIDED_STEP_FACTOR, RefinementLevels
from viscontact.simulation.transient.provenance import event_attributes
from viscontact.simulation.transient.setup import RunSetup


def event_errors(run: RunSetup, results: list[CoarserResult]) -> dict[str, str | list[float]]:
    """Errors of the instants of events from coarser runs, as attributes, modelled as approach."""
    load = run.problem.load
    if not isinstance(load, MixedHistory) or load.program is None:
        return {}
    grids = [each for each in results if not each.divides_steps]
    own = np.array(load.times[1:])
    rows = np.stack([own, *(each.segment_ends for each in grids)])
    by_steps = np.zeros(len(own))
    for divided in (each for each in results if each.divides_steps):
        for grid in (each for each in grids if each.spacing == divided.spacing):
            apart = np.abs(grid.segment_ends - divided.segment_ends)
            by_steps = DIVIDED_STEP_FACTOR * np.nan_to_num(apart)
    levels = RefinementLevels((1.0, *(each.spacing for each in grids)), rows, by_steps)
    methods = run.problem.solver_error + max(plan.error for plan in run.plans)
    methods += run.problem.surface.splitting_error + run.problem.compliance.inversion_error
    errors = ERROR_MODELS["approach"].of(levels) + levels.by_steps + methods * own
    return event_attributes(load, [float(errors[each.segment - 1]) for each in load.events])


def set_bars_at_events(values: dict[str, Floats], run: RunSetup, history: History) -> None:
    """Set the bars of scalars where an event gives them their value: the solver's error remains."""
    load = run.problem.load
    for event in load.events if isinstance(load, MixedHistory) else ():
        if event.scalar in values:
            at = history["time"] == event.time
            given = np.abs(history[event.scalar][at])
            values[event.scalar][at] = run.problem.solver_error * given
