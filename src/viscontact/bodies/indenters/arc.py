"""Drop of a circular arc below its tangent, without cancellation."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats


def arc_drop(distance: ArrayLike, radius: ArrayLike) -> Floats:
    """Drop R - sqrt(R² - s²) of an arc at s >= 0 along its tangent; +inf for s > R, R < 0 [m]."""
    # As s² / (R + sqrt((R - s) (R + s))): the difference loses all digits for s < 1e-8 R, and the
    # factored root keeps them for s near R.
    s, R = np.broadcast_arrays(
        np.asarray(distance, dtype=np.float64), np.asarray(radius, dtype=np.float64)
    )
    drop = np.full(s.shape, np.inf)
    inside = s <= R
    s, R = s[inside], R[inside]
    height = R + np.sqrt((R - s) * (R + s))
    # An arc of radius 0 at s = 0 has no drop; the quotient is 0/0.
    drop[inside] = np.divide(s * s, height, out=np.zeros_like(s), where=height > 0)
    return drop
