"""Elastic spheres that adhere: JKR and Maugis-Dugdale.

``compliance`` is the contact compliance 1/E* [1/Pa]. Forces, radii and approaches are made
dimensionless by pi w R, (pi w R^2/K)^(1/3) and (pi^2 w^2 R/K^2)^(1/3), K = 4 E*/3 (Maugis 1992).
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import require_positive

#: Largest ratio of the outer radius of the cohesive zone to that of the contact, for brackets.
_LARGEST_RATIO = 1e6


@dataclass(frozen=True)
class AdhesiveState:
    """State of an adhering sphere.

    Attributes
    ----------
    force : float
        Force, negative in tension [N].
    approach : float
        Approach, negative when the sphere is pulled out [m].
    contact_radius : float
        Radius of the contact [m].
    """

    force: float
    approach: float
    contact_radius: float


@dataclass(frozen=True)
class AdhesiveSphere:
    """A sphere that adheres to an elastic half-space, by the law of Dugdale or in the JKR limit.

    Attributes
    ----------
    radius : float
        Radius of the sphere [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].
    range : float
        Range of Dugdale's law, work over strength [m]; 0 in the limit of Johnson, Kendall and
        Roberts.
    """

    radius: float
    compliance: float
    work: float
    range: float

    @property
    def _modulus(self) -> float:
        return 4 / (3 * self.compliance)

    @property
    def _force(self) -> float:
        return math.pi * self.work * self.radius

    @property
    def _length(self) -> float:
        return float(np.cbrt(math.pi * self.work * self.radius**2 / self._modulus))

    @property
    def _depth(self) -> float:
        return self._length**2 / self.radius

    @property
    def _maugis(self) -> float:
        """Maugis's parameter λ = 2 σ0 (R/(π w K²))^(1/3)."""
        strength = self.work / self.range
        return 2 * strength * float(np.cbrt(self.radius / (math.pi * self.work * self._modulus**2)))

    def at_radius(self, contact_radius: float) -> AdhesiveState:
        """State of a contact radius, stable or not [m].

        Examples
        --------
        >>> state = jkr_sphere(radius=1e-6, compliance=1e-6, work=0.05).at_radius(1e-7)
        >>> print(f"{state.force * 1e9:.2f} nN")
        -34.12 nN
        """
        a = contact_radius / self._length
        if self.range == 0:
            force, approach = a**3 - a * math.sqrt(6 * a), a**2 - 2 / 3 * math.sqrt(6 * a)
        else:
            m = self._ratio(a)
            root, angle = math.sqrt(m**2 - 1), math.acos(1 / m)
            force = a**3 - self._maugis * a**2 * (root + m**2 * angle)
            approach = a**2 - 4 / 3 * a * self._maugis * root
        return AdhesiveState(force * self._force, approach * self._depth, contact_radius)

    def _ratio(self, a: float) -> float:
        """Outer over inner radius of the cohesive zone (Maugis 1992, eq. 6.14)."""
        lam = self._maugis

        def lacking(excess: float) -> float:
            m = 1 + excess
            root, angle = math.sqrt(m**2 - 1), math.acos(1 / m)
            first = lam * a**2 / 2 * (root + (m**2 - 2) * angle)
            return first + 4 * lam**2 * a / 3 * (1 - m + root * angle) - 1

        return 1 + float(brentq(lacking, 1e-14, _LARGEST_RATIO, xtol=1e-15, rtol=1e-13))

    @property
    def pull_off(self) -> AdhesiveState:
        """State of least force, at which a contact under a given force ends."""
        found = minimize_scalar(
            lambda log: self.at_radius(math.exp(log)).force / self._force,
            bounds=(math.log(1e-3 * self._length), math.log(3 * self._length)),
            method="bounded",
            options={"xatol": 1e-9},
        )
        return self.at_radius(math.exp(found.x))

    @property
    def last(self) -> AdhesiveState:
        """State of least approach, at which a contact under a given approach ends."""
        found = minimize_scalar(
            lambda log: self.at_radius(math.exp(log)).approach / self._depth,
            bounds=(math.log(1e-3 * self._length), math.log(3 * self._length)),
            method="bounded",
            options={"xatol": 1e-9},
        )
        return self.at_radius(math.exp(found.x))

    def at_approach(self, approach: float) -> AdhesiveState:
        """State of an approach on the branch that ends at `last` [m]."""
        least = self.last
        if approach <= least.approach:
            raise ValueError(f"approach must be above {least.approach} m, got {approach}")
        largest = 10 * (self._length + math.sqrt(self.radius * abs(approach)))
        found = brentq(
            lambda a: self.at_radius(a).approach - approach,
            least.contact_radius,
            largest,
            xtol=1e-13 * largest,
        )
        return self.at_radius(float(found))


