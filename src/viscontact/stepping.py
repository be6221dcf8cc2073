"""The instants at which results are wanted."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viscontact.real import as_real


def uniform_times(end: float, n: int) -> NDArray[np.float64]:
    """Return evenly spaced instants from 0 to `end`.

    Parameters
    ----------
    end : float
        The last instant, positive [s].
    n : int
        Number of steps, at least 1.

    Returns
    -------
    ndarray
        The instants, shape (n + 1,), the first exactly 0 and the last exactly `end` [s].

    Raises
    ------
    ValueError
        If the end is not a positive, finite time or n not a whole number of at least 1.

    Examples
    --------
    >>> uniform_times(10.0, 4).tolist()
    [0.0, 2.5, 5.0, 7.5, 10.0]
    """
    return np.linspace(0.0, _instant("end", end), _steps(n) + 1)


def log_times(first: float, end: float, n: int) -> NDArray[np.float64]:
    """Return 0, then instants in geometric progression from `first` to `end`.

    Creep under constant load is even in the logarithm of time, and so are these instants.

    Parameters
    ----------
    first : float
        The first instant after 0, positive [s].
    end : float
        The last instant, later than `first` [s].
    n : int
        Number of steps, at least 1; a single step goes from 0 to `end`.

    Returns
    -------
    ndarray
        The instants, shape (n + 1,), the first exactly 0 and the last exactly `end` [s].

    Raises
    ------
    ValueError
        If not 0 < first < end, both finite, or n is not a whole number of at least 1.

    Examples
    --------
    >>> log_times(1.0, 1000.0, 4).round(9).tolist()
    [0.0, 1.0, 10.0, 100.0, 1000.0]
    """
    first, end, n = _instant("first", first), _instant("end", end), _steps(n)
    if first >= end:
        raise ValueError(f"first must be earlier than end, got first={first} s and end={end} s")
    # Backwards from the end, the one instant that is there for every n.
    backwards = np.geomspace(end, first, n)
    return np.concatenate(([0.0], backwards[::-1]))


def _instant(name: str, value: object) -> float:
    instant = as_real(value)
    if instant is None or not (math.isfinite(instant) and instant > 0):
        raise ValueError(f"{name} must be a positive, finite time in s, got {value!r}")
    return instant


def _steps(n: object) -> int:
    steps = as_real(n)
    if steps is None or not (steps.is_integer() and steps >= 1):
        raise ValueError(f"n, the number of steps, must be a whole number >= 1, got {n!r}")
    return int(steps)
