"""Temperatures as people read them."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

#: What 0 °C is on the absolute scale [K].
ZERO_CELSIUS = 273.15

_Temperature = TypeVar("_Temperature", float, NDArray[np.float64])


def in_celsius(kelvin: _Temperature) -> _Temperature:
    """Return absolute temperatures on the Celsius scale.

    Parameters
    ----------
    kelvin : float or ndarray
        The temperatures, any shape [K].

    Returns
    -------
    float or ndarray
        The same in °C.

    Examples
    --------
    >>> in_celsius(293.15)
    20.0
    """
    return kelvin - ZERO_CELSIUS
