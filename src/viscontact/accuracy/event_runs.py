"""Coarser runs of a load program, whose events have instants of their own.

A coarser run carries the program out on its own cells and steps. Its states are compared with those
of the run at equal times after the event before, and at the event itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.loads import MixedHistory
from viscontact.simulation.load_events import EventSearch
from viscontact.simulation.program_course import ProgramCourse
from viscontact.simulation.setup import RunSetup
from viscontact.time_integration.fixed_steps import KINK_TOLERANCE

Array = NDArray[np.float64]

#: Longest duration of a segment of a coarser run that ends on a condition, over that of the run.
LONGEST = 2.0


@dataclass(frozen=True, eq=False)
class OwnEvents:
    """History of a coarser run of a program, and what its instants are compared with."""

    load: MixedHistory
    times: Array  # ends of the steps of the coarser run [s]
    own: Array  # instants of the run that they are compared with, NaN where there is none [s]
    ends: Array  # ends of the segments in the coarser run, NaN where they ended in another way [s]

    def instant_of(self, time: float) -> float:
        """Instant of the run that one of the coarser run is compared with; NaN without one [s]."""
        return float(self.own[np.abs(self.times - time).argmin()])


def own_events(coarse: RunSetup, times: Array) -> OwnEvents:
    """Carry the program of a run out on coarser cells, in steps to some of the run's times.

    ValueError if a condition is not met; ConvergenceError, DomainError as in `march`.
    """
    own = coarse.problem.load
    assert isinstance(own, MixedHistory)
    assert own.program is not None
    shared = [_times_within(own, number, times) for number in range(len(own.controls))]

    def step_ends(number: int, begin: float, end: float) -> Array:
        after = shared[number] - own.times[number]
        step = float(np.median(np.diff(after, prepend=0.0))) if after.size else end - begin
        beyond = np.arange(begin + after.max(initial=0.0) + step, end, step)
        return np.concatenate([begin + after, beyond])

    lengths = [
        float(length) * (LONGEST if ended_by else 1.0)
        for length, ended_by in zip(np.diff(own.times), own.ended_by, strict=True)
    ]
    course = ProgramCourse(own.program, sum(lengths), lengths)
    search = EventSearch(replace(coarse.problem, grid=coarse.grid), course, step_ends)
    load = search.carry_out()
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
    return OwnEvents(load, taken, compared, ends)


def _times_within(own: MixedHistory, number: int, times: Array) -> Array:
    """Times within a segment, with its end if its duration ended it [s]."""
    begin, end = own.times[number : number + 2]
    inside = times[(times > begin) & (times < end)]
    return inside if own.ended_by[number] else np.append(inside, end)
