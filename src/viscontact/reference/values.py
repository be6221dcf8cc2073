"""Argument checks and types of the exact solutions."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.units.numbers import positive

Values: TypeAlias = np.float64 | Floats
"""Values at points: a scalar for scalar arguments, else an array of their broadcast shape."""


def require_positive(unit: str, **arguments: float) -> None:
    """Raise ValueError for an argument in `unit` that is not positive and finite."""
    for name, value in arguments.items():
        # The value itself is used: one with a unit is refused.
        positive(name, str(value) if hasattr(value, "units") else value, unit)
