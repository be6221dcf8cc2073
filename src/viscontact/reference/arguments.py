"""Argument checks of the exact solutions."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Values: TypeAlias = np.float64 | NDArray[np.float64]
"""Values at points: a scalar for scalar arguments, else an array of their broadcast shape."""


def require_positive(unit: str, **arguments: float) -> None:
    """Refuse arguments that are not positive and finite.

    >>> require_positive("m", radius=-0.01)
    Traceback (most recent call last):
    ...
    ValueError: radius: wanted a positive, finite number [m], got -0.01
    """
    for name, value in arguments.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name}: wanted a positive, finite number [{unit}], got {value!r}")
