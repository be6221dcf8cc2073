"""Provenance of a result: the problem, versions and methods as plain data."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from datetime import datetime, timedelta
from typing import Any

import numpy as np

from viscontact import __version__
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import MixedHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactEvent
from viscontact.results.descriptions import describe
from viscontact.simulation.transient.contact_events import PULL_OFF_MARGIN
from viscontact.simulation.transient.setup import RunSetup
from viscontact.units.formatting import format_quantity


def date_and_time(ago: float = 0.0) -> str:
    """Return date and local time some seconds ago, with the offset from UTC, as in ISO 8601."""
    moment = datetime.now().astimezone() - timedelta(seconds=ago)
    return moment.isoformat(timespec="seconds")


#: Errors of the times of jumps, which the attributes of events take over [s].
JUMP_TIME_ERRORS = "jump_time_errors"


def run_attributes(run: RunSetup) -> dict[str, Any]:
    """Return the attributes that every result of a run carries."""
    load = run.problem.load
    events = event_attributes(load) if isinstance(load, MixedHistory) else {}
    return {
        "Conventions": "CF-1.11",
        "source": f"viscontact {__version__}",
        "version": __version__,
        "case": json.dumps(describe_problem(run.problem, run.grid)),
        "tolerance": run.problem.tolerance,
        "transforms": run.transforms,
        "inner_loops": run.inner_loops,
        "memory": run.hereditary.method,
        "memory_error": max(plan.error for plan in run.plans),
        "splitting_error": run.problem.surface.splitting_error,
        "inversion_error": run.problem.compliance.inversion_error,
        **({"ends_error": run.ends_error} if run.problem.ended_bodies else {}),
        **events,
    }


def event_attributes(
    load: MixedHistory, errors: Sequence[float] | None = None
) -> dict[str, str | list[float]]:
    """Return what ended the segments of a load program, and when: text, instants, errors [s]."""
    events = load.events
    stated = [math.nan] * len(events) if errors is None else list(errors)
    lines = [
        f"{format_quantity(event.time, 's', 6)}: {event.condition}"
        + (f" (± {format_quantity(error, 's', 2)})" if math.isfinite(error) else "")
        for event, error in zip(events, stated, strict=True)
    ]
    return {
        "events": "\n".join(lines),
        "event_times": [event.time for event in events],
        "event_time_errors": stated,
    }


def contact_event_attributes(
    events: Sequence[ContactEvent], described: Mapping[str, Any]
) -> dict[str, Any]:
    """Return where bodies that adhere came into contact and lost it, and the largest pull.

    `described` are the attributes of the run, with the events of a load program if it has one.
    """
    pulls = [event for event in events if event.kind == "pull_off"]
    largest = max(pulls, key=lambda event: event.pull, default=None)
    unknown = (math.nan, math.nan)
    program = zip(
        described.get("event_times", ()),
        described.get("event_time_errors", ()),
        str(described.get("events", "")).splitlines(),
        strict=True,
    )
    rows = [(time, error, line, "condition", unknown, unknown) for time, error, line in program]
    ends = [(time, error) for time, error, *_ in rows]
    for event, error in zip(events, _jump_errors(events, described), strict=True):
        stated = _with_segments(event.time, error, ends)
        row = (event.time, stated, _event_line(event), event.kind, event.force, event.approach)
        rows.append(row)
    rows.sort(key=lambda row: row[0])
    pull_time = math.nan if largest is None else largest.pull_time
    pull_error = described.get("pull_off_time_error", math.nan)
    return {
        "events": "\n".join(row[2] for row in rows),
        "event_times": [row[0] for row in rows],
        "event_time_errors": [row[1] for row in rows],
        "event_kind": "\n".join(row[3] for row in rows),
        "event_force": [force for row in rows for force in row[4]],
        "event_approach": [approach for row in rows for approach in row[5]],
        "pull_off_force": math.nan if largest is None else largest.pull,
        "pull_off_force_error": described.get("pull_off_force_error", math.nan),
        "pull_off_time": pull_time,
        "pull_off_time_error": _with_segments(pull_time, pull_error, ends),
    }


def _jump_errors(events: Sequence[ContactEvent], described: Mapping[str, Any]) -> list[float]:
    """Errors of jumps from coarser runs [s]; NaN where these have other numbers of a kind."""
    kinds, stated = [event.kind for event in events], dict(described.get(JUMP_TIME_ERRORS, ()))
    left = {kind: iter(found) for kind, found in stated.items() if len(found) == kinds.count(kind)}
    return [next(left[kind]) if kind in left else math.nan for kind in kinds]


def _with_segments(time: float, error: float, ends: Sequence[tuple[float, float]]) -> float:
    """Error of an instant [s], with those of the ends of segments, by their times, until then."""
    # A segment that begins late makes all in it late; a pull-off may end its segment.
    earlier = [found for end, found in ends if end <= time]
    ended = [found for end, found in ends if time <= end <= (1 + PULL_OFF_MARGIN) * time]
    known = np.fmax.reduce([error, *ended])
    return float(np.fmax.reduce([known, *earlier])) if math.isfinite(known) else math.nan


def _event_line(event: ContactEvent) -> str:
    """Describe an event in words."""
    before, after = (format_quantity(force, "N", 4) for force in event.force)
    instant = format_quantity(event.time, "s", 6)
    if event.kind == "jump_in":
        return f"{instant}: the bodies come into contact, force {before} before and {after} after"
    pull = format_quantity(event.pull, "N", 4)
    forces = f"force {before} before and {after} after"
    return f"{instant}: contact is lost, {forces}; pull-off force {pull}"


def describe_problem(problem: Problem, grid: Grid | None) -> dict[str, Any]:
    """Describe a contact problem, solved on a grid, as plain data."""
    heat = {} if problem.temperature is None else {"temperature": describe(problem.temperature)}
    grip = {
        name: describe(given)
        for name, given in (
            *(("friction", problem.friction), ("tangential", problem.tangential)),
            ("adhesion", problem.adhesion),
        )
        if given is not None
    }
    motion = {} if problem.motion.stands else {"motion": describe(problem.motion)}
    return {
        "indenter": describe(problem.indenter),
        "material": describe(problem.material),
        "indenter_material": describe(problem.indenter_material),
        "load": describe(problem.load),
        **motion,
        **heat,
        **grip,
        "grid": describe(grid),
        "automatic": describe(problem.automatic_grid),
        "times": describe(problem.instants),
        "adaptive": describe(problem.adaptive),
        "tolerance": problem.tolerance,
    }
