"""A formula over cells: its means, and what gives the displacement under it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.runs.given_pressure.boxes import TRIED, Boxes, PointValues
from viscontact.runs.given_pressure.cell_series import MULTIPOLES, legendre_to
from viscontact.runs.given_pressure.division import divide
from viscontact.runs.given_pressure.near_field import NearField
from viscontact.runs.given_pressure.patches import Patches

#: Gauss' rule on a cell: four points along each axis.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)

#: Further places along each axis at which the series is tried, so that no small spot is missed.
SPREAD = (2 * np.arange(6) - 5) / 6

#: Part of a misfit of the series in a cell, times its edge, that displaces the surface there.
OF_MISFIT = 0.1


@dataclass(frozen=True)
class Effort:
    """How closely a formula is resolved."""

    tolerance: float  # of its displacement, over the mean pressure and the width of the load
    boxes: int  # most at once, as noise would be divided without end; 0: no edges are looked for


#: What displacements are found with, and what their error is; and four points along each axis of
#: a cell.
FINE, COARSE, BY_POINTS = Effort(1e-7, 40_000), Effort(1e-6, 15_000), Effort(1e-7, 0)


@dataclass(frozen=True, eq=False)
class ResolvedPressure:
    """A pressure as its displacement is found: by cells, and by what these lack near by."""

    field: NearField
    series: Floats  # to the third order in each cell, shape (orders, nx, ny) [Pa]
    rough: Bools  # cells that are divided into patches
    patches: Patches | None = None
    lost: float = 0.0  # sum of pressures over the cells that boxes were too few for [Pa]

    @property
    def relative_loss(self) -> float:
        """Part of the force that boxes were too few to find [-]."""
        return self.lost / max(float(np.abs(self.means).sum()), np.finfo(float).tiny)

    @property
    def means(self) -> Floats:
        """Means over the cells [Pa]."""
        return np.asarray(self.series[0])

    @property
    def carriers(self) -> Floats:
        """Pressure of cells that acts as it does from a distance, on the padded grid [Pa]."""
        return self.field.carriers(self.series)

    @property
    def near(self) -> Floats:
        """Displacement that the carriers lack near by, per 1/E* [Pa m]."""
        found = self.field.of_cells(np.where(self.rough, 0.0, self.series))
        if self.patches is not None:
            found += self.field.of_patches(self.patches, self.rough)
        return found


def resolved(values: PointValues, field: NearField, effort: Effort = FINE) -> ResolvedPressure:
    """Resolve a formula over cells.

    >>> square = Grid((4, 4), (2.0, 2.0))
    >>> circle = resolved(lambda x, y: 1.0 * (x**2 + y**2 < 1), NearField(square))
    >>> print(f"{circle.means.sum() * square.cell_area:.6f}")
    3.141593
    """
    cells = _cells(values, field)
    series, loaded = _series(cells)
    mean = float(np.abs(series[0]).sum()) / loaded
    allowed = effort.tolerance * mean * loaded ** (1 / max(sum(cells.varies), 1))
    shape = (-1, *field.grid.shape)
    if not effort.boxes or not any(cells.varies):
        return ResolvedPressure(field, series.reshape(shape), np.zeros(shape[1:], dtype=bool))
    rough = _rough(cells, series, allowed, field.grid)
    which = np.flatnonzero(rough)
    if not which.size:
        return ResolvedPressure(field, series.reshape(shape), rough)
    boxes = replace(cells.chosen(which), cell=np.arange(which.size))
    patches, lost = divide(boxes, allowed, effort.boxes)
    series[:, which] = patches.series(field.size, which.size, MULTIPOLES)
    return ResolvedPressure(field, series.reshape(shape), rough, patches, lost)


def _cells(values: PointValues, field: NearField) -> Boxes:
    """The cells as boxes; along a strip, on which nothing varies, the formula is averaged."""
    grid = field.grid
    middle = np.array([each.ravel() for each in np.meshgrid(grid.x, grid.y, indexing="ij")])
    cell = np.arange(middle.shape[1])
    values = values if all(field.varies) else _averaged(values, field)
    return Boxes(values, middle, cell, np.zeros_like(middle), np.array(field.size), field.varies)


def _averaged(values: PointValues, field: NearField) -> PointValues:
    """The formula averaged along a strip."""
    grid = field.grid
    along = [
        None if varies else middle + NODES * edge / 2
        for varies, middle, edge in zip(field.varies, grid.centre, grid.size, strict=True)
    ]

    def mean(x: Floats, y: Floats) -> Floats:
        total = np.zeros(np.broadcast_shapes(x.shape, y.shape))
        for index, weight in enumerate(WEIGHTS / 2):
            at = (
                each if nodes is None else np.full_like(each, nodes[index])
                for each, nodes in zip((x, y), along, strict=True)
            )
            total += weight * values(*at)
        return total

    return mean


def _series(cells: Boxes) -> tuple[Floats, int]:
    """Series of the cells to the third order, and how many are loaded."""
    sampled = cells.on(NODES)
    rows = (2 * np.arange(4.0)[:, None] + 1) * WEIGHTS / 2 * legendre_to(3, NODES)
    terms = np.array([np.outer(rows[a], rows[b]) for a, b in MULTIPOLES])
    series = np.tensordot(terms, sampled, axes=([1, 2], [0, 1]))
    loaded = int(np.count_nonzero(sampled.any(axis=(0, 1))))
    return series, max(loaded, 1)


def _rough(cells: Boxes, series: Floats, tolerance: float, grid: Grid) -> Bools:
    """Cells in which the series misses the formula; of neighbours of such, along the sides, too."""

    def fitted(chosen: Floats, along: Floats, across: Floats) -> Floats:
        in_x, in_y = (legendre_to(3, each) for each in (along, across))
        return np.asarray(
            sum(c * in_x[a] * in_y[b] for c, (a, b) in zip(chosen, MULTIPOLES, strict=True))
        )

    found = np.zeros(cells.cell.size, dtype=bool)
    for nodes in (NODES, TRIED, SPREAD):
        places = np.broadcast_arrays(nodes[:, None, None], nodes[None, :, None])
        apart = np.abs(cells.on(nodes) - fitted(series, *places))
        found |= OF_MISFIT * apart.max(axis=(0, 1)) > tolerance
    looked = found.copy()
    modes = ["wrap" if each else "constant" for each in grid.periodic]
    while True:
        around = scipy.ndimage.maximum_filter(found.reshape(grid.shape), 3, mode=modes).ravel()
        ring = np.flatnonzero(around & ~looked)
        if not ring.size:
            return found.reshape(grid.shape)
        looked[ring] = True
        apart = cells.chosen(ring).misfit_at_sides(
            lambda *at, ring=ring: fitted(series[:, ring], *at)
        )
        found[ring] = OF_MISFIT * apart > tolerance
