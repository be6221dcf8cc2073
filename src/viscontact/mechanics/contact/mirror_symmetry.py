"""Mirror symmetry of contacts across the axes of a grid."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid


def even_axes(grid: Grid, open_gap: Floats, even_load: tuple[bool, bool]) -> tuple[bool, bool]:
    """Evenness of gap and load across x = 0 and y = 0, on a grid that is centred there."""
    along_x, along_y = (
        even_load[axis]
        and not grid.periodic[axis]
        and grid.centre[axis] == 0
        and np.array_equal(open_gap, np.flip(open_gap, axis))
        for axis in (0, 1)
    )
    return along_x, along_y


def mirrored_axes(grid: Grid, even: tuple[bool, bool]) -> tuple[bool, bool]:
    """Axes across which one half is computed: even ones with an even number of cells."""
    return even[0] and grid.shape[0] % 2 == 0, even[1] and grid.shape[1] % 2 == 0


def is_mirrored(field: Floats, axis: int) -> bool:
    """Test whether a field's second half mirrors its first along an axis of even number exactly."""
    return field.shape[axis] % 2 == 0 and np.array_equal(field, np.flip(field, axis))
