"""Estimate of the pressure error that the time steps cause, accumulated from step to step.

Within a step the pressure is taken as linear in time. The interpolation error, d² q''/12 in the
mean over a step of length d, enters the hereditary integral and decays as the body relaxes. The
displacement error e(t) that results is compensated by a pressure error dq with J * dq = -e. A
recursion of single numbers, one for each term of J, follows both, with all interpolation errors of
one sign: an estimate of their largest possible sum, without cancellation.

Unit displacements and their changes are means over the contact. A single cell that is touched or
released within a step has a large error of its own for a moment, at every such event: steps that
resolved them all would be as many as the cells, and the other cells would hardly change.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.bodies.loads import LoadHistory, LoadPoint
from viscontact.bodies.loads.clock import TIME
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.hereditary_integral import HereditaryResponse
from viscontact.mechanics.time_integration.internal_variables import ramp_weights
from viscontact.mechanics.time_integration.plan import HereditaryPlan
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_shape import FieldMap, creep_after, step_shape

#: Interpolation error of a first step after a kink, in those that the curvature of its successor
#: gives; after a first touch, where q grows as t^(2/3), the ratio is 2.9.
FIRST_STEP_CURVATURE = 3.0

#: Safety factor of curvatures, which are taken from past steps and lag where they grow.
CURVATURE_SAFETY = 2.0

#: Interpolation error of a step without a successor, as a part of the change over it: that of the
#: central pressure after a first touch, which grows as t^(1/3); under t² from rest it is a sixth.
ISOLATED_STEP_SHARE = 1 / 4

#: Largest change of the unit displacement within the contact over its mean: 2 for one that falls as
#: 1 - (r/a)² from the centre, and a margin.
LARGEST_OVER_MEAN = 2.1

#: Interpolation error of a step that continues the last one's trend, 2 h² q''/9 for two of equal
#: length, over that of a linear step, h² q''/12.
TREND_ERROR_RATIO = 8 / 3

#: Weight of the error of a step that is long against the law: it relaxes within the step, and does
#: not add to those of other steps.
FORGOTTEN_ERROR_WEIGHT = 0.2

#: Power of the load's level with which its effect is assumed to grow.
LOAD_GROWTH_EXPONENT = 1 / 4


@dataclass(frozen=True, eq=False)
class StepError:
    """Contribution of one step to the error."""

    interpolation_error: float  # mean distance of the unit displacement from the line [Pa m]
    relative: float  # added pressure error, relative to the largest pressure to come [-]
    size: float  # largest unit displacement of the contact so far [Pa m]
    level: float  # largest level of the load so far [N or m]
    travel: float = 0.0  # change of the unit displacement over the step [Pa m]
    #: Rate of the unit displacement over the step [Pa m/s], None for a jump.
    rate: Floats | None = None


class TimeErrors:
    """Accumulated relative error of the pressure from the time steps of a run, on its clock."""

    # A first touch is alike at every scale, so its error relative to the current pressure would
    # never be small. A step is therefore measured against the pressure still to come under the
    # largest level, estimated by the fourth root of the level: a sphere's pressure grows as the
    # third root of the force, a cone's not at all.

    def __init__(self, plan: HereditaryPlan, load: LoadHistory, team: Team | None = None) -> None:
        self._load, self._team = load, team or Team()
        self._level = 0.0
        self._compliance, self._clock = plan.prony_approximation, plan.clock
        #: Displacement error of each term of J, from interpolation and from the pressure error [m].
        self._term_errors = np.zeros(plan.prony_approximation.term_count)
        self._pressure_error, self._jumped = 0.0, True
        #: Durations of the last two steps since a kink, values after the last, rate over it.
        self._durations: list[float] = []
        self._values: Floats | None = None
        self._rate: Floats | None = None
        self._pending: tuple[float, float] | None = None
        self._size = 0.0

    def of_step(
        self,
        step: TimeStep,
        point: LoadPoint,
        values: Floats,
        response: HereditaryResponse,
    ) -> StepError:
        """Contribution of a step, not accepted yet, to the error of the pressure at its end.

        `values` are pressure p [Pa] and unit displacement K p [Pa m] at its end. For the first step
        after a kink it is estimated from the change over it.
        """
        step = self._on_clock(step)
        level = max(self._level, self._load.level_of(point))
        if step.is_jump or self._values is None:
            contact = values[0] > 0
            if self._values is not None:
                contact |= self._values[0] > 0
            size = max(self._size, self._team.mean_change(contact, values[1]))
            return StepError(0.0, 0.0, size, level)
        rate = np.empty(values[1].shape)
        mean, speed, turn = self._change_over(step, values, self._values, rate)
        size, travel = max(self._size, mean), LARGEST_OVER_MEAN * step.duration * speed
        interpolation_error = self._interpolation_error(step, turn, travel, response)
        crept = creep_after(self._compliance, step.duration) - self._compliance.instant
        to_come = size * self._growth_to_come(level)
        relative = 0.0
        if size > 0:
            relative = interpolation_error * crept / (response.compliance * to_come)
            forgotten = response.held + response.trended
            relative *= 1 - (1 - FORGOTTEN_ERROR_WEIGHT) * forgotten
        return StepError(interpolation_error, relative, size, level, travel, rate)

    def after(self, step: TimeStep, values: Floats, error: StepError) -> float:
        """Accept a step, and return the error of pressure after it over the largest [-]."""
        step = self._on_clock(step)
        self._size, self._level = error.size, error.level
        if not step.smooth or step.is_jump:
            self._add_first_step(alone=True)
            self._durations = self._durations[-1:]
        if step.is_jump:
            self._durations = []
            if self._compliance.instant > 0:  # otherwise the pressure does not jump
                self._pressure_error = -float(self._term_errors.sum()) / self._compliance.instant
                self._jumped = True
        elif len(self._durations) < 2:
            self._pending = (step.duration, error.travel)
        else:
            self._add_first_step(
                alone=False, interpolation_error=error.interpolation_error / step.duration**2
            )
            self._remember(step.duration, error.interpolation_error)
        self._durations = [*self._durations[-1:], step.duration]
        self._values, self._rate = values, error.rate
        return abs(self._pressure_error) / self._size if self._size > 0 else 0.0

    def restart_data(self) -> RestartData:
        """Restart data of the estimate."""
        return {
            "term_errors": self._term_errors,
            "pressure_error": self._pressure_error,
            "jumped": self._jumped,
            "durations": self._durations,
            "values": self._values,
            "rate": self._rate,
            "pending": None if self._pending is None else list(self._pending),
            "size": self._size,
            "level": self._level,
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same run."""
        self._term_errors = restart_data["term_errors"]
        self._pressure_error = restart_data["pressure_error"]
        self._jumped = restart_data["jumped"]
        self._durations, self._values = list(restart_data["durations"]), restart_data["values"]
        self._rate = restart_data["rate"]
        pending = restart_data["pending"]
        self._pending = None if pending is None else (pending[0], pending[1])
        self._size, self._level = restart_data["size"], restart_data["level"]

    def map_fields(self, grown: FieldMap, embedded: FieldMap) -> None:
        """Continue with larger fields, mapped by `grown`; the rate is that of the smaller ones."""
        self._values = None if self._values is None else grown(self._values)
        self._rate = None if self._rate is None else embedded(self._rate)

    def _on_clock(self, step: TimeStep) -> TimeStep:
        """The step with its reduced duration."""
        if self._clock is TIME or step.is_jump:
            return step
        return replace(step, duration=step.duration_on(self._clock))

    def _growth_to_come(self, level: float) -> float:
        """Least factor by which the pressure still grows with the load."""
        if level <= 0:
            return 1.0
        # A history of pulls alone has no level, but the approach that follows it may have one.
        growth: float = (max(self._load.largest_level, level) / level) ** LOAD_GROWTH_EXPONENT
        return growth

    def _interpolation_error(
        self,
        step: TimeStep,
        turn: float | None,
        travel: float,
        response: HereditaryResponse,
    ) -> float:
        """Interpolation error of a step from second differences of unit displacements [Pa m]."""
        late = response.held * travel / 2
        if not step.smooth or turn is None:
            return max(late, ISOLATED_STEP_SHARE * travel)
        change = LARGEST_OVER_MEAN * turn
        curvature = 2 * change / (step.duration + self._durations[-1])
        part = (1 + (TREND_ERROR_RATIO - 1) * response.trended) / 12
        return CURVATURE_SAFETY * part * step.duration**2 * curvature + late

    def _add_first_step(self, *, alone: bool, interpolation_error: float = 0.0) -> None:
        """Add a pending first step, with the curvature of its successor if there is one."""
        if self._pending is None:
            return
        duration, change = self._pending
        guess = ISOLATED_STEP_SHARE * change
        if not alone:
            guess = min(guess, FIRST_STEP_CURVATURE * duration**2 * interpolation_error)
        self._remember(duration, guess)
        self._pending = None

    def _remember(self, duration: float, interpolation_error: float) -> None:
        """Add the interpolation error of a step to the terms, and its effect on the pressure."""
        held, step = (
            ramp_weights(
                self._compliance, step_shape(self._compliance, duration, after_jump=jumped)
            )
            for jumped in (True, self._jumped)
        )
        self._term_errors = (
            step.decay * self._term_errors + (held.old + held.new) * interpolation_error
        )
        self._term_errors += step.old * self._pressure_error
        # Solve J * dq = -e for the pressure error at the end of the step.
        compliance = self._compliance.instant + step.sum_new
        self._pressure_error, self._jumped = -float(self._term_errors.sum()) / compliance, False
        self._term_errors += step.new * self._pressure_error

    def _change_over(
        self, step: TimeStep, values: Floats, before: Floats, rate: Floats
    ) -> tuple[float, float, float | None]:
        """Means over the contact of unit displacement, rate, and change of the rate if known."""
        pairs = values[0], before[0], values[1], before[1]
        if (core := self._team.core) is not None:
            given = step.duration, self._rate, rate, self._team.threads
            mean, speed, turn = core.step_change(*pairs, *given)
            return mean, speed, None if self._rate is None else turn
        contact, each = (pairs[0] > 0) | (pairs[1] > 0), 1 / step.duration
        self._team.weighted_sum(rate, (each, -each), pairs[2:])
        means = [self._team.mean_change(contact, field) for field in (values[1], rate)]
        if self._rate is None:
            return means[0], means[1], None
        return means[0], means[1], self._team.mean_change(contact, rate, self._rate)
