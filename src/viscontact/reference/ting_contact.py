"""Contact that grows and shrinks as a function of time: the methods common to Ting's solutions."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.reference.values import Values
from viscontact.units.numbers import real_array


def over_times(function: Callable[[Floats], Floats], t: ArrayLike) -> Values:
    """Values of a function of one-dimensional times at times of any shape [s]."""
    times = real_array("t", t, "s")
    values: Values = function(times.ravel()).reshape(times.shape)[()]
    return values


class TingContact(ABC):
    """Axisymmetric contact on a viscoelastic half-space, pressed and withdrawn."""

    def contact_radius(self, t: ArrayLike) -> Values:
        """Radius of the contact circle, 0 without contact [m].

        Parameters
        ----------
        t : array_like
            Time, from 0 to the end of the history [s].

        Returns
        -------
        float or ndarray
            The radius [m].
        """
        return over_times(self._contact_radius, t)

    def force(self, t: ArrayLike) -> Values:
        """Force on the half-space, 0 without contact [N].

        Parameters
        ----------
        t : array_like
            Time, from 0 to the end of the history [s].

        Returns
        -------
        float or ndarray
            The force [N].
        """
        return over_times(self._force, t)

    @abstractmethod
    def _contact_radius(self, t: Floats) -> Floats:
        """Radius of the contact at times in a line [m]."""

    @abstractmethod
    def _force(self, t: Floats) -> Floats:
        """Force at times in a line [N]."""


class SinglePress(TingContact):
    """Contact that grows once and shrinks once."""

    def earlier(self, t: ArrayLike) -> Values:
        """Instant of growing contact with the same contact radius, Ting's t_1 [s].

        Parameters
        ----------
        t : array_like
            Time, from 0 to the end of the history [s].

        Returns
        -------
        float or ndarray
            t_1, t itself while the contact grows, 0 after contact is lost [s].
        """
        return over_times(self._earlier_instants, t)

    @abstractmethod
    def _earlier_instants(self, t: Floats) -> Floats:
        """Instants of equal radius during growth at times in a line [s]."""
