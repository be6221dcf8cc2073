"""Base class of creep laws."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.display import Displayable
from viscontact.units.numbers import positive


@dataclass(frozen=True, eq=False, repr=False)
class Law(Displayable, ABC):
    """A linear viscoelastic law in shear: creep compliance and relaxation modulus.

    ``law(t)`` is the creep compliance Phi(t), strain deviator per unit stress deviator, so that
    Phi(0) = 1/(2 G_0); ``law.relaxation(t)`` is the plain shear modulus G(t). The two are
    inverse in the sense 2 s² L[Phi](s) L[G](s) = 1.

    Examples
    --------
    >>> from viscontact.laws import Maxwell
    >>> law = Maxwell(shear_modulus=1e6, viscosity=2e6)
    >>> law(2.0), round(law.relaxation(2.0))  # 1/(2 G) + t/(2 eta), G exp(-t G/eta)
    (1e-06, 367879)
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
            If a time is negative or NaN, or if G(t) starts with a Dirac impulse, as beside a
            dashpot alone. That of a spring-pot is inf at 0 only.
        """
        return over_times(self._relaxation, t)

    @overload
    def complex_modulus(self, angular_frequency: float) -> complex: ...
    @overload
    def complex_modulus(
        self, angular_frequency: Sequence[float] | NDArray[np.float64]
    ) -> NDArray[np.complex128]: ...
    def complex_modulus(self, angular_frequency: ArrayLike) -> complex | NDArray[np.complex128]:
        """Return the complex shear modulus G* = G' + i G''.

        Parameters
        ----------
        angular_frequency : float or array_like
            ω > 0 [rad/s]; 2π times the frequency in Hz.

        Returns
        -------
        complex or ndarray
            Stress amplitude per amplitude of the shear angle exp(i ω t) [Pa]: the storage
            modulus G' and the loss modulus G'', both >= 0.

        Raises
        ------
        ValueError
            If a frequency is not positive and finite.

        Notes
        -----
        G*(ω) = i ω L[G](i ω) = 1 / (2 i ω L[Phi](i ω)) (Tschoegl 1989,
        The Phenomenological Theory of Linear Viscoelastic Behavior, section 2.2).
        """
        omega = np.asarray(angular_frequency, dtype=np.float64)
        wrong = ~(np.isfinite(omega) & (omega > 0))
        if wrong.any():
            raise ValueError(
                "angular_frequency must be positive and finite, got "
                f"{float(omega[wrong][0])!r} rad/s; the modulus at rest is relaxation(t) at late t"
            )
        values = self._complex_modulus(omega)
        return complex(values) if omega.ndim == 0 else values

    @overload
    def mean_creep(self, start: float, end: float) -> float: ...
    @overload
    def mean_creep(
        self,
        start: Sequence[float] | NDArray[np.float64],
        end: Sequence[float] | NDArray[np.float64],
    ) -> NDArray[np.float64]: ...
    def mean_creep(self, start: ArrayLike, end: ArrayLike) -> float | NDArray[np.float64]:
        """Return the mean of Phi over the times from `start` to `end`.

        It is what a stress that rises linearly over a time `end - start` meets at `start` after
        its rise.

        Parameters
        ----------
        start, end : float or array_like
            Times since the step, 0 <= start <= end [s], of one shape. Where they are equal the
            mean is Phi there.

        Returns
        -------
        float or ndarray
            Mean creep compliance [1/Pa], of the shape of `start`.

        Raises
        ------
        ValueError
            If a time is negative, NaN or infinite, or an end comes before its start.
        """
        return over_intervals(self._mean_creep, start, end)

    @abstractmethod
    def slowed(self, factor: float) -> Law:
        """Return the law with every time multiplied by a factor: Phi(t/factor), G(t/factor).

        Parameters
        ----------
        factor : float
            Time-temperature shift factor a_T > 0 [-]; above 1 the material is slower.

        Returns
        -------
        Law
            The same law, `factor` times slower.

        Raises
        ------
        ValueError
            If the factor is not positive and finite.
        """

    @property
    def measured_until(self) -> float:
        """Last time on which the law rests on data [s]; inf for a formula."""
        return math.inf

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of what is interconverted by numbers [-]; 0 in closed form."""
        return 0.0

    @property
    def creep_error(self) -> float:
        """Of Phi alone, which is all that a contact sees [-]; 0 where it is given."""
        return self.inversion_error

    @abstractmethod
    def _creep(self, t: NDArray[np.float64]) -> NDArray[np.float64]: ...

    @abstractmethod
    def _relaxation(self, t: NDArray[np.float64]) -> NDArray[np.float64]: ...

    @abstractmethod
    def _mean_creep(
        self, start: NDArray[np.float64], end: NDArray[np.float64]
    ) -> NDArray[np.float64]: ...

    @abstractmethod
    def _complex_modulus(self, omega: NDArray[np.float64]) -> NDArray[np.complex128]: ...


def _as_times(name: str, given: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} must be times in s: {error}") from None


def over_times(
    function: Callable[[NDArray[np.float64]], NDArray[np.float64]], t: ArrayLike
) -> float | NDArray[np.float64]:
    """Return `function` at checked times `t` [s]: a float for one time, else an array."""
    times = _as_times("t", t)
    wrong = ~(times >= 0)  # true for NaN as well
    if wrong.any():
        raise ValueError(
            f"t: times since the step must be >= 0 s, got {float(times[wrong][0])!r} s; "
            "before the step the function is 0"
        )
    values = function(times)
    return float(values) if times.ndim == 0 else values


def over_intervals(
    function: Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]],
    start: ArrayLike,
    end: ArrayLike,
) -> float | NDArray[np.float64]:
    """Return `function` over checked intervals of time [s]: a float for one, else an array."""
    starts, ends = np.broadcast_arrays(_as_times("start", start), _as_times("end", end))
    wrong = ~((starts >= 0) & (ends >= starts) & (ends < np.inf))
    if wrong.any():
        raise ValueError(
            "start, end: times since the step must be finite with 0 <= start <= end, got "
            f"{float(starts[wrong][0])!r} s to {float(ends[wrong][0])!r} s"
        )
    values = function(starts, ends)
    return float(values) if starts.ndim == 0 else values


def slowing(factor: float) -> float:
    """Return the factor of `Law.slowed` as a float; ValueError unless positive and finite."""
    return positive("slowed: factor", factor)
