"""What a memory answers when asked for the displacement after the next step."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from viscontact.materials.compliance import ContactCompliance
from viscontact.time_integration.restart_data import RestartData

#: A step that creeps more than this part of J(0) is long against the law. At this part a single
#: step after a jump errs by less than 2 % of the pressure that the jump has left, for a Maxwell
#: and a Zener body alike.
MAX_RESOLVED_CREEP = 0.5

#: In a first step after a jump, what is owed to the old value is kept to this part of J(0). So a
#: Maxwell body's relaxation is met within 0.07 of what it began with, by a single step of any
#: length; at 1 it would be within 0.14, and zero beyond two relaxation times.
OLD_WEIGHT_AFTER_JUMP = 2 / 3

#: What makes larger fields of smaller ones.
FieldMap = Callable[[NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True)
class HereditaryResponse:
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
        displacement = self.compliance * value
        displacement += self.history
        return displacement


class HereditaryIntegral(ABC):
    """The running Boltzmann integral u(t) = ∫ J(t - t') dq(t') of one field q.

    What a body remembers is in its memories alone. Ask one for the `ramp` (or `jump`) that comes
    next, as often as you like; find the new value, and tell it with `accept`.
    """

    @abstractmethod
    def jump(self) -> HereditaryResponse:
        """Response to a jump: nothing has time to creep, only J(0) meets the new value."""

    @abstractmethod
    def ramp(self, duration: float) -> HereditaryResponse:
        """HereditaryResponse to a change over a step of the given time.

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
        HereditaryResponse
            History at the end of the step and the compliance of the new value.
        """

    @abstractmethod
    def accept(self, value: NDArray[np.float64]) -> None:
        """Take the new value of the field into the memory and close the step.

        Parameters
        ----------
        value : ndarray
            The field at the end of the `jump` or `ramp` asked for last. One that cannot be written
            may be kept without a copy, and must never change.
        """

    @abstractmethod
    def restart_data(self) -> RestartData:
        """What has to be kept to go on from here; asked for after an `accept`."""

    @abstractmethod
    def map_fields(self, grown: FieldMap) -> None:
        """Go on with a larger field.

        Parameters
        ----------
        grown : callable
            Makes a larger field of any field like the ones remembered, or of a stack of them; must
            be linear.
        """

    @abstractmethod
    def restore(self, restart_data: RestartData) -> None:
        """Go on from what was `restart_data`, by a memory of the same law and shape."""


def is_resolved(crept: float, instant: float, *, whole: bool) -> bool:
    """Whether a step is short against the law, so that pressure may change much over it.

    Parameters
    ----------
    crept : float
        What creeps within the step, J at its end less J(0) [1/Pa].
    instant : float
        J(0) [1/Pa].
    whole : bool
        Whether the field rises over the whole of it.

    Returns
    -------
    bool
        With J(0) = 0 nothing is short; but a law that a line through the step does not make ring
        is followed well by it.

    Examples
    --------
    >>> is_resolved(0.4, 1.0, whole=True), is_resolved(0.6, 1.0, whole=True)
    (True, False)
    """
    return whole if instant == 0 else crept <= MAX_RESOLVED_CREEP * instant


def longest_smooth_rise(
    compliance: ContactCompliance, duration: float, *, after_jump: bool = False
) -> float:
    """Return over how long a first part of a step a field may rise without ringing.

    Parameters
    ----------
    compliance : ContactCompliance
        J(t).
    duration : float
        Length of the step [s].
    after_jump : bool
        Whether the field has just jumped, and so may fall fast.

    Returns
    -------
    float
        The whole step if it is short against the law, else a part of it [s].

    Notes
    -----
    An error in the old value returns in the new one, reversed, by the ratio of the old value's
    weight, J(d) - mean of J over [d - r, d], to the new one's, that mean. The rise r is the
    longest whose old weight is within J(0), which halves an error at least. After a jump to a
    displacement that is then held, the new value is (J(0) - old weight)/(new weight) of the old
    one: there the old weight is kept to two thirds of J(0), since something is always left. With
    J(0) = 0 (a first-kind equation: Linz 1985, Analytical and Numerical Methods for Volterra
    Equations) it is the longest that halves an error: the whole step for J like t^n with n up to
    1/2, where the trapezoidal rule is known to be stable and of second order; for a dashpot,
    whose rule does not damp, two thirds of it.

    Examples
    --------
    >>> from viscontact.materials.compliance import SeriesCompliance
    >>> fluid = SeriesCompliance(1.0, (), (), 1.0)  # J = 1 + t: its old weight is r/2
    >>> longest_smooth_rise(fluid, 1.5), round(longest_smooth_rise(fluid, 9.0), 9)
    (1.5, 2.0)
    """
    instant, end = compliance.instant, compliance(duration)
    limit = OLD_WEIGHT_AFTER_JUMP * instant if after_jump else instant

    def excess(part: float) -> float:
        new = compliance.mean((1.0 - part) * duration, duration)
        return end - new - (limit if instant > 0 else new / 2)

    if excess(1.0) <= 0:
        return duration
    return duration * float(scipy.optimize.brentq(excess, 0.0, 1.0, xtol=1e-15))
