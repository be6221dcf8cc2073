"""Hereditary integral u(t) = ∫ J(t - t') dq(t') of a field, advanced step by step."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from viscontact.materials.compliance import ContactCompliance
from viscontact.time_integration.restart_data import RestartData

#: Creep within a step, over J(0), beyond which the step is long against the law. At this value a
#: single step after a jump has an error below 2 % of the pressure after the jump, for a Maxwell and
#: a Zener body.
MAX_RESOLVED_CREEP = 0.5

#: Largest weight of the old value in the first step after a jump, over J(0). A single step of any
#: length then follows the relaxation of a Maxwell body within 0.07 of its initial value; at 1 it
#: would be within 0.14, and zero beyond two relaxation times.
OLD_WEIGHT_AFTER_JUMP = 2 / 3

#: Maps fields to a larger grid.
FieldMap = Callable[[NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True)
class HereditaryResponse:
    """Displacement at the end of a step as a function of the new value q: u = history + J q."""

    history: NDArray[np.float64]  # displacement from all earlier steps [m if q is in Pa m]
    compliance: float  # mean of J over the rise of the step, J(0) for a jump [1/Pa]
    resolved: bool  # the step is short against the law, so that pressure may change much over it
    held: float = 0.0  # part of the step over which the new value is held after its rise [-]

    def of(self, value: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement for a new value of the field."""
        displacement = self.compliance * value
        displacement += self.history
        return displacement


class HereditaryIntegral(ABC):
    """Running hereditary integral u(t) = ∫ J(t - t') dq(t') of one field q.

    `ramp` or `jump` gives the response to the next step, and may be repeated; `accept` closes the
    step with the new value. Only these objects keep a history.
    """

    @abstractmethod
    def jump(self) -> HereditaryResponse:
        """Response to a jump: nothing creeps, so the new value acts by J(0) only."""

    @abstractmethod
    def ramp(self, duration: float) -> HereditaryResponse:
        """Response to a step of a positive duration [s].

        The field rises linearly: over the whole step, with an error of second order, wherever the
        step is short enough for the law. Over a step long against the relaxation times that would
        make the field oscillate about its true value from step to step; there it rises over the
        first part of the step, and is held over the rest.
        """

    @abstractmethod
    def accept(self, value: NDArray[np.float64]) -> None:
        """Close the last `jump` or `ramp` with the new value of the field.

        A read-only array may be kept without a copy, and must never change.
        """

    @abstractmethod
    def restart_data(self) -> RestartData:
        """Restart data, after an `accept`."""

    @abstractmethod
    def map_fields(self, grown: FieldMap) -> None:
        """Continue with a larger field; `grown` is linear and maps a field or a stack of fields."""

    @abstractmethod
    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same law and shape."""


def is_resolved(crept: float, instant: float, *, whole: bool) -> bool:
    """True if a step is short against the law, so that pressure may change much over it.

    `crept` is J at its end less J(0), `instant` is J(0) [1/Pa]. With J(0) = 0 no step is short, but
    one over whose `whole` length the field may rise is followed well.

    Examples
    --------
    >>> is_resolved(0.4, 1.0, whole=True), is_resolved(0.6, 1.0, whole=True)
    (True, False)
    """
    return whole if instant == 0 else crept <= MAX_RESOLVED_CREEP * instant


def longest_smooth_rise(
    compliance: ContactCompliance, duration: float, *, after_jump: bool = False
) -> float:
    """Longest rise of the field within a step [s] that does not make it oscillate.

    The whole duration if the step is short against the law. After a jump the field may fall fast.

    Notes
    -----
    The new value follows from new weight * q_new = u - old weight * q_old - .., with the new weight
    m = mean of J over [d - r, d] and the old weight J(d) - m, so an error of the old value returns
    reversed, by the ratio of the weights. The rise r is the longest whose old weight is within
    J(0), which at least halves an error. After a jump to a displacement that is then held, the new
    value is (J(0) - old weight)/(new weight) of the old one: there the old weight is kept to two
    thirds of J(0), as the true value does not vanish. With J(0) = 0 (an equation of the first kind:
    Linz 1985, Analytical and Numerical Methods for Volterra Equations) the rise is the longest that
    halves an error: the whole step for J like t^n with n up to 1/2, where the trapezoidal rule is
    known to be stable and of second order; two thirds of it for a dashpot, where it is not damped.

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
