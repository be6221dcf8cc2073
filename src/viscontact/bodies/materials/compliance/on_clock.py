"""Contact compliance of a body whose creep follows a clock."""

from __future__ import annotations

from dataclasses import field

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.clock import Clock
from viscontact.bodies.materials.compliance.base import ContactCompliance
from viscontact.units.numbers import store


@dataclass(frozen=True, eq=False)
class ClockedCompliance(ContactCompliance):
    """J(ξ(t)) over the time since the start of a run, under a load applied there.

    Parameters
    ----------
    law : ContactCompliance
        J over the reduced time.
    ticks : Clock
        Reduced time ξ over time.
    """

    law: ContactCompliance
    ticks: Clock
    instant: float = field(init=False)

    def __post_init__(self) -> None:
        store(self, instant=self.law.instant)

    @property
    def clock(self) -> Clock:
        """Clock of the creep."""
        return self.ticks

    @property
    def over_reduced_time(self) -> ContactCompliance:
        """J over the reduced time."""
        return self.law

    @property
    def settled_after(self) -> float:
        """Time at which the law has settled [s]; inf if it never does."""
        return self.ticks.time_at(self.law.settled_after)

    @property
    def measured_until(self) -> float:
        """Time at which the reduced time reaches the end of the data [s]."""
        return self.ticks.time_at(self.law.measured_until)

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of J where it was interconverted by numbers [-]; 0 if exact."""
        return self.law.inversion_error

    @property
    def is_elastic(self) -> bool:
        """True of a body that is known neither to creep nor to flow."""
        return self.law.is_elastic

    def scaled(self, factor: float) -> ClockedCompliance:
        """Return the compliance times a positive factor."""
        return ClockedCompliance(self.law.scaled(factor), self.ticks)

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the sum with a compliance of the same clock, or of an elastic body."""
        if isinstance(other, ClockedCompliance):
            assert other.clock == self.ticks  # others are separate terms of the surface
            other = other.over_reduced_time
        return ClockedCompliance(self.law + other, self.ticks)

    def _creep(self, t: Floats) -> Floats:
        return self.law(self.ticks.reduced(t))

    def _relaxation(self, t: Floats) -> Floats:
        return self.law.relaxation(self.ticks.reduced(t))

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return self.law.mean(self.ticks.reduced(start), self.ticks.reduced(end))
