"""What every contact compliance J(t) answers, and that two of them add."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.laws.law import over_intervals, over_times


class ContactCompliance(ABC):
    """J(t), in the place where (1 - nu)/(2G) stands for an elastic half-space.

    For two bodies pressed on each other their compliances add.

    Attributes
    ----------
    instant : float
        J(0) [1/Pa].
    """

    instant: float

    @overload
    def __call__(self, t: float) -> float: ...
    @overload
    def __call__(self, t: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]: ...
    def __call__(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return J(t).

        Parameters
        ----------
        t : float or array_like
            Time since the step in pressure, >= 0 [s].

        Returns
        -------
        float or ndarray
            Contact compliance [1/Pa], of the shape of `t`.

        Raises
        ------
        ValueError
            If a time is negative or NaN.
        """
        return over_times(self._creep, t)

    @overload
    def relaxation(self, t: float) -> float: ...
    @overload
    def relaxation(self, t: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]: ...
    def relaxation(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return M(t), the inverse of J: s² L[J](s) L[M](s) = 1.

        Parameters
        ----------
        t : float or array_like
            Time since the step in displacement, >= 0 [s].

        Returns
        -------
        float or ndarray
            Contact modulus [Pa], of the shape of `t`; 2G/(1 - nu) for an elastic body.

        Raises
        ------
        ValueError
            If a time is negative or NaN, or M(t) starts with a Dirac impulse, as beside a dashpot
            without instant compliance.
        """
        return over_times(self._relaxation, t)

    @overload
    def mean(self, start: float, end: float) -> float: ...
    @overload
    def mean(self, start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def mean(self, start: ArrayLike, end: ArrayLike) -> float | NDArray[np.float64]:
        """Return the mean of J over intervals of time, which is what a ramp meets.

        Parameters
        ----------
        start, end : float or array_like
            Times since the step, 0 <= start <= end [s]; where they are equal, J there.

        Returns
        -------
        float or ndarray
            Mean contact compliance [1/Pa].

        Raises
        ------
        ValueError
            If a time is negative or not finite, or an end comes before its start.
        """
        return over_intervals(self._mean, start, end)

    @property
    @abstractmethod
    def settled_after(self) -> float:
        """Time after which creep under a held load is as good as over, or the data end [s].

        Zero for an elastic body, inf where nothing says.
        """

    @property
    def measured_until(self) -> float:
        """Last time on which J rests on data [s]; inf for formulas."""
        return math.inf

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of J where it was interconverted by numbers [-]; 0 if exact."""
        return 0.0

    @abstractmethod
    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""

    @abstractmethod
    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]: ...

    @abstractmethod
    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]: ...

    @abstractmethod
    def _mean(
        self, start: NDArray[np.float64], end: NDArray[np.float64]
    ) -> NDArray[np.float64]: ...
