"""Force on a tip that is pressed on a creeping body once, and drawn back."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.elastic_indentation import ElasticIndentation
from viscontact.reference.lag_means import LagMean

_NEWTON_STEPS = 60  # far more than needed: the function is convex and grows
_SMALL = 24  # rows of a matrix that is inverted at once


@dataclass(frozen=True)
class PressedTip:
    """Tip that is pressed once, through a spring whose base moves.

    Without compliance the spring is rigid, and the indentation is the way of its base.
    """

    elastic: ElasticIndentation
    spring_compliance: float = 0.0  # [m/N]

    def force(self, times: Floats, way: Floats, mean: LagMean) -> Floats:
        """Force at instants from contact on [N].

        `way` is that of the base since contact, 0 at the first instant [m]; `mean` that of the
        contact compliance over lags [1/Pa]. The indentation is the way less the bending. While
        the contact grows the force is the integral of M(t - t') dF, F(h) the elastic force for a
        contact modulus of 1 Pa; when it shrinks the integral ends at the instant t_1 at which the
        contact was as large, with integral of M(t - t') dh = 0 from t_1 to t (Ting 1966, whose
        argument holds for a film as for a half-space: only one law of time is needed). The
        pressure of each ring of the contact changes evenly within a step, as in
        `press_axisymmetric`.
        """
        march = _March(self, relaxation_weights(times, mean), times.size)
        for i in range(1, times.size):
            if not march.advance(i, float(way[i])):
                break
        return march.forces


class _March:
    """Indentation and force of a pressed tip, step by step."""

    def __init__(self, tip: PressedTip, weights: Floats, count: int) -> None:
        self._tip, self._weights = tip, weights
        self._depth, self.forces = np.zeros(count), np.zeros(count)
        self._elastic = np.zeros(count)  # elastic force at each indentation
        # changes over each step of indentation and of elastic force
        self._deeper, self._grown = np.zeros(count), np.zeros(count)
        self._widest = 0  # instant of the largest contact

    def advance(self, i: int, way: float) -> bool:
        """Take a step to an instant; False if contact is lost."""
        row = self._weights[i, : i + 1]
        depth, force = self._growing(i, row, way)
        if self._tip.elastic.grows and depth < self._depth[self._widest]:
            shrunk = self._shrinking(i, row, way)
            if shrunk is not None:
                depth, force = shrunk
        else:
            self._widest = i
        if force <= 0:
            return False
        self._depth[i], self.forces[i] = depth, force
        self._deeper[i] = depth - self._depth[i - 1]
        self._elastic[i] = self._tip.elastic.force(abs(depth))
        self._grown[i] = self._elastic[i] - self._elastic[i - 1]
        return True

    def _growing(self, i: int, row: Floats, way: float) -> tuple[float, float]:
        """Indentation [m] and force [N] if the contact grows: by Newton's method, from above."""
        elastic, c = self._tip.elastic, self._tip.spring_compliance
        own, before = float(row[i]), float(self._elastic[i - 1])
        if self._depth[i - 1] < 0:
            before = 0.0
        known = float(row[:i] @ self._grown[:i]) - own * before
        depth = float(max(way, float(self._depth[i - 1]), 1e-300))
        if not elastic.grows:
            unit = elastic.force(1.0)
            depth = (way - c * known) / (1 + c * own * unit)
            return depth, known + own * unit * depth
        for _ in range(_NEWTON_STEPS):
            pressed, slope = elastic.force_and_slope(depth)
            step = (depth + c * (known + own * pressed) - way) / (1 + c * own * slope)
            depth -= step
            if depth <= 0:
                return 0.0, 0.0
            if abs(step) <= 1e-13 * depth:
                break
        return depth, known + own * elastic.force(depth)

    def _shrinking(self, i: int, row: Floats, way: float) -> tuple[float, float] | None:
        """Indentation and force if the contact shrinks, 0 if it is lost; None if it grows."""
        c, last = self._tip.spring_compliance, self._widest + 1
        recovered = np.cumsum(row[:i] * self._deeper[:i])
        # Indentation and force if the contact is as large as at each earlier instant.
        depths = self._depth[i - 1] - (recovered[-1] - recovered[:last]) / row[i]
        forces = np.cumsum(row[:last] * self._grown[:last])
        excess = c * forces + depths - way
        if excess[-1] < 0:
            return None
        if excess[0] >= 0:
            return 0.0, 0.0
        upper = int(np.argmax(excess >= 0))
        share = -excess[upper - 1] / (excess[upper] - excess[upper - 1])
        reached = ((1 - share) * each[upper - 1] + share * each[upper] for each in (depths, forces))
        depth, force = reached
        return float(depth), float(force)


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
    if not np.diag(compliance).all():
        raise ValueError("fit_indentation: the compliance is 0 over a step; the body is rigid")
    inverse = _inverse(compliance)
    weights = np.zeros((n + 1, n + 1))
    # A step's displacement stays: it stands in all later rows, and loads are sums of changes.
    change = np.cumsum(inverse[:, ::-1], axis=1)[:, ::-1]
    np.cumsum(np.tril(change), axis=0, out=weights[1:, 1:])
    return weights


def _inverse(lower: Floats) -> Floats:
    """Inverse of a lower triangular matrix without zeros on the diagonal, by its quarters."""
    n = len(lower)
    if n <= _SMALL:
        return np.tril(np.linalg.inv(lower)) if n else lower
    inverse, half = np.zeros((n, n)), n // 2
    first = inverse[:half, :half] = _inverse(lower[:half, :half])
    last = inverse[half:, half:] = _inverse(lower[half:, half:])
    inverse[half:, :half] = -last @ (lower[half:, :half] @ first)
    return inverse
