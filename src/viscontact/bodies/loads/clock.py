"""Clocks of materials: the reduced time that temperature and ageing make of the time.

A thermorheologically simple body at the temperature T(t) that ages creeps as it does at the
reference temperature, without ageing, over the reduced time

    ξ(t) = ∫ dt'/(a_T(T(t')) a_e(t'))

(Morland & Lee 1960, Trans. Soc. Rheol. 4, 233; Struik 1978): u(t) = ∫ J(ξ(t) - ξ(t')) dq(t').
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Shift
from viscontact.bodies.laws.ageing import Ageing
from viscontact.bodies.loads.temperature import TemperatureHistory

#: Largest change of ln(1/a) within a piece over which the rate is integrated by Gauss's rule, which
#: is exact to rounding then.
PIECE_CHANGE = 0.25

#: Largest change of ln(1/a) over a step: a factor of two in the rate.
STEP_CHANGE = math.log(2.0)

#: End of the times that a clock is made for [s].
END = 1e30

#: Bisections of a time between two kinks, to rounding.
BISECTIONS = 60

_NODES, _WEIGHTS = leggauss(8)


class Clock:
    """The time itself: the clock of a body at a constant temperature that does not age."""

    @property
    def kinks(self) -> Floats:
        """Instants of kinks and jumps of the rate [s]."""
        return np.zeros(0)

    @property
    def jumps(self) -> Floats:
        """Instants of jumps of the rate [s]."""
        return np.zeros(0)

    def reduced(self, times: Floats) -> Floats:
        """Reduced times since time 0 [s]."""
        return np.asarray(times, dtype=float)

    def passed(self, end: float, duration: float) -> float:
        """Reduced duration of a step that ends at a time [s]."""
        del end
        return duration

    def rate(self, time: float) -> float:
        """Reduced time that passes in a unit of time just before a time [-]."""
        del time
        return 1.0

    def time_at(self, reduced: float) -> float:
        """Time at which a reduced time is reached [s]."""
        return reduced

    def divisions(self, begin: float, end: float, step_ratio: float = 1.0) -> Floats:
        """Times between two, over whose steps the rate changes little; `step_ratio` times more."""
        del begin, end, step_ratio
        return np.zeros(0)


TIME = Clock()


class _Pieces(NamedTuple):
    """Pieces of time over which the rate is smooth."""

    ends: Floats  # [s]
    reduced: Floats  # reduced times at the ends [s]
    rates: Floats  # of the pieces over which the rate is constant, NaN of the others [-]


@dataclass(frozen=True)
class ReducedTime(Clock):
    """Clock of a material under a temperature history, or one that ages, or both."""

    temperature: TemperatureHistory | None = None
    shift: Shift | None = None
    ageing: Ageing | None = None

    @property
    def kinks(self) -> Floats:
        """Instants of kinks and jumps of the rate [s]."""
        return np.zeros(0) if self.temperature is None else self.temperature.kinks

    @property
    def jumps(self) -> Floats:
        """Instants of jumps of the rate [s]."""
        return np.zeros(0) if self.temperature is None else self.temperature.jumps

    def reduced(self, times: Floats) -> Floats:
        """Reduced times since time 0 [s]."""
        instants = np.minimum(times, END)
        ends, reduced, _ = self._pieces
        piece = np.clip(np.searchsorted(ends, instants, side="right") - 1, 0, ends.size - 2)
        return np.asarray(reduced[piece] + self._since_begin(piece, instants))

    def passed(self, end: float, duration: float) -> float:
        """Reduced duration of a step that ends at a time [s]."""
        # Not the difference of two reduced times, which cancels.
        begin = end - duration
        inner, rate = self._between(begin, end)
        if not math.isnan(rate):
            return rate * duration
        marks = np.concatenate([[begin], inner, [end]])
        return float(self._within(marks[:-1], marks[1:]).sum())

    def rate(self, time: float) -> float:
        """Reduced time that passes in a unit of time just before a time [-]."""
        return float(np.exp(self._log_rate(np.array([time]), "left")[0]))

    def time_at(self, reduced: float) -> float:
        """Time at which a reduced time is reached [s]; inf if it never is."""
        ends, passed, _ = self._pieces
        piece = int(np.searchsorted(passed, reduced, side="right")) - 1
        if piece >= ends.size - 1:
            return math.inf
        low, high = float(ends[piece]), float(ends[piece + 1])
        for _ in range(200):  # bisection, at last of neighbouring numbers
            middle = (low + high) / 2
            if not low < middle < high:
                break
            if float(passed[piece] + self._since_begin(piece, np.array(middle))) < reduced:
                low = middle
            else:
                high = middle
        return high

    def divisions(self, begin: float, end: float, step_ratio: float = 1.0) -> Floats:
        """Times between two, over whose steps the rate changes little; `step_ratio` times more."""
        # Ends of pieces, which end where the rate has changed by a part of what a step may.
        inner, rate = self._between(begin, end)
        if not math.isnan(rate):
            return np.zeros(0)
        marks = np.concatenate([[begin], inner, [end]])
        left, right = self._log_rate(marks[1:], "left"), self._log_rate(marks[:-1], "right")
        changed = np.cumsum(np.abs(left - right))
        parts = math.ceil(float(changed[-1]) / (STEP_CHANGE * step_ratio) * (1 - 1e-9))
        if parts <= 1:
            return np.zeros(0)
        wanted = float(changed[-1]) * np.arange(1, parts) / parts
        return np.asarray(np.interp(wanted, np.append(0.0, changed), marks))

    @cached_property
    def _pieces(self) -> _Pieces:
        inner = self.kinks, self._passages(), self._ends_of_ageing()
        ends = np.unique(np.concatenate([[0.0, END], *inner]))
        if self.temperature is not None:
            ends = self._divided(ends)
        half, rates = self._at_nodes(ends[:-1], ends[1:])
        is_constant = np.ptp(rates, axis=-1) == 0
        return _Pieces(
            ends,
            np.append(0.0, np.cumsum(half * (rates @ _WEIGHTS))),
            np.where(is_constant, rates[..., 0], np.nan),
        )

    def _passages(self) -> Floats:
        """Instants between kinks of the temperature at which it passes one of the shift [s]."""
        if self.temperature is None or self.shift is None:
            return np.zeros(0)
        temperature, kinks = self.temperature, self.kinks
        levels = np.array(self.shift.kinks)[:, None]
        # It rises or falls all the way from one of its kinks to the next.
        above = temperature.at(kinks[:-1]) - levels
        row, begin = np.nonzero(above * (temperature.at(kinks[1:], side="left") - levels) < 0)
        low, high = kinks[begin], kinks[begin + 1]
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            is_before = (temperature.at(middle) - levels[row, 0]) * above[row, begin] > 0
            low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
        return high

    def _ends_of_ageing(self) -> Floats:
        if self.ageing is None:
            return np.zeros(0)
        age, each = self.ageing.age, PIECE_CHANGE / max(self.ageing.exponent, PIECE_CHANGE)
        count = math.ceil(math.log1p(END / age) / each)
        return np.asarray(age * np.expm1(each * np.arange(1, count)))

    def _divided(self, ends: Floats) -> Floats:
        """Ends of pieces with further ones, until the shift changes little over each."""
        held = float(self.kinks[-1])
        while True:
            left, right = self._log_shift(ends[1:], "left"), self._log_shift(ends[:-1], "right")
            long = (np.abs(left - right) > PIECE_CHANGE) & (ends[1:] <= held)
            if not long.any():
                return ends
            ends = np.sort(np.concatenate([ends, (ends[1:] + ends[:-1])[long] / 2]))

    def _between(self, begin: float, end: float) -> tuple[Floats, float]:
        """Ends of pieces between two times [s], and the rate there, NaN if it may vary [-]."""
        ends, _, rates = self._pieces
        first, last = int(ends.searchsorted(begin, "right")), int(ends.searchsorted(end, "left"))
        is_in_one = first >= last and first < ends.size
        return ends[first:last], float(rates[first - 1]) if is_in_one else math.nan

    def _since_begin(self, piece: Integers | int, times: Floats) -> Floats:
        """Reduced durations from the begin of a piece to times in it."""
        begin = self._pieces.ends[piece]
        passed = np.asarray(self._pieces.rates[piece] * (times - begin))
        if np.isnan(passed).any():
            passed = np.where(np.isnan(passed), self._within(begin, times), passed)
        return passed

    def _within(self, begin: Floats, end: Floats) -> Floats:
        """Reduced durations between times of one piece, by Gauss's rule with eight points."""
        half, rates = self._at_nodes(np.asarray(begin), np.asarray(end))
        return np.asarray(half * (rates @ _WEIGHTS))

    def _at_nodes(self, begin: Floats, end: Floats) -> tuple[Floats, Floats]:
        """Half durations between times of one piece, and the rates at the points of the rule."""
        half = (end - begin) / 2
        nodes = begin[..., None] + half[..., None] * (1 + _NODES)
        return half, np.exp(self._log_rate(nodes, "right"))

    def _log_rate(self, times: Floats, side: str) -> Floats:
        rate = -self._log_shift(times, side)
        return rate if self.ageing is None else rate - np.log(self.ageing.factor(times))

    def _log_shift(self, times: Floats, side: str) -> Floats:
        if self.temperature is None or self.shift is None:
            return np.zeros(np.shape(times))
        return np.asarray(np.log(self.shift.factor(self.temperature.at(times, side=side))))
