"""Solution of an analysis in this process, and its result."""

from __future__ import annotations

import time as clock
import warnings
from collections.abc import Sequence
from typing import Any

import xarray as xr

from viscontact.backend.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.mechanics.state import ContactState
from viscontact.results.dataset import to_dataset
from viscontact.runs.analysis import Analysis
from viscontact.simulation.accuracy.coarser_results import history_of
from viscontact.simulation.accuracy.error_bars import ErrorBars
from viscontact.simulation.transient.provenance import JUMP_TIME_ERRORS, date_and_time
from viscontact.simulation.transient.state_generator import Progress

#: Frames between a warning and the caller of `simulate` or `steady`.
_CALLER = 3


def solve(run: Analysis[Any, Any], progress: Progress | None = None) -> xr.Dataset:
    """Compute the states and errors of a run as a data set."""
    # ConvergenceError and DomainError of its states carry the result so far as `partial`.
    started = clock.perf_counter()
    loop, states = run.states(), list[ContactState]()
    try:
        for state in loop:
            if state is None:
                continue
            for text in state.warnings:
                warnings.warn(text, AccuracyWarning, stacklevel=_CALLER)
            if progress is not None:
                progress(state, loop.done, loop.done + loop.left)
            found = run.leaking(state)
            states.append(found.with_own_fields() if run.keeps(state) else found.without_fields())
    except (ConvergenceError, DomainError) as stop:
        if states:
            bars = run.error_bars_so_far(loop, history_of(states)) if run.errors else None
            stop.partial = labelled(run, states, clock.perf_counter() - started, bars)
        raise
    bars = _bars(run, loop, states) if run.errors else None
    return labelled(run, states, clock.perf_counter() - started, bars)


def _bars(run: Analysis[Any, Any], loop: Any, states: Sequence[ContactState]) -> ErrorBars:
    issued = [text for state in states for text in state.warnings]
    bars = run.error_bars(loop, history_of(states), states[-1].grid, issued)
    for text in bars.warnings:
        warnings.warn(text, AccuracyWarning, stacklevel=_CALLER + 1)
    return bars


def labelled(
    run: Analysis[Any, Any],
    states: Sequence[ContactState],
    wall_time: float,
    bars: ErrorBars | None = None,
) -> xr.Dataset:
    """Return the states of a run, at least one, as a result; `wall_time` in seconds."""
    run = run.after(states)
    warned = [text for state in states for text in state.warnings]
    warned += bars.warnings if bars is not None else ()
    stated = {} if bars is None else dict(bars.attributes)
    attributes = {
        **run.attributes,
        **run.fluid_attributes,
        "started": date_and_time(wall_time),
        "wall_time": wall_time,
        "warnings": "\n".join(warned),
        **stated,
        **run.attributes_after(states, stated),
    }
    attributes.pop(JUMP_TIME_ERRORS, None)  # the events have them
    recorded = [run.recorded_state(state) for state in states]
    errors = None if bars is None else bars.values
    return to_dataset(recorded, run.field_axis(states), attributes, errors)
