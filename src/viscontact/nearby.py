"""What the instants around each have: the largest, the least, the mean."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Instants on both sides.
AROUND = 3


def _windows(values: NDArray[Any], reach: int) -> Array:
    padded = np.pad(np.asarray(values, dtype=float), reach, constant_values=np.nan)
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1))


def largest_around(values: NDArray[Any], reach: int = AROUND) -> Array:
    """Return the largest value of the instants around each; NaN where none of them has one.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Over the instants.
    reach : int
        How many on both sides count.

    Examples
    --------
    >>> largest_around(np.array([1.0, np.nan, 5.0, 2.0, 0.0]), reach=1)
    array([1., 5., 5., 5., 2.])
    """
    return np.asarray(np.fmax.reduce(_windows(values, reach), axis=1))


def least_around(values: NDArray[Any]) -> Array:
    """Return the least value of the instants around each; NaN where none of them has one.

    Examples
    --------
    >>> least_around(np.array([1.0, np.nan, 5.0]))
    array([1., 1., 1.])
    """
    return np.asarray(np.fmin.reduce(_windows(values, AROUND), axis=1))


def mean_around(values: Array) -> Array:
    """Return the mean of the instants around each that have a value; 0 where none has one.

    Examples
    --------
    >>> mean_around(np.array([1.0, np.nan, 5.0]))
    array([3., 3., 3.])
    """
    windows = _windows(values, AROUND)
    known = np.isfinite(windows)
    return np.asarray(np.where(known, windows, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1))
