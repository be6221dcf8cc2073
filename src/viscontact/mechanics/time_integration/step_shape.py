"""Shape of a field within one time step: linear, or a rise and then a slower change.

Over a step that is long against the law the field first rises from its last value, and then takes a
straight line to its new one. After a kink that line is level, which is of first order in the step.
Otherwise it continues from the mean over the same part of the step before, which is of second
order: where the body relaxes instantly, the backward difference formula of two steps (Hairer &
Wanner 1996, Solving Ordinary Differential Equations II, section V.1).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.compliance import ContactCompliance

#: Maps fields to a larger grid.
FieldMap = Callable[[Floats], Floats]

#: Further creep functions that act on the same field, each with its own duration of a step [s].
Companions = tuple[tuple[ContactCompliance, float], ...]

#: Largest weight of the old value in the first step after a jump, over J(0). A single step of any
#: length then follows the relaxation of a Maxwell body within 0.07 of its initial value; at 1 it
#: would be within 0.14, and zero beyond two relaxation times.
OLD_WEIGHT_AFTER_JUMP = 2 / 3

#: Largest growth from one slow part to the next whose trend is continued; backward differences of
#: two steps are stable up to 1 + sqrt(2) (Hairer, Norsett & Wanner 1993, section III.5).
MAX_TREND_GROWTH = 2.4


@dataclass(frozen=True, eq=False)
class Trend:
    """Mean of a field over the slow part of a step, which the next step may continue from."""

    mean: Floats
    age: float  # time from the middle of that part to the end of the step [s]

    def mapped(self, grown: FieldMap) -> Trend:
        """Trend of a larger field, mapped by `grown`."""
        return Trend(grown(self.mean), self.age)


@dataclass(frozen=True)
class StepShape:
    """Lengths of the parts of a step, and the value between them."""

    duration: float  # [s]
    rise: float  # first part, over which the field leaves its last value [s]
    #: Weight of the new value in the value at the end of the rise; the rest is that of the trend.
    turn_weight: float = 1.0

    @property
    def slow(self) -> float:
        """Length of the second part [s]; 0 for a step that is linear."""
        return self.duration - self.rise

    @property
    def is_level(self) -> bool:
        """True if the new value is held over the second part."""
        return self.turn_weight == 1

    @property
    def held(self) -> float:
        """Part of the step over which the new value is held [-]."""
        return self.slow / self.duration if self.is_level and self.slow > 0 else 0.0

    @property
    def trended(self) -> float:
        """Part of the step over which the trend is continued [-]."""
        return 0.0 if self.is_level else self.slow / self.duration

    def trend(self, value: Floats, before: Trend | None) -> Trend | None:
        """Trend after a step to a new value; None for a linear one, and without contact."""
        if self.slow == 0 or not value.any():
            return None
        mean = value
        if not self.is_level:
            assert before is not None  # the step continues it
            mean = (1 + self.turn_weight) / 2 * value + (1 - self.turn_weight) / 2 * before.mean
        return Trend(mean, self.slow / 2)


def step_shape(
    compliance: ContactCompliance,
    duration: float,
    *,
    after_jump: bool = False,
    trend: Trend | None = None,
    others: Companions = (),
) -> StepShape:
    """Shape of a step of a duration [s] for a law and `others`, continued from a recent trend."""
    laws = ((compliance, duration), *others)
    rise = longest_smooth_rise(compliance, duration, after_jump=after_jump)
    for law, own in others:
        other = longest_smooth_rise(law, own, after_jump=after_jump)
        rise = min(rise, other * (duration / own))
    # Without instantaneous compliance the rise damps errors too little for a trend.
    if trend is None or any(law.instant == 0 for law, _ in laws):
        return StepShape(duration, rise)
    if not 0 < duration - rise <= MAX_TREND_GROWTH * 2 * trend.age:
        return StepShape(duration, rise)
    # On the line from the mean, in the middle of its part, to the new value.
    return StepShape(duration, rise, (trend.age + rise) / (trend.age + duration))


# Cached, as several integrals and the estimate of their error take the same step.
@lru_cache(maxsize=16)
def creep_after(compliance: ContactCompliance, duration: float) -> float:
    """Creep function after a duration [1/Pa]."""
    return compliance(duration)


@lru_cache(maxsize=16)
def _mean_creep_until(compliance: ContactCompliance, duration: float) -> float:
    return compliance.mean(0.0, duration)


@lru_cache(maxsize=16)
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
    """
    instant, end = compliance.instant, creep_after(compliance, duration)
    limit = OLD_WEIGHT_AFTER_JUMP * instant if after_jump else instant

    def excess_of(new: float) -> float:
        return end - new - (limit if instant > 0 else new / 2)

    def excess(part: float) -> float:
        return excess_of(compliance.mean((1.0 - part) * duration, duration))

    if excess_of(_mean_creep_until(compliance, duration)) <= 0:
        return duration
    return duration * float(scipy.optimize.brentq(excess, 0.0, 1.0, xtol=1e-15))
