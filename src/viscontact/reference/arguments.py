"""What every exact solution asks of its arguments."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Values: TypeAlias = np.float64 | NDArray[np.float64]
"""Values at points: a scalar for scalar arguments, else an array of their broadcast shape."""


def require_positive(unit: str, **arguments: float) -> None:
    """Refuse arguments that are not positive and finite.

    Parameters
    ----------
    unit : str
        Their unit, for the message.
    **arguments : float
        The arguments by name.

    Raises
    ------
    ValueError
        If one of them is zero, negative, infinite or not a number.

    Examples
    --------
    >>> require_positive("m", radius=-0.01)
    Traceback (most recent call last):
    ...
    ValueError: radius: wanted a positive, finite number [m], got -0.01
    """
    for name, value in arguments.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name}: wanted a positive, finite number [{unit}], got {value!r}")
