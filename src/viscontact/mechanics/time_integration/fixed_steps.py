"""Time steps of a run at requested times, with the load's kinks and jumps among them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.clock import Clock
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.units.formatting import format_quantity

#: Relative difference below which a time counts as a kink of the load.
KINK_TOLERANCE = 1e-9

#: Shortest step over the end of the run. Prony series have terms in every decade between them.
MIN_STEP_OF_END = 1e-30

#: Upper limit on the number of steps; a longer list takes more memory than the fields.
MAX_STEPS = 1_000_000


@dataclass(frozen=True)
class TimeStep:
    """One time step."""

    time: float  # end of the step [s]
    duration: float  # 0 for a jump [s]
    requested: float | None  # requested time that it ends at [s], None for an inner step
    smooth: bool  # False for the first step after a kink, jump or touch of the load
    before_jump: bool = False  # the load jumps right after the step
    is_shortest: bool = False  # no shorter step is possible

    @property
    def is_jump(self) -> bool:
        """True if the load jumps in this step."""
        return self.duration == 0

    @property
    def side(self) -> str:
        """Side of the step's end on which the load is read."""
        return "left" if self.before_jump else "right"

    def duration_on(self, clock: Clock) -> float:
        """Duration of the step on a clock [s]."""
        # Several memories and the estimate of the error ask for it, and it is an integral.
        if clock not in self._durations_on:
            self._durations_on[clock] = clock.passed(self.time, self.duration)
        return self._durations_on[clock]

    @cached_property
    def _durations_on(self) -> dict[Clock, float]:
        return {}


def plan_steps(
    times: Floats,
    load: LoadHistory,
    step_ratio: float = 1.0,
    clocks: Sequence[Clock] = (),
) -> tuple[TimeStep, ...]:
    """Plan steps to requested times [s] and, before the last, to kinks, jumps and touches.

    A time that differs from a kink by rounding is taken as the kink. Steps longer than `step_ratio`
    times what the load and the clocks of the materials allow are divided.
    """
    stops = np.unique(np.concatenate([load.stops, *(clock.kinks for clock in clocks)]))
    wanted = _requested_ends(times, stops)
    for divided in [
        *_divisions(sorted({0.0, *wanted}), load, step_ratio * load.longest_step),
        *_divisions_on(clocks, sorted({0.0, *wanted}), step_ratio),
    ]:
        wanted[divided] = None
    wanted = dict(sorted(wanted.items()))
    _refuse_endless_span(list(wanted))
    return tuple(_steps(wanted, load, {jump for each in clocks for jump in each.jumps.tolist()}))


def step_ends(steps: Iterable[TimeStep]) -> Floats:
    """Ends of steps, a jump's twice [s]."""
    return np.array([step.time for step in steps])


