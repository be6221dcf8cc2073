"""What a memory answers when asked for the displacement after the next step."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from viscontact.compliance import ContactCompliance

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
    held : float
        Part of the step over which the field is held after its rise, 0 for a line through the
        whole step [-].
    """

    history: NDArray[np.float64]
    compliance: float
    resolved: bool
    held: float = 0.0

    def of(self, value: NDArray[np.float64]) -> NDArray[np.float64]:
        """The displacement if the field ends the step at a value."""
        return self.history + self.compliance * value


class Memory(ABC):
    """The running Boltzmann integral u(t) = ∫ J(t - t') dq(t') of one field q.

    Memories are the only objects that remember. Ask one for the `ramp` (or `jump`) that comes
    next, as often as you like; find the new value, and tell it with `accept`.
    """

    @abstractmethod
    def jump(self) -> Response:
        """Response to a jump: nothing has time to creep, only J(0) meets the new value."""

    @abstractmethod
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
        """

    @abstractmethod
    def accept(self, value: NDArray[np.float64]) -> None:
        """Take the new value of the field into the memory and close the step.

        Parameters
        ----------
        value : ndarray
            The field at the end of the `jump` or `ramp` asked for last.
        """


def longest_smooth_rise(compliance: ContactCompliance, duration: float) -> float:
    """Return over how long a first part of a step a field may rise without ringing.

    Parameters
    ----------
    compliance : ContactCompliance
        J(t).
    duration : float
        Length of the step [s].

    Returns
    -------
    float
        The whole step if it is short against the law, else a part of it [s].

    Notes
    -----
    An error in the old value returns in the new one, reversed, by the ratio of the old value's
    weight, J(d) - mean of J over [d - r, d], to the new one's, that mean. The rise r is the
    longest whose old weight is within J(0), which halves an error at least. With J(0) = 0 (a
    first-kind equation, where the trapezoidal rule is known not to damp: Linz 1985, Analytical
    and Numerical Methods for Volterra Equations) the rise is a jump.

    Examples
    --------
    >>> from viscontact.compliance import SeriesCompliance
    >>> fluid = SeriesCompliance(1.0, (), (), 1.0)  # J = 1 + t: its old weight is r/2
    >>> longest_smooth_rise(fluid, 1.5), round(longest_smooth_rise(fluid, 9.0), 9)
    (1.5, 2.0)
    """
    instant, end = compliance.instant, compliance(duration)

    def excess(part: float) -> float:
        return end - compliance.mean((1.0 - part) * duration, duration) - instant

    if excess(1.0) <= 0:
        return duration
    if instant == 0:
        return 0.0
    return duration * float(brentq(excess, 0.0, 1.0, xtol=1e-15))
