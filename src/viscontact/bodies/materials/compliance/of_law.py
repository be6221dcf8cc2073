"""Contact compliance of a body with any creep law."""

from __future__ import annotations

from dataclasses import field

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Law
from viscontact.bodies.materials.compliance.base import ContactCompliance
from viscontact.bodies.materials.compliance.sum import SummedCompliance
from viscontact.units.numbers import store


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
    >>> from viscontact.bodies.laws import Elastic
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

    def scaled(self, factor: float) -> LawCompliance:
        """Return the compliance times a positive factor."""
        return LawCompliance(self.law, factor * self.factor)

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        return SummedCompliance((self,)) + other

    def _creep(self, t: Floats) -> Floats:
        return self.factor * self.law(t)

    def _relaxation(self, t: Floats) -> Floats:
        # G is the inverse of 2 Phi.
        return 2.0 / self.factor * self.law.relaxation(t)

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return self.factor * self.law.mean_creep(start, end)
