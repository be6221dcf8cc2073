"""Base class of contact compliances J(t), which add for two bodies."""

from __future__ import annotations

from abc import abstractmethod

from viscontact.bodies.laws.creep_function import CreepFunction


class ContactCompliance(CreepFunction):
    """J(t), which replaces (1 - ν)/(2G) of an elastic half-space.

    The compliances of two bodies in contact add.

    Attributes
    ----------
    instant : float
        J(0) [1/Pa].
    """

    instant: float

    # The mean under its older name.
    mean = CreepFunction.mean_creep

    @property
    @abstractmethod
    def settled_after(self) -> float:
        """Time after which creep under a held load is negligible, or the data end [s].

        Zero for an elastic body, inf where it is unknown.
        """

    @property
    def is_elastic(self) -> bool:
        """True of a body that is known neither to creep nor to flow."""
        return False

    @abstractmethod
    def scaled(self, factor: float) -> ContactCompliance:
        """Return the compliance times a positive factor."""

    @abstractmethod
    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
