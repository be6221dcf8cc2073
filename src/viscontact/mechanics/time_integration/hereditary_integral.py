"""Hereditary integral u(t) = ∫ J(t - t') dq(t') of a field, advanced step by step."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import field

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_shape import Companions, FieldMap

#: Creep within a step, over J(0), beyond which the step is long against the law. At this value a
#: single step after a jump has an error below 2 % of the pressure after the jump, for a Maxwell and
#: a Zener body.
MAX_RESOLVED_CREEP = 0.5


@dataclass(frozen=True)
class HereditaryResponse:
    """Displacement at the end of a step as a function of the new value q: u = history + J q.

    The history is a weighted sum of fields, which hold until the step is accepted.
    """

    weights: tuple[float, ...]
    fields: tuple[Floats, ...]  # [m if q is in Pa m, weights as compliances where they are q]
    compliance: float  # mean of J over the rise of the step, J(0) for a jump [1/Pa]
    resolved: bool  # the step is short against the law, so that pressure may change much over it
    held: float = 0.0  # part of the step over which the new value is held after its rise [-]
    trended: float = 0.0  # part of the step over which the last step's trend is continued [-]
    team: Team = field(default_factory=Team)  # threads that share the field out

    @property
    def history(self) -> Floats:
        """Displacement from all earlier steps, not to be changed [m if q is in Pa m]."""
        if self.weights == (1.0,):
            return self.fields[0]
        return self.team.weighted_sum(np.empty(self.shape), self.weights, self.fields)

    def history_on(self, cut: tuple[slice, slice]) -> Floats:
        """Displacement of some rows and columns from all earlier steps."""
        parts = zip(self.weights, self.fields, strict=True)
        return np.asarray(sum(weight * field[..., *cut] for weight, field in parts))

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the field."""
        return self.fields[0].shape

    def of(self, value: Floats) -> Floats:
        """Displacement for a new value of the field."""
        weights, fields = (self.compliance, *self.weights), (value, *self.fields)
        return self.team.weighted_sum(np.empty(value.shape), weights, fields)

    def value_of(self, displacement: Floats) -> Floats:
        """New value of the field for a displacement, in the memory of that."""
        each = 1 / self.compliance
        weights = (each, *(-each * weight for weight in self.weights))
        return self.team.weighted_sum(displacement, weights, (displacement, *self.fields))


class HereditaryIntegral(ABC):
    """Running hereditary integral u(t) = ∫ J(t - t') dq(t') of one field q.

    `ramp` or `jump` gives the response to the next step, and may be repeated; `accept` closes the
    step with the new value. Only these objects keep a history.
    """

    #: Clock of its creep, and further creep functions that act on the same field.
    clock: Clock = TIME
    others: tuple[ContactCompliance, ...] = ()

    @abstractmethod
    def jump(self) -> HereditaryResponse:
        """Response to a jump: nothing creeps, so the new value acts by J(0) only."""

    @abstractmethod
    def ramp(
        self, duration: float, *, smooth: bool = False, others: Companions = ()
    ) -> HereditaryResponse:
        """Response to a step of a reduced duration > 0 [s], `smooth` without kink at its begin."""
        # `others` act on the same field, which has one shape in the step, each over its own
        # duration.
        # The field rises linearly: over the whole step, with an error of second order, wherever the
        # step is short enough for the law. Over a step long against the relaxation times that would
        # make the field oscillate about its true value from step to step; there it rises over the
        # first part of the step only (`step_shape`).

    @abstractmethod
    def accept(self, value: Floats) -> None:
        """Close the last `jump` or `ramp` with a value; a read-only one must never change."""

    @abstractmethod
    def restart_data(self) -> RestartData:
        """Restart data, after an `accept`."""

    @abstractmethod
    def map_fields(self, grown: FieldMap) -> None:
        """Continue with a larger field; `grown` is linear and maps a field or a stack of fields."""

    @abstractmethod
    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same law and shape."""


def response_to(step: TimeStep, memory: HereditaryIntegral) -> HereditaryResponse:
    """Response of a hereditary integral to a jump or to a step in time."""
    if step.is_jump:
        return memory.jump()
    others = tuple((each.over_reduced_time, step.duration_on(each.clock)) for each in memory.others)
    return memory.ramp(step.duration_on(memory.clock), smooth=step.smooth, others=others)


def is_resolved(crept: float, instant: float, *, whole: bool) -> bool:
    """True if a step is short against the law, so that pressure may change much over it.

    `crept` is J at its end less J(0), `instant` is J(0) [1/Pa]. With J(0) = 0 no step is short, but
    one over whose `whole` length the field may rise is followed well.
    """
    return whole if instant == 0 else crept <= MAX_RESOLVED_CREEP * instant
