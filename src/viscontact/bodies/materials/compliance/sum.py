"""Sum of contact compliances, of two bodies or of shear and volume of one."""

from __future__ import annotations

from dataclasses import field

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.volterra import invert
from viscontact.bodies.materials.compliance.base import ContactCompliance
from viscontact.units.numbers import store


@dataclass(frozen=True, eq=False)
class SummedCompliance(ContactCompliance):
    """The sum of several compliances: two bodies, or shear and volume of one.

    Parameters
    ----------
    parts : tuple of ContactCompliance
        The summands.

    Examples
    --------
    >>> from viscontact.bodies.materials.compliance import SeriesCompliance
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

    def scaled(self, factor: float) -> SummedCompliance:
        """Return the compliance times a positive factor."""
        return SummedCompliance(tuple(part.scaled(factor) for part in self.parts))

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        more = other.parts if isinstance(other, SummedCompliance) else (other,)
        return SummedCompliance((*self.parts, *more))

    def _creep(self, t: Floats) -> Floats:
        return np.asarray(sum(part(t) for part in self.parts))

    def _relaxation(self, t: Floats) -> Floats:
        values, _ = invert(self._creep, self._mean_creep, t)
        return values

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return np.asarray(sum(part.mean(start, end) for part in self.parts))
