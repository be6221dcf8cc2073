"""The contact compliance J(t): the one function of time through which a contact sees the bodies."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.laws import Law
from viscontact.laws.arguments import non_negative, series, store
from viscontact.laws.interconversion import (
    RelaxationTerms,
    SeriesTerms,
    creep_function,
    creep_mean,
    merged,
    relaxation_from_creep,
    relaxation_function,
)
from viscontact.laws.law import over_intervals, over_times
from viscontact.laws.volterra import invert


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


@dataclass(frozen=True, eq=False)
class SeriesCompliance(ContactCompliance):
    """J(t) = instant + sum amplitudes (1 - exp(-t/times)) + fluidity t.

    Parameters
    ----------
    instant : float
        J(0) >= 0 [1/Pa].
    amplitudes : array_like
        Delayed compliances >= 0 [1/Pa]. Zeros are dropped.
    times : array_like
        Retardation times > 0 [s], one for each amplitude. Equal times are merged; what is
        stored ascends.
    fluidity : float, optional
        Rate of steady flow >= 0 [1/(Pa s)].

    Raises
    ------
    ValueError
        If a compliance is negative, a time not positive, a value not finite, or lengths differ.

    Examples
    --------
    >>> one = SeriesCompliance(1e-9, [1e-9, 0.0, 1e-9], [2.0, 3.0, 2.0])
    >>> both = one + one
    >>> both.instant, both.amplitudes.tolist(), both.times.tolist()
    (2e-09, [4e-09], [2.0])
    >>> both(0.0), round(both.relaxation(0.0))
    (2e-09, 500000000)
    """

    instant: float
    amplitudes: NDArray[np.float64]
    times: NDArray[np.float64]
    fluidity: float = 0.0

    def __post_init__(self) -> None:
        owner = "SeriesCompliance"
        instant = non_negative(f"{owner}.instant", self.instant, "1/Pa")
        fluidity = non_negative(f"{owner}.fluidity", self.fluidity, "1/(Pa s)")
        amplitudes, times = merged(
            *series(owner, "amplitudes", list(self.amplitudes), list(self.times), "1/Pa")
        )
        amplitudes.flags.writeable = times.flags.writeable = False
        store(self, instant=instant, amplitudes=amplitudes, times=times, fluidity=fluidity)

    @property
    def settled_after(self) -> float:
        """Five of the slowest times [s]; a fluid's is the time of doubling its instant part."""
        times = self.times.tolist()
        if self.fluidity > 0 and self.instant > 0:
            times.append(self.instant / self.fluidity)
        return 5 * max(times, default=0.0)

    def scaled(self, factor: float) -> SeriesCompliance:
        """Return the compliance times a factor."""
        amplitudes = factor * self.amplitudes
        return SeriesCompliance(
            factor * self.instant, amplitudes, self.times, factor * self.fluidity
        )

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        if not isinstance(other, SeriesCompliance):
            return SummedCompliance((self,)) + other
        return SeriesCompliance(
            self.instant + other.instant,
            np.concatenate([self.amplitudes, other.amplitudes]),
            np.concatenate([self.times, other.times]),
            self.fluidity + other.fluidity,
        )

    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return creep_function(self._terms, t)

    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return relaxation_function(self._inverse, t)

    def _mean(self, start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.float64]:
        return creep_mean(self._terms, start, end)

    @property
    def _terms(self) -> SeriesTerms:
        return SeriesTerms(self.instant, self.amplitudes, self.times, self.fluidity)

    @cached_property
    def _inverse(self) -> RelaxationTerms:
        return relaxation_from_creep(*self._terms)


@dataclass(frozen=True, eq=False)
class LawCompliance(ContactCompliance):
    """A factor times the creep compliance Phi(t) of any law.

    Parameters
    ----------
    law : Law
        Creep law in shear.
    factor : float
        Positive; 1 - nu for a constant Poisson's ratio [-].

    Examples
    --------
    >>> from viscontact.laws import Elastic
    >>> LawCompliance(Elastic(1e9), 0.5)(1.0)
    2.5e-10
    """

    law: Law
    factor: float
    instant: float = field(init=False)

    def __post_init__(self) -> None:
        store(self, instant=self.factor * self.law(0.0))

    @property
    def settled_after(self) -> float:
        """The end of the data [s]; inf for a formula."""
        return self.law.measured_until

    @property
    def measured_until(self) -> float:
        """Last time on which J rests on data [s]; inf for formulas."""
        return self.law.measured_until

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of J where it was interconverted by numbers [-]; 0 if exact."""
        return self.law.creep_error

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        return SummedCompliance((self,)) + other

    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.factor * self.law(t)

    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        # G is the inverse of 2 Phi.
        return 2.0 / self.factor * self.law.relaxation(t)

    def _mean(self, start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.factor * self.law.mean_creep(start, end)


@dataclass(frozen=True, eq=False)
class SummedCompliance(ContactCompliance):
    """The sum of several compliances: two bodies, or shear and volume of one.

    Parameters
    ----------
    parts : tuple of ContactCompliance
        The summands.

    Examples
    --------
    >>> both = SummedCompliance((SeriesCompliance(1e-9, [], []), SeriesCompliance(2e-9, [], [])))
    >>> round(both(1.0) * 1e9, 9)
    3.0
    """

    parts: tuple[ContactCompliance, ...]
    instant: float = field(init=False)

    def __post_init__(self) -> None:
        store(self, instant=sum(part.instant for part in self.parts))

    @property
    def settled_after(self) -> float:
        """The longest of the parts' [s]."""
        return max(part.settled_after for part in self.parts)

    @property
    def measured_until(self) -> float:
        """Last time on which all of J rests on data [s]; inf for formulas."""
        return min(part.measured_until for part in self.parts)

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of J where it was interconverted by numbers [-]; 0 if exact."""
        return max(part.inversion_error for part in self.parts)

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        more = other.parts if isinstance(other, SummedCompliance) else (other,)
        return SummedCompliance((*self.parts, *more))

    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(sum(part(t) for part in self.parts))

    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        values, _ = invert(self._creep, self._mean, t)
        return values

    def _mean(self, start: NDArray[np.float64], end: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(sum(part.mean(start, end) for part in self.parts))
