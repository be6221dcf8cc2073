"""Bending of a cantilever whose tip is pressed on a creeping body once, and drawn back."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dtrtri

from viscontact.backend.arrays import Floats
from viscontact.reference.lag_means import LagMean

_NEWTON_STEPS = 60  # far more than needed: the function is convex and grows


@dataclass(frozen=True)
class PressedTip:
    """Tip with elastic force E* factor h^exponent, on a cantilever of a spring constant [N/m]."""

    factor: float  # force at an indentation of 1 m and E* = 1 Pa
    exponent: float  # 1.5 of a sphere, 2 of a cone, 1 of a punch
    spring_constant: float

    @property
    def grows(self) -> bool:
        """True if the contact grows with the indentation, as that of a punch does not."""
        return self.exponent > 1

    def bending(self, times: Floats, way: Floats, mean: LagMean) -> Floats:
        """Bending of the cantilever at instants from contact on [m].

        `way` is that of its base since contact, 0 at the first instant [m]; `mean` that of the
        contact compliance over lags [1/Pa]. The indentation is the way less the bending. While
        the contact grows the force is the integral of M(t - t') d(factor h^exponent); when it
        shrinks the integral ends at the instant t_1 at which the contact was as large, with
        integral of M(t - t') dh = 0 from t_1 to t (Ting 1966). The force on each rod of the
        contact changes evenly within a step, as in `press_axisymmetric`.
        """
        march = _March(self, relaxation_weights(times, mean), times.size)
        for i in range(1, times.size):
            if not march.advance(i, float(way[i])):
                break
        return march.bent


class _March:
    """Indentation and bending of a pressed tip, step by step."""

    def __init__(self, tip: PressedTip, weights: Floats, count: int) -> None:
        self._tip, self._weights = tip, weights
        self._depth, self.bent = np.zeros(count), np.zeros(count)
        # changes over each step of indentation and of factor h^exponent
        self._deeper, self._grown = np.zeros(count), np.zeros(count)
        self._widest = 0  # instant of the largest contact

    def advance(self, i: int, way: float) -> bool:
        """Take a step to an instant; False if contact is lost."""
        row = self._weights[i, : i + 1]
        depth = self._growing(i, row, way)
        if self._tip.grows and depth < self._depth[self._widest]:
            shrunk = self._shrinking(i, row, way)
            if shrunk is not None:
                depth = shrunk
        else:
            self._widest = i
        if depth >= way:
            return False
        self._depth[i], self.bent[i] = depth, way - depth
        self._deeper[i] = depth - self._depth[i - 1]
        n = self._tip.exponent
        grown = abs(depth) ** n - abs(float(self._depth[i - 1])) ** n
        self._grown[i] = self._tip.factor * grown
        return True

    def _growing(self, i: int, row: Floats, way: float) -> float:
        """Indentation if the contact grows: by Newton's method, from above [m]."""
        tip, before = self._tip, float(self._depth[i - 1])
        k, n = tip.spring_constant, tip.exponent
        own = float(row[i]) * tip.factor
        known = float(row[:i] @ self._grown[:i]) - own * max(before, 0.0) ** n - k * way
        depth = float(max(way, before, 1e-300))
        if n == 1:
            return float(-known / (own + k))
        for _ in range(_NEWTON_STEPS):
            slope = own * math.pow(depth, n - 1)
            step = (known + slope * depth + k * depth) / (n * slope + k)
            depth -= step
            if depth <= 0:
                return 0.0
            if abs(step) <= 1e-13 * depth:
                break
        return depth

    def _shrinking(self, i: int, row: Floats, way: float) -> float | None:
        """Indentation if the contact shrinks, inf if it is lost, None if it grows after all [m]."""
        k, last = self._tip.spring_constant, self._widest + 1
        recovered = np.cumsum(row[:i] * self._deeper[:i])
        # Indentation and force if the contact is as large as at each earlier instant.
        depths = self._depth[i - 1] - (recovered[-1] - recovered[:last]) / row[i]
        forces = np.cumsum(row[:last] * self._grown[:last])
        excess = forces + k * (depths - way)
        if excess[-1] < 0:
            return None
        if excess[0] >= 0:
            return math.inf
        upper = int(np.argmax(excess >= 0))
        share = -excess[upper - 1] / (excess[upper] - excess[upper - 1])
        return float(depths[upper - 1] + share * (depths[upper] - depths[upper - 1]))


def relaxation_weights(times: Floats, mean: LagMean) -> Floats:
    """Load at each instant per displacement over each earlier step, shape (n, n) [Pa].

    The discrete relaxation modulus: loads that change evenly over each step give by the means of
    the compliance the displacements, exactly. Column 0 is zero.
    """
    n = times.size - 1
    ends, begins = times[1:], times[:-1]
    i, j = np.tril_indices(n)
    compliance = np.zeros((n, n))
    compliance[i, j] = mean(np.maximum(ends[i] - ends[j], 0.0), ends[i] - begins[j])
    inverse, failed = dtrtri(compliance, lower=1)
    if failed:
        raise ValueError("fit_indentation: the compliance is 0 over a step; the body is rigid")
    weights = np.zeros((n + 1, n + 1))
    # A step's displacement stays: it stands in all later rows, and loads are sums of changes.
    change = np.cumsum(inverse[:, ::-1], axis=1)[:, ::-1]
    np.cumsum(np.tril(change), axis=0, out=weights[1:, 1:])
    return weights
