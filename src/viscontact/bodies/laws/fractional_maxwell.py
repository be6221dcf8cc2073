"""Fractional Maxwell law: two spring-pots in series.

The stress of a spring-pot is G τ^a times the a-th derivative of the strain in time, 0 <= a <= 1:
between a spring and a dashpot.
"""

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
class FractionalMaxwell(Law):
    """Two spring-pots in series; with second exponent 0, a spring and a spring-pot.

    Phi(t) = [(t/τ)^b/Γ(1+b) + (t/τ)^a/Γ(1+a)] / (2G).

    Parameters
    ----------
    shear_modulus : float
        G > 0 [Pa].
    time : float
        τ > 0 at which both have crept alike [s].
    exponent : float
        a, of the spring-pot that flows late, above b and up to 1 [-].
    second_exponent : float, optional
        b, of the one that creeps early, from 0 (a spring) on [-]. Above 0 there is no instant
        compliance: such a law cannot follow a jump of the load.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the exponents are not in that order.

    Notes
    -----
    G(t) = G (t/τ)^-b E_(a-b, 1-b)(-(t/τ)^(a-b)) with the Mittag-Leffler function (Schiessel,
    Metzler, Blumen & Nonnenmacher 1995, J. Phys. A 28, 6567).

    Examples
    --------
    >>> law = FractionalMaxwell(1e6, 2.0, 0.5)
    >>> law(0.0), round(law(2.0) * 1e6, 6), round(law.relaxation(2.0))
    (5e-07, 1.06419, 427584)
    """

    shear_modulus: float = field(metadata={"unit": "Pa"})
    time: float = field(metadata={"unit": "s"})
    exponent: float = field(metadata={"unit": "1"})
    second_exponent: float = field(default=0.0, metadata={"unit": "1"})

    def __post_init__(self) -> None:
        owner = type(self).__name__
        check_fields(self, "shear_modulus", "time")
        check_fields(self, "exponent", check=exponent)
        check_fields(self, "second_exponent", check=non_negative)
        if not self.second_exponent < self.exponent:
            raise ValueError(
                f"{owner}: second_exponent must be below exponent {self.exponent!r}, got "
                f"{self.second_exponent!r}; a law with one exponent alone is PowerLaw"
            )

    @classmethod
    def from_shear(
        cls, shear_modulus: float, time: float, exponent: float, second_exponent: float = 0.0
    ) -> FractionalMaxwell:
        """Return the law from shear data, which are what the class takes.

        Parameters
        ----------
        shear_modulus, time, exponent, second_exponent
            As in the class.

        Returns
        -------
        FractionalMaxwell
            The law.

        Examples
        --------
        >>> FractionalMaxwell.from_shear(1e6, 2.0, 0.5).shear_modulus
        1000000.0
        """
        return cls(shear_modulus, time, exponent, second_exponent)

    @classmethod
    def from_uniaxial(
        cls,
        youngs_modulus: float,
        time: float,
        exponent: float,
        second_exponent: float = 0.0,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> FractionalMaxwell:
        """Return the law from tensile data, D(t) = [(t/τ)^b/Γ(1+b) + (t/τ)^a/Γ(1+a)] / E.

        Parameters
        ----------
        youngs_modulus : float
            E > 0 [Pa].
        time, exponent, second_exponent
            As in the class, but in tension.
        poisson_ratio : float, optional
            Constant Poisson's ratio: G = E / (2 (1 + ν)).
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa], above E/9, for a spring and a spring-pot only:
            1/G = 3/E - 1/(3K), with another time. Exactly one of the two.

        Returns
        -------
        FractionalMaxwell
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or it is out of range.

        Examples
        --------
        >>> law = FractionalMaxwell.from_uniaxial(3e6, 2.0, 0.5, poisson_ratio=0.5)
        >>> round(law.shear_modulus)
        1000000
        """
        owner = "FractionalMaxwell.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        given = cls(youngs_modulus, time, exponent, second_exponent)
        if convert.volumetric == 0:
            return replace(given, shear_modulus=given.shear_modulus / (2 * convert.factor))
        if given.second_exponent > 0:
            raise ValueError(
                f"{owner}: bulk_modulus needs an instant tensile compliance to come from, but "
                f"with second_exponent {given.second_exponent!r} there is none; give poisson_ratio"
            )
        modulus = convert.spring(owner, "youngs_modulus", given.shear_modulus)
        stretch = (given.shear_modulus / (3 * modulus)) ** (1 / given.exponent)
        return replace(given, shear_modulus=modulus, time=given.time * stretch)

    def slowed(self, factor: float) -> FractionalMaxwell:
        """Return the law with every time multiplied by a factor > 0."""
        return replace(self, time=slowing(factor) * self.time)

    def _creep(self, t: Floats) -> Floats:
        ratio = t / self.time
        crept = sum(ratio**n * float(scipy.special.rgamma(1 + n)) for n in self._exponents)
        return np.asarray(crept / (2 * self.shear_modulus))

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        a, b = start / self.time, end / self.time
        gammas = [float(scipy.special.rgamma(1 + n)) for n in self._exponents]
        crept = sum(mean_power(n, a, b) * g for n, g in zip(self._exponents, gammas, strict=True))
        return np.asarray(crept / (2 * self.shear_modulus))

    def _relaxation(self, t: Floats) -> Floats:
        a, b, ratio = self.exponent, self.second_exponent, t / self.time
        with np.errstate(divide="ignore"):  # infinite at t = 0
            early = ratio**-b
        relaxed = mittag_leffler(ratio ** (a - b), a - b, 1 - b)
        return np.asarray(self.shear_modulus * early * relaxed)

    def _complex_modulus(self, omega: Floats) -> Complexes:
        sizes = [(n, (omega * self.time) ** -n / (2 * self.shear_modulus)) for n in self._exponents]
        storage = sum(size * math.cos(math.pi * n / 2) for n, size in sizes)
        loss = sum(size * math.sin(math.pi * n / 2) for n, size in sizes)
        return half_inverse(np.asarray(storage), np.asarray(loss))

    @property
    def _exponents(self) -> tuple[float, float]:
        return self.second_exponent, self.exponent
