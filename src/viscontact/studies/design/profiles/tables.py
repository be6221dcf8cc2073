"""Drop curves as tables with the digits that a grinding machine gets."""

from __future__ import annotations

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
