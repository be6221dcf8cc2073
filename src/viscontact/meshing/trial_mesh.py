"""Mesh trial: an elastic contact on a mesh, and on cells twice as long along x and along y."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.body_edge import trace_outline
from viscontact.contact.domain import mirrored_axes
from viscontact.contact.rim import mean_chords, trace_rim
from viscontact.grid import GRID_QUANTITIES, Grid
from viscontact.indenters import Indenter
from viscontact.loads import LoadPoint
from viscontact.meshing.elastic_estimate import elastic_contact

#: Error of the rim's position on a row of cells, in cells. The error of the area changes sign with
#: the position of the rim among the cells, so that two meshes may agree by chance; measured on
#: Hertz's ellipses.
RIM_SCATTER = 0.07

TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class ElasticContact:
    """An elastic contact to be solved on several meshes."""

    indenter: Indenter
    compliance: float  # contact compliance [1/Pa]
    point: LoadPoint
    size: tuple[float, float]  # extents of the grid [m]


@dataclass(frozen=True, eq=False)
class MeshTrial:
    """Values on a mesh, and their changes when cells are twice as long."""

    shape: tuple[int, int]  # cells along x and y
    values: NDArray[np.float64]  # `GRID_QUANTITIES` [Pa, m², m]
    #: Relative changes for cells twice as long along x, and along y [-]; shape (2, 3).
    changes: NDArray[np.float64]
    #: Mean chords of the contact along x and along y, in cells.
    consecutive_cells: NDArray[np.float64]

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.shape[0] * self.shape[1]

    @cached_property
    def errors(self) -> dict[str, float]:
        """Estimated relative errors: upper bounds for convergence of first order or better [-]."""
        return dict(zip(GRID_QUANTITIES, self.changes.sum(axis=0).tolist(), strict=True))


def try_mesh(pressing: ElasticContact, shape: tuple[int, int], tolerance: float) -> MeshTrial:
    """Solve a contact on a mesh, and on cells twice as long along x and along y.

    `shape` holds even numbers of cells; `tolerance` is that of gap and balances.

    Examples
    --------
    >>> from viscontact.indenters import Sphere
    >>> from viscontact.loads import step
    >>> ball = ElasticContact(Sphere(0.01), 1e-6, step(0.1).at(0.0), (2.4e-3, 2.4e-3))
    >>> try_mesh(ball, (24, 24), 1e-4).errors["approach"] < 0.01
    True
    """
    nx, ny = shape
    coarser = [_found(pressing, coarse, tolerance) for coarse in ((nx // 2, ny), (nx, ny // 2))]
    # Start from the mean of both coarse pressures, each spread to two cells.
    spread = [np.repeat(coarser[axis].pressure, 2, axis=axis) for axis in (0, 1)]
    fine = _found(pressing, shape, tolerance, (spread[0] + spread[1]) / 2)
    changes = np.stack([np.abs(other.values - fine.values) / fine.scales for other in coarser])
    area = GRID_QUANTITIES.index("contact_area")
    changes[:, area] = np.maximum(changes[:, area], RIM_SCATTER / fine.consecutive_cells)
    return MeshTrial(shape, fine.values, changes, fine.consecutive_cells)


@dataclass(frozen=True, eq=False)
class _Found:
    """Solution on one mesh: values of `GRID_QUANTITIES`, and the scales of their errors."""

    pressure: NDArray[np.float64]
    values: NDArray[np.float64]
    scales: NDArray[np.float64]
    consecutive_cells: NDArray[np.float64]


def _found(
    pressing: ElasticContact,
    shape: tuple[int, int],
    tolerance: float,
    start: NDArray[np.float64] | None = None,
) -> _Found:
    """Solve a contact on one mesh, starting from a pressure [Pa] if one is given."""
    grid, indenter, point = Grid(shape, pressing.size), pressing.indenter, pressing.point
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    even = (
        not (point.eccentricity_x or point.tilt_x),
        not (point.eccentricity_y or point.tilt_y),
    )
    found = elastic_contact(
        open_gap,
        pressing.compliance,
        point,
        grid,
        tolerance=tolerance,
        mirrored=mirrored_axes(open_gap, even),
        start=start,
    )
    contact = found.pressure > 0
    area = trace_rim(grid, contact, found.gap, trace_outline(indenter, grid)).area
    values = np.array([found.peak_pressure, area, found.approach])
    # A body that mostly tilts has a small approach: its error is relative to the displacement.
    scales = np.maximum(values, [TINY, TINY, found.largest_displacement])
    return _Found(found.pressure, values, scales, mean_chords(contact))
