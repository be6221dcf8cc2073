"""Laws that are sums of exponentials (Prony series), in creep or in relaxation."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import field, replace
from functools import cached_property
from typing import Self

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.oscillation import (
    modulus_of_creep,
    modulus_of_relaxation,
)
from viscontact.bodies.laws.interconversion.series import (
    RelaxationTerms,
    SeriesTerms,
    creep_from_relaxation,
    creep_function,
    creep_mean,
    merged,
    relaxation_from_creep,
    relaxation_function,
)
from viscontact.bodies.laws.law import Law, slowing
from viscontact.bodies.laws.parameter_checks import check_series
from viscontact.bodies.laws.uniaxial import uniaxial
from viscontact.units.numbers import check_fields, non_negative


class SeriesLaw(Law):
    """A law whose compliance and modulus are finite sums of exponentials."""

    @abstractmethod
    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""

    def relaxation_series(self) -> RelaxationSeries:
        """Return the same law as a series in G; ValueError without instant compliance."""
        return self._series.relaxation_series()

    @abstractmethod
    def slowed(self, factor: float) -> Self:
        """Return the law with every time multiplied by a factor > 0: Phi(t/factor)."""

    @cached_property
    def _series(self) -> CreepSeries:
        # Kept, because a series in turn keeps its inverse, which takes a root search.
        return self.creep_series()

    def _creep(self, t: Floats) -> Floats:
        return self._series._creep(t)

    def _relaxation(self, t: Floats) -> Floats:
        return self._series._relaxation(t)

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return creep_mean(self._series.terms, start, end)

    def _complex_modulus(self, omega: Floats) -> Complexes:
        return modulus_of_creep(self._series.terms, omega)


@dataclass(frozen=True)
class CreepSeries(SeriesLaw):
    """A creep series, Phi(t) = J_0 + sum_i J_i (1 - exp(-t/τ_i)) + φ t.

    Parameters
    ----------
    instant : float
        Instantaneous compliance J_0 = 1/(2 G_0) >= 0 [1/Pa]. Zero is a law that cannot follow a
        jump of the load.
    amplitudes : sequence of float
        Delayed compliances J_i >= 0 [1/Pa].
    times : sequence of float
        Retardation times τ_i > 0 [s], one for each amplitude, in any order.
    fluidity : float, optional
        Rate of steady flow, φ = 1/(2 η) >= 0 [1/(Pa s)].

    Raises
    ------
    ValueError
        If a compliance is negative, a time not positive, a value not finite, the lengths
        differ, or every compliance is 0.

    Notes
    -----
    All compliances are strain deviator per unit stress deviator. From data as a rheometer
    gives them (1/G) use `from_shear`, from tensile data (1/E) use `from_uniaxial`.

    Examples
    --------
    >>> law = CreepSeries(1e-9, [2e-9], [10.0])
    >>> law(0.0), round(law(10.0) * 1e9, 6), round(law.relaxation(0.0))
    (1e-09, 2.264241, 500000000)
    """

    instant: float = field(metadata={"unit": "1/Pa", "name": "instant compliance"})
    amplitudes: Sequence[float] = field(metadata={"unit": "1/Pa", "name": "delayed compliances"})
    times: Sequence[float] = field(metadata={"unit": "s", "name": "retardation times"})
    fluidity: float = field(default=0.0, metadata={"unit": "1/(Pa s)"})

    def __post_init__(self) -> None:
        check_fields(self, "instant", "fluidity", check=non_negative)
        check_series(self, "amplitudes")
        if not any((self.instant, self.fluidity, *self.amplitudes)):
            raise ValueError(
                "CreepSeries: instant, amplitudes and fluidity are all 0, which is a rigid body; "
                "give at least one positive compliance"
            )

    @classmethod
    def from_shear(
        cls,
        instant: float,
        amplitudes: Sequence[float],
        times: Sequence[float],
        fluidity: float = 0.0,
    ) -> CreepSeries:
        """Return the law from a rheometer's compliance, shear angle per shear stress.

        Parameters
        ----------
        instant, amplitudes, times, fluidity
            As in the class, but in terms of 1/G [1/Pa] and 1/eta [1/(Pa s)]: Phi is half of it.

        Returns
        -------
        CreepSeries
            The law in terms of Phi.

        Examples
        --------
        >>> CreepSeries.from_shear(2e-9, [4e-9], [10.0])
        CreepSeries(instant=1e-09, amplitudes=(2e-09,), times=(10.0,), fluidity=0.0)
        """
        given = cls(instant, amplitudes, times, fluidity)
        return given._scaled_series(0.5, 0.5 * given.instant)

    @classmethod
    def from_uniaxial(
        cls,
        instant: float,
        amplitudes: Sequence[float],
        times: Sequence[float],
        fluidity: float = 0.0,
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> CreepSeries:
        """Return the law from a tensile compliance D, strain per stress.

        Parameters
        ----------
        instant, amplitudes, times, fluidity
            As in the class, but in terms of D, with D(0) = 1/E_0 [1/Pa].
        poisson_ratio : float, optional
            Constant Poisson's ratio, above -1 and up to 0.5: Phi = (1 + ν) D.
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa]: Phi = (3/2) (D - 1/(9K)). Exactly one of the two.

        Returns
        -------
        CreepSeries
            The law in terms of Phi.

        Raises
        ------
        ValueError
            If not exactly one is given, or K is so small that Phi(0) would be negative.

        Examples
        --------
        >>> law = CreepSeries.from_uniaxial(2e-9, [4e-9], [10.0], poisson_ratio=0.5)
        >>> round(law.instant * 1e9, 6), round(law.amplitudes[0] * 1e9, 6)
        (3.0, 6.0)
        """
        convert = uniaxial("CreepSeries.from_uniaxial", poisson_ratio, bulk_modulus)
        given = cls(instant, amplitudes, times, fluidity)
        return given._scaled_series(
            convert.factor, convert.instant("CreepSeries.from_uniaxial", given.instant)
        )

    def creep_series(self) -> CreepSeries:
        """Return the law itself."""
        return self

    def relaxation_series(self) -> RelaxationSeries:
        """Return the same law as a series in G; ValueError without instant compliance."""
        return RelaxationSeries(
            self._inverse.equilibrium, tuple(self._inverse.moduli), tuple(self._inverse.times)
        )

    def slowed(self, factor: float) -> CreepSeries:
        """Return the law with every time multiplied by a factor > 0, and flow divided by it."""
        factor = slowing(factor)
        times = tuple(factor * time for time in self.times)
        return replace(self, times=times, fluidity=self.fluidity / factor)

    def _scaled_series(self, factor: float, instant: float) -> CreepSeries:
        amplitudes = tuple(factor * a for a in self.amplitudes)
        return CreepSeries(instant, amplitudes, self.times, factor * self.fluidity)

    @cached_property
    def terms(self) -> SeriesTerms:
        """The series as arrays, times ascending, equal times merged, zeros left out."""
        return SeriesTerms(self.instant, *merged(self.amplitudes, self.times), self.fluidity)

    @cached_property
    def _inverse(self) -> RelaxationTerms:
        # G is the inverse of 1/G = 2 Phi: the convention's factor 2 is put in here.
        instant, amplitudes, times, fluidity = self.terms
        return relaxation_from_creep(2 * instant, 2 * amplitudes, times, 2 * fluidity)

    def _creep(self, t: Floats) -> Floats:
        return creep_function(self.terms, t)

    def _relaxation(self, t: Floats) -> Floats:
        return relaxation_function(self._inverse, t)


@dataclass(frozen=True)
class RelaxationSeries(SeriesLaw):
    """A relaxation (Prony) series, G(t) = G_inf + sum_i G_i exp(-t/τ_i).

    Parameters
    ----------
    equilibrium : float
        Shear modulus left after all relaxation, G_inf >= 0 [Pa]; 0 for a fluid.
    moduli : sequence of float
        Shear moduli G_i >= 0 that relax [Pa].
    times : sequence of float
        Relaxation times τ_i > 0 [s], one for each modulus, in any order.

    Raises
    ------
    ValueError
        If a modulus is negative, a time not positive, a value not finite, the lengths differ,
        or every modulus is 0.

    Examples
    --------
    >>> law = RelaxationSeries(1e9, [2e9], [1.0])
    >>> law.relaxation(0.0), round(law(0.0) * 1e9, 6)
    (3000000000.0, 0.166667)
    """

    equilibrium: float = field(metadata={"unit": "Pa"})
    moduli: Sequence[float] = field(metadata={"unit": "Pa"})
    times: Sequence[float] = field(metadata={"unit": "s", "name": "relaxation times"})

    def __post_init__(self) -> None:
        check_fields(self, "equilibrium", check=non_negative)
        check_series(self, "moduli")
        if not any((self.equilibrium, *self.moduli)):
            raise ValueError(
                "RelaxationSeries: equilibrium and moduli are all 0, which resists nothing; "
                "give at least one positive modulus"
            )

    @classmethod
    def from_shear(
        cls, equilibrium: float, moduli: Sequence[float], times: Sequence[float]
    ) -> RelaxationSeries:
        """Return the law from shear moduli, which are what the class takes.

        Parameters
        ----------
        equilibrium, moduli, times
            As in the class.

        Returns
        -------
        RelaxationSeries
            The law.

        Examples
        --------
        >>> RelaxationSeries.from_shear(1e9, [2e9], [1.0]).equilibrium
        1000000000.0
        """
        return cls(equilibrium, moduli, times)

    @classmethod
    def from_uniaxial(
        cls,
        equilibrium: float,
        moduli: Sequence[float],
        times: Sequence[float],
        *,
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> RelaxationSeries:
        """Return the law from a tensile relaxation modulus E(t).

        Parameters
        ----------
        equilibrium, moduli, times
            As in the class, but in terms of E [Pa].
        poisson_ratio : float, optional
            Constant Poisson's ratio, above -1 and up to 0.5: G = E / (2 (1 + ν)).
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa], above E(0)/9; G(t) is then the exact inverse of
            3 D(t) - 1/(3K), with other times than E(t). Exactly one of the two.

        Returns
        -------
        RelaxationSeries
            The law in terms of G.

        Raises
        ------
        ValueError
            If not exactly one is given, or K is not above E(0)/9.

        Examples
        --------
        >>> RelaxationSeries.from_uniaxial(3e9, [6e9], [1.0], poisson_ratio=0.5).moduli
        (2000000000.0,)
        """
        owner = "RelaxationSeries.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        given = cls(equilibrium, moduli, times)
        if convert.volumetric == 0:
            factor = 2 * convert.factor
            return cls(given.equilibrium / factor, [m / factor for m in given.moduli], given.times)
        convert.spring(owner, "E(0)", given.equilibrium + sum(given.moduli))
        creep = creep_from_relaxation(given.equilibrium, given.moduli, given.times)
        return CreepSeries.from_uniaxial(
            creep.instant,
            tuple(creep.amplitudes),
            tuple(creep.times),
            creep.fluidity,
            bulk_modulus=bulk_modulus,
        ).relaxation_series()

    def creep_series(self) -> CreepSeries:
        """Return the same law as a series in Phi."""
        instant, amplitudes, times, fluidity = self._inverse
        return CreepSeries(instant, tuple(amplitudes), tuple(times), fluidity)

    def relaxation_series(self) -> RelaxationSeries:
        """Return the law itself."""
        return self

    def slowed(self, factor: float) -> RelaxationSeries:
        """Return the law with every time multiplied by a factor > 0."""
        factor = slowing(factor)
        return replace(self, times=tuple(factor * time for time in self.times))

    @cached_property
    def _terms(self) -> RelaxationTerms:
        return RelaxationTerms(self.equilibrium, *merged(self.moduli, self.times))

    @cached_property
    def _inverse(self) -> SeriesTerms:
        # Phi is half the inverse of G: the convention's factor 2 is put in here.
        instant, amplitudes, times, fluidity = creep_from_relaxation(*self._terms)
        return SeriesTerms(instant / 2, amplitudes / 2, times, fluidity / 2)

    def _creep(self, t: Floats) -> Floats:
        return creep_function(self._inverse, t)

    def _relaxation(self, t: Floats) -> Floats:
        return relaxation_function(self._terms, t)

    def _complex_modulus(self, omega: Floats) -> Complexes:
        return modulus_of_relaxation(self._terms, omega)
