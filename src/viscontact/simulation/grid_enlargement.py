"""A grid that the contact outgrows: which one follows, and what is remembered on it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.contact.domain import ContactDomain
from viscontact.grid import Grid
from viscontact.meshing.contact_extent import MAX_CELLS
from viscontact.simulation.step_solution import StepSolution

#: How much longer a grid becomes along an axis on which it is overrun.
FACTOR = 1.5


#: So many cells stay free around a contact whose grid may grow: its rim is traced in two of them.
FREE = 2


def overrun(pressure: NDArray[np.float64], free: int = 1) -> tuple[bool, bool]:
    """Whether pressure has come to the outermost cells along x, and along y.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        On the whole grid.
    free : int
        How many cells have to stay free on every side.

    Examples
    --------
    >>> overrun(np.eye(5)[:, 1:4])
    (False, True)
    """
    both = (slice(0, free), slice(-free, None))
    along = any(bool(pressure[ends, :].any()) for ends in both)
    return along, any(bool(pressure[:, ends].any()) for ends in both)


def next_grid(grid: Grid, along: bool, across: bool) -> Grid | None:
    """The same cells on a roomier grid.

    Parameters
    ----------
    grid : Grid
        The grid that has been overrun.
    along, across : bool
        Whether it was along x, and along y.

    Returns
    -------
    Grid or None
        Half as long again where it has been overrun, or a little more; None where that would be
        more cells than an automatic grid may have.

    Examples
    --------
    >>> next_grid(Grid((32, 16), (2.0, 1.0)), True, False).shape
    (48, 16)
    """
    shape = (
        _longer(grid.shape[0], grid.cell_size[0]) if along else grid.shape[0],
        _longer(grid.shape[1], grid.cell_size[1]) if across else grid.shape[1],
    )
    return grid.widened(shape) if shape[0] * shape[1] <= MAX_CELLS else None


def _longer(cells: int, size: float) -> int:
    """A number of cells that is good to transform, and leaves the cells the same to the bit."""
    wanted = math.ceil(FACTOR * cells)
    while True:
        count = int(fft.next_fast_len(wanted, real=True))
        # What is carried and what is read back are on the same cells then, in however many leaps.
        if (count - cells) % 2 == 0 and size * count / count == size:
            return count
        wanted = count + 1


@dataclass(frozen=True, eq=False)
class GridEnlargement:
    """From one half-space to the same one under a larger grid.

    All that is remembered of the surface is pressures, and the deflections that they cause. Beyond
    the smaller grid there has been no pressure; the unit_displacement there follows from it.

    Parameters
    ----------
    small, large : ContactDomain
        Before and after.

    Examples
    --------
    >>> small = ContactDomain(Grid((4, 4), (1.0, 1.0)))
    >>> large = ContactDomain(small.grid.widened((8, 8)))
    >>> pressure = np.ones((4, 4))
    >>> pair = np.stack([pressure, small.convolution.apply(pressure)])
    >>> grown = GridEnlargement(small, large).pairs(pair)
    >>> bool(np.allclose(grown[1, 2:6, 2:6], pair[1], rtol=1e-14))
    True
    """

    small: ContactDomain
    large: ContactDomain

    def pressure(self, pressure: NDArray[np.float64]) -> NDArray[np.float64]:
        """A pressure on the smaller grid as one on the larger, each as it is worked with."""
        whole = self.small.expand_by_symmetry(pressure)
        return self.large.reduce_by_symmetry(self.small.grid.embed(whole, self.large.grid))

    def pairs(self, fields: NDArray[np.float64]) -> NDArray[np.float64]:
        """Pressures and their deflections, shape (..., 2, nx, ny), as those on the larger grid."""
        grown = np.empty((*fields.shape[:-2], *self.large.shape))
        for index in np.ndindex(fields.shape[:-3]):
            pressure, unit_displacement = grown[index]
            pressure[:] = self.pressure(fields[index][0])
            unit_displacement[:] = self.large.convolution.apply(pressure)
        return grown

    def instant(self, before: StepSolution) -> StepSolution:
        """An earlier instant as it looks on the larger grid, but for its gap out there."""
        small, large = self.small, self.large
        twin = self.pairs(before.twin)
        return replace(
            before,
            pressure=small.grid.embed(before.pressure, large.grid),
            gap=small.grid.embed(before.gap, large.grid, beyond=np.nan),
            displacement=large.expand_by_symmetry(twin[1]),
            twin=twin,
        )
