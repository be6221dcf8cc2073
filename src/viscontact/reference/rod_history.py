"""What the rods of an axisymmetric contact remember: all their changes of load so far."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.reference.lag_means import LagMean

Array = NDArray[np.float64]


class RodHistory:
    """Changes of load of many rods, of which it recalls the displacement they cause later.

    The only object here that remembers: `recall` what comes next, then `add` what came.

    Parameters
    ----------
    mean : callable
        Mean of the compliance over lags.
    rods, steps : int
        How many rods, and at most so many steps.

    Notes
    -----
    A change that takes from t1 to t2 evenly has at t moved its rod by itself times the mean
    of J over the lags t - t2 to t - t1: no law is asked for more, and none is approximated.
    Most rods change over whole steps, together; those that meet or leave the indenter within
    a step are kept one by one.

    Examples
    --------
    >>> from viscontact.reference.lag_means import lag_mean
    >>> history = RodHistory(lag_mean(lambda t: 1.0 + t), rods=1, steps=1)
    >>> history.add_whole(0.0, 2.0, np.array([3.0]))
    >>> history.recall(4.0).round(12).tolist()
    [12.0]
    """

    def __init__(self, mean: LagMean, rods: int, steps: int) -> None:
        self._mean = mean
        self._begins, self._ends = np.zeros(steps), np.zeros(steps)
        self._changes = np.zeros((steps, rods))
        self._steps = 0
        self._rod = np.zeros(0, dtype=np.intp)
        self._begin, self._end, self._change = np.zeros(0), np.zeros(0), np.zeros(0)

    def add_whole(self, begin: float, end: float, changes: Array) -> None:
        """Add changes of all rods from one instant to another, the same for all [N/m]."""
        k = self._steps
        self._begins[k], self._ends[k], self._changes[k] = begin, end, changes
        self._steps += 1

    def add_single(self, rod: NDArray[np.intp], begin: Array, end: Array, change: Array) -> None:
        """Add changes of single rods, each from and to its own instant [N/m]."""
        self._rod = np.append(self._rod, rod)
        self._begin, self._end = np.append(self._begin, begin), np.append(self._end, end)
        self._change = np.append(self._change, change)

    def recall(self, now: float) -> Array:
        """Displacement of each rod at an instant, owed to all changes so far [m]."""
        k = self._steps
        ends = np.append(self._ends[:k], self._end)
        begins = np.append(self._begins[:k], self._begin)
        means = self._mean(np.maximum(now - ends, 0.0), now - begins)
        whole: Array = means[:k] @ self._changes[:k]
        single = np.bincount(self._rod, self._change * means[k:], minlength=whole.size)
        return whole + single
