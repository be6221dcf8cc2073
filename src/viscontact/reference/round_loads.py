"""Elastic half-spaces under given pressures on a circle: closed forms."""

from __future__ import annotations

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


def circle_displacement(
    pressure: float, radius: float, contact_modulus: float, r: ArrayLike = 0.0
) -> Values:
    """Displacement of the surface of a half-space under uniform pressure on a circle.

    Parameters
    ----------
    pressure : float
        On the circle, positive in compression [Pa].
    radius : float
        Of the circle, a [m].
    contact_modulus : float
        E* [Pa].
    r : array_like, optional
        Distances from the centre [m].

    Returns
    -------
    float or ndarray
        Displacement, positive into the half-space [m].

    Notes
    -----
    With the complete elliptic integrals K and E of the modulus k,

        u = (4 p a/(π E*)) E(r/a),   r <= a,
        u = (4 p r/(π E*)) [E(a/r) - (1 - a²/r²) K(a/r)],   r > a.

    References
    ----------
    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377; Johnson 1985, eq. 3.29.

    Examples
    --------
    >>> print(f"{circle_displacement(1e6, 1e-3, 1e9) * 1e6:.4f} um")
    2.0000 um
    """
    require_positive("m", radius=radius)
    require_positive("Pa", pressure=pressure, contact_modulus=contact_modulus)
    r = np.abs(real_array("r", r, "m"))
    inside = r <= radius
    within = np.where(inside, r / radius, 0.0)
    beyond = np.where(inside, 0.0, radius / np.where(inside, radius, r))
    outer = scipy.special.ellipe(beyond**2) - (1 - beyond**2) * scipy.special.ellipk(beyond**2)
    shape = np.where(inside, radius * scipy.special.ellipe(within**2), r * outer)
    u: Values = 4 * pressure / (math.pi * contact_modulus) * shape
    return u


def hertz_displacement(
    peak_pressure: float, radius: float, contact_modulus: float, r: ArrayLike = 0.0
) -> Values:
    """Displacement of the surface of a half-space under Hertz's pressure on a circle.

    Parameters
    ----------
    peak_pressure : float
        p of p (1 - r²/a²)^(1/2), positive in compression [Pa].
    radius : float
        Of the circle, a [m].
    contact_modulus : float
        E* [Pa].
    r : array_like, optional
        Distances from the centre [m].

    Returns
    -------
    float or ndarray
        Displacement, positive into the half-space [m].

    Notes
    -----
    Inside u = π p (2 a² - r²)/(4 a E*), and outside

        u = (p/(2 a E*)) [(2 a² - r²) asin(a/r) + a (r² - a²)^(1/2)].

    References
    ----------
    H. Hertz, J. reine angew. Math. 92 (1882) 156; Johnson 1985, eq. 3.41 and 3.42.

    Examples
    --------
    >>> print(f"{hertz_displacement(1e6, 1e-3, 1e9) * 1e6:.4f} um")
    1.5708 um
    """
    require_positive("m", radius=radius)
    require_positive("Pa", peak_pressure=peak_pressure, contact_modulus=contact_modulus)
    a, r = radius, np.abs(real_array("r", r, "m"))
    beyond = np.maximum(r, a)  # the same form inside, where the angle is a right one
    shape = (2 * a**2 - r**2) * np.arcsin(a / beyond) + a * np.sqrt(beyond**2 - a**2)
    u: Values = peak_pressure / (2 * a * contact_modulus) * shape
    return u
