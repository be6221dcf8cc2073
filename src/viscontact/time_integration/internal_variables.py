"""Hereditary integral of a Prony series, by a recursion of internal variables.

One internal field for each exponential term replaces the load history. For a field q that is linear
in time over a step, or over its first part and then held, the update is exact for steps of any
length:

    d(t + h) = exp(-h/τ) d(t) + w_old q(t) + w_new q(t + h)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from viscontact.materials.compliance import SeriesCompliance
from viscontact.time_integration.hereditary_integral import (
    FieldMap,
    HereditaryIntegral,
    HereditaryResponse,
    is_resolved,
    longest_smooth_rise,
)
from viscontact.time_integration.restart_data import RestartData


class InternalVariables(HereditaryIntegral):
    """Running hereditary integral of one field under a Prony series, by internal variables.

    Notes
    -----
    With J(t) = J0 + Σ Ji (1 - exp(-t/τi)) + φ t each term is an internal variable with
    τi d' = Ji q - d, integrated exactly for q linear over the rise of a step (Taylor, Pister &
    Goudreau 1970, Int. J. Numer. Meth. Eng. 2, 45, for relaxation; Simo & Hughes, Computational
    Inelasticity, 1998, section 10.3).

    Examples
    --------
    A Maxwell body, J = 1 + t, under q = 1 from time 0 on, has the displacement J(2) = 3 at t = 2:

    >>> import numpy as np
    >>> from viscontact.materials.compliance import SeriesCompliance
    >>> memory = InternalVariables(SeriesCompliance(1.0, (), (), 1.0), (1,))
    >>> memory.jump().compliance
    1.0
    >>> memory.accept(np.ones(1))
    >>> response = memory.ramp(2.0)
    >>> float(response.history[0] + response.compliance * 1.0)
    3.0
    """

    def __init__(self, compliance: SeriesCompliance, shape: tuple[int, ...]) -> None:
        self._compliance = compliance
        self._fields = np.zeros((compliance.term_count, *shape))
        self._value = np.zeros(shape)
        self._term = np.empty(shape)  # work array
        self._jumped = self._next_jumps = False
        self._next = _jump(compliance)

    def jump(self) -> HereditaryResponse:
        """Response to a jump; see `HereditaryIntegral.jump`."""
        self._next_jumps = True
        self._next = _jump(self._compliance)
        return self._response()

    def ramp(self, duration: float) -> HereditaryResponse:
        """Response to a step of a duration [s]; see `HereditaryIntegral.ramp`."""
        self._next_jumps = False
        self._next = ramp_weights(self._compliance, duration, after_jump=self._jumped)
        return self._response()

    def accept(self, value: NDArray[np.float64]) -> None:
        """Update the internal variables with the new value of the field, and close the step."""
        self._jumped = self._next_jumps
        # d(t + h) = decay d(t) + w_old q(t) + w_new q(t + h), term by term.
        for field, decay, old, new in zip(
            self._fields, self._next.decay, self._next.old, self._next.new, strict=True
        ):
            field *= decay
            field += np.multiply(old, self._value, out=self._term)
            field += np.multiply(new, value, out=self._term)
        self._value = value.copy() if value.flags.writeable else value

    def restart_data(self) -> RestartData:
        """Restart data: internal variables and last value."""
        return {"fields": self._fields.copy(), "value": self._value, "jumped": self._jumped}

    def map_fields(self, grown: FieldMap) -> None:
        """Continue with a larger field; see `HereditaryIntegral.map_fields`."""
        self._fields, self._value = grown(self._fields), grown(self._value)
        self._term = np.empty(self._value.shape)

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data; see `HereditaryIntegral.restore`."""
        self._fields = restart_data["fields"].copy()
        self._value, self._jumped = restart_data["value"], restart_data["jumped"]

    def _response(self) -> HereditaryResponse:
        """Response to the step whose weights are set."""
        # History: all of the displacement that does not depend on the new value.
        step = self._next
        history = step.old.sum() * self._value
        for field, decay in zip(self._fields, step.decay, strict=True):
            history += np.multiply(decay, field, out=self._term)
        compliance = self._compliance.instant + float(step.new.sum())
        return HereditaryResponse(history, compliance, step.resolved, step.held)


@dataclass(frozen=True, eq=False)
class RampWeights:
    """Weights of one step in the recursion, for each term of the series."""

    decay: NDArray[np.float64]  # factor of the term's internal variable [-]
    old: NDArray[np.float64]  # weight of the value before the step [1/Pa]
    new: NDArray[np.float64]  # weight of the value at its end [1/Pa]
    resolved: bool = True  # the step is short against the law
    held: float = 0.0  # part of the step over which the new value is held [-]


def _jump(compliance: SeriesCompliance) -> RampWeights:
    """Weights of a jump: the internal variables do not change."""
    nothing = np.zeros(compliance.term_count)
    return RampWeights(nothing + 1.0, nothing, nothing)


# Cached, as the integrals of fields and of the numbers that go with them take the same step.
@lru_cache(maxsize=16)
def ramp_weights(compliance: SeriesCompliance, duration: float, *, after_jump: bool) -> RampWeights:
    """Weights of a step of a duration [s], with a rise and a hold; those of the fluidity last.

    Examples
    --------
    >>> flow = SeriesCompliance(1.0, [], [], 0.01)
    >>> ramp_weights(flow, 2.0, after_jump=False).new.tolist()
    [0.01]
    """
    rise = longest_smooth_rise(compliance, duration, after_jump=after_jump)
    times, amplitudes = np.asarray(compliance.times), np.asarray(compliance.amplitudes)
    ratio, rest = rise / times, np.exp((rise - duration) / times)
    share = _share_of_new(ratio)
    decay = np.exp(-duration / times)
    old = amplitudes * (-np.expm1(-ratio) - share) * rest
    new = amplitudes * (share * rest - np.expm1((rise - duration) / times))
    if compliance.fluidity > 0:
        decay = np.append(decay, 1.0)
        old = np.append(old, compliance.fluidity * rise / 2)
        new = np.append(new, compliance.fluidity * (duration - rise / 2))
    crept = compliance(duration) - compliance.instant
    resolved = is_resolved(crept, compliance.instant, whole=rise == duration)
    return RampWeights(decay, old, new, resolved, 1 - rise / duration)


def _share_of_new(ratio: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weight 1 - (1 - exp(-r))/r of the new value after a ramp over r = rise/τ."""
    small = ratio < 1e-3  # by the series, as the closed form cancels
    safe = np.where(small, 1.0, ratio)
    series = ratio / 2 * (1 - ratio / 3 * (1 - ratio / 4 * (1 - ratio / 5)))
    return np.where(small, series, 1 + np.expm1(-safe) / safe)
