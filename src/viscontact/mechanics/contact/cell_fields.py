"""Fields on cells: heights over the neighbouring cells."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats


def height_over_neighbours(gap: Floats, axis: int) -> Floats:
    """Half the height of points over the mean of two neighbours [m]; 0 at dips, ends, holes."""
    height = np.zeros(gap.shape)
    lines, out = np.moveaxis(gap, axis, 0), np.moveaxis(height, axis, 0)[1:-1]
    known = np.isfinite(lines[:-2] + lines[1:-1] + lines[2:])
    mean = (lines[:-2][known] + lines[2:][known]) / 2
    out[known] = np.maximum(mean - lines[1:-1][known], 0.0) / 2
    return height
