"""Times at which results are requested: uniform, logarithmic, or adaptive."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.numbers import as_real, positive, store, whole

#: Range of the relative error that steps chosen by the run may cause [-].
FINEST_TIME_ERROR, COARSEST_TIME_ERROR = 1e-6, 0.1

#: Upper limit on the number of requested steps.
_MAX_STEPS = 10_000_000


def uniform_times(end: float, n: int) -> Floats:
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
    return np.linspace(0.0, positive("end", end, "s"), _steps(n) + 1)


def log_times(first: float, end: float, n: int) -> Floats:
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
    first, end, n = positive("first", first, "s"), positive("end", end, "s"), _steps(n)
    if first >= end:
        raise ValueError(f"first must be earlier than end, got first={first} s and end={end} s")
    # Backwards from the end, so that the end is exact for every n.
    backwards = np.geomspace(end, first, n)
    return np.concatenate(([0.0], backwards[::-1]))


@dataclass(frozen=True)
class AdaptiveTimes:
    """Times to be chosen by the run itself; made by `adaptive_times`.

    Attributes
    ----------
    end : float
        The last instant, positive [s].
    tolerance : float
        Relative error of pressure and approach that the steps may cause, between 1e-6 and 0.1 [-].

    Raises
    ------
    ValueError
        If the end is not a positive, finite time or the tolerance out of range.
    """

    end: float
    tolerance: float

    def __post_init__(self) -> None:
        allowed = as_real(self.tolerance)
        if allowed is None or not FINEST_TIME_ERROR <= allowed <= COARSEST_TIME_ERROR:
            raise ValueError(f"tolerance must lie between 1e-6 and 0.1, got {self.tolerance!r}")
        store(self, tolerance=allowed, end=positive("end", self.end, "s"))


def adaptive_times(end: float, tolerance: float) -> AdaptiveTimes:
    """Return times that a run chooses by the error of its steps.

    Parameters
    ----------
    end : float
        The last instant, positive [s].
    tolerance : float
        Relative error of pressure and approach that the steps may cause, between 1e-6 and 0.1.

    Returns
    -------
    AdaptiveTimes
        To be given as `times`; the result's ``time`` then holds the steps that were taken, and
        its ``time_error`` an estimate of the error they caused.

    Raises
    ------
    ValueError
        If the end is not a positive, finite time or the tolerance out of range.

    Examples
    --------
    >>> adaptive_times(100.0, tolerance=1e-3)
    AdaptiveTimes(end=100.0, tolerance=0.001)
    """
    return AdaptiveTimes(end, tolerance)


def _steps(n: object) -> int:
    return whole("n, the number of steps,", n, 1, _MAX_STEPS)
