"""Coarser runs of a load program, whose events have instants of their own.

A coarser run carries the program out on its own cells and steps. The states on the way, found by
the search for the events, are compared with those of the run at equal times after the event before,
and at the event itself.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.loads import MixedHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactState
from viscontact.mechanics.time_integration.fixed_steps import KINK_TOLERANCE
from viscontact.simulation.checks.adhesion import LEAST_CELLS, cells_across_zone
from viscontact.simulation.transient.event_search import EventSearch
from viscontact.simulation.transient.segments_so_far import ProgramCourse
from viscontact.simulation.transient.setup import RunSetup

#: Longest duration of a segment of a coarser run that ends on a condition, over that of the run.
LONGEST = 2.0

#: Error of the instants of its events, as a part of the step: the events of two grids are farther
#: apart.
EVENT_TOLERANCE = 1e-5


@dataclass(frozen=True, eq=False)
class OwnEvents:
    """Instants of a coarser run of a program, and what they are compared with."""

    own: Floats  # instants of the run that its states are compared with, NaN where none is [s]
    ends: Floats  # ends of the segments in the coarser run, NaN where they ended in another way [s]


def own_events(
    coarse: RunSetup, times: Floats, on_state: Callable[[ContactState], None]
) -> OwnEvents:
    """Carry the program of a run out on coarser cells, in steps to some of the run's times."""
    # `on_state` is called with the state at the end of each step. EventError if a condition is not
    # met; ConvergenceError, DomainError as in `march`.
    own = coarse.problem.load
    assert isinstance(own, MixedHistory)
    assert own.program is not None
    shared = [_times_within(own, number, times) for number in range(len(own.controls))]

    def step_ends(number: int, begin: float, end: float) -> Floats:
        after = shared[number] - own.times[number]
        step = float(np.median(np.diff(after, prepend=0.0))) if after.size else end - begin
        beyond = np.arange(begin + after.max(initial=0.0) + step, end, step)
        return np.concatenate([begin + after, beyond])

    lengths = [
        float(length) * (LONGEST if ended_by else 1.0)
        for length, ended_by in zip(np.diff(own.times), own.ended_by, strict=True)
    ]
    problem = _with_the_same_range(coarse)
    adheres = problem.adhesion is not None
    course = ProgramCourse(own.program, sum(lengths), lengths, may_pull=adheres)
    search = EventSearch(
        problem, course, step_ends, event_tolerance=EVENT_TOLERANCE, on_state=on_state
    )
    load = search.carry_out()
    search.refuse_coarse_mesh()
    taken = np.array([state.time for state in search.states])
    ends = np.full(len(own.controls), np.nan)
    compared = np.full(len(taken), np.nan)
    compared[0] = 0.0
    for number, within in enumerate(shared[: len(load.controls)]):
        begin, end = load.times[number : number + 2]
        for instant in within.tolist():
            then = begin + (instant - own.times[number])
            if then < end * (1 - KINK_TOLERANCE):
                compared[np.abs(taken - then).argmin()] = instant
        if own.ended_by[number] != load.ended_by[number]:
            break
        compared[np.abs(taken - end).argmin()] = own.times[number + 1]
        ends[number] = end
    return OwnEvents(compared, ends)


def _with_the_same_range(coarse: RunSetup) -> Problem:
    """Problem of a coarser run, whose range was found for the run's cells; DomainError if short."""
    problem, law = replace(coarse.problem, grid=coarse.grid), coarse.law
    if problem.adhesion is None or law is None:
        return problem
    if cells_across_zone(law, problem, coarse.grid) < LEAST_CELLS:
        raise DomainError("grid: the cells of a coarser run are too large for the cohesive zone")
    kind = problem.adhesion.law
    return replace(problem, adhesion=Adhesion(law.work, strength=law.strength, law=kind))


def _times_within(own: MixedHistory, number: int, times: Floats) -> Floats:
    """Times within a segment, with its end if its duration ended it [s]."""
    begin, end = own.times[number : number + 2]
    inside = times[(times > begin) & (times < end)]
    return inside if own.ended_by[number] else np.append(inside, end)
