"""Uncertainty of shift factors: joint covariance, intervals, correlations."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Level of the stated intervals.
CONFIDENCE = 0.95


@dataclass(frozen=True, eq=False)
class ShiftUncertainty:
    """Joint uncertainty of the factors a_T and b_T of several sets, relative to the reference.

    Attributes
    ----------
    covariance : ndarray, shape (2 sets, 2 sets)
        Covariance of ln a_T of all sets and then ln b_T of all sets, infinite for a set that
        nothing connects with the reference temperature.
    freedom : float
        Degrees of freedom of the scatter.
    scatter : mapping of str to float
        Relative scatter of each measured column about the common curve [-].

    Examples
    --------
    >>> about = ShiftUncertainty(np.diag([0.0, 0.01, 0.0, 0.0]), 50.0, {"modulus": 0.01})
    >>> about.decades.round(3).tolist()
    [0.0, 0.087]
    """

    covariance: Floats
    freedom: float
    scatter: Mapping[str, float]

    @property
    def decades(self) -> Floats:
        """Half widths of the 95 % intervals of log10 a_T, shape (sets,)."""
        return np.asarray(self._half_widths[: self._count] / np.log(10.0))

    @property
    def vertical(self) -> Floats:
        """Half widths of the 95 % intervals of ln b_T, shape (sets,): relative ones of b_T."""
        return self._half_widths[self._count :]

    @property
    def correlations(self) -> Floats:
        """Correlation of ln a_T and ln b_T of each set [-]; NaN where one is fixed."""
        variances, count = np.diag(self.covariance), self._count
        with np.errstate(invalid="ignore", divide="ignore"):
            crossed = np.diag(self.covariance[:count, count:])
            return np.asarray(crossed / np.sqrt(variances[:count] * variances[count:]))

    @property
    def _count(self) -> int:
        return len(self.covariance) // 2

    @property
    def _half_widths(self) -> Floats:
        quantile = scipy.stats.t.ppf(0.5 + CONFIDENCE / 2, max(self.freedom, 1.0))
        return np.asarray(quantile * np.sqrt(np.maximum(np.diag(self.covariance), 0.0)))


def relative_to(
    reference: float, temperatures: Floats, logs: Floats, covariance: Floats
) -> tuple[Floats, Floats]:
    """Logarithms ln a and ln b, shape (2, sets), and their covariance, relative to a reference.

    Between two sets a logarithm is straight in temperature.
    """
    count = temperatures.size
    shares = np.array([np.interp(reference, temperatures, row) for row in np.eye(count)])
    relative = np.eye(count) - shares
    both = scipy.linalg.block_diag(relative, relative)
    return logs @ relative.T, np.asarray(both @ covariance @ both.T)
