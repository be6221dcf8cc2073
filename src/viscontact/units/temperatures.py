"""Conversion of temperatures between kelvin and degrees Celsius."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from viscontact.units.formatting import ReadableUnit

#: 0 °C on the absolute scale [K].
ZERO_CELSIUS = 273.15

#: Unit in which absolute temperatures are drawn.
CELSIUS = ReadableUnit("°C", 1.0, ZERO_CELSIUS)

_Temperature = TypeVar("_Temperature", float, NDArray[np.float64])


def in_celsius(kelvin: _Temperature) -> _Temperature:
    """Return absolute temperatures [K] in °C."""
    return kelvin - ZERO_CELSIUS
