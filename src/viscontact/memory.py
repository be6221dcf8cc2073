"""What a viscoelastic body remembers: time without space.

Because the half-space kernel separates, the displacement is the Boltzmann integral
u(t) = ∫ J(t - t') dq(t') over the *elastic* displacement q = K p per unit compliance, which the
contact solver computes anyway: history costs no convolution. With q linear in time within a step
(jumps allowed; over long steps it rises and is held, see `Memory.ramp`) and J a series of
exponentials, the integral is a recursion over a few internal fields, exact on uneven steps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from viscontact.material import ContactCompliance

#: A step that creeps more than this part of J(0) is long against the law. At this part a single
#: step after a jump errs by less than 1 % of the pressure, for a Maxwell and a Zener body alike.
RESOLVED = 0.25


@dataclass(frozen=True)
class Response:
    """The displacement at the end of a step, before its load is known: u = history + J q.

    Attributes
    ----------
    history : ndarray, shape (nx, ny)
        Displacement owed to all earlier steps [m if q is in Pa m].
    compliance : float
        Compliance that meets the new value q itself: the mean of J over a ramp of the step's
        length, or J(0) for a jump [1/Pa].
    resolved : bool
        Whether the step is short against the law, so that pressure may change much over it.
    """

    history: NDArray[np.float64]
    compliance: float
    resolved: bool

    def of(self, value: NDArray[np.float64]) -> NDArray[np.float64]:
        """The displacement if the field ends the step at a value."""
        return self.history + self.compliance * value


class Memory:
    """The running Boltzmann integral of one field.

    The only object that remembers. Ask it for the `ramp` (or `jump`) that comes next, find the
    new value, and tell it with `accept`.

    Parameters
    ----------
    compliance : ContactCompliance
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
    >>> from viscontact.material import ContactCompliance
    >>> memory = Memory(ContactCompliance(1.0, (), (), 1.0), (1,))
    >>> memory.jump().compliance
    1.0
    >>> memory.accept(np.ones(1))
    >>> response = memory.ramp(2.0)
    >>> float(response.history[0] + response.compliance * 1.0)
    3.0
    """

    def __init__(self, compliance: ContactCompliance, shape: tuple[int, ...]) -> None:
        self._instant = float(compliance.instant)
        self._amplitudes = np.asarray(compliance.amplitudes, dtype=float)
        self._times = np.asarray(compliance.times, dtype=float)
        self._fluidity = float(compliance.fluidity)
        flowing = self._fluidity > 0
        self._fields = np.zeros((len(self._amplitudes) + flowing, *shape))
        self._value = np.zeros(shape)
        self._decay = np.ones(len(self._fields))
        self._old_weight = np.zeros(len(self._fields))
        self._new_weight = np.zeros(len(self._fields))

    def jump(self) -> Response:
        """Response to a jump: nothing has time to creep, only J(0) meets the new value."""
        self._decay = np.ones(len(self._fields))
        self._old_weight = np.zeros(len(self._fields))
        self._new_weight = np.zeros(len(self._fields))
        return self._response(resolved=True)

    def ramp(self, duration: float) -> Response:
        """Response to a change over a step of the given time.

        The field rises linearly, over the whole step wherever the step is short enough for the
        law, and so with an error of second order. Over a step long against the relaxation times a
        line through the whole step would make the field ring about its true value, step after
        step: there it rises over the first part of the step, and is held over the rest.

        Parameters
        ----------
        duration : float
            Length of the step [s], positive.

        Returns
        -------
        Response
            History at the end of the step and the compliance of the new value.

        Notes
        -----
        An error in the old value returns in the new one, reversed, by the ratio of old to J(0) +
        new weight. The rise is the longest whose old weight is within J(0), which halves it at
        least. With J(0) = 0 (a first-kind equation, where the trapezoidal rule is known not to
        damp: Linz 1985, Analytical and Numerical Methods for Volterra Equations) the
        rise is a jump.
        """
        rise = self._longest_smooth_rise(duration)
        decays = np.exp(-duration / self._times)
        self._decay = np.append(decays, np.ones(len(self._fields) - len(decays)))
        self._old_weight, self._new_weight = self._weights(duration, rise)
        # What creeps within the step, by a line through it, is to stay a part of J(0).
        crept = self._amplitudes @ np.minimum(duration / self._times / 2, 1.0)
        crept += self._fluidity * duration / 2
        return self._response(resolved=bool(crept <= RESOLVED * self._instant))

    def _longest_smooth_rise(self, duration: float) -> float:
        def excess(part: float) -> float:
            return float(self._weights(duration, part * duration)[0].sum()) - self._instant

        if excess(1.0) <= 0:
            return duration
        if self._instant == 0:
            return 0.0
        return duration * float(brentq(excess, 0.0, 1.0, xtol=1e-15))

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
        """Take the new value of the field into the memory and close the step.

        Parameters
        ----------
        value : ndarray
            The field at the end of the `jump` or `ramp` asked for last.
        """
        for field, decay, old, new in zip(
            self._fields, self._decay, self._old_weight, self._new_weight, strict=True
        ):
            field *= decay
            field += old * self._value
            field += new * value
        self._value = value.copy()

    def _response(self, *, resolved: bool) -> Response:
        history = self._old_weight.sum() * self._value
        for field, decay in zip(self._fields, self._decay, strict=True):
            history += decay * field
        return Response(history, self._instant + float(self._new_weight.sum()), resolved)


def _share_of_new(ratio: NDArray[np.float64]) -> NDArray[np.float64]:
    """1 - (1 - exp(-r))/r, the part of a term that the new value has excited after a ramp."""
    small = ratio < 1e-3
    safe = np.where(small, 1.0, ratio)
    series = ratio / 2 * (1 - ratio / 3 * (1 - ratio / 4 * (1 - ratio / 5)))
    return np.where(small, series, 1 + np.expm1(-safe) / safe)
