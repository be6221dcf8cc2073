"""Base class of contact compliances J(t), which add for two bodies."""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws.creep_function import CreepFunction
from viscontact.bodies.loads.clock import TIME, Clock


class ContactCompliance(CreepFunction):
    """J(t), which replaces (1 - ν)/(2G) of an elastic half-space.

    The compliances of two bodies in contact add.

    Attributes
    ----------
    instant : float
        J(0) [1/Pa].
    """

    instant: float

    @property
    def clock(self) -> Clock:
        """Clock of the creep, TIME without a temperature history or ageing."""
        return TIME

    @property
    def over_reduced_time(self) -> ContactCompliance:
        """J over the reduced time of its clock."""
        return self

    def since(self, applied: Floats, time: float) -> Floats:
        """J at a time of loads that were applied earlier [s]."""
        return np.asarray(self.over_reduced_time(self._ages(applied, time)))

    def mean_since(self, begun: Floats, ended: Floats, time: float) -> Floats:
        """J at a time of loads that rose between earlier times [s], linear in reduced time."""
        ages = self._ages(ended, time), self._ages(begun, time)
        return np.asarray(self.over_reduced_time.mean(*ages))

    def _ages(self, applied: Floats, time: float) -> Floats:
        return self.clock.reduced(np.array(time)) - self.clock.reduced(applied)

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
