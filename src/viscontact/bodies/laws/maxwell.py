"""Elastic and Maxwell laws: a spring; a spring and a dashpot in series."""

from __future__ import annotations

from dataclasses import field, replace

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.law import slowing
from viscontact.bodies.laws.series import CreepSeries, SeriesLaw
from viscontact.bodies.laws.uniaxial import uniaxial
from viscontact.units.numbers import check_fields


@dataclass(frozen=True)
class Elastic(SeriesLaw):
    """A spring: Phi = 1/(2G).

    Parameters
    ----------
    shear_modulus : float
        G > 0 [Pa].

    Raises
    ------
    ValueError
        If the modulus is not positive and finite.

    Examples
    --------
    >>> law = Elastic(shear_modulus=1e9)
    >>> law(0.0), round(law.relaxation(0.0))
    (5e-10, 1000000000)
    """

    shear_modulus: float = field(metadata={"unit": "Pa"})

    def __post_init__(self) -> None:
        check_fields(self, "shear_modulus")

    @classmethod
    def from_shear(cls, shear_modulus: float) -> Elastic:
        """Return the law from its shear modulus, which is what the class takes.

        Parameters
        ----------
        shear_modulus : float
            As in the class.

        Returns
        -------
        Elastic
            The law.

        Examples
        --------
        >>> Elastic.from_shear(1e9)
        Elastic(shear_modulus=1000000000.0)
        """
        return cls(shear_modulus)

    @classmethod
    def from_uniaxial(
        cls,
        youngs_modulus: float,
        poisson_ratio: float | None = None,
        *,
        bulk_modulus: float | None = None,
    ) -> Elastic:
        """Return the law from Young's modulus.

        Parameters
        ----------
        youngs_modulus : float
            E > 0 [Pa].
        poisson_ratio : float, optional
            Above -1 and up to 0.5: G = E / (2 (1 + ν)).
        bulk_modulus : float, optional
            K [Pa], above E/9: G = 3 K E / (9 K - E). Exactly one of the two.

        Returns
        -------
        Elastic
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or it is out of range.

        Examples
        --------
        >>> round(Elastic.from_uniaxial(3e9, poisson_ratio=0.5).shear_modulus)
        1000000000
        """
        owner = "Elastic.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        return cls(convert.spring(owner, "youngs_modulus", youngs_modulus))

    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""
        return CreepSeries(0.5 / self.shear_modulus, (), ())

    def slowed(self, factor: float) -> Elastic:
        """Return the law itself, which has no time in it; ValueError unless the factor is > 0."""
        slowing(factor)
        return self


@dataclass(frozen=True)
class Maxwell(SeriesLaw):
    """A spring and a dashpot in series: Phi(t) = [1/G + t/η] / 2, G(t) = G exp(-t G/η).

    Parameters
    ----------
    shear_modulus : float
        G > 0 of the spring [Pa].
    viscosity : float
        η > 0 of the dashpot [Pa s].

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Examples
    --------
    >>> law = Maxwell(shear_modulus=1e9, viscosity=1e10)
    >>> law(0.0), law(10.0), round(law.relaxation(10.0) / 1e9, 6)
    (5e-10, 1e-09, 0.367879)
    """

    shear_modulus: float = field(metadata={"unit": "Pa"})
    viscosity: float = field(metadata={"unit": "Pa s"})

    def __post_init__(self) -> None:
        check_fields(self, "shear_modulus", "viscosity")

    @classmethod
    def from_shear(cls, shear_modulus: float, viscosity: float) -> Maxwell:
        """Return the law from shear data, which are what the class takes.

        Parameters
        ----------
        shear_modulus, viscosity : float
            As in the class.

        Returns
        -------
        Maxwell
            The law.

        Examples
        --------
        >>> Maxwell.from_shear(1e9, 1e10).viscosity
        10000000000.0
        """
        return cls(shear_modulus, viscosity)

    @classmethod
    def from_uniaxial(
        cls,
        youngs_modulus: float,
        viscosity: float,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> Maxwell:
        """Return the law from tensile data, D(t) = 1/E + t/η_E.

        Parameters
        ----------
        youngs_modulus : float
            E > 0 of the spring [Pa].
        viscosity : float
            Tensile viscosity η_E > 0, stress per rate of strain in steady flow [Pa s].
        poisson_ratio : float, optional
            Constant Poisson's ratio: G = E / (2 (1 + ν)), η = η_E / (2 (1 + ν)).
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa], above E/9: 1/G = 3/E - 1/(3K), η = η_E / 3.
            Exactly one of the two.

        Returns
        -------
        Maxwell
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or it is out of range.

        Examples
        --------
        >>> law = Maxwell.from_uniaxial(3e9, 3e10, poisson_ratio=0.5)
        >>> round(law.shear_modulus), law.viscosity
        (1000000000, 10000000000.0)
        """
        owner = "Maxwell.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        return cls(
            convert.spring(owner, "youngs_modulus", youngs_modulus),
            convert.delayed(owner, "viscosity", viscosity, "Pa s"),
        )

    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""
        return CreepSeries(0.5 / self.shear_modulus, (), (), 0.5 / self.viscosity)

    def slowed(self, factor: float) -> Maxwell:
        """Return the law with every time multiplied by a factor > 0: a thicker dashpot."""
        return replace(self, viscosity=slowing(factor) * self.viscosity)
