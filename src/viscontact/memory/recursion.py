"""The Boltzmann integral of a series law, as a recursion.

With the field linear in time within a step and J a series of exponentials, the integral is a
recursion over a few internal fields, exact on uneven steps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.carried import Carried
from viscontact.compliance import SeriesCompliance
from viscontact.memory.response import Enlarging, Memory, Response, is_resolved, longest_smooth_rise


class RecursiveMemory(Memory):
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
    >>> from viscontact.compliance import SeriesCompliance
    >>> memory = RecursiveMemory(SeriesCompliance(1.0, (), (), 1.0), (1,))
    >>> memory.jump().compliance
    1.0
    >>> memory.accept(np.ones(1))
    >>> response = memory.ramp(2.0)
    >>> float(response.history[0] + response.compliance * 1.0)
    3.0
    """

    def __init__(self, compliance: SeriesCompliance, shape: tuple[int, ...]) -> None:
        self._compliance = compliance
        self._instant = float(compliance.instant)
        self._amplitudes = np.asarray(compliance.amplitudes, dtype=float)
        self._times = np.asarray(compliance.times, dtype=float)
        self._fluidity = float(compliance.fluidity)
        flowing = self._fluidity > 0
        self._fields = np.zeros((len(self._amplitudes) + flowing, *shape))
        self._value = np.zeros(shape)
        self._jumped = self._next_jumps = False
        self._decay = np.ones(len(self._fields))
        self._old_weight = np.zeros(len(self._fields))
        self._new_weight = np.zeros(len(self._fields))

    def jump(self) -> Response:
        """Response to a jump; see `Memory.jump`."""
        self._next_jumps = True
        self._decay = np.ones(len(self._fields))
        self._old_weight = np.zeros(len(self._fields))
        self._new_weight = np.zeros(len(self._fields))
        return self._response(resolved=True)

    def ramp(self, duration: float) -> Response:
        """Response to a change over a step of the given time; see `Memory.ramp`."""
        rise = longest_smooth_rise(self._compliance, duration, after_jump=self._jumped)
        self._next_jumps = False
        decays = np.exp(-duration / self._times)
        self._decay = np.append(decays, np.ones(len(self._fields) - len(decays)))
        self._old_weight, self._new_weight = self._weights(duration, rise)
        crept = self._compliance(duration) - self._instant
        resolved = is_resolved(crept, self._instant, whole=rise == duration)
        return self._response(resolved=resolved, held=1 - rise / duration)

    def _weights(
        self, duration: float, rise: float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Parts of the old and the new value in each term after a rise and a hold."""
        ratio = rise / self._times
        rest = np.exp((rise - duration) / self._times)
        share = _share_of_new(ratio)
        old = self._amplitudes * (-np.expm1(-ratio) - share) * rest
        new = self._amplitudes * (share * rest - np.expm1((rise - duration) / self._times))
        if self._fluidity > 0:
            old = np.append(old, self._fluidity * rise / 2)
            new = np.append(new, self._fluidity * (duration - rise / 2))
        return old, new

    def accept(self, value: NDArray[np.float64]) -> None:
        """Take the new value of the field into the memory and close the step."""
        self._jumped = self._next_jumps
        for field, decay, old, new in zip(
            self._fields, self._decay, self._old_weight, self._new_weight, strict=True
        ):
            field *= decay
            field += old * self._value
            field += new * value
        self._value = value.copy()

    def carried(self) -> Carried:
        """The internal fields and the last value; see `Memory.carried`."""
        return {"fields": self._fields.copy(), "value": self._value, "jumped": self._jumped}

    def enlarge(self, grown: Enlarging) -> None:
        """Go on with a larger field; see `Memory.enlarge`."""
        self._fields, self._value = grown(self._fields), grown(self._value)

    def restore(self, carried: Carried) -> None:
        """Go on from what was carried; see `Memory.restore`."""
        self._fields = carried["fields"].copy()
        self._value, self._jumped = carried["value"], carried["jumped"]

    def _response(self, *, resolved: bool, held: float = 0.0) -> Response:
        history = self._old_weight.sum() * self._value
        for field, decay in zip(self._fields, self._decay, strict=True):
            history += decay * field
        return Response(history, self._instant + float(self._new_weight.sum()), resolved, held)


def _share_of_new(ratio: NDArray[np.float64]) -> NDArray[np.float64]:
    """1 - (1 - exp(-r))/r, the part of a term that the new value has excited after a ramp."""
    small = ratio < 1e-3
    safe = np.where(small, 1.0, ratio)
    series = ratio / 2 * (1 - ratio / 3 * (1 - ratio / 4 * (1 - ratio / 5)))
    return np.where(small, series, 1 + np.expm1(-safe) / safe)
