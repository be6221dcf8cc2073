"""Hereditary integral of a Prony series, by a recursion of internal variables.

One internal field for each exponential term replaces the load history. For a field q that is linear
in time over a step, or over each of two parts of it (`step_shape`), the update is exact for steps
of any length:

    d(t + h) = exp(-h/τ) d(t) + w_old q(t) + w_new q(t + h) + w_trend (mean of q before)
"""

from __future__ import annotations

from functools import cached_property, lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.mechanics.time_integration.dissipation import heat_of_step, power_lost
from viscontact.mechanics.time_integration.hereditary_integral import (
    HereditaryIntegral,
    HereditaryResponse,
    is_resolved,
)
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_shape import (
    Companions,
    FieldMap,
    StepShape,
    Trend,
    creep_after,
    step_shape,
)


class InternalVariables(HereditaryIntegral):
    """Running hereditary integral of one field under a Prony series, by internal variables.

    With J(t) = J0 + Σ Ji (1 - exp(-t/τi)) + φ t each term is an internal variable with τi d' = Ji q
    - d, integrated exactly for q linear over the rise of a step (Taylor, Pister & Goudreau 1970,
    Int. J. Numer. Meth. Eng. 2, 45, for relaxation; Simo & Hughes, Computational Inelasticity,
    1998, section 10.3). `others` are further creep functions on the same field, for the shape of
    its steps; the threads of a `team` share the field out. Steps have the durations of the `clock`.
    """

    def __init__(
        self,
        compliance: SeriesCompliance,
        shape: tuple[int, ...],
        others: tuple[ContactCompliance, ...] = (),
        team: Team | None = None,
        clock: Clock = TIME,
    ) -> None:
        self._compliance, self.others, self.clock = compliance, others, clock
        self._team = team or Team()
        self._fields = np.zeros((compliance.term_count, *shape))
        self._value = np.zeros(shape)
        self._jumped = self._next_jumps = False
        self._next, self._shape = _jump(compliance), StepShape(0.0, 0.0)
        #: Trend of the last step, and whether the next one begins with a kink.
        self._trend: Trend | None = None
        self._next_smooth = False

    def jump(self) -> HereditaryResponse:
        """Response to a jump; see `HereditaryIntegral.jump`."""
        self._next_jumps, self._next_smooth = True, False
        self._next, self._shape = _jump(self._compliance), StepShape(0.0, 0.0)
        return self._response()

    def ramp(
        self, duration: float, *, smooth: bool = False, others: Companions = ()
    ) -> HereditaryResponse:
        """Response to a step of a duration [s]; see `HereditaryIntegral.ramp`."""
        self._next_jumps, self._next_smooth = False, smooth
        trend = self._trend if smooth else None
        self._shape = step_shape(
            self._compliance,
            duration,
            after_jump=self._jumped,
            trend=trend,
            others=others,
        )
        self._next = ramp_weights(self._compliance, self._shape)
        return self._response()

    def accept(self, value: Floats) -> None:
        """Update the internal variables with the new value of the field, and close the step."""
        self._jumped = self._next_jumps
        value = value.copy() if value.flags.writeable else value
        weights, values = zip(*self._weighted_values(value), strict=True)
        # d(t + h) = decay d(t) + w_old q(t) + w_new q(t + h) + w_trend (mean of q), term by term.

        for index, field in enumerate(self._fields):
            each = (self._next.decay[index], *(weight[index] for weight in weights))
            self._team.weighted_sum(field, each, (field, *values))
        self._trend = self._shape.trend(value, self._trend) if self._next_smooth else None
        self._value = value

    def loss(self, value: Floats, paired: FieldMap | None = None) -> tuple[float, float]:
        """Heat of the step to a new value, and power lost at its end, per area [J/m², W/m²].

        The power is that per reduced time. A field that is no pair of pressure and unit
        displacement is made one by a linear map.
        """
        # To be called before `accept`.
        shape, turned = self._shape, value
        if self._trend is not None and not shape.is_level:
            turned = shape.turn_weight * value + (1 - shape.turn_weight) * self._trend.mean
        weighted, fields, before = self._weighted_values(value), self._fields, self._value
        if paired is not None:
            fields = np.stack([paired(each) for each in fields])
            weighted = [(weights, paired(each)) for weights, each in weighted]
            before, value, turned = paired(before), paired(value), paired(turned)
        parts = [(shape.rise, before, turned), (shape.slow, turned, value)]
        heat = heat_of_step(self._compliance, fields, parts) if shape.duration > 0 else 0.0
        variables = self._next.decay[:, None, None, None] * fields
        for weights, each in weighted:
            variables += weights[:, None, None, None] * each
        return heat, power_lost(self._compliance, variables, value)

    def restart_data(self) -> RestartData:
        """Restart data: internal variables, last value and trend."""
        return {
            "fields": self._fields.copy(),
            "value": self._value,
            "jumped": self._jumped,
            "trend": None if self._trend is None else vars(self._trend),
        }

    def map_fields(self, grown: FieldMap) -> None:
        """Continue with a larger field; see `HereditaryIntegral.map_fields`."""
        self._fields, self._value = grown(self._fields), grown(self._value)
        self._trend = None if self._trend is None else self._trend.mapped(grown)

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data; see `HereditaryIntegral.restore`."""
        self._fields = restart_data["fields"].copy()
        self._value, self._jumped = restart_data["value"], restart_data["jumped"]
        trend = restart_data["trend"]
        self._trend = None if trend is None else Trend(**trend)

    def _weighted_values(self, value: Floats) -> list[tuple[Floats, Floats]]:
        """Weights of the step, for each term, with the values that they belong to."""
        values = [(self._next.old, self._value), (self._next.new, value)]
        if self._trend is not None and not self._shape.is_level:
            values.append((self._next.trend, self._trend.mean))
        return values

    def _response(self) -> HereditaryResponse:
        """Response to the step whose weights are set."""
        step, shape = self._next, self._shape
        compliance = self._compliance.instant + step.sum_new
        weights: tuple[float, ...] = (float(step.old.sum()), *step.decay.tolist())
        fields: tuple[Floats, ...] = (self._value, *self._fields)
        if self._trend is not None and not shape.is_level:
            weights, fields = (*weights, float(step.trend.sum())), (*fields, self._trend.mean)
        others = shape.held, shape.trended, self._team
        return HereditaryResponse(weights, fields, compliance, step.resolved, *others)


@dataclass(frozen=True, eq=False)
class RampWeights:
    """Weights of one step in the recursion, for each term of the series."""

    decay: Floats  # factor of the term's internal variable [-]
    old: Floats  # weight of the value before the step [1/Pa]
    new: Floats  # weight of the value at its end [1/Pa]
    trend: Floats  # weight of the trend's mean [1/Pa]
    resolved: bool = True  # the step is short against the law

    @cached_property
    def sum_new(self) -> float:
        """Weight of the value at the end of the step in all terms [1/Pa]."""
        return float(self.new.sum())


def _jump(compliance: SeriesCompliance) -> RampWeights:
    """Weights of a jump: the internal variables do not change."""
    nothing = np.zeros(compliance.term_count)
    return RampWeights(nothing + 1.0, nothing, nothing, nothing)


# Cached, as the integrals of fields and of the numbers that go with them take the same step.
@lru_cache(maxsize=16)
def ramp_weights(compliance: SeriesCompliance, shape: StepShape) -> RampWeights:
    """Weights of a step, for each term; those of the fluidity last."""
    times, amplitudes = np.asarray(compliance.times), np.asarray(compliance.amplitudes)
    rise, slow = shape.rise, shape.slow
    first, second = (_share_of_new(part / times) for part in (rise, slow))
    rest = np.exp(-slow / times)
    decay = np.exp(-shape.duration / times)
    # Of the value before the step, at the turn between its parts, and at its end.
    old = amplitudes * (-np.expm1(-rise / times) - first) * rest
    turn = amplitudes * (first * rest - np.expm1(-slow / times) - second)
    end = amplitudes * second
    if compliance.fluidity > 0:
        decay = np.append(decay, 1.0)
        old = np.append(old, compliance.fluidity * rise / 2)
        turn = np.append(turn, compliance.fluidity * shape.duration / 2)
        end = np.append(end, compliance.fluidity * slow / 2)
    weight = shape.turn_weight
    crept = creep_after(compliance, shape.duration) - compliance.instant
    resolved = is_resolved(crept, compliance.instant, whole=slow == 0)
    return RampWeights(decay, old, end + weight * turn, (1 - weight) * turn, resolved)


def _share_of_new(ratio: Floats) -> Floats:
    """Weight 1 - (1 - exp(-r))/r of the new value after a ramp over r = rise/τ."""
    small = ratio < 1e-3  # by the series, as the closed form cancels
    safe = np.where(small, 1.0, ratio)
    series = ratio / 2 * (1 - ratio / 3 * (1 - ratio / 4 * (1 - ratio / 5)))
    return np.where(small, series, 1 + np.expm1(-safe) / safe)
