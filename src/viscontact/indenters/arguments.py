"""What an indenter accepts as a length."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.units.numbers import as_real


def real_number(name: str, value: object, unit: str) -> float:
    """Return `value` as a float, or refuse what is not a plain number.

    Parameters
    ----------
    name : str
        What the value is, for the message: "Sphere: radius".
    value : object
        What the user gave.
    unit : str
        The unit the number is taken in.

    Raises
    ------
    ValueError
        If the value is a boolean, a text, an array, None or anything else but a real number.

    Examples
    --------
    >>> real_number("Cone: half_angle", 1, "rad")
    1.0
    """
    number = as_real(value)
    if number is None:
        raise ValueError(f"{name} must be a number in {unit}, got {value!r}")
    return number


def positions(x: ArrayLike, y: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return coordinates as arrays of floats, or refuse what is none.

    Parameters
    ----------
    x, y : array_like
        What the user gave [m].

    Raises
    ------
    ValueError
        If either holds anything else than real numbers.

    Examples
    --------
    >>> positions(1, [2, 3])
    (array(1.), array([2., 3.]))
    """
    try:
        return np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"x and y must be positions in m: {error}") from None


def positive_length(name: str, value: object) -> float:
    """Return `value` as a float if it is a positive, finite length [m].

    Parameters
    ----------
    name : str
        What the length is, for the message: "Sphere: radius".
    value : object
        What the user gave [m].

    Raises
    ------
    ValueError
        If the value is not a number, not finite, zero or negative.

    Examples
    --------
    >>> positive_length("Sphere: radius", 1)
    1.0
    """
    length = real_number(name, value, "m")
    if not (math.isfinite(length) and length > 0):
        raise ValueError(f"{name} must be a positive, finite length in m, got {value!r}")
    return length


def acute_angle(name: str, value: object) -> float:
    """Return `value` as a float if it is an angle between 0 and π/2, both excluded [rad].

    Parameters
    ----------
    name : str
        What the angle is, for the message: "Cone: half_angle".
    value : object
        What the user gave [rad].

    Raises
    ------
    ValueError
        If the value is not a number, or not between these.

    Examples
    --------
    >>> acute_angle("Cone: half_angle", 1)
    1.0
    """
    angle = real_number(name, value, "rad")
    if not 0 < angle < math.pi / 2:
        raise ValueError(
            f"{name} must lie between 0 and π/2 rad, got {value!r}; for degrees use "
            "math.radians(...)"
        )
    return angle


def length_or_zero(name: str, value: object) -> float:
    """Return `value` as a float if it is a finite length of zero or more [m].

    Parameters
    ----------
    name : str
        What the length is, for the message: "Chamfer: corner_radius".
    value : object
        What the user gave [m].

    Raises
    ------
    ValueError
        If the value is not a number, not finite, or negative.

    Examples
    --------
    >>> length_or_zero("Chamfer: corner_radius", 0)
    0.0
    """
    length = real_number(name, value, "m")
    if not (math.isfinite(length) and length >= 0):
        raise ValueError(f"{name} must be a finite length of zero or more in m, got {value!r}")
    return length
