"""Load history of the rods of an axisymmetric contact."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.reference.lag_means import LagMean


class RodHistory:
    """Load changes of all rods, and the displacement that they cause at later times.

    A change dχ that takes place evenly from t1 to t2 has at t displaced its rod by dχ times the
    mean of J over the lags t - t2 to t - t1: exact for every law. Most rods change over whole
    steps, together; those that meet or leave the indenter within a step are kept one by one.
    """

    def __init__(self, mean: LagMean, rods: int, steps: int) -> None:
        self._mean = mean
        self._begins, self._ends = np.zeros(steps), np.zeros(steps)
        self._changes = np.zeros((steps, rods))
        self._steps = 0
        self._rod = np.zeros(0, dtype=np.intp)
        self._begin, self._end, self._change = np.zeros(0), np.zeros(0), np.zeros(0)

    def add_whole(self, begin: float, end: float, changes: Floats) -> None:
        """Add load changes of all rods over one interval [N/m]."""
        k = self._steps
        self._begins[k], self._ends[k], self._changes[k] = begin, end, changes
        self._steps += 1

    def add_single(self, rod: Integers, begin: Floats, end: Floats, change: Floats) -> None:
        """Add load changes of single rods, each over its own interval [N/m]."""
        self._rod = np.append(self._rod, rod)
        self._begin, self._end = np.append(self._begin, begin), np.append(self._end, end)
        self._change = np.append(self._change, change)

    def displacement_at(self, now: float) -> Floats:
        """Displacement of each rod due to all changes so far [m]."""
        k = self._steps
        ends = np.append(self._ends[:k], self._end)
        begins = np.append(self._begins[:k], self._begin)
        means = self._mean(np.maximum(now - ends, 0.0), now - begins)
        whole: Floats = means[:k] @ self._changes[:k]
        single = np.bincount(self._rod, self._change * means[k:], minlength=whole.size)
        return whole + single