def jkr_sphere(radius: float, compliance: float, work: float) -> AdhesiveSphere:
    """Sphere that adheres at once, by attraction of no range.

    Parameters
    ----------
    radius : float
        Radius of the sphere, or relative radius of two spheres [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].

    Returns
    -------
    AdhesiveSphere
        States by contact radius or approach, and pull-off at the force -3/2 π w R (K. L. Johnson,
        K. Kendall & A. D. Roberts 1971, Proc. R. Soc. A 324, 301).

    Raises
    ------
    ValueError
        If an argument is not positive.

    Examples
    --------
    >>> print(f"{jkr_sphere(radius=1e-6, compliance=1e-6, work=0.05).pull_off.force * 1e9:.1f} nN")
    -235.6 nN
    """
    _require_positive(radius, compliance, work)
    return AdhesiveSphere(radius, compliance, work, 0.0)


def maugis_dugdale(radius: float, compliance: float, work: float, range: float) -> AdhesiveSphere:
    """Sphere that is attracted by a constant traction up to a gap.

    Parameters
    ----------
    radius : float
        Radius of the sphere, or relative radius of two spheres [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].
    range : float
        Largest gap of the attraction, of the strength work/range [m].

    Returns
    -------
    AdhesiveSphere
        States by contact radius or approach, and pull-off (D. Maugis 1992, J. Colloid Interface
        Sci. 150, 243, eqs. 6.14 to 6.18).

    Raises
    ------
    ValueError
        If an argument is not positive.

    Examples
    --------
    >>> sphere = maugis_dugdale(radius=1e-6, compliance=1e-6, work=0.05, range=1e-9)
    >>> print(f"{sphere.pull_off.force * 1e9:.1f} nN")
    -235.6 nN
    """
    _require_positive(radius, compliance, work)
    require_positive("m", range=range)
    return AdhesiveSphere(radius, compliance, work, range)


def tabor_number(radius: float, compliance: float, work: float, range: float) -> float:
    """Tabor number of a sphere: below about 0.1 DMT's limit applies, above about 5 JKR's.

    Parameters
    ----------
    radius : float
        Radius of the sphere, or relative radius of two spheres [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].
    range : float
        Range of the attraction, work over strength [m].

    Returns
    -------
    float
        (R w²/(E*² rho³))^(1/3) with the range rho (D. Tabor 1977, J. Colloid Interface Sci. 58, 2);
        Maugis's λ is 1.1273 times this number.

    Raises
    ------
    ValueError
        If an argument is not positive.

    Examples
    --------
    >>> print(f"{tabor_number(radius=20e-9, compliance=1e-8, work=0.05, range=0.5e-9):.2f}")
    3.42
    """
    _require_positive(radius, compliance, work)
    require_positive("m", range=range)
    return float(np.cbrt(radius * (work * compliance) ** 2)) / range


def _require_positive(radius: float, compliance: float, work: float) -> None:
    require_positive("m", radius=radius)
    require_positive("1/Pa", compliance=compliance)
    require_positive("J/m^2", work=work)
