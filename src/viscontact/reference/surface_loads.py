"""Elastic half-spaces and layers under given pressures: closed forms."""

from __future__ import annotations

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike

from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array

#: Wave number times thickness beyond which a layer is a half-space, to rounding.
_SHORT_WAVES = 40.0


def point_load(force: float, contact_modulus: float, distance: ArrayLike) -> Values:
    """Displacement of the surface of a half-space around a point load.

    Parameters
    ----------
    force : float
        The load, positive into the half-space [N].
    contact_modulus : float
        E* = E/(1 - ν²) [Pa].
    distance : array_like
        Distances from the load on the surface, positive [m].

    Returns
    -------
    float or ndarray
        F/(π E* r), positive into the half-space [m].

    References
    ----------
    J. Boussinesq, *Application des potentiels*, Paris 1885; K. L. Johnson, *Contact Mechanics*,
    Cambridge 1985, eq. 3.22a.

    Examples
    --------
    >>> print(f"{point_load(force=100.0, contact_modulus=1e9, distance=1e-3) * 1e6:.4f} um")
    31.8310 um
    """
    require_positive("N", force=force)
    require_positive("Pa", contact_modulus=contact_modulus)
    u: Values = force / (math.pi * contact_modulus * real_array("distance", distance, "m"))
    return u


def rectangle_displacement(
    pressure: float,
    half_length: float,
    half_width: float,
    contact_modulus: float,
    x: ArrayLike = 0.0,
    y: ArrayLike = 0.0,
) -> Values:
    """Displacement of the surface of a half-space under uniform pressure on a rectangle.

    Parameters
    ----------
    pressure : float
        On the rectangle, positive in compression [Pa].
    half_length, half_width : float
        Half the edges along x and y [m].
    contact_modulus : float
        E* [Pa].
    x, y : array_like, optional
        Positions from the centre [m].

    Returns
    -------
    float or ndarray
        Displacement, positive into the half-space [m].

    References
    ----------
    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377; Johnson 1985, eq. 3.25.

    Examples
    --------
    >>> print(f"{rectangle_displacement(1e6, 1e-3, 1e-3, 1e9) * 1e6:.4f} um")
    2.2444 um
    """
    a, b = half_length, half_width
    require_positive("m", half_length=a, half_width=b)
    require_positive("Pa", pressure=pressure, contact_modulus=contact_modulus)
    x, y = real_array("x", x, "m"), real_array("y", y, "m")
    corners = [
        sign_x * sign_y * _corner_displacement(x + sign_x * a, y + sign_y * b)
        for sign_x in (1, -1)
        for sign_y in (1, -1)
    ]
    u: Values = pressure / (math.pi * contact_modulus) * np.sum(corners, axis=0)
    return u


def rectangle_stress(
    pressure: float,
    half_length: float,
    half_width: float,
    x: ArrayLike,
    y: ArrayLike,
    depth: ArrayLike,
) -> Values:
    """Vertical stress in a half-space under uniform pressure on a rectangle.

    Parameters
    ----------
    pressure : float
        On the rectangle, positive in compression [Pa].
    half_length, half_width : float
        Half the edges along x and y [m].
    x, y : array_like
        Positions from the centre [m].
    depth : array_like
        Depths, positive [m].

    Returns
    -------
    float or ndarray
        σzz, negative in compression, whatever Poisson's ratio is [Pa].

    References
    ----------
    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377, section 4.

    Examples
    --------
    >>> print(f"{rectangle_stress(1e6, 1e-3, 1e-3, 0.0, 0.0, 1e-3) / 1e6:.4f} MPa")
    -0.7009 MPa
    """
    a, b = half_length, half_width
    require_positive("m", half_length=a, half_width=b)
    x, y, z = (real_array(n, v, "m") for n, v in (("x", x), ("y", y), ("depth", depth)))
    corners = [
        sign_x * sign_y * _corner_stress(x + sign_x * a, y + sign_y * b, z)
        for sign_x in (1, -1)
        for sign_y in (1, -1)
    ]
    stress: Values = -pressure / (2 * math.pi) * np.sum(corners, axis=0)
    return stress


