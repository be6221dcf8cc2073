"""Events of a load program: the instants at which its conditions are met.

A program is marched once on the cells and times of the run. A step in which a condition is crossed
is solved again with other ends, until the condition is met at its end: a root of one number, found
by Brent's method. So the event is as accurate as the solution at the end of a step, of second order
in the steps. The history that results, of mixed control, is then run as any other load.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from viscontact.contact.domain import ContactDomain
from viscontact.errors import ConvergenceError
from viscontact.loads import Condition, LoadHistory, LoadProgram, MixedHistory, Segment
from viscontact.loads.history import Control
from viscontact.problem.problem import Problem
from viscontact.simulation.march import domain_of, not_converged, refuse_rim
from viscontact.simulation.observer import Observer
from viscontact.simulation.setup import RunSetup, prepare_run
from viscontact.simulation.stepper import Stepper, TrialStep
from viscontact.state import ContactState, Outcome
from viscontact.time_integration.fixed_steps import KINK_TOLERANCE, Step
from viscontact.time_integration.requested_times import AdaptiveTimes
from viscontact.units.formatting import format_quantity

#: Error of the instant of an event that its search leaves, as a part of the step.
SEARCH_TOLERANCE = 1e-9

#: Distance from the root to the instant of the event, in tolerances of the search: there a lost
#: contact is lost for certain.
LOST_MARGIN = 3.0

#: Requested error of steps by which the hereditary integral of the search is planned [-].
PLANNED_ERROR = 1e-3

Times = ArrayLike | AdaptiveTimes | None


def problem_under(
    load: LoadHistory | LoadProgram,
    problem_of: Callable[[LoadHistory, Times], Problem],
    times: Times,
    threads: int = 1,
) -> Problem:
    """Return the problem under a load, or under the history that a load program comes to."""
    if not isinstance(load, LoadProgram):
        return problem_of(load, times)
    return problem_of(*carry_out(load, problem_of, times, threads))


def carry_out(
    program: LoadProgram,
    problem_of: Callable[[LoadHistory, Times], Problem],
    times: Times,
    threads: int = 1,
) -> tuple[MixedHistory, NDArray[np.float64]]:
    """March a load program and find the instants of its events.

    Parameters
    ----------
    program : LoadProgram
        The program.
    problem_of : callable
        Returns the problem under a load at given times; its grid must be given.
    times : array_like
        Requested instants; the last is the latest end [s].
    threads : int
        Threads of one Fourier transform.

    Returns
    -------
    MixedHistory
        The history that it was, with its events.
    ndarray
        Times of the run up to its end, with those of the events [s].

    Raises
    ------
    ValueError
        If a condition is not met by the last of the times, or the input is invalid.
    ConvergenceError, DomainError
        As in `march`.
    """
    instants = _checked(times, problem_of)
    way = _Way(program, float(instants[-1]))
    run = prepare_run(problem_of(way.history(), AdaptiveTimes(way.latest, PLANNED_ERROR)), threads)
    search = _Search(run, instants)
    for number in range(1, len(program.segments) + 1):
        found = search.march_segment(way)
        if found is None and way.segment.until is not None:
            raise ValueError(_never(way.segment, number, way.latest, search.state))
        way.finish(search.state, found)
        if way.is_over:
            break
    kept = instants[instants < search.state.time * (1 - KINK_TOLERANCE)]
    ends = np.array(way.times[1:])
    apart = np.abs(kept[:, None] - ends).min(axis=1) > KINK_TOLERANCE * ends[-1]
    return way.history(), np.union1d(kept[apart], ends)


class _Way:
    """The part of a program that has been carried out, and the segment that follows."""

    def __init__(self, program: LoadProgram, latest: float) -> None:
        self.program, self.latest = program, latest
        self.times: list[float] = [0.0]
        self.controls: list[Control] = []
        self.begins: list[float] = []
        self.ends: list[float] = []
        self.events: list[str] = []
        self.stopped = False
        self._begin = 0.0

    @property
    def is_over(self) -> bool:
        """True after the last segment, a stop, or the latest end."""
        done = len(self.controls) == len(self.program.segments)
        return done or self.stopped or self.times[-1] >= self.latest

    @property
    def segment(self) -> Segment:
        """The segment that follows."""
        segment = self.program.segments[len(self.controls)]
        assert isinstance(segment, Segment)
        return segment

    @property
    def planned_end(self) -> float:
        """End of the segment that follows, if no condition is met before [s]."""
        duration = self.segment.duration
        return self.latest if duration is None else min(self.times[-1] + duration, self.latest)

    @property
    def conditions(self) -> list[Condition]:
        """Conditions that end the segment that follows; the first is its own, if it has one."""
        own = self.segment.until
        return [each for each in (own, *self.program.stop) if isinstance(each, Condition)]

    def history(self) -> MixedHistory:
        """History so far, with the segment that follows up to its planned end."""
        times, controls = list(self.times), list(self.controls)
        begins, ends = list(self.begins), list(self.ends)
        if not self.is_over:
            end = self.planned_end
            times.append(end)
            controls.append(self.segment.control)
            begins.append(self._begin)
            ends.append(self._level(end))
        tilts = self.program.tilt_x, self.program.tilt_y
        return MixedHistory(times, controls, begins, ends, *tilts, self.events)

    def _level(self, time: float) -> float:
        level = self._begin + self.segment.rate * (time - self.times[-1])
        return max(level, 0.0) if self.segment.control == "force" else level

    def finish(self, state: ContactState, met: Condition | None) -> None:
        """End the segment at a state, where a condition was met, or none."""
        segment, values = self.segment, {"force": state.force, "approach": state.approach}
        values[segment.control] = self._level(state.time)
        if met is not None:
            self.stopped = met is not segment.until
            at = format_quantity(state.time, "s", 6)
            self.events.append(f"{at}: {met}" + (", the run ends" if self.stopped else ""))
            if met.scalar in values:
                values[met.scalar] = met.value
        self.times.append(state.time)
        self.controls.append(segment.control)
        self.begins.append(self._begin)
        self.ends.append(values[segment.control])
        if not self.is_over:
            self._begin = values[self.segment.control]


class _Search:
    """March over a program, one segment after the other."""

    def __init__(self, run: RunSetup, instants: NDArray[np.float64]) -> None:
        self._run, self._instants = run, instants
        self._domain: ContactDomain = domain_of(run)
        self._stepper = Stepper(run, self._domain)
        self._observer = Observer(run, warns=False)
        step = Step(0.0, 0.0, None, smooth=False)
        trial, self.state = self._solved(step)
        self._stepper.accept(step, trial)

    def march_segment(self, way: _Way) -> Condition | None:
        """March up to the end of the segment that follows, or to the first condition met."""
        self._stepper.continue_under(way.history())
        begin, now = self.state.time, self.state.time
        for end in self._ends(begin, way.planned_end):
            smooth = now > begin and now > 0
            step = Step(end, end - now, None, smooth)
            trial, state = self._solved(step)
            found = [
                (*self._located(condition, step, state), condition)
                for condition in way.conditions
                if _crosses(condition, self.state, state)
            ]
            if found:
                step, trial, state, met = min(found, key=lambda each: each[0].time)
            self._stepper.accept(step, trial)
            refuse_rim(self._run, step, self._stepper.whole_solution(trial))
            self.state, now = state, step.time
            if found:
                return met
        return None

    def _ends(self, begin: float, end: float) -> Iterator[float]:
        margin = KINK_TOLERANCE * end
        inside = (self._instants > begin + margin) & (self._instants < end - margin)
        yield from self._instants[inside].tolist()
        yield end

    def _solved(self, step: Step) -> tuple[TrialStep, ContactState]:
        trial = self._stepper.trial(step)
        if trial.outcome is Outcome.NOT_CONVERGED:
            raise ConvergenceError(not_converged(self._run, step, trial.solution))
        solution = self._stepper.whole_solution(trial)
        return trial, self._observer.evaluate(step, trial.point, solution)

    def _located(
        self, condition: Condition, step: Step, crossed: ContactState
    ) -> tuple[Step, TrialStep, ContactState]:
        """Return the step up to the instant at which a condition is met."""
        begin = step.time - step.duration

        def excess(time: float) -> float:
            if time == begin:
                return _excess(condition, self.state)
            if time == step.time:
                return _excess(condition, crossed)
            return _excess(condition, self._solved(_until(time))[1])

        def _until(time: float) -> Step:
            return Step(time, time - begin, None, step.smooth)

        tolerance = SEARCH_TOLERANCE * step.duration
        met = float(scipy.optimize.brentq(excess, begin, step.time, xtol=tolerance))
        # An event right at the begin would be a step of no length; a lost contact is past its root.
        least = 2 * KINK_TOLERANCE * step.time
        located = _until(min(max(met + LOST_MARGIN * tolerance, begin + least), step.time))
        return located, *self._solved(located)


def _excess(condition: Condition, state: ContactState) -> float:
    """How far a condition's scalar is above its value; of a lost contact the clearance, negative.

    Force and clearance have different units; only the sign counts, and zero is between them.
    """
    if condition.scalar != "contact":
        return float(getattr(state, condition.scalar)) - condition.value
    if state.outcome is Outcome.NO_CONTACT:
        return -float(state.gap.min()) - math.ulp(0.0)
    return state.force


def _crosses(condition: Condition, before: ContactState, after: ContactState) -> bool:
    """Test whether a condition is met within a step between two states, or at its end."""
    first, last = _excess(condition, before), _excess(condition, after)
    if condition.scalar == "contact":
        return first > 0 >= last
    return first != 0 and (last == 0 or (first > 0) != (last > 0))


def _checked(times: Times, problem_of: Callable[..., Problem]) -> NDArray[np.float64]:
    """Requested instants; refuses those that the run would choose, and grids that it would."""
    if times is None or isinstance(times, AdaptiveTimes):
        raise ValueError(
            "times: a LoadProgram needs given instants, the last one its latest end; write e.g. "
            "times=vc.uniform_times(10.0, 100)"
        )
    open_ended = MixedHistory([0.0, 1.0], ["approach"], [0.0], [0.0])
    problem = problem_of(open_ended, times)
    instants = problem.instants
    if instants[-1] <= 0:
        raise ValueError("times: the last one is the latest end of a LoadProgram, later than 0 s")
    return instants


def _never(segment: Segment, number: int, latest: float, state: ContactState) -> str:
    assert isinstance(segment.until, Condition)
    scalar = segment.until.scalar
    now = ""
    if scalar != "contact":
        value = format_quantity(float(getattr(state, scalar)), segment.until.unit)
        now = f", where it is {value}"
    return (
        f"load: segment {number} lasts until {segment.until}, which does not happen by the latest "
        f"end at {format_quantity(latest, 's', 6)}{now}; give later times, or change the program"
    )
