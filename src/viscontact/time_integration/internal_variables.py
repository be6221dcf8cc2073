"""The Boltzmann integral of a series law, as a recursion.

With the field linear in time within a step and J a series of exponentials, the integral is a
recursion over a few internal fields, exact on uneven steps.
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
    """The running Boltzmann integral of one field under a series law.

    Parameters
    ----------
    compliance : SeriesCompliance
        J(t): instant part, exponential terms, fluidity.
    shape : tuple of int
        Shape of the field.

    Notes
    -----
    With J(t) = J0 + Σ Ji (1 - exp(-t/τi)) + φ t each term obeys a first-order equation
    τi d' = Ji q - d, solved exactly for q linear over a step, or over its first part and then held
    (Taylor et al. 1970, Int. J. Numer. Meth. Eng. 2, 45; Simo & Hughes, Computational
    Inelasticity, 1998, section 10.3).

    Examples
    --------
    A Maxwell body, J = 1 + t, that carries q = 1 from time 0 on has moved by J(2) = 3:

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
        self._term = np.empty(shape)  # to work in
        self._jumped = self._next_jumps = False
        self._next = _jump(compliance)

    def jump(self) -> HereditaryResponse:
        """HereditaryResponse to a jump; see `HereditaryIntegral.jump`."""
        self._next_jumps = True
        self._next = _jump(self._compliance)
        return self._response()

    def ramp(self, duration: float) -> HereditaryResponse:
        """Response to a change over a step of the given time; see `HereditaryIntegral.ramp`."""
        self._next_jumps = False
        self._next = ramp_weights(self._compliance, duration, after_jump=self._jumped)
        return self._response()

    def accept(self, value: NDArray[np.float64]) -> None:
        """Take the new value of the field into the memory and close the step."""
        self._jumped = self._next_jumps
        for field, decay, old, new in zip(
            self._fields, self._next.decay, self._next.old, self._next.new, strict=True
        ):
            field *= decay
            field += np.multiply(old, self._value, out=self._term)
            field += np.multiply(new, value, out=self._term)
        self._value = value.copy() if value.flags.writeable else value

    def restart_data(self) -> RestartData:
        """The internal fields and the last value; see `HereditaryIntegral.restart_data`."""
        return {"fields": self._fields.copy(), "value": self._value, "jumped": self._jumped}

    def map_fields(self, grown: FieldMap) -> None:
        """Go on with a larger field; see `HereditaryIntegral.map_fields`."""
        self._fields, self._value = grown(self._fields), grown(self._value)
        self._term = np.empty(self._value.shape)

    def restore(self, restart_data: RestartData) -> None:
        """Go on from what was restart_data; see `HereditaryIntegral.restore`."""
        self._fields = restart_data["fields"].copy()
        self._value, self._jumped = restart_data["value"], restart_data["jumped"]

    def _response(self) -> HereditaryResponse:
        step = self._next
        history = step.old.sum() * self._value
        for field, decay in zip(self._fields, step.decay, strict=True):
            history += np.multiply(decay, field, out=self._term)
        met = self._compliance.instant + float(step.new.sum())
        return HereditaryResponse(history, met, step.resolved, step.held)


@dataclass(frozen=True, eq=False)
class RampWeights:
    """What a step makes of each term of a series.

    Attributes
    ----------
    decay : ndarray, shape (n,)
        The part of a term that is left of it [-].
    old, new : ndarray, shape (n,)
        What is added to it of the value before the step, and of the value at its end [1/Pa].
    resolved : bool
        Whether the step is short against the law.
    held : float
        Part of the step over which the new value is held [-].
    """

    decay: NDArray[np.float64]
    old: NDArray[np.float64]
    new: NDArray[np.float64]
    resolved: bool = True
    held: float = 0.0


def _jump(compliance: SeriesCompliance) -> RampWeights:
    nothing = np.zeros(compliance.term_count)
    return RampWeights(nothing + 1.0, nothing, nothing)


# Several memories take the same step: of the fields, and of single numbers that go with them.
@lru_cache(maxsize=16)
def ramp_weights(compliance: SeriesCompliance, duration: float, *, after_jump: bool) -> RampWeights:
    """Parts of the old and the new value in each term after a rise and a hold.

    Parameters
    ----------
    compliance : SeriesCompliance
        J(t).
    duration : float
        Length of the step [s].
    after_jump : bool
        Whether the step before was a jump.

    Returns
    -------
    RampWeights
        Of each of its terms, the flow's last.

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
    """1 - (1 - exp(-r))/r, the part of a term that the new value has excited after a ramp."""
    small = ratio < 1e-3
    safe = np.where(small, 1.0, ratio)
    series = ratio / 2 * (1 - ratio / 3 * (1 - ratio / 4 * (1 - ratio / 5)))
    return np.where(small, series, 1 + np.expm1(-safe) / safe)
