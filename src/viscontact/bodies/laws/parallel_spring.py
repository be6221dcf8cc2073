"""A law in parallel with a spring."""

from __future__ import annotations

import math
from dataclasses import field, replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.cached_inverse import Inverse
from viscontact.bodies.laws.interconversion.product_integration import Forcing
from viscontact.bodies.laws.interconversion.volterra import onset
from viscontact.bodies.laws.law import Law, slowing
from viscontact.units.numbers import check_fields

# Ratio of the first node to the onset of creep, so that the start-up error has decayed by then.
_AHEAD = 1e-3
# Decades over which the error is estimated of a law without data, after it has crept as much as
# the spring.
_DECADES = 6


@dataclass(frozen=True)
class BesideSpring(Law):
    """A law in parallel with a spring: equal strains, and the stresses add.

    Parameters
    ----------
    law : Law
        Any law, also one without instant compliance.
    shear_modulus : float
        Modulus of the spring, G_s > 0 [Pa].

    Raises
    ------
    ValueError
        If the law is not one, or the modulus is not positive and finite.

    Notes
    -----
    The relaxation modulus is `law.relaxation(t)` + G_s. With C = 2 Phi the compliance of the law
    alone and c = 1/G_s that of the spring, the pair creeps as B(t), the solution of

        c B(t) + ∫ C(t - t') dB(t') = c C(t),

    which follows from 1/(s L[B]) = 1/(s L[C]) + 1/c. It is solved by numbers (`volterra`), with
    an `inversion_error`, and needs no G(t) of the law: C(0) = 0 will do. A law that is a series
    has an exact answer: add the spring to the `equilibrium` of its `relaxation_series`.

    Examples
    --------
    A Maxwell body in parallel with a spring is a Zener body:

    >>> from viscontact.bodies.laws import Maxwell
    >>> pair = BesideSpring(Maxwell(1e6, 1e6), 1e6)
    >>> round(pair(0.0) * 1e6, 6), round(pair(2.0) * 1e6, 4)
    (0.25, 0.408)
    """

    law: Law
    shear_modulus: float = field(metadata={"unit": "Pa", "name": "modulus of the parallel spring"})

    def __post_init__(self) -> None:
        if not isinstance(self.law, Law):
            raise ValueError(f"BesideSpring: law must be a law such as PowerLaw, got {self.law!r}")
        check_fields(self, "shear_modulus")

    def slowed(self, factor: float) -> BesideSpring:
        """Return the law with every time multiplied by a factor > 0."""
        return replace(self, law=self.law.slowed(slowing(factor)))

    @property
    def measured_until(self) -> float:
        """Last time on which the law rests on data [s]."""
        return self.law.measured_until

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of the numerical solution, creep or relaxation [-]."""
        return max(self._error, self.law.inversion_error)

    @property
    def creep_error(self) -> float:
        """Estimated relative error of Phi alone, solved numerically from that of the law [-]."""
        return max(self._error, self.law.creep_error)

    @cached_property
    def _error(self) -> float:
        end = self.law.measured_until
        if not math.isfinite(end):
            spring = 1 / self.shear_modulus
            crept = onset(lambda t: spring + self._compliance(t), 1.0)
            end = max(crept, self._onset) * 10.0**_DECADES
        return self._inverse.error(self._onset, end)

    def _compliance(self, t: Floats) -> Floats:
        return np.asarray(2 * self.law._creep(t))

    def _mean_compliance(self, start: Floats, end: Floats) -> Floats:
        return np.asarray(2 * self.law._mean_creep(start, end))

    @cached_property
    def _onset(self) -> float:
        """Time up to which the pair is nearly elastic [s]."""
        spring = 1 / self.shear_modulus
        if self._compliance(np.zeros(1))[0] > 0:
            return onset(self._compliance)
        return onset(lambda t: spring + self._compliance(t))

    @cached_property
    def _inverse(self) -> Inverse:
        spring = 1 / self.shear_modulus
        return Inverse(
            lambda t: spring + self._compliance(t),
            lambda start, end: spring + self._mean_compliance(start, end),
            _AHEAD * self._onset,
            1,
            load=Forcing(
                lambda t: spring * self._compliance(t),
                lambda start, end: spring * self._mean_compliance(start, end),
            ),
        )

    def _creep(self, t: Floats) -> Floats:
        early = self._of_springs(self._compliance(np.minimum(t, self._onset)))
        return np.where(t <= self._onset, early, self._inverse(t)) / 2

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        a, b = np.minimum(start, self._onset), np.minimum(end, self._onset)
        early = self._of_springs(self._mean_compliance(a, b))
        late = self._inverse.mean(np.maximum(start, self._onset), np.maximum(end, self._onset))
        share = (b - a) / np.where(end > start, end - start, 1.0)
        share = np.where(end > start, share, start <= self._onset)
        return np.asarray(share * early + (1 - share) * late) / 2

    def _of_springs(self, compliance: Floats) -> Floats:
        """Return the compliance of two springs in parallel, valid at early times."""
        return np.asarray(compliance / (1 + self.shear_modulus * compliance))

    def _relaxation(self, t: Floats) -> Floats:
        return np.asarray(self.law._relaxation(t) + self.shear_modulus)

    def _complex_modulus(self, omega: Floats) -> Complexes:
        return np.asarray(self.law._complex_modulus(omega) + self.shear_modulus)
