"""Shape of the body on its grid, as warnings need it."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.mechanics.contact.body_edge import end_cells
from viscontact.simulation.checks.covers import Cover
from viscontact.simulation.checks.sampling import Sampling

#: Slope of the surface from which small-strain theory is warned of.
STEEP_SLOPE = 0.3

#: Tilts up to this need not be added to slopes that are smaller than the limit by as much [rad].
LITTLE_TILT = 0.03


@dataclass(frozen=True, eq=False)
class Geometry:
    """Shape of the body on its grid, as the warnings about geometry need it."""

    indenter: Indenter
    open_gap: Floats  # initial gap, +inf outside the outline [m]
    grid: Grid
    thickness: float = math.inf  # of the thinner body, inf if not given [m]
    indenter_gives: bool = False  # the indenter is deformable, so a half-space as well
    planes: tuple[float, ...] = ()  # at which bodies end, and no pressure is singular: x [m]
    covers: tuple[Cover, ...] = ()
    is_supported: bool = False  # the bodies lie on rigid bases, so that any approach has a datum
    predicted: bool = False  # the contact is an estimate made before the run

    @property
    def verbs(self) -> tuple[str, str]:
        """Verbs of a sentence about an extent, and about a limit."""
        return ("will be about", "will reach") if self.predicted else ("is", "reaches")

    @property
    def steepness(self) -> Floats:
        """Larger absolute slope from each cell to the next along either axis, not kept [-]."""
        steepness = np.zeros(self.grid.shape)
        np.maximum(steepness[:-1], self._slopes(0), out=steepness[:-1])
        np.maximum(steepness[:, :-1], self._slopes(1), out=steepness[:, :-1])
        return steepness

    @cached_property
    def steepest(self) -> float:
        """Largest of these slopes [-]."""
        # Not `max`, which may pass over NaN.
        return float(np.max([self._slopes(axis).max(initial=0.0) for axis in (0, 1)]))

    def _slopes(self, axis: int) -> Floats:
        """Absolute slopes from each cell to the next along an axis, NaN outside the body [-]."""
        with np.errstate(invalid="ignore"):
            slopes = np.diff(self.open_gap, axis=axis)
        np.abs(slopes, out=slopes)
        slopes /= self.grid.cell_size[axis]
        return slopes

    @cached_property
    def nearly_steep(self) -> Bools:
        """Cells at which a little tilt makes the slope too steep."""
        return self.steepness > STEEP_SLOPE - LITTLE_TILT

    @cached_property
    def ends(self) -> bool:
        """True if the body ends within the grid."""
        return bool(np.isinf(self.open_gap).any())

    @cached_property
    def end_cells(self) -> Bools:
        """Cells next to the end of the body."""
        around = self.open_gap
        for axis, repeats in enumerate(self.grid.periodic):
            width = [(int(axis == 0),) * 2, (int(axis == 1),) * 2]
            around = np.pad(around, width, mode="wrap" if repeats else "edge")
        ends_along, ends_across = end_cells(around, 1)[:, 1:-1, 1:-1]
        for plane in self.planes:
            ends_along[np.abs(self.grid.x - plane) < self.grid.cell_size[0]] = False
        return np.asarray(ends_along | ends_across)

    @cached_property
    def beyond(self) -> Bools:
        """Cells beyond the outline of the indenter, but not beyond the ends of the other body."""
        outside = np.isinf(self.open_gap)
        first, *others = np.flatnonzero(~outside.all(axis=1)) if self.planes else (0,)
        last = others[-1] if others else first
        for plane in self.planes:
            x, near = self.grid.x, self.grid.cell_size[0]
            if abs(x[first] - plane) < near:
                outside[:first] = False
            if abs(x[last] - plane) < near:
                outside[last + 1 :] = False
        return outside

    @cached_property
    def sampling(self) -> Sampling:
        """Sampling of the shape by the grid."""
        return Sampling(self.indenter, self.open_gap, self.grid)
