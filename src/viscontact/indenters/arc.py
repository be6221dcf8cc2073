"""The drop of a circular arc, without cancellation."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def arc_drop(distance: ArrayLike, radius: ArrayLike) -> NDArray[np.float64]:
    """Return how far a circular arc has dropped below its tangent.

    Parameters
    ----------
    distance : array_like
        Distance from the point of tangency, along the tangent, not negative [m].
    radius : array_like
        Radius of the arc [m]; where it is negative there is no arc.

    Returns
    -------
    ndarray
        R - sqrt(R² - s²), not negative; +inf where the arc has ended, s > R [m].

    Notes
    -----
    The drop is computed as s² / (R + sqrt(R² - s²)), the same number; the difference itself
    loses all its digits where s is below 1e-8 R. The root's argument is factored for the
    same reason, for s near R.

    Examples
    --------
    >>> float(arc_drop(3.0, 5.0))
    1.0
    """
    s, R = np.broadcast_arrays(
        np.asarray(distance, dtype=np.float64), np.asarray(radius, dtype=np.float64)
    )
    drop = np.full(s.shape, np.inf)
    inside = s <= R
    s, R = s[inside], R[inside]
    height = R + np.sqrt((R - s) * (R + s))
    # A point-like arc (R = s = 0) has no drop: 0/0 otherwise.
    drop[inside] = np.divide(s * s, height, out=np.zeros_like(s), where=height > 0)
    return drop
