"""Events of a load program: the instants at which its conditions are met.

A program is marched once on the cells and times of the run. A step in which a condition is crossed
is solved again with other ends, until the condition is met at its end: a root of one number, found
by Brent's method. So the event is as accurate as the solution at the end of a step, of second order
in the steps. The history that results, of mixed control, is then run as any other load.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import ConvergenceError, SlidingError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import Condition, MixedHistory
from viscontact.bodies.loads.program_sentences import SLIDING
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.mechanics.time_integration.adaptive_steps import AdaptiveSteps
from viscontact.mechanics.time_integration.fixed_steps import KINK_TOLERANCE, FixedSteps, TimeStep
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.simulation.transient.contact_events import PULL_OFF_MARGIN
from viscontact.simulation.transient.frictionless import SlipTrial, frictional_contact
from viscontact.simulation.transient.march import domain_of, not_converged, refuse_rim
from viscontact.simulation.transient.observer import Observer
from viscontact.simulation.transient.segments_so_far import EventError, ProgramCourse, never_happens
from viscontact.simulation.transient.setup import RunSetup, prepare_run
from viscontact.simulation.transient.step_solution import StepSolution
from viscontact.simulation.transient.stepper import Stepper
from viscontact.simulation.transient.trial_step import StepTooLongError, TrialStep
from viscontact.units.formatting import format_quantity

#: Error of the instant of an event that its search leaves, as a part of the step.
EVENT_TOLERANCE = 1e-9

#: The same of scalars that jump, as they count cells, and parts of an interval at which it is
#: divided in turn, should one not be solved.
COUNTED, COUNTED_TOLERANCE, MIDDLES = (
    (SLIDING, "slip_fraction", "stick_area"),
    1e-6,
    (0.5, 0.4, 0.6),
)

#: Distance from the root to the instant of the event, in tolerances of the search: there contact is
#: lost in the search. In the run, which is within the solver's tolerance of it, one cell may still
#: bear 1e-10 of the largest force.
LOST_MARGIN = 3.0

#: Requested error of steps by which the hereditary integral of the search is planned [-].
PLANNED_ERROR = 1e-3

#: Ends of the steps of a segment [s], from its number, its begin and its latest end.
StepEnds = Callable[[int, float, float], Floats]


@dataclass(frozen=True, eq=False)
class _SolvedStep:
    """A step that has been solved but not accepted, its state, and the observer after it."""

    step: TimeStep
    trial: TrialStep
    state: ContactState
    observer: Observer
    slip: SlipTrial | None  # None where the body slides away


class EventSearch:
    """March over a load program, one segment after the other, up to the events that end them."""

    def __init__(
        self,
        problem: Problem,
        course: ProgramCourse,
        step_ends: StepEnds | None,
        threads: int = 1,
        *,
        event_tolerance: float = EVENT_TOLERANCE,
        on_state: Callable[[ContactState], None] | None = None,
    ) -> None:
        """Take given steps or adaptive ones; events are found to a part of a step."""
        self._course, self._step_ends = course, step_ends
        self._event_tolerance, self._on_state = event_tolerance, on_state
        self._stops = problem.instants
        self._tolerance = problem.adaptive.tolerance if problem.adaptive else PLANNED_ERROR
        times = AdaptiveTimes(course.latest, self._tolerance)
        planned = replace(problem, load=course.history(), times=times, kept=NO_FIELDS)
        self._run: RunSetup = prepare_run(planned, threads)
        self._domain: ContactDomain = domain_of(self._run)
        self._friction = frictional_contact(self._run)
        self._stepper = Stepper(self._run, self._domain, self._friction)
        self._observer = Observer(self._run, warns=False)
        self.states: list[ContactState] = []  # at the ends of the steps, without fields
        self.reach = (0.0, 0.0)  # of the contact from the middle of the grid, along x and y [m]
        self._accept(self._solve(TimeStep(0.0, 0.0, 0.0, smooth=False)))

    def carry_out(self) -> MixedHistory:
        """March to the end of the program; EventError if a condition is never met."""
        course = self._course
        while not course.is_over:
            course.refuse_pull()
            first = len(self.states) - 1
            met = self._march_segment()
            if self._state.outcome is Outcome.PULLED_OFF:
                course.end_with(self._state)
                break
            if met is None and course.segment.until is not None:
                raise EventError(never_happens(course, self.states[first:]))
            course.finish(self._state, met)
        return course.history()

    def refuse_coarse_mesh(self) -> None:
        """Raise DomainError if the largest contact had too few cells across, as a run does."""
        self._observer.refuse_coarse_mesh()

    def _march_segment(self) -> Condition | None:
        """March up to the end of the segment that follows, or to the first condition met."""
        history, begin, end = self._course.history(), self._course.begin, self._course.planned_end
        self._stepper.continue_under(history)
        fixed = self._step_ends is not None and self._run.law is None
        steps = self._given_steps(begin, end) if fixed else self._adaptive(history, end)
        while (step := steps.next_step()) is not None:
            try:
                solved = self._solve(step)
            except StepTooLongError as found:
                assert isinstance(steps, AdaptiveSteps)  # of bodies that adhere
                steps.repeat_shorter(found.change, found.longest)
                continue
            except ConvergenceError:
                if isinstance(steps, AdaptiveSteps) and steps.repeat_sooner():
                    continue
                raise
            if not steps.accept_step(solved.trial.error.relative, solved.trial.change):
                continue
            if solved.state.outcome is Outcome.PULLED_OFF:
                self._accept(solved)
                return None
            solved, met = self._first_event(solved)
            self._accept(solved)
            if met is not None:
                if met.scalar == "contact" and self._run.law is not None:
                    self._leave(end)
                return met
        return None

    def _leave(self, end: float) -> None:
        """Go on behind a pull-off, to where the run has lost contact for certain."""
        begin = self._state.time
        time = min((1 + PULL_OFF_MARGIN) * begin, end)
        if time > begin * (1 + KINK_TOLERANCE):
            step = TimeStep(time, time - begin, time, smooth=False, is_shortest=True)
            self._accept(self._solve(step))

    def _first_event(self, solved: _SolvedStep) -> tuple[_SolvedStep, Condition | None]:
        """Return a step, or its part up to the first condition that is met in it, and this."""
        slides = None
        if solved.slip is None:
            slides = next(each for each in self._course.conditions if each.scalar == SLIDING)
            solved = self._last_grip(solved.step)
        found = [
            (self._locate(condition, solved), condition)
            for condition in self._course.conditions
            if _is_met_between(condition, self._state, solved.state)
        ]
        if not found:
            # The histories answer to the step that was solved last.
            return (solved if slides is None else self._solve(solved.step)), slides
        first, met = min(found, key=lambda each: each[0].step.time)
        return (first if len(found) == 1 else self._solve(first.step)), met

    def _given_steps(self, begin: float, end: float) -> FixedSteps:
        """Steps through given instants within a segment, up to its end."""
        assert self._step_ends is not None
        wanted = self._step_ends(len(self._course.controls), begin, end)
        margin = KINK_TOLERANCE * end
        inside = wanted[(wanted > begin + margin) & (wanted < end - margin)]
        ends = [begin, *inside.tolist(), end]
        return FixedSteps(
            tuple(
                TimeStep(after, after - before, after, smooth=before > begin)
                for before, after in itertools.pairwise(ends)
            )
        )

    def _adaptive(self, history: MixedHistory, end: float) -> AdaptiveSteps:
        """Steps that their error determines, after the last one."""
        request = AdaptiveTimes(end, self._tolerance)
        stops = self._stops[self._stops < end]
        if self._step_ends is not None:
            wanted = self._step_ends(len(self._course.controls), self._course.begin, end)
            margin = KINK_TOLERANCE * end
            stops = wanted[(wanted > self._course.begin + margin) & (wanted < end - margin)]
        surface = self._run.problem.surface
        load = replace(self._run.problem, load=history).contact_load
        limits = self._run.problem.step_limits
        steps = AdaptiveSteps(
            *(request, stops, load, surface.creep), clocks=surface.clocks, **limits
        )
        last = self._last
        begun = {"time": last.time - last.duration, "duration": last.duration, "growth": 1.0}
        steps.restore({**begun, "step": asdict(last)})
        steps.accept_step(0.0)  # goes on behind it, with a first step as behind any kink
        return steps

    def _accept(self, solved: _SolvedStep) -> None:
        self._stepper.accept(solved.step, solved.trial)
        refuse_rim(self._run, solved.step, self._stepper.whole_solution(solved.trial))
        assert solved.slip is not None  # a step that slides away is not accepted
        self._friction.accept(solved.slip)
        self._last, self._state, self._observer = solved.step, solved.state, solved.observer
        if self._on_state is not None:
            self._on_state(solved.observer.with_events(solved.state))
        self.states.append(solved.state.without_fields())
        reach = _reach(self._run, solved.state)
        self.reach = max(self.reach[0], reach[0]), max(self.reach[1], reach[1])

    def _solve(self, step: TimeStep) -> _SolvedStep:
        slides = False
        try:
            trial = self._stepper.trial(step)
        except SlidingError:  # of tractions that are coupled with the pressure
            if not self._may_slide:
                raise
            trial, slides = self._stepper.without_friction().trial(step), True
        if trial.outcome is Outcome.NOT_CONVERGED:
            raise ConvergenceError(not_converged(self._run, step, trial.solution))
        solution = self._stepper.whole_solution(trial)
        observer = self._observer.copied()  # it adds the work of each step that it sees
        state = observer.evaluate(step, trial.point, solution)
        slip = None if slides else self._slip_of(step, solution, trial)
        found: dict[str, Any] = {"slip_fraction": 1.0} if slip is None else dict(slip.values)
        return _SolvedStep(step, trial, replace(state, **found), observer, slip)

    def _slip_of(
        self, step: TimeStep, solution: StepSolution, trial: TrialStep
    ) -> SlipTrial | None:
        """Tractions of a step; None where the body slides away and a condition waits for it."""
        try:
            return self._friction.trial(step, solution, trial.joint)
        except SlidingError:
            if not self._may_slide:
                raise
            return None

    @property
    def _may_slide(self) -> bool:
        """True if a condition waits for the whole contact to slip."""
        return any(each.scalar == SLIDING for each in self._course.conditions)

    def _locate(self, condition: Condition, crossed: _SolvedStep) -> _SolvedStep:
        """Return the step up to the instant at which a condition is met."""
        step = crossed.step
        begin = step.time - step.duration
        adheres = condition.scalar == "contact" and self._run.law is not None
        if adheres and math.isinf(crossed.trial.change):
            return crossed  # a jump has no root, and takes the shortest step
        if adheres or condition.scalar in COUNTED:
            first = _excess(condition, self._state) > 0
            _, past = self._around(step, lambda at: (_excess(condition, at.state) > 0) != first)
            return self._solve((past or crossed).step)

        def excess(time: float) -> float:
            if time == begin:
                return _excess(condition, self._state)
            if time == step.time:
                return _excess(condition, crossed.state)
            return _excess(condition, self._solve(_part_of(step, time)).state)

        tolerance = self._event_tolerance * step.duration
        met = float(scipy.optimize.brentq(excess, begin, step.time, xtol=tolerance))
        # An event right at the begin would be a step of no length; a lost contact is past its root.
        least = 2 * KINK_TOLERANCE * step.time
        certain = min(max(met + LOST_MARGIN * tolerance, begin + least), step.time)
        return self._solve(_part_of(step, certain))

    def _last_grip(self, step: TimeStep) -> _SolvedStep:
        """Return the longest part of a step at whose end the body does not slide away."""
        held, _ = self._around(step, lambda solved: solved.slip is None)
        if held is None:
            begin = format_quantity(step.time - step.duration, "s", 6)
            raise EventError(
                f"load: the body slides from {begin} on, before anything grips; let the load along "
                "the surface begin later"
            )
        return held

    def _around(
        self, step: TimeStep, is_past: Callable[[_SolvedStep], bool]
    ) -> tuple[_SolvedStep | None, _SolvedStep | None]:
        """Return the parts of a step right before and past an instant, by bisection."""
        begin, low, high = step.time - step.duration, 0.0, 1.0
        before, past = None, None
        while high - low > COUNTED_TOLERANCE:
            for part in MIDDLES:
                middle = low + part * (high - low)
                time = begin + middle * step.duration
                try:
                    solved = self._solve(_part_of(step, time))
                    break
                except ConvergenceError:  # at an instant at which a cell hardly slips or sticks
                    continue
            else:
                break
            if is_past(solved):
                high, past = middle, solved
            else:
                low, before = middle, solved
        return before, past


def _part_of(step: TimeStep, time: float) -> TimeStep:
    """First part of a step that has been solved, up to a time [s]; a jump within it is one."""
    begin = step.time - step.duration
    return TimeStep(time, time - begin, time, step.smooth, is_shortest=True)


def _reach(run: RunSetup, state: ContactState) -> tuple[float, float]:
    """Largest distances of the contact from the middle of the grid along x and y [m]."""
    touched = state.in_contact
    places = ((run.grid.x, touched.any(axis=1)), (run.grid.y, touched.any(axis=0)))
    x, y = (float(np.abs(each[where]).max(initial=0.0)) for each, where in places)
    return x, y


def _excess(condition: Condition, state: ContactState) -> float:
    """Scalar of a condition less its value; of a lost contact the clearance, negative."""
    if condition.scalar == SLIDING:
        assert state.slip_fraction is not None  # there is friction, as is checked
        return state.slip_fraction - 1 or math.ulp(0.0)  # above 0 where all cells slip
    if condition.scalar != "contact":
        return float(getattr(state, condition.scalar)) - condition.value
    if state.least_pressure is not None:  # bodies that adhere touch under forces of any sign
        return 1.0 if state.outcome is Outcome.CONVERGED else -1.0
    # Force and clearance have different units; only the sign counts, and zero is between them.
    if state.outcome is Outcome.NO_CONTACT:
        return -max(float(state.gap.min()), 0.0) - math.ulp(0.0)  # below 0 by rounding
    return state.force


def _is_met_between(condition: Condition, before: ContactState, after: ContactState) -> bool:
    """Test whether a condition is met within a step between two states, or at its end."""
    first, last = _excess(condition, before), _excess(condition, after)
    if condition.scalar == "contact":
        return first > 0 >= last
    if condition.scalar == SLIDING:
        return first < 0 < last
    return first != 0 and (last == 0 or (first > 0) != (last > 0))
