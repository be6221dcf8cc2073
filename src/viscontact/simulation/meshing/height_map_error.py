"""Error of the peak pressure from a height map, which is linear between its points."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import Indenter
from viscontact.mechanics.contact.cell_fields import height_over_neighbours
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate


def facet_error(indenter: Indenter, found: ContactEstimate, compliance: float) -> float:
    """Relative error of the peak pressure from the facets of a height map; 0 without a map [-]."""
    steps = indenter.sample_spacing
    if min(steps) <= 0:
        return 0.0
    x, y = (
        _lines(middle, extent, step)
        for middle, extent, step in zip(found.centre, found.extents, steps, strict=True)
    )
    gap = indenter.gap(x[:, None], y[None, :])
    motion = found.motion
    # The height of a point over the mean of its neighbours counts as a wave of two steps and of
    # half that amplitude, which takes a pressure of pi h / (l J) to flatten (Johnson 1985, Contact
    # Mechanics, eq. 13.7); waves along x and along y add. Points that the undeformed body would
    # press in count.
    pressed = gap < motion[0] + motion[1] * x[:, None] + motion[2] * y[None, :]
    slopes = sum(height_over_neighbours(gap, axis) / steps[axis] for axis in (0, 1))
    steepest = float(np.where(pressed, slopes, 0.0).max(initial=0.0))
    return math.pi / 2 * steepest / (compliance * found.peak_pressure)


def _lines(middle: float, extent: float, step: float) -> Floats:
    """Points of the map along an axis over the contact and one step beyond [m]."""
    count = math.ceil(extent / 2 / step) + 1
    return np.asarray(middle + step * np.arange(-count, count + 1))
