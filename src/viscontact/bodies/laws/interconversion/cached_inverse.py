"""Numerical inverse of a creep or relaxation function, computed on demand and cached."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws.interconversion.log_curve import LogCurve
from viscontact.bodies.laws.interconversion.product_integration import Forcing, Function, Mean
from viscontact.bodies.laws.interconversion.volterra import Extrapolated, respond, steadied

# Beyond this many decades after the first node the function equals its final value.
_MOST_DECADES = 60


class Inverse:
    """Solution g of ∫ f(t - t') dg(t') = r(t), computed up to the largest time requested so far.

    `mean` is that of `volterra.invert`; `first` the first node [s]; `trend` +1 if g grows, -1 if it
    falls; `kinks` [s] those of f or r; r is `load`, 1 if left out; up to `since` [s] f may be a
    power.
    """

    def __init__(
        self,
        function: Function,
        mean: Mean,
        first: float,
        trend: int,
        *,
        kinks: Sequence[float] = (),
        load: Forcing | None = None,
        since: float = 0.0,
    ) -> None:
        self._function, self._mean, self._load = function, mean, load
        self._first, self._trend, self._kinks = first, trend, kinks
        self._since = since
        self._decades = 0
        self._found: Extrapolated

    def __call__(self, t: Floats) -> Floats:
        """Return g at times >= 0 [s], inf included."""
        last = self._first * 10.0**_MOST_DECADES
        within = np.where(t > last, 0.0, t)
        values = self.curve(float(within.max(initial=0.0)))(within)
        if not (t > last).any():
            return values
        return np.where(t > last, self._limit_after(last), values)

    def _limit_after(self, last: float) -> float:
        """Return the limit at infinite time, or the value at a very late time if there is none."""
        for late in (np.full(1, np.inf), np.full(1, last)):
            load = 1.0 if self._load is None else float(self._load.at(late)[0])
            met = float(self._function(late)[0])
            if math.isfinite(load) or math.isfinite(met):
                break
        return load / met if met > 0 else math.inf

    def mean(self, start: Floats, end: Floats) -> Floats:
        """Return the means of g over intervals of time [s]."""
        return self.curve(float(end.max(initial=0.0))).mean(start, end)

    def curve(self, end: float) -> LogCurve:
        """Return g as a curve that reaches a time [s] at least."""
        reach = max(end, 10 * self._since, 10 * self._first)
        decades = min(math.ceil(math.log10(reach / self._first)), _MOST_DECADES + 1)
        if decades > self._decades:
            found = respond(
                self._function,
                self._mean,
                self._first * 10.0**decades,
                first=self._first,
                since=self._since,
                kinks=self._kinks,
                load=self._load,
            )
            bound = self._function if self._load is None else None
            self._found = steadied(found, self._trend, bound)
            self._decades = decades
        return self._found.curve

    def error(self, start: float, end: float) -> float:
        """Return the estimated relative error of g between two times [s]."""
        self.curve(end)
        return self._found.error(start, end)
