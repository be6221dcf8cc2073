"""A material: a creep law in shear and how the body gives in volume, as one compliance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.laws import SeriesLaw
from viscontact.laws.arguments import compressibility, non_negative, series, store
from viscontact.laws.interconversion import (
    RelaxationTerms,
    SeriesTerms,
    creep_function,
    merged,
    relaxation_from_creep,
    relaxation_function,
)
from viscontact.laws.law import over_times


@dataclass(frozen=True, eq=False)
class ContactCompliance:
    """The one function of time through which a contact sees the bodies in it.

    J(t) = instant + sum amplitudes (1 - exp(-t/times)) + fluidity t stands where (1 - nu)/(2G)
    stands for an elastic half-space; for two bodies their compliances add.

    Parameters
    ----------
    instant : float
        J(0) >= 0 [1/Pa].
    amplitudes : array_like
        Delayed compliances >= 0 [1/Pa]. Zeros are dropped.
    times : array_like
        Retardation times > 0 [s], one for each amplitude. Equal times are merged; what is
        stored ascends.
    fluidity : float, optional
        Rate of steady flow >= 0 [1/(Pa s)].

    Raises
    ------
    ValueError
        If a compliance is negative, a time not positive, a value not finite, or lengths differ.

    Examples
    --------
    >>> one = ContactCompliance(1e-9, [1e-9, 0.0, 1e-9], [2.0, 3.0, 2.0])
    >>> both = one + one
    >>> both.instant, both.amplitudes.tolist(), both.times.tolist()
    (2e-09, [4e-09], [2.0])
    >>> both(0.0), round(both.relaxation(0.0))
    (2e-09, 500000000)
    """

    instant: float
    amplitudes: NDArray[np.float64]
    times: NDArray[np.float64]
    fluidity: float = 0.0

    def __post_init__(self) -> None:
        owner = "ContactCompliance"
        instant = non_negative(f"{owner}.instant", self.instant, "1/Pa")
        fluidity = non_negative(f"{owner}.fluidity", self.fluidity, "1/(Pa s)")
        amplitudes, times = merged(
            *series(owner, "amplitudes", list(self.amplitudes), list(self.times), "1/Pa")
        )
        amplitudes.flags.writeable = times.flags.writeable = False
        store(self, instant=instant, amplitudes=amplitudes, times=times, fluidity=fluidity)

    @overload
    def __call__(self, t: float) -> float: ...
    @overload
    def __call__(self, t: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]: ...
    def __call__(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return J(t).

        Parameters
        ----------
        t : float or array_like
            Time since the step in pressure, >= 0 [s].

        Returns
        -------
        float or ndarray
            Contact compliance [1/Pa], of the shape of `t`.

        Raises
        ------
        ValueError
            If a time is negative or NaN.
        """
        return over_times(lambda times: creep_function(self._terms, times), t)

    @overload
    def relaxation(self, t: float) -> float: ...
    @overload
    def relaxation(self, t: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]: ...
    def relaxation(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return M(t), the exact inverse of J: s² L[J](s) L[M](s) = 1.

        Parameters
        ----------
        t : float or array_like
            Time since the step in displacement, >= 0 [s].

        Returns
        -------
        float or ndarray
            Contact modulus [Pa], of the shape of `t`; 2G/(1 - nu) for an elastic body.

        Raises
        ------
        ValueError
            If a time is negative or NaN, or J(0) = 0.
        """
        return over_times(lambda times: relaxation_function(self._inverse, times), t)

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        if not isinstance(other, ContactCompliance):
            return NotImplemented
        return ContactCompliance(
            self.instant + other.instant,
            np.concatenate([self.amplitudes, other.amplitudes]),
            np.concatenate([self.times, other.times]),
            self.fluidity + other.fluidity,
        )

    @property
    def _terms(self) -> SeriesTerms:
        return SeriesTerms(self.instant, self.amplitudes, self.times, self.fluidity)

    @cached_property
    def _inverse(self) -> RelaxationTerms:
        return relaxation_from_creep(*self._terms)


@dataclass(frozen=True)
class Material:
    """A linear viscoelastic material: creep in shear, and what its volume does.

    Parameters
    ----------
    law : Law
        Creep law in shear; one that is a series (all of `viscontact.laws` are).
    poisson_ratio : float, optional
        Constant Poisson's ratio, above -1 and up to 0.5 [-].
    bulk_modulus : float, optional
        Elastic bulk modulus K > 0 [Pa]: Poisson's ratio then varies in time with the law.
        Exactly one of the two must be given.

    Raises
    ------
    ValueError
        If the law is not one, not exactly one of the two is given, or it is out of range.

    Examples
    --------
    >>> from viscontact.laws import Elastic
    >>> rubber = Material(Elastic(shear_modulus=1e6), poisson_ratio=0.5)
    >>> rubber.contact_compliance()(0.0)
    2.5e-07
    """

    law: SeriesLaw
    poisson_ratio: float | None = None
    _: KW_ONLY
    bulk_modulus: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.law, SeriesLaw):
            raise ValueError(
                f"Material.law: must be a creep law such as Zener or CreepSeries, got {self.law!r}"
            )
        ratio, bulk = compressibility("Material", self.poisson_ratio, self.bulk_modulus)
        store(self, poisson_ratio=ratio, bulk_modulus=bulk)

    def contact_compliance(self) -> ContactCompliance:
        """Return the contact compliance J(t) of a half-space of this material.

        Returns
        -------
        ContactCompliance
            J(t) [1/Pa], exact for both kinds of material.

        Notes
        -----
        With a constant Poisson's ratio J(t) = (1 - nu) Phi(t). With an elastic bulk modulus,
        (1 - nu)/(2G) in terms of K and G is, after the correspondence principle with
        G~ = s L[G],

            s L[J] = (3K + 4G~) / (4 G~ (3K + G~)) = 1/(4 G~) + (3/4) / (3K + G~).

        The first part is Phi/2, as 1/G~ = 2 s L[Phi]. The second is a spring 3K beside the
        law, which creeps as a series too.

        Examples
        --------
        With K and G of nu = 0.25 both ways agree:

        >>> from viscontact.laws import Elastic
        >>> law = Elastic(shear_modulus=3e9)
        >>> round(Material(law, poisson_ratio=0.25).contact_compliance()(0.0) * 1e9, 9)
        0.125
        >>> round(Material(law, bulk_modulus=5e9).contact_compliance()(0.0) * 1e9, 9)
        0.125
        """
        phi = self.law.creep_series()
        creep = ContactCompliance(
            phi.instant, np.array(phi.amplitudes), np.array(phi.times), phi.fluidity
        )
        if self.poisson_ratio is not None:
            return _scaled(creep, 1.0 - self.poisson_ratio)
        assert self.bulk_modulus is not None  # exactly one is given
        beside = _beside_spring(_scaled(creep, 2.0), 3.0 * self.bulk_modulus)
        return _scaled(creep, 0.5) + _scaled(beside, 0.75)


def _scaled(creep: ContactCompliance, factor: float) -> ContactCompliance:
    return ContactCompliance(
        factor * creep.instant, factor * creep.amplitudes, creep.times, factor * creep.fluidity
    )


def _beside_spring(creep: ContactCompliance, stiffness: float) -> ContactCompliance:
    """Return the creep of a body whose load is shared by a spring beside it.

    With C = s L[creep] and the spring's compliance c = 1/stiffness, side by side they have
    1/(1/c + 1/C) = c - c²/(c + C). The fraction is a relaxation function: that of the same body
    with the spring in series. This holds for a body without instant compliance as well, whose
    own relaxation modulus is not a series.
    """
    c = 1.0 / stiffness
    in_series = relaxation_from_creep(
        c + creep.instant, creep.amplitudes, creep.times, creep.fluidity
    )
    # Relaxation that is subtracted is creep: -M exp(-t/τ) = M (1 - exp(-t/τ)) - M.
    instant = creep.instant / (1.0 + stiffness * creep.instant)
    return ContactCompliance(instant, c * c * in_series.moduli, in_series.times)
