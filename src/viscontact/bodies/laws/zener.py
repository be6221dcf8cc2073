"""Zener and Burgers laws: with a Kelvin unit, a spring and a dashpot in parallel."""

from __future__ import annotations

from dataclasses import field, replace

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.law import slowing
from viscontact.bodies.laws.series import CreepSeries, SeriesLaw
from viscontact.bodies.laws.uniaxial import uniaxial
from viscontact.units.numbers import check_fields


@dataclass(frozen=True)
class Zener(SeriesLaw):
    """A spring in series with a Kelvin unit, the standard linear solid.

    Phi(t) = [1/G_1 + (1 - exp(-t/τ))/G_2] / 2 with τ = η/G_2.

    Parameters
    ----------
    shear_modulus : float
        G_1 > 0 of the spring, the instantaneous modulus [Pa].
    delayed_modulus : float
        G_2 > 0 of the Kelvin unit's spring [Pa].
    viscosity : float
        η > 0 of the Kelvin unit's dashpot [Pa s].

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Examples
    --------
    >>> law = Zener(shear_modulus=1e9, delayed_modulus=1e9, viscosity=1e10)
    >>> law(0.0), round(law(1e3) * 1e9, 6), round(law.relaxation(1e3) / 1e9, 6)
    (5e-10, 1.0, 0.5)
    """

    shear_modulus: float = field(metadata={"unit": "Pa"})
    delayed_modulus: float = field(metadata={"unit": "Pa"})
    viscosity: float = field(metadata={"unit": "Pa s"})

    def __post_init__(self) -> None:
        check_fields(self, "shear_modulus", "delayed_modulus", "viscosity")

    @classmethod
    def from_shear(cls, shear_modulus: float, delayed_modulus: float, viscosity: float) -> Zener:
        """Return the law from shear data, which are what the class takes.

        Parameters
        ----------
        shear_modulus, delayed_modulus, viscosity : float
            As in the class.

        Returns
        -------
        Zener
            The law.

        Examples
        --------
        >>> Zener.from_shear(1e9, 1e9, 1e10).delayed_modulus
        1000000000.0
        """
        return cls(shear_modulus, delayed_modulus, viscosity)

    @classmethod
    def from_uniaxial(
        cls,
        youngs_modulus: float,
        delayed_modulus: float,
        viscosity: float,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> Zener:
        """Return the law from tensile data, D(t) = 1/E_1 + (1 - exp(-t E_2/η_E))/E_2.

        Parameters
        ----------
        youngs_modulus : float
            E_1 > 0 of the spring [Pa].
        delayed_modulus : float
            E_2 > 0 of the Kelvin unit [Pa].
        viscosity : float
            η_E > 0 of the Kelvin unit in tension [Pa s].
        poisson_ratio : float, optional
            Constant Poisson's ratio: every argument is divided by 2 (1 + ν).
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa], above E_1/9: 1/G_1 = 3/E_1 - 1/(3K), and the Kelvin
            unit is divided by 3. Exactly one of the two.

        Returns
        -------
        Zener
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or it is out of range.

        Examples
        --------
        >>> Zener.from_uniaxial(3e9, 6e9, 3e10, poisson_ratio=0.5).delayed_modulus
        2000000000.0
        """
        owner = "Zener.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        return cls(
            convert.spring(owner, "youngs_modulus", youngs_modulus),
            convert.delayed(owner, "delayed_modulus", delayed_modulus),
            convert.delayed(owner, "viscosity", viscosity, "Pa s"),
        )

    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""
        return CreepSeries(
            0.5 / self.shear_modulus,
            (0.5 / self.delayed_modulus,),
            (self.viscosity / self.delayed_modulus,),
        )

    def slowed(self, factor: float) -> Zener:
        """Return the law with every time multiplied by a factor > 0: a thicker dashpot."""
        return replace(self, viscosity=slowing(factor) * self.viscosity)


