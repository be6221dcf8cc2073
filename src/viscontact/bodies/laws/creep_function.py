"""Base class of creep functions, with checks of the times they are evaluated at."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.units.numbers import real_array


class CreepFunction(ABC):
    """A creep compliance over time, its mean over an interval, and its relaxation modulus.

    Of a creep law, Phi(t) and G(t) in shear; of a contact, J(t) and its inverse M(t).
    """

    @overload
    def __call__(self, t: float) -> float: ...
    @overload
    def __call__(self, t: Sequence[float] | Floats) -> Floats: ...
    def __call__(self, t: ArrayLike) -> float | Floats:
        """Return the creep compliance: Phi(t) of a law, J(t) of a contact.

        Parameters
        ----------
        t : float or array_like
            Time since the step in stress, >= 0 [s].

        Returns
        -------
        float or ndarray
            Creep compliance [1/Pa], of the shape of `t`: of a law, strain deviator per unit
            stress deviator.

        Raises
        ------
        ValueError
            If a time is negative or NaN.
        """
        return _over_times(self._creep, t)

    @overload
    def relaxation(self, t: float) -> float: ...
    @overload
    def relaxation(self, t: Sequence[float] | Floats) -> Floats: ...
    def relaxation(self, t: ArrayLike) -> float | Floats:
        """Return the relaxation modulus: G(t) of a law, M(t) of a contact.

        Parameters
        ----------
        t : float or array_like
            Time since the step in strain or displacement, >= 0 [s].

        Returns
        -------
        float or ndarray
            Modulus [Pa], of the shape of `t`: of a law, shear stress per unit shear angle; of a
            contact, the inverse of J, s² L[J](s) L[M](s) = 1, 2G/(1 - ν) for an elastic body.

        Raises
        ------
        ValueError
            If a time is negative or NaN, or if the modulus starts with a Dirac impulse, as of
            a dashpot alone. That of a spring-pot is inf at 0 only.
        """
        return _over_times(self._relaxation, t)

    @overload
    def mean_creep(self, start: float, end: float) -> float: ...
    @overload
    def mean_creep(
        self,
        start: Sequence[float] | Floats,
        end: Sequence[float] | Floats,
    ) -> Floats: ...
    def mean_creep(self, start: ArrayLike, end: ArrayLike) -> float | Floats:
        """Return the mean creep compliance over the times from `start` to `end`.

        It is the compliance under a stress that rises linearly over a time `end - start`, at
        `start` after its rise.

        Parameters
        ----------
        start, end : float or array_like
            Times since the step, 0 <= start <= end [s], of one shape. Where they are equal the
            mean is the compliance there.

        Returns
        -------
        float or ndarray
            Mean creep compliance [1/Pa], of the shape of `start`.

        Raises
        ------
        ValueError
            If a time is negative, NaN or infinite, or an end comes before its start.
        """
        return _over_intervals(self._mean_creep, start, end)

    @property
    def measured_until(self) -> float:
        """Last time on which the function rests on data [s]; inf for a formula."""
        return math.inf

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of the numerical interconversion [-]; 0 in closed form."""
        return 0.0

    @abstractmethod
    def _creep(self, t: Floats) -> Floats: ...

    @abstractmethod
    def _relaxation(self, t: Floats) -> Floats: ...

    @abstractmethod
    def _mean_creep(self, start: Floats, end: Floats) -> Floats: ...


def _over_times(function: Callable[[Floats], Floats], t: ArrayLike) -> float | Floats:
    """Return `function` at checked times `t` [s]: a float for one time, else an array."""
    times = real_array("t", t, "s")
    wrong = ~(times >= 0)  # true for NaN as well
    if wrong.any():
        raise ValueError(
            f"t: times since the step must be >= 0 s, got {float(times[wrong][0])!r} s; "
            "before the step the function is 0"
        )
    values = function(times)
    return float(values) if times.ndim == 0 else values


def _over_intervals(
    function: Callable[[Floats, Floats], Floats],
    start: ArrayLike,
    end: ArrayLike,
) -> float | Floats:
    """Return `function` over checked intervals of time [s]: a float for one, else an array."""
    starts, ends = np.broadcast_arrays(real_array("start", start, "s"), real_array("end", end, "s"))
    wrong = ~((starts >= 0) & (ends >= starts) & (ends < np.inf))
    if wrong.any():
        raise ValueError(
            "start, end: times since the step must be finite with 0 <= start <= end, got "
            f"{float(starts[wrong][0])!r} s to {float(ends[wrong][0])!r} s"
        )
    values = function(starts, ends)
    return float(values) if starts.ndim == 0 else values
