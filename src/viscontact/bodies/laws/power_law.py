"""Power-law creep, with or without instant compliance."""

from __future__ import annotations

import math
from dataclasses import field, replace

import numpy as np
import scipy

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.log_curve import mean_power
from viscontact.bodies.laws.interconversion.mittag_leffler import mittag_leffler
from viscontact.bodies.laws.interconversion.oscillation import half_inverse
from viscontact.bodies.laws.law import Law, slowing
from viscontact.bodies.laws.parameter_checks import exponent
from viscontact.bodies.laws.uniaxial import uniaxial
from viscontact.units.numbers import check_fields, non_negative


@dataclass(frozen=True)
class PowerLaw(Law):
    """A creep compliance that grows as a power of time, Phi(t) = J_0 + J (t/τ)^n.

    Parameters
    ----------
    compliance : float
        Delayed compliance at the reference time, J > 0 [1/Pa].
    exponent : float
        n, above 0 and up to 1 [-].
    reference_time : float
        τ > 0 [s].
    instant : float, optional
        Instantaneous compliance J_0 >= 0 [1/Pa]. Zero, as in atomic force microscopy of cells, is a
        law that cannot follow a jump of the load.

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Notes
    -----
    L[Phi] = J_0/s + J Γ(1+n) τ^-n s^-(1+n), so that without instant compliance

        G(t) = (t/τ)^-n / (2 J Γ(1+n) Γ(1-n)),

    and with it

        G(t) = E_n(-Γ(1+n) (J/J_0) (t/τ)^n) / (2 J_0),

    E_n being the Mittag-Leffler function (Mainardi 2010, Fractional Calculus and Waves in Linear
    Viscoelasticity, section 3.2).

    Examples
    --------
    >>> law = PowerLaw(1e-3, 0.5, 1.0)
    >>> law(0.0), law(4.0), round(law.relaxation(4.0), 4)
    (0.0, 0.002, 159.1549)
    """

    compliance: float = field(metadata={"unit": "1/Pa"})
    exponent: float = field(metadata={"unit": "1"})
    reference_time: float = field(metadata={"unit": "s"})
    instant: float = field(default=0.0, metadata={"unit": "1/Pa", "name": "instant compliance"})

    def __post_init__(self) -> None:
        check_fields(self, "compliance", "reference_time")
        check_fields(self, "exponent", check=exponent)
        check_fields(self, "instant", check=non_negative)

    @classmethod
    def from_shear(
        cls, compliance: float, exponent: float, reference_time: float, instant: float = 0.0
    ) -> PowerLaw:
        """Return the law from a rheometer's compliance, shear angle per shear stress.

        Parameters
        ----------
        compliance, exponent, reference_time, instant
            As in the class, but the compliances in terms of 1/G [1/Pa]: Phi is half of it.

        Returns
        -------
        PowerLaw
            The law in terms of Phi.

        Examples
        --------
        >>> PowerLaw.from_shear(2e-3, 0.5, 1.0).compliance
        0.001
        """
        given = cls(compliance, exponent, reference_time, instant)
        return replace(given, compliance=given.compliance / 2, instant=given.instant / 2)

    @classmethod
    def from_uniaxial(
        cls,
        compliance: float,
        exponent: float,
        reference_time: float,
        instant: float = 0.0,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> PowerLaw:
        """Return the law from a tensile compliance D, strain per stress.

        Parameters
        ----------
        compliance, exponent, reference_time, instant
            As in the class, but the compliances in terms of D [1/Pa].
        poisson_ratio : float, optional
            Constant Poisson's ratio, above -1 and up to 0.5: Phi = (1 + ν) D.
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa]: Phi = (3/2) (D - 1/(9K)). Exactly one of the two.

        Returns
        -------
        PowerLaw
            The law in terms of Phi.

        Raises
        ------
        ValueError
            If not exactly one is given, or K is so small that Phi(0) would be negative: without
            an instant tensile compliance any K is.

        Examples
        --------
        >>> round(PowerLaw.from_uniaxial(2e-3, 0.5, 1.0, poisson_ratio=0.5).compliance, 9)
        0.003
        """
        owner = "PowerLaw.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        given = cls(compliance, exponent, reference_time, instant)
        return replace(
            given,
            compliance=convert.factor * given.compliance,
            instant=convert.instant(owner, given.instant),
        )

    def slowed(self, factor: float) -> PowerLaw:
        """Return the law with every time multiplied by a factor > 0."""
        return replace(self, reference_time=slowing(factor) * self.reference_time)

    def _creep(self, t: Floats) -> Floats:
        grown = (t / self.reference_time) ** self.exponent
        return np.asarray(self.instant + self.compliance * grown)

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        grown = mean_power(self.exponent, start / self.reference_time, end / self.reference_time)
        return np.asarray(self.instant + self.compliance * grown)

    def _relaxation(self, t: Floats) -> Floats:
        n, ratio = self.exponent, t / self.reference_time
        if self.instant > 0:
            strength = math.gamma(1 + n) * self.compliance / self.instant
            relaxed = mittag_leffler(strength * ratio**n, n)
            return np.asarray(relaxed / (2 * self.instant))
        if n == 1:
            raise ValueError(
                "PowerLaw.instant: a relaxation modulus needs an instant compliance > 0 with a "
                "dashpot (exponent 1), got 0.0 1/Pa; without one a step in strain takes an "
                "infinite stress (a Dirac impulse)"
            )
        with np.errstate(divide="ignore"):  # infinite at t = 0
            powers = ratio**-n
        gammas = scipy.special.rgamma(1 + n) * scipy.special.rgamma(1 - n)
        return np.asarray(powers * (gammas / (2 * self.compliance)))

    def _complex_modulus(self, omega: Floats) -> Complexes:
        n = self.exponent
        size = self.compliance * math.gamma(1 + n) * (omega * self.reference_time) ** -n
        storage, loss = math.cos(math.pi * n / 2), math.sin(math.pi * n / 2)
        return half_inverse(self.instant + size * storage, size * loss)
