"""Base class of roller profiles (generating lines)."""

from __future__ import annotations

from abc import ABC, abstractmethod

from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.units.display import Displayable


class Profile(Displayable, ABC):
    """The generating line of a roller: how far it drops below its highest point.

    A profile is a shape; the length is the roller's. To add one, write a frozen dataclass with a
    `drop` and an `end`, and a `curvature` if the line is smooth in the middle.

    Examples
    --------
    >>> from viscontact.bodies.indenters import FullCrown
    >>> profile = FullCrown(crown_radius=13.0)
    >>> float(profile.drop(5.0, half_length=6.0)), profile.end(half_length=6.0)
    (1.0, 6.0)
    """

    @abstractmethod
    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the drop of the generating line.

        Parameters
        ----------
        x : array_like
            Positions along the roller, from its middle [m].
        half_length : float
            Half length of the roller; each profile says what it is half the length of [m].

        Returns
        -------
        ndarray
            Not negative, zero at the highest point, +inf beyond the end [m].
        """

    @abstractmethod
    def end(self, half_length: float) -> float:
        """Return the distance from the middle beyond which there is no roller, inf if none [m]."""

    def curvature(self, half_length: float) -> float:
        """Return the curvature in the middle, zero where it means nothing [1/m]."""
        return 0.0

    def require_fit(self, half_length: float) -> None:
        """Raise ValueError if there is no such profile on a roller of this half length [m]."""
        self.drop(0.0, half_length)
