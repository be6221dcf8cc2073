"""Adaptive time steps: short where the load moves, growing under creep.

An elementary step size controller (Hairer, Norsett & Wanner, Solving Ordinary Differential
Equations I, section II.4): the next duration is the last one times SAFETY_FACTOR (allowed
error/error)^(1/ERROR_ORDER), with the factor kept between MIN_FACTOR and MAX_FACTOR. A step with
too large an error is repeated with a shorter duration. Kinks and jumps of the load, and requested
times, end a step; the first one after a kink has a duration of its own.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.clock import Clock
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.time_integration.fixed_steps import TimeStep, snap_to_kink
from viscontact.mechanics.time_integration.load_stretches import stretch_at
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_error import ISOLATED_STEP_SHARE

#: Part of the tolerance that one step may add, as the errors of steps accumulate.
STEP_TOLERANCE_SHARE = 0.2

#: Safety factor of the controller, and power of the duration that a step's error falls with.
SAFETY_FACTOR, ERROR_ORDER = 0.7, 3.0

#: Safety factor where the change of the force limits a step, which is foreseen better than an
#: error.
CHANGE_SAFETY_FACTOR = 0.85

#: Smallest and largest factor from one duration to the next; the largest one where the change of
#: the force alone limits steps, which are very short after a jump.
MIN_FACTOR, MAX_FACTOR, MAX_FACTOR_OF_CHANGE = 0.2, 2.0, 4.0

#: Shortest step, as a part of the run.
MIN_STEP_FRACTION = 1e-12

#: Part of the way to a time at which no near state was found that a step takes, and the length of a
#: step over that way from which on a state is looked for there again.
PART_OF_WAY, LOOKED_AGAIN = 0.5, 1.5

#: Change in a step, over the largest one, from which on the force begins to change within it.
BEYOND = 2.0
#: Longest first step after a kink, as a part of the interval to the next kink.
FIRST_STEP_FRACTION = 0.02

#: Part of a step in which a jump is tried again, and least part of the shortest one of a jump.
SOONER, LEAST_JUMP = 0.3, 0.01


class AdaptiveSteps:
    """Controller that chooses each step by the error of the last one."""

    # `stops` are times to be hit, in addition to the load's kinks and the end; `marks` are times at
    # which longer steps end, increasing: those at which a moving body has passed whole cells [s].
    # Over a step the rates of the clocks change little. States are requested at the end of each
    # step, or at the `shown` times only [s]. The shortest step is a part of the run, or the part
    # `jumps_in` of the stretch of the load that it lies in: a jump of the contact takes one. Up to
    # `stretched` proposed steps to a stop are one.

    def __init__(  # noqa: PLR0913
        self,
        request: AdaptiveTimes,
        stops: Floats,
        load: LoadHistory,
        compliance: ContactCompliance,
        marks: Floats | None = None,
        clocks: Sequence[Clock] = (),
        *,
        shown: Floats | None = None,
        jumps_in: float | None = None,
        stretched: float = 1.0,
    ) -> None:
        self._marks = np.empty(0) if marks is None else marks
        self._end, self._allowed = request.end, STEP_TOLERANCE_SHARE * request.tolerance
        self._load, self._compliance = load, compliance
        self._touches = set(load.touches.tolist())
        self._clocks = clocks
        turns = {jump for clock in clocks for jump in clock.jumps.tolist()}
        self._kinks = {*load.kinks.tolist(), *self._touches, *turns}
        stopping = np.unique(np.concatenate([load.stops, *(each.kinks for each in clocks)]))
        self._jumps = set(load.jumps.tolist())
        requested = {snap_to_kink(stop, stopping) for stop in [*stops.tolist(), request.end]}
        given = None if shown is None else shown.tolist()
        #: Requested times by the ends of the steps there; None: at the end of each step.
        self._shown = None if given is None else {snap_to_kink(t, stopping): t for t in given}
        self._jumps_in, self._stretched = jumps_in, stretched
        inner = {stop for stop in stopping.tolist() if stop < self._end}
        self._stops = sorted((requested | inner) - {0.0})
        self._end = max(self._stops)
        self._time, self._duration = 0.0, 0.0
        self._step: TimeStep | None = TimeStep(0.0, 0.0, self._state_at(0.0), smooth=False)
        self._growth = MAX_FACTOR
        self._lost = 0.0  # time at which no state was found near the one before [s]
        #: Time at which the force had changed too much, and longest step by that [s].
        self._changed = 0.0, 0.0

    @property
    def left(self) -> int:
        """Number of requested states still to come: where all steps have one, an estimate."""
        if self._shown is not None:
            ahead = [0.0] if self._duration == 0 else []
            return sum(time > self._time for time in self._shown) + len(ahead)
        way = self._end - self._time
        if way <= 0:
            return 0
        if self._duration == 0:
            return 100
        growth = min(max(self._growth, 1.0), 1.3)
        if growth < 1.01:
            return math.ceil(way / self._duration)
        return math.ceil(math.log1p((growth - 1) * way / self._duration) / math.log(growth))

    def next_step(self) -> TimeStep | None:
        """Next step; None at the end."""
        return self._step

    def accept_step(self, error: float, change: float = 0.0) -> bool:
        """Accept the step if its relative error [-] is allowed, else choose a shorter one.

        `change` is that of the force over the largest one that is allowed in a step; inf where the
        contact has jumped, which ends a smooth part of the run.
        """
        step = self._step
        assert step is not None  # there was one to be accepted
        if step.is_jump:
            self._advance(step)
            return True
        # Proposed factor of the duration (Hairer, Norsett & Wanner, section II.4), limited below.
        factor = SAFETY_FACTOR * (self._allowed / max(error, 1e-30)) ** (1 / ERROR_ORDER)
        factor = min(factor, CHANGE_SAFETY_FACTOR / max(change, 1e-30))
        # Error too large: repeat with a shorter duration.
        is_too_long = error > self._allowed or change > 1
        if is_too_long and not self._is_shortest(step.duration):
            self._duration = step.duration * min(max(factor, MIN_FACTOR), 0.8)
            self._step = self._next_step(step.smooth)
            return False
        changed = error > 0 or change > 0
        largest = MAX_FACTOR_OF_CHANGE if change > 0 else MAX_FACTOR
        self._growth = min(max(factor, MIN_FACTOR), largest) if changed else MAX_FACTOR
        # A step that a stop cut short does not reduce the duration that it was cut from.
        self._duration = min(self._duration, largest * step.duration)
        self._duration = max(self._duration, self._growth * step.duration)
        self._advance(step, jumped=math.isinf(change))
        return True

    def repeat_shorter(self, change: float, longest: float) -> None:
        """Choose a shorter step, by a change as in `accept_step`, or of a duration at most [s]."""
        if math.isinf(longest):
            if self._step is not None and math.isinf(change):
                self._lost = self._step.time
            elif self._step is not None and change > BEYOND:
                allowed = CHANGE_SAFETY_FACTOR * self._step.duration / change
                self._changed = self._step.time, allowed
            self.accept_step(0.0, change)
            return
        assert self._step is not None  # there was one that is too long
        self._duration = longest
        self._step = self._next_step(self._step.smooth)

    def repeat_sooner(self) -> bool:
        """Choose a shorter step in place of a jump that was not solved; False if there is none."""
        # The contact may not have reached the end of its state yet, or take another way from there.
        if self._step is None or self._jumps_in is None or self._step.is_jump:
            return False
        shortest = self._jumps_in * stretch_at(self._load, self._time, self._end)
        if self._step.duration <= LEAST_JUMP * shortest:
            return False
        self.repeat_shorter(math.inf, SOONER * self._step.duration)
        return True

    def restart_data(self) -> RestartData:
        """Restart data of the controller."""
        return {
            "time": self._time,
            "duration": self._duration,
            "growth": self._growth,
            "lost": self._lost,
            "changed": self._changed,
            "step": None if self._step is None else asdict(self._step),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same steps."""
        self._time, self._duration, self._growth = (
            restart_data[name] for name in ("time", "duration", "growth")
        )
        self._lost = restart_data.get("lost", 0.0)
        self._changed = restart_data.get("changed", (0.0, 0.0))
        self._step = None if restart_data["step"] is None else TimeStep(**restart_data["step"])

    def _is_shortest(self, duration: float) -> bool:
        """True if a step is not to be shortened [s]."""
        return duration <= self._shortest

    @property
    def _shortest(self) -> float:
        """Longest step that is not to be shortened [s]."""
        if self._jumps_in is None:
            return MIN_STEP_FRACTION * self._end
        return self._jumps_in * stretch_at(self._load, self._time, self._end)

    def _state_at(self, time: float) -> float | None:
        """Requested time of a state at the end of a step [s]; None without one."""
        return time if self._shown is None else self._shown.get(time)

    def _advance(self, step: TimeStep, *, jumped: bool = False) -> None:
        """Move to the end of an accepted step, and choose the next one."""
        self._time = step.time
        if jumped:
            self._changed = 0.0, 0.0
        if step.before_jump:
            self._step = TimeStep(step.time, 0.0, self._state_at(step.time), smooth=False)
        elif self._time >= self._end:
            self._step = None
        else:
            after_kink = self._time == 0 or self._time in self._kinks
            if after_kink:
                # After a kink that changes little the steps keep their duration.
                starts = step.is_jump or self._time in self._touches
                before = 0.0 if starts else step.duration
                self._duration = max(self._first_duration(), before)
            smooth = not (after_kink or jumped)
            self._step = self._next_step(smooth, self._stretched)

    def _next_step(self, smooth: bool, stretch: float = 1.0) -> TimeStep:
        """Step of about the current duration, up to the next stop at most."""
        stop = next(stop for stop in self._stops if stop > self._time)
        way = stop - self._time
        duration = self._nearing_change()
        if self._time < self._load.curved_until:
            duration = min(duration, self._load.longest_step)
        for clock in self._clocks:
            changes = clock.divisions(self._time, self._time + min(duration, way))
            duration = min(duration, *(changes[:1] - self._time).tolist(), math.inf)
        # The last two steps before a stop are of equal length, so that none is very short.
        parts = math.ceil(way / (stretch * duration) * (1 - 1e-9))
        duration = way if parts <= 1 else way / 2 if parts == 2 else duration
        time = stop if parts <= 1 else self._last_mark(self._time + duration)
        duration = duration if parts <= 1 else time - self._time
        jumps = parts <= 1 and stop in self._jumps
        requested, shortest = self._state_at(time), self._is_shortest(duration)
        return TimeStep(
            *(time, duration, None if jumps else requested, smooth),
            before_jump=jumps,
            is_shortest=shortest,
        )

    def _nearing_change(self) -> float:
        """The current duration, or that of a step towards where a longer one was refused [s]."""
        duration, (changed, allowed) = self._duration, self._changed
        if changed > self._time:  # the force begins to change so much between
            duration = min(duration, max(PART_OF_WAY * (changed - self._time), allowed))
        ahead = self._lost - self._time
        if ahead > 0 and duration < LOOKED_AGAIN * ahead:  # the end of the state lies between
            duration = min(duration, ahead, max(PART_OF_WAY * ahead, self._shortest))
        return duration

    def _last_mark(self, time: float) -> float:
        """The last mark of a step up to a time, or the time without one [s]."""
        before = int(np.searchsorted(self._marks, time * (1 + 1e-9))) - 1
        mark = float(self._marks[before]) if before >= 0 else -math.inf
        return mark if mark > self._time * (1 + 1e-9) else time

    def _first_duration(self) -> float:
        """Duration of a first step, over which the law creeps little [s]."""
        way = next(stop for stop in (*sorted(self._kinks), self._end) if stop > self._time)
        shortest = MIN_STEP_FRACTION * self._end
        way = max(FIRST_STEP_FRACTION * (way - self._time), shortest)
        clock, law = self._compliance.clock, self._compliance.over_reduced_time

        def crept(age: float) -> float:
            return float(law(clock.passed(self._time + age, age)))

        instant = law.instant or crept(way)
        part = 0.5 * (12 * self._allowed) ** (1 / ERROR_ORDER)
        if self._load.level_at(self._time) <= 0:
            # A first touch, after which pressure and contact grow with roots of time.
            part = min(part, self._allowed / ISOLATED_STEP_SHARE)
        limit = part * instant + self._compliance.instant

        def excess(logarithm: float) -> float:
            return float(crept(way * math.exp(logarithm)) - limit)

        # Over the way, so that the unit of time changes nothing.
        least = math.log(shortest / way)
        if excess(0.0) <= 0:
            return float(way)
        if excess(least) >= 0:
            return shortest
        found = float(scipy.optimize.brentq(excess, least, 0.0, xtol=1e-3))
        return float(way * math.exp(found))
