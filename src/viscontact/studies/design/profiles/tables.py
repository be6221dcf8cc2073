"""Drop curves as tables with the digits that a grinding machine gets, and their deviations."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters.profile import Profile
from viscontact.bodies.indenters.tabulated import TabulatedProfile

#: Last digit of a drop [m].
RESOLUTION = 1e-10


def rounded(drop: Floats) -> Floats:
    """Drops with the digits of the tables [m]."""
    return np.asarray(np.round(drop / RESOLUTION) / round(1 / RESOLUTION))


def tabulated(x: Floats, drop: Floats) -> TabulatedProfile:
    """Profile through positions and drops [m]."""
    return TabulatedProfile(x, rounded(drop))


def finite_table(profile: Profile, x: Floats, half_length: float) -> Floats:
    """Drops of a profile at positions [m], continued where they are infinite at the ends."""
    drop = np.array(profile.drop(x, half_length))
    for end, next_one, second in ((0, 1, 2), (-1, -2, -3)):
        if np.isinf(drop[end]):
            drop[end] = 2 * drop[next_one] - drop[second] + (drop[next_one] - drop[second])
    return drop


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
