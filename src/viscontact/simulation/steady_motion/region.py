"""Region of a contact in steady motion, found by itself, and grids over it.

The contact of a moving body lies off its centre, by up to several of its lengths, and its size
depends on the speed. The region is searched on a coarse grid: it grows on each side that the
contact reaches, until there is free room around it. The grids of all speeds of a run are parts of
one lattice of cells, so that their fields have common coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cell_borders import cell_length, with_borders_at
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.moving_domain import COARSEST
from viscontact.simulation.steady_motion.contact import SteadyContact, SteadySolver
from viscontact.units.formatting import format_quantity

#: Cells along each axis of the search, and its tolerance.
SEARCH_CELLS, SEARCH_TOLERANCE = 48, 1e-4

#: Fewest cells across a contact whose region is known, free cells around it, and searches.
FEWEST_ACROSS, FREE, MAX_SEARCHES = 20, 2, 40

#: Growth on a side that the contact reaches, and margin elsewhere, in lengths of the contact.
GROWTH, MARGIN = 0.5, 0.1

#: Free cells around the region of a grid: its rim is traced in them.
MARGIN_CELLS = 5

#: Cells along an axis of the largest contact of a run, over those of the smallest.
MOST_OF_LATTICE = 4.0


@dataclass(frozen=True, eq=False)
class Region:
    """Bounds of a contact along x and y, in the coordinates of the body [m]."""

    low: Floats
    high: Floats

    @property
    def extents(self) -> Floats:
        """Lengths along x and y [m]."""
        return self.high - self.low

    def widened(self, share: float) -> Region:
        """Region with a margin on each side, as a share of its lengths."""
        return Region(self.low - share * self.extents, self.high + share * self.extents)

    def centred(self, axes: tuple[bool, bool]) -> Region:
        """Region made symmetric about 0 along some axes."""
        half = np.maximum(-self.low, self.high)
        return Region(np.where(axes, -half, self.low), np.where(axes, half, self.high))

    def grid(self, cells: int) -> Grid:
        """Grid with as many cells along both axes."""
        (lx, ly), (x, y) = self.extents.tolist(), ((self.low + self.high) / 2).tolist()
        return Grid((cells, cells), (lx, ly), centre=(x, y))


@dataclass(frozen=True, eq=False)
class Lattice:
    """Cells of all grids of a run: cell i along an axis lies between i and i + 1 edges."""

    cell_size: Floats  # [m]
    origin: float = 0.0  # border of cells along x [m]

    def grid_over(self, region: Region, *, centred: tuple[bool, bool]) -> Grid:
        """Grid of the lattice over a region with a margin, centred on 0 along some axes."""
        shape, size, centre = [], [], []
        region = region.centred(centred)
        for axis, cell in enumerate(self.cell_size.tolist()):
            origin = 0.0 if axis == 1 else self.origin
            low, high = ((float(each[axis]) - origin) / cell for each in (region.low, region.high))
            room = MARGIN_CELLS + MARGIN / 2 * (high - low)
            count = _divisible(high - low + 2 * room)
            first = round((low + high - count) / 2)
            shape.append(count)
            size.append(count * cell)
            centre.append(origin + (first + count / 2) * cell)
        return Grid((shape[0], shape[1]), (size[0], size[1]), centre=(centre[0], centre[1]))


def lattice_for(regions: list[Region], across: float) -> Lattice:
    """Cells for regions of several speeds: so many across the smallest, unless others get many."""
    extents = np.array([region.extents for region in regions])
    smallest, largest = extents.min(axis=0), extents.max(axis=0)
    return Lattice(np.maximum(smallest / across, largest / (MOST_OF_LATTICE * across)))


def lattice_with_ends(lattice: Lattice, planes: Sequence[float]) -> Lattice:
    """Lattice of which cells, of at most the same length, end at planes across x [m]."""
    if not planes:
        return lattice
    # About the origin where ends lie on both sides alike, so that grids can be centred on it.
    even = set(planes) == {-plane for plane in planes}
    along, across = lattice.cell_size.tolist()
    length = cell_length([*planes, 0.0] if even else planes, along)
    return Lattice(np.array([length, across]), 0.0 if even else planes[0])


def common_grid(grids: Sequence[Grid]) -> Grid:
    """Smallest grid that holds grids of one lattice of cells."""
    if all(grid == grids[0] for grid in grids):
        return grids[0]
    cell = grids[0].cell_size
    shape, centre = [], []
    for axis in (0, 1):
        edges = [
            (grid.centre[axis] - grid.size[axis] / 2, grid.centre[axis] + grid.size[axis] / 2)
            for grid in grids
        ]
        low, high = min(each[0] for each in edges), max(each[1] for each in edges)
        shape.append(round((high - low) / cell[axis]))
        centre.append((low + high) / 2)
    size = (shape[0] * cell[0], shape[1] * cell[1])
    return Grid((shape[0], shape[1]), size, centre=(centre[0], centre[1]))


def find_region(
    solver: SteadySolver, speed: float, start: Region, *, centred: tuple[bool, bool]
) -> tuple[Region, float]:
    """Region of the contact at a speed, near `start`, and the convolutions of the search."""
    box = start.widened(MARGIN)
    work = 0.0
    for _ in range(MAX_SEARCHES):
        box = box.centred(centred)
        grid = with_borders_at(box.grid(SEARCH_CELLS), solver.problem.contact.planes)
        found = solver.solve(speed, grid, SEARCH_TOLERANCE)
        work += found.solution.work
        region, across, touched = _measure(found)
        if not touched.any() and across.min() >= FEWEST_ACROSS:
            return region, work
        box = _next_region(box, region, touched, across)
    raise ValueError(
        "grid: no region is found that holds the contact at "
        f"{format_quantity(speed, 'm/s')}; give a grid of your own, or check whether the load "
        "moves the body away"
    )


def _measure(
    contact: SteadyContact,
) -> tuple[Region, Integers, Bools]:
    """Region under pressure, cells across it, and sides of the grid that it reaches, (2, 2)."""
    grid, in_contact = contact.grid, contact.in_contact
    low, high, across, touched = [], [], [], []
    for axis in (0, 1):
        lines = np.flatnonzero(in_contact.any(axis=1 - axis))
        cells, half = (grid.x, grid.y)[axis], grid.cell_size[axis] / 2
        low.append(cells[lines[0]] - half)
        high.append(cells[lines[-1]] + half)
        across.append(len(lines))
        touched.append([lines[0] < FREE, lines[-1] >= grid.shape[axis] - FREE])
    return Region(np.array(low), np.array(high)), np.array(across), np.array(touched)


def _next_region(box: Region, region: Region, touched: Bools, across: Integers) -> Region:
    """Box of the next search, after a contact in a box."""
    # Where the contact reaches the box, the box grows along that axis and does not shrink: the
    # contact may have been pushed against its rim.
    room = MARGIN * region.extents + (FREE + 1) * region.extents / across
    cut = touched.any(axis=1)
    growth = GROWTH * box.extents[:, None] * touched
    low = np.where(cut, box.low - growth[:, 0], region.low - room)
    return Region(low, np.where(cut, box.high + growth[:, 1], region.high + room))


def _divisible(cells: float) -> int:
    """Number of cells, at least these, that stays even when halved down to the coarsest grid."""
    factor: int = 2 ** (1 + int(np.log2(max(cells / COARSEST, 1))))
    return int(np.ceil(cells / factor)) * factor