def strip_stresses(
    pressure: float, half_width: float, y: ArrayLike, depth: ArrayLike
) -> tuple[Values, Values]:
    """Stresses in a half-space under uniform pressure on a long strip.

    Parameters
    ----------
    pressure : float
        On the strip, positive in compression [Pa].
    half_width : float
        Half the width, along y [m].
    y : array_like
        Positions from the middle of the strip [m].
    depth : array_like
        Depths, positive [m].

    Returns
    -------
    tuple
        σyy and σzz, negative in compression [Pa].

    References
    ----------
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, eq. 2.31.

    Examples
    --------
    >>> across, vertical = strip_stresses(1e6, 1e-3, 0.0, 1e-3)
    >>> print(f"{across / 1e6:.4f} MPa, {vertical / 1e6:.4f} MPa")
    -0.1817 MPa, -0.8183 MPa
    """
    require_positive("m", half_width=half_width)
    y, z = real_array("y", y, "m"), real_array("depth", depth, "m")
    ends = [np.arctan2(y + side, z) for side in (half_width, -half_width)]
    angle = ends[0] - ends[1]
    part = (np.sin(2 * ends[0]) - np.sin(2 * ends[1])) / 2
    return -pressure / math.pi * (angle - part), -pressure / math.pi * (angle + part)


def strip_on_layer(
    pressure: float, half_width: float, thickness: float, contact_modulus: float, y: float
) -> float:
    """Displacement of a layer, on a rigid base without friction, under pressure on a long strip.

    Parameters
    ----------
    pressure : float
        On the strip, positive in compression [Pa].
    half_width : float
        Half the width, along y [m].
    thickness : float
        Of the layer [m].
    contact_modulus : float
        E* of the layer [Pa].
    y : float
        Position from the middle of the strip [m].

    Returns
    -------
    float
        Displacement of the surface, positive into the layer [m].

    Notes
    -----
    With L = (cosh 2qh - 1)/(sinh 2qh + 2qh), the displacement of the layer under a wave of pressure
    over that of a half-space, it is

        u = (2 p/(π E*)) Σ ∫ L(q) sin(q s)/q² dq,   s = b + y, b - y.

    For 1 - exp(-q h/2) in place of L the integral is elementary; the rest is regular.

    References
    ----------
    I. N. Sneddon, *Fourier Transforms*, New York 1951, section 46; the frictionless layer of K. L.
    Johnson, *Contact Mechanics*, Cambridge 1985, section 5.8.

    Examples
    --------
    A strip that is wide against the layer compresses it uniformly, by p h/E*:

    >>> print(f"{strip_on_layer(1e6, 20e-3, 1e-3, 1e9, 0.0) * 1e6:.4f} um")
    1.0000 um
    """
    require_positive("m", half_width=half_width, thickness=thickness)
    require_positive("Pa", pressure=pressure, contact_modulus=contact_modulus)
    total = sum(_layer_integral(side * y + half_width, thickness) for side in (1, -1))
    return 2 * pressure / (math.pi * contact_modulus) * total


def _corner_displacement(x: Values, y: Values) -> Values:
    """Primitive x asinh(y/|x|) + y asinh(x/|y|) of 1/r in x and y."""
    r = np.hypot(x, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.where(x == 0, 0.0, x * np.log((y + r) / np.abs(x)))
        across = np.where(y == 0, 0.0, y * np.log((x + r) / np.abs(y)))
    found: Values = along + across
    return found


def _corner_stress(x: Values, y: Values, z: Values) -> Values:
    """Vertical stress under the corner of a rectangle of edges x and y, over p/(2π)."""
    r = np.sqrt(x**2 + y**2 + z**2)
    found: Values = np.arctan2(x * y, z * r) + x * y * z / r * (
        1 / (x**2 + z**2) + 1 / (y**2 + z**2)
    )
    return found


def _layer_integral(s: float, thickness: float) -> float:
    """∫ L(q) sin(q s)/q² dq from 0 to infinity [m]."""
    b = thickness / 2

    def rest(q: float) -> float:
        if q * thickness < 1e-4:  # the next term of both series, where the difference cancels
            return b * b / 2 * math.sin(q * s)
        twice = 2 * q * thickness
        ratio = (math.cosh(twice) - 1) / (math.sinh(twice) + twice)
        return (ratio + math.expm1(-b * q)) * math.sin(q * s) / q**2

    end = _SHORT_WAVES / thickness
    value, _ = scipy.integrate.quad(rest, 0.0, end, limit=2000, epsabs=1e-13 * thickness)
    # Beyond, L = 1 to rounding, and the elementary part differs by the exponential only.
    elementary = s / 2 * math.log1p(b * b / s**2) + b * math.atan(s / b) if s else 0.0
    tail, _ = scipy.integrate.quad(
        lambda q: math.exp(-b * q) * math.sin(q * s) / q**2, end, 3 * end, limit=500
    )
    return float(value + elementary + tail)
