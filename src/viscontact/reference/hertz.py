"""Hertz's elastic point contacts: circular and elliptical.

``contact_modulus`` is E* [Pa] in u = 1/(π E*) * integral of p/r: 1/E* is the sum over both
bodies of (1 - nu²)/E, or the contact compliance J of a law at one instant.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import elliprd, elliprf

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class SphereContact:
    """A sphere, or a paraboloid of revolution, pressed on an elastic half-space.

    Attributes
    ----------
    force : float
        Load, positive into the half-space [N].
    contact_radius : float
        Radius of the contact circle [m].
    approach : float
        Approach of the bodies, positive when they come closer [m].
    peak_pressure : float
        Pressure at the centre, positive in compression [Pa].
    """

    force: float
    contact_radius: float
    approach: float
    peak_pressure: float

    def pressure(self, r: ArrayLike) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        r : array_like
            Distance from the axis [m].

        Returns
        -------
        float or ndarray
            p0 sqrt(1 - r²/a²), zero outside the contact (Johnson 1985, eq. 3.39) [Pa].

        Examples
        --------
        >>> contact = hertz_sphere(force=10.0, radius=0.01, contact_modulus=2e9)
        >>> print(f"{contact.pressure(0.0) / 1e6:.4f} MPa")
        42.6174 MPa
        """
        ratio = real_array("r", r, "m") / self.contact_radius
        return self.peak_pressure * _hemisphere(ratio**2)


def hertz_sphere(force: float, radius: float, contact_modulus: float) -> SphereContact:
    """Contact of a sphere with a half-space.

    Parameters
    ----------
    force : float
        Load, positive into the half-space [N].
    radius : float
        Radius of the sphere, or relative radius of two spheres [m].
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    SphereContact
        Contact radius, approach, peak pressure and the pressure by radius.

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    a³ = 3 F R / (4 E*), approach = a²/R, p0 = 2 E* a / (π R) = 3 F / (2 π a²): exact for the
    paraboloid r²/(2R), which approximates the sphere while a is small against R.

    References
    ----------
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, eqs. 4.22-4.24.

    Examples
    --------
    >>> contact = hertz_sphere(force=10.0, radius=0.01, contact_modulus=2e9)
    >>> print(f"{contact.contact_radius * 1e3:.6f} mm, {contact.approach * 1e6:.5f} um")
    0.334716 mm, 11.20351 um
    """
    require_positive("N", force=force)
    require_positive("m", radius=radius)
    require_positive("Pa", contact_modulus=contact_modulus)
    contact_radius = math.cbrt(3 * force * radius / (4 * contact_modulus))
    return SphereContact(
        force=force,
        contact_radius=contact_radius,
        approach=contact_radius**2 / radius,
        peak_pressure=2 * contact_modulus * contact_radius / (math.pi * radius),
    )


@dataclass(frozen=True)
class EllipticalContact:
    """A paraboloid of two curvatures pressed on an elastic half-space.

    Attributes
    ----------
    force : float
        Load, positive into the half-space [N].
    semi_axis_x, semi_axis_y : float
        Semi-axes of the contact ellipse along x and y [m].
    approach : float
        Approach of the bodies, positive when they come closer [m].
    peak_pressure : float
        Pressure at the centre, positive in compression [Pa].
    """

    force: float
    semi_axis_x: float
    semi_axis_y: float
    approach: float
    peak_pressure: float

    def pressure(self, x: ArrayLike, y: ArrayLike) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        x, y : array_like
            Positions from the centre of the contact, broadcast together [m].

        Returns
        -------
        float or ndarray
            p0 sqrt(1 - x²/a_x² - y²/a_y²), zero outside (Johnson 1985, eq. 3.58) [Pa].

        Examples
        --------
        >>> contact = hertz_elliptical(10.0, radius_x=0.05, radius_y=0.01, contact_modulus=2e9)
        >>> print(f"{contact.pressure(0.0, 0.0) / 1e6:.4f} MPa")
        26.6592 MPa
        """
        along = real_array("x", x, "m") / self.semi_axis_x
        across = real_array("y", y, "m") / self.semi_axis_y
        return self.peak_pressure * _hemisphere(along**2 + across**2)


def hertz_elliptical(
    force: float, radius_x: float, radius_y: float, contact_modulus: float
) -> EllipticalContact:
    """Contact of a paraboloid of two curvatures with a half-space.

    Parameters
    ----------
    force : float
        Load, positive into the half-space [N].
    radius_x, radius_y : float
        Radii of curvature in the planes x-z and y-z, at the deepest point [m].
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    EllipticalContact
        Semi-axes, approach, peak pressure and the pressure by position.

    Raises
    ------
    ValueError
        If an argument is not positive and finite; for an infinite radius there is `hertz_line`.

    Notes
    -----
    The displacement under p0 sqrt(1 - x²/a_x² - y²/a_y²) (Johnson 1985, eqs. 3.58-3.64) is
    written with Carlson's symmetric integrals, free of cancellation at every axis ratio:
    1/R_x = F/(π E*) R_D(0, a_y², a_x²), 1/R_y = F/(π E*) R_D(0, a_x², a_y²),
    approach = 3 F/(2 π E*) R_F(0, a_x², a_y²). The ratio of the first two gives a_x/a_y.

    References
    ----------
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, section 4.2.
    B. C. Carlson, Numer. Algorithms 10 (1995) 13-26, for R_F and R_D.

    Examples
    --------
    >>> contact = hertz_elliptical(10.0, radius_x=0.05, radius_y=0.01, contact_modulus=2e9)
    >>> print(f"{contact.semi_axis_x * 1e3:.5f} mm, {contact.semi_axis_y * 1e3:.5f} mm")
    0.71947 mm, 0.24893 mm
    """
    require_positive("N", force=force)
    require_positive("m", radius_x=radius_x, radius_y=radius_y)
    require_positive("Pa", contact_modulus=contact_modulus)
    kappa = _axis_ratio(radius_x / radius_y)
    b = math.cbrt(force * radius_y / (math.pi * contact_modulus) * elliprd(0.0, kappa**2, 1.0))
    a = kappa * b
    return EllipticalContact(
        force=force,
        semi_axis_x=a,
        semi_axis_y=b,
        approach=float(1.5 * force / (math.pi * contact_modulus * b) * elliprf(0.0, kappa**2, 1.0)),
        peak_pressure=1.5 * force / (math.pi * a * b),
    )


def _axis_ratio(radius_ratio: float) -> float:
    """Axis ratio a_x/a_y of the contact ellipse of bodies with R_x/R_y = ``radius_ratio``."""
    if radius_ratio < 1:
        return 1 / _axis_ratio(1 / radius_ratio)
    wanted = math.log(radius_ratio)

    def excess(log_kappa: float) -> float:
        square = math.exp(2 * log_kappa)
        return math.log(elliprd(0.0, square, 1.0) / elliprd(0.0, 1.0, square)) - wanted

    # The ellipse is less slender than the bodies' curvatures: kappa < R_x/R_y. The margin
    # keeps the bracket open when the two radii differ by rounding only.
    return math.exp(brentq(excess, 0.0, wanted + 1e-6, xtol=1e-15, rtol=1e-15))


def _hemisphere(square: Values) -> Values:
    """Real part of sqrt(1 - square)."""
    height: Values = np.sqrt(np.maximum(1 - square, 0.0))
    return height
