"""The square of the pressure, whose contours are smooth up to the rim."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.plot.pressure.rim_polygons import offsets_from_rim
from viscontact.results.snapshots import Snapshot

# Least distance of a pressed cell's centre from the rim [cells]: a line through the pressure
# there would otherwise fall without end.
_LEAST_DEPTH = 0.1


def squared_pressure(snapshot: Snapshot) -> NDArray[np.float64]:
    """Square the pressure and continue it below zero just outside the rim.

    Parameters
    ----------
    snapshot : Snapshot
        Pressure and gap.

    Returns
    -------
    ndarray
        Shape (nx, ny) [Pa²].

    Notes
    -----
    At a smooth rim the pressure starts as the square root of the distance to it, so its square
    is linear there: interpolated between cells it gives smooth contours where the pressure
    itself, which ends between two cells, would draw the staircase of the grid.

    Examples
    --------
    A straight rim at x = 0, pressure sqrt(-x), gap x^1.5: the square is -x on both sides.

    >>> x, y = np.arange(-3.5, 4.0), np.arange(4.0)
    >>> distance = x[:, None] + 0 * y
    >>> pressure, gap = np.sqrt(np.maximum(-distance, 0)), np.maximum(distance, 0) ** 1.5
    >>> squared = squared_pressure(Snapshot(0.0, x, y, pressure, gap))
    >>> squared[2:5, 1].round(6).tolist()
    [1.5, 0.5, -0.5]
    """
    squared = np.square(snapshot.pressure)
    contact = snapshot.pressure > 0
    offsets = offsets_from_rim(contact, snapshot.gap)
    distance = np.linalg.norm(offsets, axis=-1)
    normal = offsets / np.where(distance > 0, distance, np.nan)[..., None]
    total, weight, beside = (np.zeros_like(squared) for _ in range(3))
    for axis in (0, 1):
        for step in (1, -1):
            inner = np.where(contact, 0.0, np.roll(squared, step, axis))
            outward = step * normal[..., axis]
            known = (inner > 0) & (outward > 0)
            depth = np.maximum(outward - distance, _LEAST_DEPTH)
            total += np.where(known, outward * inner * distance / depth, 0.0)
            weight += np.where(known, outward, 0.0)
            beside = np.maximum(beside, inner)
    # Where the gap tells nothing, half-way between the cells.
    outside = np.where(weight > 0, total / np.where(weight > 0, weight, 1.0), beside)
    return np.where(contact, squared, -outside)
