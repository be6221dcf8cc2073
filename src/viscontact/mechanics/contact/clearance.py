"""Clearance of a body under a prescribed approach: tilts at which it does not touch the surface.

A body that is free to tilt turns away from the surface without any force, until its pivot, the
origin, is too deep. The largest approach without contact is the convex envelope of the gap at the
pivot, and its tilts are those of the plane that supports the envelope there: the solution of a
linear program with one to three unknowns.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.contact.rigid_balance import RigidPlane

#: Exchanges of one cell for another; a few tens are needed.
MAX_EXCHANGES = 1000

#: Rounding of a gap, relative to the height of the plane of the rigid motion.
ROUNDING = 2e-15

#: Shift of the pivot, relative to the grid: a pivot on the line between two cells could make the
#: exchanges go in circles.
SHIFT = np.array([0.0, 1.0e-11, 1.7e-11])

#: Distance and height of the first corners, relative to the grid and to the range of the gap: they
#: lie around every body, and above every plane between cells on both sides of the pivot.
FIRST_DISTANCE, FIRST_HEIGHT = 3.0, 1e6


def touching_motion(gap: Floats, plane: RigidPlane, free: Bools) -> Floats:
    """Largest approach without contact, and free tilts at which the body then touches [m, rad].

    A body that lies on one side of the pivot can be clear at any approach: one far larger than its
    gap. By the simplex method on the dual program (Dantzig 1963, Linear Programming and Extensions,
    chapter 5): a plane through corners around the pivot is exchanged for a lower one, through the
    cell farthest below it.
    """
    sought = np.append(0, 1 + np.flatnonzero(free[1:]))
    solid = gap[np.isfinite(gap)]
    scale = plane.extents[sought]
    pivot = np.array([1.0, 0.0, 0.0])[sought] + SHIFT[sought]
    corners = _first_corners(sought.size)
    heights = np.full(sought.size, solid.max() + FIRST_HEIGHT * (np.ptp(solid) or 1.0))
    motion = np.zeros(3)
    for _ in range(MAX_EXCHANGES):
        coefficients = np.linalg.solve(corners.T, heights)
        motion[sought] = coefficients / scale
        above = gap - plane.field(motion)
        row, column = divmod(int(above.argmin()), above.shape[1])
        if above[row, column] >= -ROUNDING * plane.height(motion):
            break
        entering = plane.column(row, column)[sought] / scale
        weights, change = np.linalg.solve(corners, np.stack([pivot, entering], axis=1)).T
        # The corner whose weight vanishes first as the cell takes over.
        steps = np.divide(weights, change, out=np.full(sought.size, np.inf), where=change > 0)
        leaving = int(steps.argmin())
        corners[:, leaving], heights[leaving] = entering, gap[row, column]
    return motion


def _first_corners(count: int) -> Floats:
    """Corners of a simplex around the pivot, as columns (1, x, y)."""
    corners = np.ones((count, count))
    corners[1:] = FIRST_DISTANCE * np.eye(count)[1:]
    corners[1:, 0] = -FIRST_DISTANCE
    return corners


def just_clear(
    gap: Floats,
    plane: RigidPlane,
    begin: Floats,
    clear: Floats,
) -> Floats:
    """First motion on the way from one to another at which no cell overlaps the surface."""
    overlap = np.maximum(plane.field(begin) - gap, 0.0)
    # At most all the way, in spite of rounding.
    opening = np.maximum(np.broadcast_to(plane.field(begin - clear), gap.shape), overlap)
    way = np.divide(overlap, opening, out=np.zeros(gap.shape), where=overlap > 0)
    return begin + float(way.max()) * (clear - begin)
