"""Fractional Zener law: a standard solid with a spring-pot as its dashpot."""

from __future__ import annotations

import math
from dataclasses import field, replace

import numpy as np

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.log_curve import narrow_mean
from viscontact.bodies.laws.interconversion.mittag_leffler import mittag_leffler
from viscontact.bodies.laws.law import Law, slowing
from viscontact.bodies.laws.parameter_checks import exponent
from viscontact.bodies.laws.uniaxial import uniaxial
from viscontact.units.numbers import check_fields, non_negative


@dataclass(frozen=True)
class FractionalZener(Law):
    """Fractional standard solid: a spring parallel to a spring and a spring-pot in series.

    G(t) = G_e + (G_g - G_e) E_a(-(t/τ)^a) with the Mittag-Leffler function E_a.

    Parameters
    ----------
    shear_modulus : float
        Instantaneous (glassy) modulus G_g [Pa], above `equilibrium_modulus`.
    equilibrium_modulus : float
        Modulus left after all relaxation, G_e >= 0 [Pa].
    time : float
        Relaxation time τ > 0 [s].
    exponent : float
        a, above 0 and up to 1 (the Zener law) [-].

    Raises
    ------
    ValueError
        If an argument is out of its range, or the moduli are not in that order.

    Notes
    -----
    The creep compliance is Phi = [1/G_g + (1/G_e - 1/G_g) (1 - E_a(-(t/λ)^a))] / 2 with
    λ = τ (G_g/G_e)^(1/a) (Mainardi 2010, Fractional Calculus and Waves in Linear Viscoelasticity,
    section 3.3), computed as X E_(a, 1+a)(-X), which neither cancels at short times nor lacks a
    limit at G_e = 0.

    Examples
    --------
    >>> law = FractionalZener(3e6, 1e6, 2.0, 0.5)
    >>> round(law.relaxation(0.0)), round(law.relaxation(2.0)), round(law(0.0) * 1e6, 6)
    (3000000, 1855167, 0.166667)
    """

    shear_modulus: float = field(metadata={"unit": "Pa"})
    equilibrium_modulus: float = field(metadata={"unit": "Pa"})
    time: float = field(metadata={"unit": "s"})
    exponent: float = field(metadata={"unit": "1"})

    def __post_init__(self) -> None:
        owner = type(self).__name__
        check_fields(self, "shear_modulus", "time")
        check_fields(self, "equilibrium_modulus", check=non_negative)
        check_fields(self, "exponent", check=exponent)
        if not self.equilibrium_modulus < self.shear_modulus:
            raise ValueError(
                f"{owner}: equilibrium_modulus must be below shear_modulus {self.shear_modulus!r} "
                f"Pa, got {self.equilibrium_modulus!r} Pa; the first is left after all relaxation, "
                "the second is the instant modulus"
            )

    @classmethod
    def from_shear(
        cls, shear_modulus: float, equilibrium_modulus: float, time: float, exponent: float
    ) -> FractionalZener:
        """Return the law from shear data, which are what the class takes.

        Parameters
        ----------
        shear_modulus, equilibrium_modulus, time, exponent
            As in the class.

        Returns
        -------
        FractionalZener
            The law.

        Examples
        --------
        >>> FractionalZener.from_shear(3e6, 1e6, 2.0, 0.5).time
        2.0
        """
        return cls(shear_modulus, equilibrium_modulus, time, exponent)

    @classmethod
    def from_uniaxial(
        cls,
        youngs_modulus: float,
        equilibrium_modulus: float,
        time: float,
        exponent: float,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> FractionalZener:
        """Return the law from a tensile relaxation modulus of the same form.

        Parameters
        ----------
        youngs_modulus, equilibrium_modulus : float
            E_g > E_e >= 0 [Pa].
        time, exponent
            As in the class, but in tension.
        poisson_ratio : float, optional
            Constant Poisson's ratio: both moduli are divided by 2 (1 + ν).
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa], above E_g/9: 1/G = 3/E - 1/(3K) for both moduli, with
            another time. Exactly one of the two.

        Returns
        -------
        FractionalZener
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or it is out of range.

        Examples
        --------
        >>> law = FractionalZener.from_uniaxial(9e6, 3e6, 2.0, 0.5, poisson_ratio=0.5)
        >>> round(law.shear_modulus), round(law.equilibrium_modulus), law.time
        (3000000, 1000000, 2.0)
        """
        owner = "FractionalZener.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        given = cls(youngs_modulus, equilibrium_modulus, time, exponent)
        glassy, rest = given.shear_modulus, given.equilibrium_modulus
        modulus = convert.spring(owner, "youngs_modulus", glassy)
        # G_e/E_e, which is finite for E_e = 0. The retardation time stays: λ^a = τ^a E_g/E_e.
        share = 1 / (2 * convert.factor * (1 - convert.volumetric * rest))
        stretch = (share * glassy / modulus) ** (1 / given.exponent)
        return cls(modulus, share * rest, given.time * stretch, given.exponent)

    def slowed(self, factor: float) -> FractionalZener:
        """Return the law with every time multiplied by a factor > 0."""
        return replace(self, time=slowing(factor) * self.time)

    def _relaxation(self, t: Floats) -> Floats:
        relaxed = mittag_leffler((t / self.time) ** self.exponent, self.exponent)
        return np.asarray(
            self.equilibrium_modulus + (self.shear_modulus - self.equilibrium_modulus) * relaxed
        )

    def _creep(self, t: Floats) -> Floats:
        # At infinite time the product would be inf times 0.
        final = 0.5 / self.equilibrium_modulus if self.equilibrium_modulus > 0 else math.inf
        ended = np.isinf(t)
        return np.where(ended, final, self._delayed(np.where(ended, 0.0, t), 1.0))

    def _delayed(self, t: Floats, beta: float) -> Floats:
        """Return Phi (beta 1) or its mean from 0 to t (beta 2)."""
        a, stiff, rest = self.exponent, self.shear_modulus, self.equilibrium_modulus
        x = (t / self.time) ** a
        crept = (1 - rest / stiff) * x * mittag_leffler(x * (rest / stiff), a, beta + a)
        return np.asarray((1 + crept) / (2 * stiff))

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        length = end - start
        area = end * self._delayed(end, 2.0) - start * self._delayed(start, 2.0)
        wide = area / np.where(length > 0, length, 1.0)
        return narrow_mean(self._creep, start, end, otherwise=wide)

    def _complex_modulus(self, omega: Floats) -> Complexes:
        angle = math.pi * self.exponent / 2
        # y e^iφ/(1 + y e^iφ) in real and imaginary part, by the size that stays below 1
        y = (omega * self.time) ** self.exponent
        below = 1 / (1 / y + 2 * math.cos(angle) + y)
        storage, loss = below * (math.cos(angle) + y), below * math.sin(angle)
        rest, relaxing = self.equilibrium_modulus, self.shear_modulus - self.equilibrium_modulus
        return np.asarray(rest + relaxing * storage + 1j * (relaxing * loss))