@dataclass(frozen=True)
class Burgers(SeriesLaw):
    """A Maxwell and a Kelvin unit in series: instant, delayed and steady creep.

    Phi(t) = [1/G_1 + t/η_1 + (1 - exp(-t/τ))/G_2] / 2 with τ = η_2/G_2.

    Parameters
    ----------
    shear_modulus : float
        G_1 > 0 of the Maxwell unit [Pa].
    viscosity : float
        η_1 > 0 of the Maxwell unit, the steady flow [Pa s].
    delayed_modulus : float
        G_2 > 0 of the Kelvin unit [Pa].
    delayed_viscosity : float
        η_2 > 0 of the Kelvin unit [Pa s].

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Examples
    --------
    >>> law = Burgers(1e9, 1e12, 1e9, 1e10)
    >>> law(0.0), round(law(1e3) * 1e9, 6), round(law.relaxation(0.0) / 1e9, 6)
    (5e-10, 1.5, 1.0)
    """

    shear_modulus: float = field(metadata={"unit": "Pa"})
    viscosity: float = field(metadata={"unit": "Pa s"})
    delayed_modulus: float = field(metadata={"unit": "Pa"})
    delayed_viscosity: float = field(metadata={"unit": "Pa s"})

    def __post_init__(self) -> None:
        check_fields(self, "shear_modulus", "viscosity", "delayed_modulus", "delayed_viscosity")

    @classmethod
    def from_shear(
        cls,
        shear_modulus: float,
        viscosity: float,
        delayed_modulus: float,
        delayed_viscosity: float,
    ) -> Burgers:
        """Return the law from shear data, which are what the class takes.

        Parameters
        ----------
        shear_modulus, viscosity, delayed_modulus, delayed_viscosity : float
            As in the class.

        Returns
        -------
        Burgers
            The law.

        Examples
        --------
        >>> Burgers.from_shear(1e9, 1e12, 1e9, 1e10).viscosity
        1000000000000.0
        """
        return cls(shear_modulus, viscosity, delayed_modulus, delayed_viscosity)

    @classmethod
    def from_uniaxial(
        cls,
        youngs_modulus: float,
        viscosity: float,
        delayed_modulus: float,
        delayed_viscosity: float,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> Burgers:
        """Return the law from tensile data.

        D(t) = 1/E_1 + t/η_E1 + (1 - exp(-t E_2/η_E2))/E_2.

        Parameters
        ----------
        youngs_modulus : float
            E_1 > 0 of the Maxwell unit [Pa].
        viscosity : float
            η_E1 > 0 of the Maxwell unit in tension [Pa s].
        delayed_modulus : float
            E_2 > 0 of the Kelvin unit [Pa].
        delayed_viscosity : float
            η_E2 > 0 of the Kelvin unit in tension [Pa s].
        poisson_ratio : float, optional
            Constant Poisson's ratio: every argument is divided by 2 (1 + ν).
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa], above E_1/9: 1/G_1 = 3/E_1 - 1/(3K), and all else is
            divided by 3. Exactly one of the two.

        Returns
        -------
        Burgers
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or it is out of range.

        Examples
        --------
        >>> Burgers.from_uniaxial(3e9, 3e12, 6e9, 3e10, poisson_ratio=0.5).delayed_modulus
        2000000000.0
        """
        owner = "Burgers.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        return cls(
            convert.spring(owner, "youngs_modulus", youngs_modulus),
            convert.delayed(owner, "viscosity", viscosity, "Pa s"),
            convert.delayed(owner, "delayed_modulus", delayed_modulus),
            convert.delayed(owner, "delayed_viscosity", delayed_viscosity, "Pa s"),
        )

    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""
        return CreepSeries(
            0.5 / self.shear_modulus,
            (0.5 / self.delayed_modulus,),
            (self.delayed_viscosity / self.delayed_modulus,),
            0.5 / self.viscosity,
        )

    def slowed(self, factor: float) -> Burgers:
        """Return the law with every time multiplied by a factor > 0: thicker dashpots."""
        factor = slowing(factor)
        return replace(
            self,
            viscosity=factor * self.viscosity,
            delayed_viscosity=factor * self.delayed_viscosity,
        )