class FixedSteps:
    """Planned steps, taken one after the other."""

    def __init__(self, steps: tuple[TimeStep, ...]) -> None:
        self._steps = steps
        requested = [step.requested is not None for step in steps]
        #: Number of requested times among the first steps.
        self._requested_counts = list(itertools.accumulate(requested, initial=0))
        self._taken = 0

    @property
    def left(self) -> int:
        """Number of requested times that remain."""
        return self._requested_counts[-1] - self._requested_counts[self._taken]

    def next_step(self) -> TimeStep | None:
        """Next step; None at the end."""
        return self._steps[self._taken] if self._taken < len(self._steps) else None

    def accept_step(self, error: float, change: float = 0.0) -> bool:
        """Accept the step; prescribed steps are always accepted."""
        del error, change
        self._taken += 1
        return True

    def restart_data(self) -> RestartData:
        """Restart data: the number of steps taken."""
        return {"taken": self._taken}

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same steps."""
        self._taken = restart_data["taken"]


def _requested_ends(times: Floats, stops: Floats) -> dict[float, float | None]:
    """Ends of steps, also at the stops, each with the requested time there, or None."""
    wanted: dict[float, float | None] = {}
    for time, stop in zip(times.tolist(), _snapped_to_kinks(times, stops).tolist(), strict=True):
        wanted[time if stop in wanted else stop] = time
    last = max(wanted)
    for stop in stops[stops <= last].tolist():
        wanted.setdefault(stop, None)
    return wanted


def _divisions_on(
    clocks: Sequence[Clock], instants: list[float], step_ratio: float
) -> Iterator[float]:
    """Times that divide intervals over which the rate of a clock changes much."""
    for clock in clocks:
        for begin, end in itertools.pairwise(instants):
            yield from clock.divisions(begin, end, step_ratio).tolist()


def _refuse_endless_span(instants: list[float]) -> None:
    """Refuse steps that range over more decades than a law can be evaluated for."""
    steps = np.diff(np.append(0.0, instants))
    shortest = float(steps.min(initial=np.inf, where=steps > 0))
    if shortest < MIN_STEP_OF_END * instants[-1]:
        raise ValueError(
            f"time: steps from {format_quantity(shortest, 's', 3)} to the end at "
            f"{format_quantity(instants[-1], 's', 3)} range over too many decades, at most "
            f"{-math.log10(MIN_STEP_OF_END):.0f}; begin later or end earlier"
        )


def _divisions(instants: list[float], load: LoadHistory, longest_step: float) -> Iterator[float]:
    """Times that divide intervals longer than the load allows, while it moves."""
    if math.isinf(longest_step):
        return
    cycle_steps = min(instants[-1], load.curved_until) / longest_step
    if cycle_steps > MAX_STEPS:
        raise ValueError(
            f"load: takes {cycle_steps:.3g} steps of {format_quantity(longest_step, 's', 3)} for "
            f"its cycles, and {MAX_STEPS} at most can be taken; give fewer cycles, or end the run "
            "earlier"
        )
    for begin, end in itertools.pairwise(instants):
        if end > load.curved_until:
            return
        parts = math.ceil((end - begin) / longest_step * (1 - KINK_TOLERANCE))
        yield from np.linspace(begin, end, parts + 1)[1:-1].tolist()


def _steps(
    wanted: dict[float, float | None], load: LoadHistory, turns: set[float]
) -> Iterator[TimeStep]:
    """Steps to these times, the first a jump at time 0, of size zero under a gradual start."""
    # Where bodies come to touch, the pressure has a kink; where a clock jumps, its rate.
    kinks, jumps = {*load.kinks.tolist(), *load.touches.tolist()} | turns, set(load.jumps.tolist())
    begin = 0.0
    yield TimeStep(0.0, 0.0, wanted.get(0.0), smooth=False)
    for instant, requested in wanted.items():
        if instant == 0:
            continue
        smooth = begin not in kinks and begin > 0
        yield from _up_to(instant, instant - begin, requested, smooth, jumping=instant in jumps)
        begin = instant


def _up_to(
    instant: float, duration: float, requested: float | None, smooth: bool, *, jumping: bool
) -> Iterator[TimeStep]:
    """Step to a time, and the jump there."""
    yield TimeStep(instant, duration, None if jumping else requested, smooth, before_jump=jumping)
    if jumping:
        yield TimeStep(instant, 0.0, requested, smooth=False)


def snap_to_kink(time: float, kinks: Floats) -> float:
    """Kink that a time differs from by rounding only, else the time [s]."""
    return float(_snapped_to_kinks(np.array([time]), kinks)[0])


def _snapped_to_kinks(times: Floats, kinks: Floats) -> Floats:
    """For each time the kink that it differs from by rounding only, else itself [s]."""
    after = np.clip(np.searchsorted(kinks, times), 0, len(kinks) - 1)
    before = np.maximum(after - 1, 0)
    nearer = np.abs(kinks[before] - times) <= np.abs(kinks[after] - times)
    nearest = np.where(nearer, kinks[before], kinks[after])
    same = np.abs(nearest - times) <= KINK_TOLERANCE * np.maximum(nearest, times)
    return np.where(same, nearest, times)
