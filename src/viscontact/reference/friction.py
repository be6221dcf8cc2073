"""A sphere on an elastic half-space under friction: partial slip after Cattaneo and Mindlin.

Exact at a Poisson's ratio of 0, where tractions have the direction of the force; else those across
it are neglected, which takes a tenth of a percent of the shift at a ratio of 1/2.
"""

from __future__ import annotations

import numpy as np
import scipy  # its quadrature is imported at its first use
from numpy.typing import ArrayLike

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.hertz import SphereContact, hertz_sphere
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class PartialSlip:
    """A sphere that was pressed on a half-space, and is then pulled along it.

    Attributes
    ----------
    normal : SphereContact
        The contact under the normal force.
    coefficient : float
        Coefficient of friction [-].
    contact_modulus : float
        E*, of a rigid ball E/(1 - ν²) [Pa].
    poisson_ratio : float
        Of the half-space [-].
    force : float
        Tangential force [N].
    """

    normal: SphereContact
    coefficient: float
    contact_modulus: float
    poisson_ratio: float
    force: float

    @property
    def stick_radius(self) -> float:
        """Radius of the part that sticks, a (1 - Q/(μ W))^(1/3) [m]."""
        left = 1 - self.force / self._limit
        return float(self.normal.contact_radius * left ** (1 / 3))

    @property
    def displacement(self) -> float:
        """Rigid shift of the ball along the force [m]."""
        return self._virgin(self.force)

    @property
    def heat_of_cycle(self) -> float:
        """Heat of friction of a cycle of the force between -Q and Q [J]."""
        # From a reversal on, the shift is twice the virgin curve at half the change of the force.
        force = self.force

        def width(at: float) -> float:
            return 2 * self._virgin(force) - 2 * sum(
                self._virgin((force + sign * at) / 2) for sign in (-1, 1)
            )

        return float(abs(scipy.integrate.quad(width, -force, force)[0]))

    def traction(self, r: ArrayLike) -> Values:
        """Traction along the force [Pa].

        Parameters
        ----------
        r : array_like
            Distance from the axis [m].

        Returns
        -------
        float or ndarray
            Friction times Hertz's pressure less that of the part that sticks, zero outside [Pa].

        Examples
        --------
        >>> slip = cattaneo_mindlin(10.0, 0.01, 2e9, 1.5, 0.3)
        >>> print(f"{slip.traction(0.9 * slip.normal.contact_radius) / 1e6:.2f} MPa")
        5.57 MPa
        """
        r = real_array("r", r, "m")
        peak, radius = self.normal.peak_pressure, self.normal.contact_radius
        parts = [np.sqrt(np.maximum(edge**2 - r**2, 0.0)) for edge in (radius, self.stick_radius)]
        found = self.coefficient * peak / radius * (parts[0] - parts[1])
        return np.float64(found) if found.ndim == 0 else found

    @property
    def _limit(self) -> float:
        """Force that friction carries [N]."""
        return self.coefficient * self.normal.force

    def _virgin(self, force: float) -> float:
        """Shift under a force that has grown from zero [m]."""
        # 3 μ W (2 - ν)/(16 a G) [1 - (1 - Q/(μ W))^(2/3)] with G = (1 - ν) E*/2.
        ratio, radius = self.poisson_ratio, self.normal.contact_radius
        factor = (2 - ratio) / (1 - ratio) * 2 / self.contact_modulus
        left = 1 - force / self._limit
        return float(3 * self._limit / (16 * radius) * factor * (1 - left ** (2 / 3)))


def cattaneo_mindlin(
    force: float,
    radius: float,
    contact_modulus: float,
    tangential_force: float,
    coefficient: float,
    poisson_ratio: float = 0.0,
) -> PartialSlip:
    """Return a rigid sphere that is pressed on an elastic half-space, then pulled along it.

    Parameters
    ----------
    force : float
        Normal force W [N].
    radius : float
        Radius of the sphere [m].
    contact_modulus : float
        E*, for a rigid sphere E/(1 - ν²) [Pa].
    tangential_force : float
        Force along the surface, below μ W [N].
    coefficient : float
        Coefficient of friction μ [-].
    poisson_ratio : float, optional
        Of the half-space; the solution is exact at 0 [-].

    Returns
    -------
    PartialSlip
        The contact.

    Raises
    ------
    ValueError
        If a number is not positive, or the force beyond what friction carries.

    References
    ----------
    K. L. Johnson, Contact Mechanics (1985), eqs. 7.40 to 7.42; R. D. Mindlin and H. Deresiewicz,
    J. Appl. Mech. 20 (1953) 327, for the heat of a cycle.

    Examples
    --------
    >>> slip = cattaneo_mindlin(10.0, 0.01, 2e9, 1.5, 0.3)
    >>> print(f"{slip.stick_radius / slip.normal.contact_radius:.4f}")
    0.7937
    >>> print(f"{slip.displacement * 1e6:.4f} µm")
    1.2437 µm
    """
    require_positive("1", coefficient=coefficient)
    require_positive("N", tangential_force=tangential_force)
    normal = hertz_sphere(force, radius, contact_modulus)
    if tangential_force >= coefficient * force:
        raise ValueError(
            f"tangential_force must be below coefficient times force, {coefficient * force:g} N, "
            f"got {tangential_force:g} N: the sphere slides"
        )
    return PartialSlip(normal, coefficient, contact_modulus, poisson_ratio, tangential_force)
