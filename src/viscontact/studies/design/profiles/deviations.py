"""Deviations of a ground profile from the drawing, within a tolerance."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from viscontact.backend.arrays import Floats

#: Deviations over the position u from -1 to 1, at most 1: the crown too deep or too flat, a taper
#: to either side, and a wave.
DEVIATIONS: Mapping[str, Callable[[Floats], Floats]] = {
    "none": np.zeros_like,
    "crown deeper": lambda u: u**2,
    "crown flatter": lambda u: -(u**2),
    "taper to the left": lambda u: -u,
    "taper to the right": lambda u: u,
    "wave up": lambda u: np.cos(2 * np.pi * u),
    "wave down": lambda u: -np.cos(2 * np.pi * u),
}


def deviating(drop: Floats, places: Floats, tolerance: float) -> dict[str, Floats]:
    """Drops [m] of profiles within a tolerance [m] of a drop, at places from -1 to 1."""
    if tolerance == 0.0:
        return {"none": drop}
    return {name: drop + tolerance * shape(places) for name, shape in DEVIATIONS.items()}
