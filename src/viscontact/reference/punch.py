"""Rigid axisymmetric punches on an elastic half-space: the flat-ended cylinder and the cone.

``contact_modulus`` is E* [Pa] in u = 1/(π E*) * integral of p/r, as in `hertz`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class FlatPunchContact:
    """A rigid round punch with a flat end, pressed on an elastic half-space.

    Attributes
    ----------
    force : float
        Load, positive into the half-space [N].
    eccentricity : float
        Distance of the load from the axis, along x [m].
    contact_radius : float
        Radius of the punch [m].
    approach : float
        Approach on the axis, positive when the bodies come closer [m].
    tilt_x : float
        Slope of the punch along x, positive when it presses the +x side deeper [rad].
    """

    force: float
    eccentricity: float
    contact_radius: float
    approach: float
    tilt_x: float

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        x, y : array_like
            Positions from the axis, broadcast together [m].

        Returns
        -------
        float or ndarray
            F/(2 π a) (1 + 3 e x/a²)/sqrt(a² - r²); infinite at the edge, zero outside [Pa].

        Examples
        --------
        >>> punch = flat_punch(100.0, 0.005, 2e9, eccentricity=0.001)
        >>> print(f"{punch.pressure(0.0) / 1e6:.6f} MPa")
        0.636620 MPa
        """
        x, y = np.broadcast_arrays(real_array("x", x, "m"), real_array("y", y, "m"))
        a = self.contact_radius
        square = a**2 - (x**2 + y**2)
        lean = 1 + 3 * self.eccentricity * x / a**2
        with np.errstate(divide="ignore", invalid="ignore"):
            # At the largest eccentricity the far edge point has 0/0: its pressure is 0.
            p = np.where((square >= 0) & (lean > 0), lean / np.sqrt(square), 0.0)
        p *= self.force / (2 * math.pi * a)
        return p[()]


def flat_punch(
    force: float, radius: float, contact_modulus: float, eccentricity: float = 0.0
) -> FlatPunchContact:
    """Contact of a rigid round flat-ended punch with a half-space, central or eccentric.

    Parameters
    ----------
    force : float
        Load, positive into the half-space [N].
    radius : float
        Radius of the punch [m].
    contact_modulus : float
        E* [Pa].
    eccentricity : float, optional
        Distance of the load from the axis, along x; at most a third of the radius [m].

    Returns
    -------
    FlatPunchContact
        Approach, tilt and the pressure by position.

    Raises
    ------
    ValueError
        If force, radius or modulus is not positive and finite, or if the eccentricity is
        beyond a third of the radius: the formula would give tension at the far edge, where
        the real punch lifts off.

    Notes
    -----
    approach = F/(2 a E*), tilt = 3 F e/(4 a³ E*). The tilt follows from the pressure
    2 E* tilt x / (π sqrt(a² - r²)): along every chord it integrates to π times its numerator at
    mid-chord, so its displacement is tilt * x; its moment is 4 E* a³ tilt / 3.

    References
    ----------
    I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47-57, for the central load. The eccentric one is
    derived in the Notes; that the pressure tilts the surface so is checked in the tests.

    Examples
    --------
    >>> punch = flat_punch(100.0, 0.005, 2e9, eccentricity=0.001)
    >>> print(f"{punch.approach * 1e6:.3f} um, {punch.tilt_x * 1e3:.3f} mrad")
    5.000 um, 0.300 mrad
    """
    require_positive("N", force=force)
    require_positive("m", radius=radius)
    require_positive("Pa", contact_modulus=contact_modulus)
    if not abs(eccentricity) <= radius / 3:
        raise ValueError(
            f"eccentricity: wanted at most a third of the radius, {radius / 3:.6g} m, "
            f"got {eccentricity!r} m; beyond it the far edge lifts off and no closed form holds"
        )
    return FlatPunchContact(
        force=force,
        eccentricity=eccentricity,
        contact_radius=radius,
        approach=force / (2 * radius * contact_modulus),
        tilt_x=3 * force * eccentricity / (4 * radius**3 * contact_modulus),
    )


@dataclass(frozen=True)
class ConeContact:
    """A rigid cone pressed, point down, on an elastic half-space.

    Attributes
    ----------
    force : float
        Load, positive into the half-space [N].
    contact_radius : float
        Radius of the contact circle [m].
    approach : float
        Approach of the bodies, positive when they come closer [m].
    mean_pressure : float
        Force over contact area, the same at every load [Pa].
    """

    force: float
    contact_radius: float
    approach: float
    mean_pressure: float

    def pressure(self, r: ArrayLike) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        r : array_like
            Distance from the axis [m].

        Returns
        -------
        float or ndarray
            p_mean arccosh(a/r), infinite on the axis, zero outside (Sneddon 1965) [Pa].

        Examples
        --------
        >>> contact = cone(10.0, half_angle=math.radians(85), contact_modulus=2e9)
        >>> print(f"{contact.pressure(contact.contact_radius / 2) / 1e6:.4f} MPa")
        115.2189 MPa
        """
        with np.errstate(divide="ignore"):
            ratio = self.contact_radius / np.abs(real_array("r", r, "m"))
        p: Values = self.mean_pressure * np.arccosh(np.maximum(ratio, 1.0))
        return p


def cone(force: float, half_angle: float, contact_modulus: float) -> ConeContact:
    """Contact of a rigid cone with a half-space.

    Parameters
    ----------
    force : float
        Load, positive into the half-space [N].
    half_angle : float
        Angle from the axis to the flank, between 0 and π/2 [rad].
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    ConeContact
        Contact radius, approach, mean pressure and the pressure by radius.

    Raises
    ------
    ValueError
        If force or modulus is not positive and finite, or the angle not between 0 and π/2.

    Notes
    -----
    For the gap r cot(half_angle): F = π E* cot a² / 2, approach = π a cot / 2,
    p = (E* cot / 2) arccosh(a/r).

    References
    ----------
    A. E. H. Love, Q. J. Math. 10 (1939) 161-175;
    I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47-57.

    Examples
    --------
    >>> contact = cone(10.0, half_angle=math.radians(85), contact_modulus=2e9)
    >>> print(f"{contact.contact_radius * 1e3:.6f} mm, {contact.approach * 1e6:.4f} um")
    0.190743 mm, 26.2132 um
    """
    require_positive("N", force=force)
    require_positive("Pa", contact_modulus=contact_modulus)
    if not 0 < half_angle < math.pi / 2:
        raise ValueError(
            f"half_angle: wanted an angle from the axis between 0 and pi/2 rad, got {half_angle!r}"
        )
    slope = 1 / math.tan(half_angle)
    contact_radius = math.sqrt(2 * force / (math.pi * contact_modulus * slope))
    return ConeContact(
        force=force,
        contact_radius=contact_radius,
        approach=math.pi / 2 * slope * contact_radius,
        mean_pressure=contact_modulus * slope / 2,
    )
