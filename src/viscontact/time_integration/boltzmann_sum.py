"""The Boltzmann integral of any law, as the sum it is: no fit, no approximation.

Every increment of the field is kept and weighted by the creep compliance of its age. The cost of a
step grows with the number of steps, and so does the memory; both are fields times steps.
"""

from __future__ import annotations

from math import isclose

import numpy as np
from numpy.typing import NDArray

from viscontact.materials.compliance import ContactCompliance
from viscontact.time_integration.hereditary_integral import (
    FieldMap,
    HereditaryIntegral,
    HereditaryResponse,
    is_resolved,
    longest_smooth_rise,
)
from viscontact.time_integration.restart_data import RestartData

#: Steps ahead for which the sum over the past is made at once, as one product of matrices.
BLOCK_STEPS = 16

#: Numbers of a field that are summed at once, so that a row of them stays in the nearest cache.
BLOCK_CELLS = 2048


class BoltzmannSum(HereditaryIntegral):
    """The running Boltzmann integral of one field under any law.

    Parameters
    ----------
    compliance : ContactCompliance
        J(t), used as it stands.
    shape : tuple of int
        Shape of the field.
    instants : ndarray, optional
        Ends of the steps that are planned, a jump's twice [s]. Sums are made for several of
        them at once; a step that ends elsewhere is summed by itself.
    steps : int
        How many steps there is room for from the start; memory is taken as they come.

    Examples
    --------
    A fluid, J = 1 + t, that carries q = 1 from time 0 on has moved by J(2) = 3:

    >>> from viscontact.materials.compliance import SeriesCompliance
    >>> memory = BoltzmannSum(SeriesCompliance(1.0, (), (), 1.0), (1,))
    >>> memory.jump().compliance
    1.0
    >>> memory.accept(np.ones(1))
    >>> response = memory.ramp(2.0)
    >>> float(response.history[0] + response.compliance * 1.0)
    3.0
    """

    def __init__(
        self,
        compliance: ContactCompliance,
        shape: tuple[int, ...],
        instants: NDArray[np.float64] | None = None,
        steps: int = BLOCK_STEPS,
    ) -> None:
        self._compliance, self._shape = compliance, shape
        self._planned = np.zeros(0) if instants is None else instants
        rows = max(len(self._planned), steps)
        # Row by row: an increment of the field, and when its rise began and ended.
        self._increments = np.zeros((rows, int(np.prod(shape))))
        self._began, self._ended = np.zeros(rows), np.zeros(rows)
        self._count = 0
        self._value = np.zeros(shape)
        self._time = 0.0
        self._jumped = self._next_jumps = False
        self._next = (0.0, 0.0)
        self._ahead = np.zeros((0, self._increments.shape[1]))
        self._ahead_from = 0

    def jump(self) -> HereditaryResponse:
        """HereditaryResponse to a jump; see `HereditaryIntegral.jump`."""
        self._next_jumps = True
        past = self._history_at(self._time, rise=0.0)
        met = self._compliance.instant
        return HereditaryResponse(past - met * self._value, met, resolved=True)

    def ramp(self, duration: float) -> HereditaryResponse:
        """Response to a change over a step of the given time; see `HereditaryIntegral.ramp`."""
        rise = longest_smooth_rise(self._compliance, duration, after_jump=self._jumped)
        self._next_jumps = False
        met = self._compliance.mean(duration - rise, duration)
        crept = self._compliance(duration) - self._compliance.instant
        resolved = is_resolved(crept, self._compliance.instant, whole=rise == duration)
        past = self._history_at(self._time + duration, rise=rise)
        return HereditaryResponse(past - met * self._value, met, resolved, held=1 - rise / duration)

    def accept(self, value: NDArray[np.float64]) -> None:
        """Take the new value of the field into the memory and close the step."""
        self._jumped = self._next_jumps
        if self._count == len(self._began):
            self._grow_arrays()
        row, (end, rise) = self._count, self._next
        self._increments[row] = (value - self._value).ravel()
        self._began[row], self._ended[row] = self._time, self._time + rise
        self._value = value.copy()
        self._time = end
        self._count += 1

    def restart_data(self) -> RestartData:
        """All increments so far, and the sums computed ahead, as restart data."""
        return {
            "increments": self._increments[: self._count],
            "began": self._began[: self._count],
            "ended": self._ended[: self._count],
            "value": self._value,
            "time": self._time,
            "jumped": self._jumped,
            "ahead": self._ahead,
            "ahead_from": self._ahead_from,
        }

    def map_fields(self, grown: FieldMap) -> None:
        """Go on with a larger field; see `HereditaryIntegral.map_fields`."""
        old, increments, ahead = self._shape, self._increments, self._ahead
        self._value = grown(self._value)
        self._shape, size = self._value.shape, self._value.size
        self._increments = np.zeros((len(increments), size))
        for row in range(self._count):
            self._increments[row] = grown(increments[row].reshape(old)).ravel()
        self._ahead = grown(ahead.reshape(len(ahead), *old)).reshape(len(ahead), size)

    def restore(self, restart_data: RestartData) -> None:
        """Go on from what was restart_data; see `HereditaryIntegral.restore`."""
        self._count = len(restart_data["began"])
        while len(self._began) < self._count:
            self._grow_arrays()
        self._increments[: self._count] = restart_data["increments"]
        self._began[: self._count] = restart_data["began"]
        self._ended[: self._count] = restart_data["ended"]
        self._value, self._time, self._jumped = (
            restart_data[name] for name in ("value", "time", "jumped")
        )
        self._ahead, self._ahead_from = restart_data["ahead"], restart_data["ahead_from"]

    def _history_at(self, end: float, *, rise: float) -> NDArray[np.float64]:
        step = self._count
        is_planned = step < len(self._planned) and isclose(self._planned[step], end, rel_tol=1e-9)
        end = float(self._planned[step]) if is_planned else end
        self._next = (end, rise)
        past = self._planned_history(step) if is_planned else self._summed(np.array([end]), 0)[0]
        return past.reshape(self._shape)

    def _planned_history(self, step: int) -> NDArray[np.float64]:
        """Displacement at the end of a planned step owed to all increments so far."""
        if not self._ahead_from <= step < self._ahead_from + len(self._ahead):
            self._ahead = self._summed(self._planned[step : step + BLOCK_STEPS], 0)
            self._ahead_from = step
        recent = self._summed(self._planned[step : step + 1], self._ahead_from)[0]
        return np.asarray(self._ahead[step - self._ahead_from] + recent)

    def _summed(self, ends: NDArray[np.float64], first: int) -> NDArray[np.float64]:
        """What the increments so far, from a first one on, have come to at some instants."""
        began, ended = (each[first : self._count] for each in (self._began, self._ended))
        since_began = np.maximum(ends[:, None] - began, 0.0)
        since_ended = np.clip(ends[:, None] - ended, 0.0, since_began)
        weights = self._compliance.mean(since_ended, since_began)
        return _product(weights, self._increments[first : self._count])

    def _grow_arrays(self) -> None:
        more = max(len(self._began) // 2, BLOCK_STEPS)
        roomier = np.zeros((len(self._began) + more, self._increments.shape[1]))
        roomier[: self._count] = self._increments[: self._count]
        self._increments = roomier
        self._began = np.append(self._began, np.zeros(more))
        self._ended = np.append(self._ended, np.zeros(more))


def _product(weights: NDArray[np.float64], increments: NDArray[np.float64]) -> NDArray[np.float64]:
    """The product of two matrices, not by BLAS, whose bits depend on its number of threads."""
    product = np.empty((len(weights), increments.shape[1]))
    for first in range(0, increments.shape[1], BLOCK_CELLS):
        part = slice(first, first + BLOCK_CELLS)
        np.einsum("ij,jk->ik", weights, increments[:, part], out=product[:, part])
    return product
