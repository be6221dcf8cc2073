"""What every creep law can do, and what those that are finite series can do besides."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:  # only names for type checkers: the series know laws, not laws the series
    from viscontact.laws.series import CreepSeries, RelaxationSeries


class Law(ABC):
    """A linear viscoelastic law in shear: creep compliance and relaxation modulus.

    ``law(t)`` is the creep compliance Phi(t), strain deviator per unit stress deviator, so that
    Phi(0) = 1/(2 G_0); ``law.relaxation(t)`` is the plain shear modulus G(t). The two are
    inverse in the sense 2 s² L[Phi](s) L[G](s) = 1.
    """

    @overload
    def __call__(self, t: float) -> float: ...
    @overload
    def __call__(self, t: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]: ...
    def __call__(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return the creep compliance Phi(t).

        Parameters
        ----------
        t : float or array_like
            Time since the step in stress, >= 0 [s].

        Returns
        -------
        float or ndarray
            Strain deviator per unit stress deviator [1/Pa], of the shape of `t`.

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
        """Return the shear relaxation modulus G(t).

        Parameters
        ----------
        t : float or array_like
            Time since the step in strain, >= 0 [s].

        Returns
        -------
        float or ndarray
            Shear stress per unit shear angle [Pa], of the shape of `t`.

        Raises
        ------
        ValueError
            If a time is negative or NaN, or if the law has no instant compliance: G(t) then
            starts with a Dirac impulse.
        """
        return over_times(self._relaxation, t)

    @abstractmethod
    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]: ...

    @abstractmethod
    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]: ...


class SeriesLaw(Law):
    """A law whose compliance and modulus are finite sums of exponentials."""

    @abstractmethod
    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""

    def relaxation_series(self) -> RelaxationSeries:
        """Return the same law as a series in G; ValueError without instant compliance."""
        return self._series.relaxation_series()

    @cached_property
    def _series(self) -> CreepSeries:
        # Kept, because a series in turn keeps its inverse, which takes a root search.
        return self.creep_series()

    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._series._creep(t)

    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._series._relaxation(t)


def over_times(
    function: Callable[[NDArray[np.float64]], NDArray[np.float64]], t: ArrayLike
) -> float | NDArray[np.float64]:
    """Return `function` at checked times `t` [s]: a float for one time, else an array."""
    times = np.asarray(t, dtype=np.float64)
    wrong = ~(times >= 0)  # true for NaN as well
    if wrong.any():
        raise ValueError(
            f"t: times since the step must be >= 0 s, got {float(times[wrong][0])!r} s; "
            "before the step the function is 0"
        )
    values = function(times)
    return float(values) if times.ndim == 0 else values
