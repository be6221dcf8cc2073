"""Square of the pressure, whose contours are smooth up to the rim."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.rim import offsets_from_rim
from viscontact.results.snapshots import Snapshot

# Least distance of a pressed cell's centre from the rim [cells]: it limits the slope of the
# continuation.
_LEAST_DEPTH = 0.1


def squared_pressure(snapshot: Snapshot) -> Floats:
    """Square of the pressure, continued below zero just outside the rim [Pa²], shape (nx, ny)."""
    # At a smooth rim the pressure starts as the square root of the distance to it, so its square is
    # linear there: interpolated between cells it gives smooth contours where the pressure itself
    # would follow the steps of the grid.
    squared = np.square(snapshot.pressure)
    contact = snapshot.in_contact
    offsets = offsets_from_rim(contact, snapshot.gap)
    distance = np.linalg.norm(offsets, axis=-1)
    normal = offsets / np.where(distance > 0, distance, np.nan)[..., None]
    total, weight, neighbour = (np.zeros_like(squared) for _ in range(3))
    for axis in (0, 1):
        for step in (1, -1):
            inner = np.where(contact, 0.0, np.roll(squared, step, axis))
            outward = step * normal[..., axis]
            known = (inner > 0) & (outward > 0)
            depth = np.maximum(outward - distance, _LEAST_DEPTH)
            total += np.where(known, outward * inner * distance / depth, 0.0)
            weight += np.where(known, outward, 0.0)
            neighbour = np.maximum(neighbour, inner)
    # Where the gap does not determine it, half-way between the cells.
    outside = np.where(weight > 0, total / np.where(weight > 0, weight, 1.0), neighbour)
    return np.where(contact, squared, -outside)
