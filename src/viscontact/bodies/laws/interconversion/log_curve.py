"""Monotone interpolation of a function of time in log time, with exact means.

Between the points the curve is the monotone cubic in ln t of Fritsch & Carlson (1980, SIAM J.
Numer. Anal. 17, 238), so that values over many decades weigh alike and there is no overshoot.
Before the first point and beyond the last one it is extrapolated by a named rule.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers, Numbers

#: Rules before the first point: its value, the power of time through the first two, or one of a
#: given exponent.
Before = Literal["value", "power"] | float
#: Rules beyond the last: its value, or the straight line in ln t or the power of time through the
#: last two.
Beyond = Literal["value", "line", "power"]

# Of an interval no wider than a factor e the mean is taken by 12 Gauss-Legendre nodes: the nearest
# singularity of ln t, t = 0, lies at -2.16 of its half widths, which leaves 4.08^-24 = 2e-15.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_NODES, _WEIGHTS = (_NODES + 1) / 2, _WEIGHTS / 2
_NARROW = 1.0


class LogCurve:
    """Monotone curve through points in log time.

    `times` >= 0 ascend, two or more of them positive [s]; from a point at 0 the curve is straight
    in t. Rules `before` the first point and `beyond` the last; `steepest` bounds the exponent of a
    power.
    """

    def __init__(
        self,
        times: ArrayLike,
        values: ArrayLike,
        *,
        before: Before = "value",
        beyond: Beyond = "line",
        steepest: tuple[float, float] = (-np.inf, np.inf),
    ) -> None:
        times, values = np.asarray(times, np.float64), np.asarray(values, np.float64)
        self.at_once = float(values[0]) if times[0] == 0 else None
        if self.at_once is not None:
            times, values = times[1:], values[1:]
        self.times, self.values = times, values
        self._widths = np.diff(np.log(times))
        if before == "power":
            before = float(np.clip(_power(times[:2], values[:2]), *steepest))
        self.exponent = 0.0 if before == "value" else float(before)
        self._line = self._fade = 0.0
        if beyond == "line":
            self._line = float((values[-1] - values[-2]) / self._widths[-1])
        elif beyond == "power":
            self._fade = _power(times[-2:], values[-2:])
        self._pieces = self._smooth(
            self.exponent * values[0] if before != "value" and self.at_once is None else None,
            {"value": None, "line": self._line, "power": self._fade * values[-1]}[beyond],
        )
        whole = self._primitive(np.arange(self._widths.size), times[1:], times[:-1])
        self._areas = np.concatenate([[0.0], np.cumsum(whole)])

    def _smooth(self, first: float | None, last: float | None) -> Floats:
        """Return the cubics, with given slopes at the ends for a smooth continuation."""
        u = np.log(self.times)
        monotone = scipy.interpolate.PchipInterpolator(u, self.values)
        slopes = monotone.derivative()(u)
        # Up to three times the slope of the points a cubic stays monotone (Fritsch & Carlson).
        secants = np.diff(self.values)[[0, -1]] / self._widths[[0, -1]]
        for at, slope, secant in ((0, first, secants[0]), (-1, last, secants[-1])):
            if slope is not None:
                slopes[at] = np.sign(secant) * min(abs(slope), 3 * abs(secant))
        return np.asarray(scipy.interpolate.CubicHermiteSpline(u, self.values, slopes).c)

    def __call__(self, t: ArrayLike) -> Floats:
        """Return the values at times >= 0 [s], of the shape of `t`."""
        t = np.asarray(t, np.float64)
        # Each point belongs to the piece that begins there, whose first coefficient it is.
        inside = np.clip(t, self.times[0], self.times[-1])
        values = self._cubic(self._piece(inside), inside)
        values = np.where(t < self.times[0], self._head(np.minimum(t, self.times[0])), values)
        beyond = self._tail(np.maximum(t, self.times[-1]))
        return np.asarray(np.where(t >= self.times[-1], beyond, values))

    def rate(self, t: Numbers, where: Floats) -> Numbers:
        """Return df/dt at times `t` (or complex), by the pieces that contain `where` [s]."""
        u = np.log(t / self.times[0])
        if self.at_once is not None:
            head = np.full_like(t, (self.values[0] - self.at_once) / self.times[0])
        else:
            head = self.exponent * self.values[0] * np.exp(self.exponent * u) / t
        piece = self._piece(where)
        c3, c2, c1, _ = self._pieces[:, piece]
        v = np.log(t / self.times[piece])
        body = ((3 * c3 * v + 2 * c2) * v + c1) / t
        late = np.log(t / self.times[-1])
        with np.errstate(over="ignore", invalid="ignore"):  # a steep one, far before its piece
            tail = (self._line + self._fade * self.values[-1] * np.exp(self._fade * late)) / t
        return np.where(where < self.times[0], head, np.where(where >= self.times[-1], tail, body))

    def mean(self, start: ArrayLike, end: ArrayLike) -> Floats:
        """Return the means over `start` to `end` [s], of one shape; values where equal."""
        # The primitive of a polynomial P(ln t) is t (P - P' + P'' - P^(3) + ...). Gauss-Legendre
        # quadrature replaces it on intervals so narrow that its difference would cancel.
        start, end = np.asarray(start, np.float64), np.asarray(end, np.float64)
        first, last = self.times[0], self.times[-1]
        area = np.zeros(np.broadcast_shapes(start.shape, end.shape))
        for low, high, mean in (
            (0.0, first, self._head_mean),
            (first, last, self._body_mean),
            (last, np.inf, self._tail_mean),
        ):
            a, b = np.clip(start, low, high), np.clip(end, low, high)
            some = b > a
            if some.any():
                area[some] += (b - a)[some] * mean(a[some], b[some])
        length = end - start
        return np.asarray(np.where(length > 0, area / np.where(length > 0, length, 1), self(start)))

    # --- before the first point ------------------------------------------------------------------

    def _head(self, t: Floats) -> Floats:
        ratio = t / self.times[0]
        if self.at_once is not None:
            return np.asarray(self.at_once + (self.values[0] - self.at_once) * ratio)
        with np.errstate(divide="ignore"):  # infinite at t = 0
            return np.asarray(self.values[0] * ratio**self.exponent)

    def _head_mean(self, start: Floats, end: Floats) -> Floats:
        if self.at_once is not None:
            return self._head(start + (end - start) / 2)
        scale = self.values[0] / self.times[0] ** self.exponent
        return np.asarray(scale * mean_power(self.exponent, start, end))

    # --- among the points ------------------------------------------------------------------------

    def _piece(self, t: Floats) -> Integers:
        found = np.searchsorted(self.times, t, side="right") - 1
        return np.asarray(np.clip(found, 0, self._widths.size - 1))

    def _cubic(self, piece: Integers, t: Floats) -> Floats:
        u = np.log(t / self.times[piece])
        c3, c2, c1, c0 = self._pieces[:, piece]
        return np.asarray(((c3 * u + c2) * u + c1) * u + c0)

    def _primitive(self, piece: Integers, end: Floats, start: Floats) -> Floats:
        """Return the integral over a part of a piece."""
        c3, c2, c1, c0 = self._pieces[:, piece]

        def primitive(t: Floats) -> Floats:
            u = np.log(t / self.times[piece])
            value = ((c3 * u + c2) * u + c1) * u + c0
            slope = (3 * c3 * u + 2 * c2) * u + c1
            return np.asarray(t * (value - slope + (6 * c3 * u + 2 * c2) - 6 * c3))

        def value(t: Floats) -> Floats:
            u = np.log(t / self.times[piece])
            return np.asarray(((c3 * u + c2) * u + c1) * u + c0)

        length, area = end - start, primitive(end) - primitive(start)
        wide = area / np.where(length > 0, length, 1.0)
        return narrow_mean(value, start, end, otherwise=wide) * length

    def _body_mean(self, start: Floats, end: Floats) -> Floats:
        """Return means over intervals of positive length between the first and the last point."""
        first, last = self._piece(start), self._piece(end)
        upper = np.minimum(end, self.times[first + 1])
        area = self._primitive(first, upper, start)
        several = last > first
        if several.any():
            m, k = last[several], first[several]
            area[several] += self._areas[m] - self._areas[k + 1]
            area[several] += self._primitive(m, end[several], self.times[m])
        return area / (end - start)

    # --- beyond the last point -------------------------------------------------------------------

    def _tail(self, t: Floats) -> Floats:
        ratio = t / self.times[-1]
        if self._line != 0:
            return np.asarray(self.values[-1] + self._line * np.log(ratio))
        return np.asarray(self.values[-1] * ratio**self._fade)

    def _tail_mean(self, start: Floats, end: Floats) -> Floats:
        if self._line != 0:
            # The mean of ln t from a to b is ln b - 1 + a ln(b/a)/(b - a).
            part, rest = (end - start) / end, start / end
            # The logarithm of what is left keeps its digits where nearly all of it is the part.
            tiny = np.finfo(np.float64).tiny
            near = np.log1p(-np.minimum(part, 0.5))
            offset = -1 - np.where(part < 0.5, near, np.log(np.maximum(rest, tiny))) * rest / part
            return np.asarray(self._tail(end) + self._line * offset)
        ratio = mean_power(self._fade, start / self.times[-1], end / self.times[-1])
        return np.asarray(self.values[-1] * ratio)


def _power(times: Floats, values: Floats) -> float:
    """Return the exponent of the power of time through two points; 0 where one is not positive."""
    if not (values > 0).all():
        return 0.0
    return float(np.log(values[1] / values[0]) / np.log(times[1] / times[0]))


def narrow_mean(
    function: Callable[[Floats], Floats], start: Floats, end: Floats, *, otherwise: Floats
) -> Floats:
    """Return the mean of a function of ln t by quadrature on narrow intervals, else `otherwise`."""
    narrow = np.asarray(end <= start * np.exp(_NARROW))
    if not narrow.any():
        return otherwise
    length, mean = end - start, np.zeros(narrow.shape)
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        mean += weight * function(start + node * length)
    return np.asarray(np.where(narrow, mean, otherwise))


def mean_power(exponent: float, start: Floats, end: Floats) -> Floats:
    """Return the mean of t^n over intervals of time; infinite from 0 on if n <= -1."""
    # b^n (1 - r^(n+1)) / ((n+1)(1 - r)) with r = a/b, whose differences do not cancel however close
    # a and b are; for n < -1, where b^n may vanish against r^n, with a and b exchanged.
    length, power = end - start, exponent + 1
    part = np.where(length > 0, length, 1.0) / np.where(length > 0, end, 1.0)
    with np.errstate(divide="ignore"):  # from 0 on
        log_ratio = np.log1p(-np.minimum(part, 1.0))  # ln(a/b)
        powers = (start if power < 0 else end) ** exponent
    if power < 0:
        part = np.where(length > 0, length, 1.0) / np.where(start > 0, start, 1.0)
        log_ratio = -log_ratio
    grown = log_ratio if power == 0 else np.expm1(power * log_ratio) / power
    return np.asarray(powers * np.where(length > 0, np.abs(grown) / part, 1.0))
