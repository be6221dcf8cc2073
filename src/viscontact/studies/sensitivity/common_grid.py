"""Grid that all runs of a sensitivity share, so that errors of its cells cancel in differences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.simulation.meshing.refinement import good_shape

#: Cells that may be longer than those that another run would choose by this factor.
TOLERATED = 1.5


def covering(nominal: Grid, others: Sequence[Grid]) -> Grid:
    """Return a grid over the extents of all grids, whose cells lie on those of the nominal one."""
    cell = np.array(nominal.cell_size)
    finest = np.min([each.cell_size for each in (nominal, *others)], axis=0)
    # Parts of whole cells still end where a straight part of the body ends.
    cell = cell / np.maximum(1, np.ceil(cell / (TOLERATED * finest) - 1e-9))
    centre = np.array(nominal.centre)
    reach = [
        np.abs(np.array(each.centre) - centre) + np.array(each.size) / 2
        for each in (nominal, *others)
    ]
    counts = good_shape(2 * np.max(reach, axis=0) / cell - 1e-6, np.inf)
    size = (float(counts[0] * cell[0]), float(counts[1] * cell[1]))
    return Grid(counts, size, nominal.periodic, centre=nominal.centre)
