"""Hereditary integral of any law as a sum over all increments (Boltzmann superposition).

A product integration rule for the Volterra integral (Linz 1985, Analytical and Numerical Methods
for Volterra Equations): the field is linear in time over each part of a step (`step_shape`), so its
increment is weighted by the mean of J over the ages of that part, without approximation of J. Work
of a step and memory are proportional to the number of steps.
"""

from __future__ import annotations

from math import isclose

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance
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
    step_shape,
)

#: Steps ahead for which the sum over the past is computed at once, as one matrix product.
BLOCK_STEPS = 16

#: Values of a field that are summed at once, so that a row of them stays in the first-level cache.
BLOCK_CELLS = 2048


class BoltzmannSum(HereditaryIntegral):
    """Running hereditary integral of one field under any law, by superposition of increments.

    `instants` are planned ends of steps on the `clock`, a jump's twice [s]: sums are computed for
    several of them at once, singly for others. Memory for `steps` increments is reserved, and grows
    beyond them.
    """

    def __init__(
        self,
        compliance: ContactCompliance,
        shape: tuple[int, ...],
        instants: Floats | None = None,
        steps: int = BLOCK_STEPS,
        others: tuple[ContactCompliance, ...] = (),
        clock: Clock = TIME,
    ) -> None:
        self._compliance, self._shape = compliance, shape
        self.others, self.clock = others, clock
        self._planned = np.zeros(0) if instants is None else instants
        rows = max(len(self._planned), steps)
        # A row for each linear part of a step: increment of the field, and start and end.
        self._increments = np.zeros((rows, int(np.prod(shape))))
        self._began, self._ended = np.zeros(rows), np.zeros(rows)
        self._count = self._steps = 0
        self._value = np.zeros(shape)
        self._time = 0.0
        self._jumped = self._next_jumps = self._next_smooth = False
        self._end, self._step = 0.0, StepShape(0.0, 0.0)
        self._trend: Trend | None = None
        #: Sums computed ahead: for which steps, and of how many rows.
        self._ahead = np.zeros((0, self._increments.shape[1]))
        self._ahead_from = self._ahead_count = 0

    def jump(self) -> HereditaryResponse:
        """Response to a jump; see `HereditaryIntegral.jump`."""
        self._next_jumps, self._next_smooth = True, False
        past = self._history_at(self._time, StepShape(0.0, 0.0))
        compliance = self._compliance.instant
        history = past - compliance * self._value
        return HereditaryResponse((1.0,), (history,), compliance, resolved=True)

    def ramp(
        self, duration: float, *, smooth: bool = False, others: Companions = ()
    ) -> HereditaryResponse:
        """Response to a step of a duration [s]; see `HereditaryIntegral.ramp`."""
        self._next_jumps, self._next_smooth = False, smooth
        trend = self._trend if smooth else None
        step = step_shape(
            self._compliance,
            duration,
            after_jump=self._jumped,
            trend=trend,
            others=others,
        )
        history = self._history_at(self._time + duration, step)
        # Weights of the changes over both parts of the step.
        risen = self._compliance.mean(step.slow, duration)
        compliance = risen
        history = history - risen * self._value
        if trend is not None and not step.is_level:
            slow = self._compliance.mean(0.0, step.slow)
            compliance = slow + step.turn_weight * (risen - slow)
            history += (1 - step.turn_weight) * (risen - slow) * trend.mean
        crept = self._compliance(duration) - self._compliance.instant
        resolved = is_resolved(crept, self._compliance.instant, whole=step.slow == 0)
        return HereditaryResponse((1.0,), (history,), compliance, resolved, step.held, step.trended)

    def accept(self, value: Floats) -> None:
        """Add the increments to the new value of the field, and close the step."""
        value = value.copy() if value.flags.writeable else value
        self._jumped = self._next_jumps
        step, turned = self._step, value
        risen_at = self._time + step.rise
        if self._trend is not None and not step.is_level:
            turned = step.turn_weight * value + (1 - step.turn_weight) * self._trend.mean
            self._add(value - turned, risen_at, self._end)
        self._add(turned - self._value, self._time, risen_at)
        self._trend = step.trend(value, self._trend) if self._next_smooth else None
        self._value, self._time = value, self._end
        self._steps += 1

    def restart_data(self) -> RestartData:
        """Restart data: all increments so far, the trend, and the sums computed ahead."""
        return {
            "increments": self._increments[: self._count],
            "began": self._began[: self._count],
            "ended": self._ended[: self._count],
            "value": self._value,
            "time": self._time,
            "steps": self._steps,
            "jumped": self._jumped,
            "trend": None if self._trend is None else vars(self._trend),
            "ahead": self._ahead,
            "ahead_from": self._ahead_from,
            "ahead_count": self._ahead_count,
        }

    def map_fields(self, grown: FieldMap) -> None:
        """Continue with a larger field; see `HereditaryIntegral.map_fields`."""
        old, increments, ahead = self._shape, self._increments, self._ahead
        self._value = grown(self._value)
        self._trend = None if self._trend is None else self._trend.mapped(grown)
        self._shape, size = self._value.shape, self._value.size
        self._increments = np.zeros((len(increments), size))
        for row in range(self._count):
            self._increments[row] = grown(increments[row].reshape(old)).ravel()
        self._ahead = grown(ahead.reshape(len(ahead), *old)).reshape(len(ahead), size)

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data; see `HereditaryIntegral.restore`."""
        count = len(restart_data["began"])
        while len(self._began) < count:
            self._grow_arrays()
        self._count = count
        self._increments[: self._count] = restart_data["increments"]
        self._began[: self._count] = restart_data["began"]
        self._ended[: self._count] = restart_data["ended"]
        self._value, self._time, self._steps, self._jumped = (
            restart_data[name] for name in ("value", "time", "steps", "jumped")
        )
        trend = restart_data["trend"]
        self._trend = None if trend is None else Trend(**trend)
        self._ahead, self._ahead_from, self._ahead_count = (
            restart_data[name] for name in ("ahead", "ahead_from", "ahead_count")
        )

    def _add(self, increment: Floats, began: float, ended: float) -> None:
        """Add a row for an increment of the field between two times [s]."""
        if self._count == len(self._began):
            self._grow_arrays()
        self._increments[self._count] = increment.ravel()
        self._began[self._count], self._ended[self._count] = began, ended
        self._count += 1

    def _history_at(self, end: float, shape: StepShape) -> Floats:
        """Displacement from the past at the end of a step [s]."""
        step = self._steps
        is_planned = step < len(self._planned) and isclose(self._planned[step], end, rel_tol=1e-9)
        end = float(self._planned[step]) if is_planned else end
        self._end, self._step = end, shape
        past = self._planned_history(step) if is_planned else self._sum_at(np.array([end]), 0)[0]
        return past.reshape(self._shape)

    def _planned_history(self, step: int) -> Floats:
        """Displacement at the end of a planned step from all increments so far."""
        if not self._ahead_from <= step < self._ahead_from + len(self._ahead):
            self._ahead = self._sum_at(self._planned[step : step + BLOCK_STEPS], 0)
            self._ahead_from, self._ahead_count = step, self._count
        # Increments since the block was computed are added singly.
        recent = self._sum_at(self._planned[step : step + 1], self._ahead_count)[0]
        return np.asarray(self._ahead[step - self._ahead_from] + recent)

    def _sum_at(self, ends: Floats, first: int) -> Floats:
        """Displacements at some times from the increments so far, from the index `first` on."""
        began, ended = (each[first : self._count] for each in (self._began, self._ended))
        # Ages of each increment's rise at these times: its weight is the mean of J over them.
        since_began = np.maximum(ends[:, None] - began, 0.0)
        since_ended = np.clip(ends[:, None] - ended, 0.0, since_began)
        weights = self._compliance.mean(since_ended, since_began)
        return _product(weights, self._increments[first : self._count])

    def _grow_arrays(self) -> None:
        """Make room for more increments."""
        more = max(len(self._began) // 2, BLOCK_STEPS)
        roomier = np.zeros((len(self._began) + more, self._increments.shape[1]))
        roomier[: self._count] = self._increments[: self._count]
        self._increments = roomier
        self._began = np.append(self._began, np.zeros(more))
        self._ended = np.append(self._ended, np.zeros(more))


def _product(weights: Floats, increments: Floats) -> Floats:
    """Matrix product, not by BLAS, whose bits depend on its number of threads."""
    product = np.empty((len(weights), increments.shape[1]))
    for first in range(0, increments.shape[1], BLOCK_CELLS):
        part = slice(first, first + BLOCK_CELLS)
        np.einsum("ij,jk->ik", weights, increments[:, part], out=product[:, part])
    return product
