"""Mesh trial: an elastic contact on a mesh, and on cells twice as long along x and along y."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.body_edge import END_DEPTH, end_cells, trace_outline
from viscontact.contact.domain import mirrored_axes
from viscontact.contact.rim import mean_chords, trace_rim
from viscontact.grid import GRID_QUANTITIES, Grid
from viscontact.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.indenters import Indenter
from viscontact.loads import LoadPoint
from viscontact.meshing.body_fit import fitted_extents
from viscontact.meshing.elastic_estimate import elastic_contact

#: Error of the rim's position on a row of cells, in cells, the largest on Hertz's ellipses. The
#: error of the area changes sign with the position of the rim among the cells, so that two meshes
#: may agree by chance.
RIM_SCATTER = 0.05

#: Least relative error of a peak pressure within END_DEPTH cells of the body's end: on four times
#: as many cells it was up to 20 % larger or smaller (Lundberg's and Johns and Gohar's profiles).
UNRESOLVED_END = 0.1

#: Error of the area in the cells at the body's end, in cells: the contact becomes wider in them, or
#: ends before the body does; measured on rollers with sharp and logarithmic ends.
END_SCATTER = 0.3

TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class ElasticContact:
    """An elastic contact to be solved on several meshes."""

    indenter: Indenter
    compliance: float  # contact compliance [1/Pa]
    point: LoadPoint
    size: tuple[float, float]  # extents of the grid, to be fitted to the body's ends [m]
    ends: tuple[float, float] = (math.inf, math.inf)  # of the body, from `straight_ends` [m]
    centre: tuple[float, float] = (0.0, 0.0)  # of the grid [m]
    response: SurfaceResponse = HALF_SPACE

    def grid(self, shape: tuple[int, int]) -> Grid:
        """Grid with these numbers of cells, which end where the body ends."""
        return Grid(shape, fitted_extents(self.size, shape, self.ends), centre=self.centre)


@dataclass(frozen=True, eq=False)
class MeshTrial:
    """Values on a mesh, and their changes when cells are twice as long."""

    grid: Grid
    values: NDArray[np.float64]  # `GRID_QUANTITIES` [Pa, m², m]
    #: Relative changes for cells twice as long along x, and along y [-]; shape (2, 3). That of a
    #: peak pressure at the body's end is no smaller than `end_excess` and UNRESOLVED_END.
    changes: NDArray[np.float64]
    #: Relative excess of the peak over the largest pressure farther from the body's ends along x,
    #: and along y, than END_DEPTH cells [-].
    end_excess: NDArray[np.float64]
    at_end: NDArray[np.bool_]  # the contact reaches the body's end along x, and along y
    #: Mean chords of the contact along x and along y, in cells.
    consecutive_cells: NDArray[np.float64]
    cells_across: int  # cells over the shorter extent of the contact
    peak_place: tuple[float, float]  # position of the largest pressure [m]

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of cells along x and y."""
        return self.grid.shape

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
    (nx, ny), grid = shape, pressing.grid(shape)
    coarser = [
        _found(pressing, replace(grid, shape=coarse), tolerance)
        for coarse in ((nx // 2, ny), (nx, ny // 2))
    ]
    # Start from the mean of both coarse pressures, each spread to two cells.
    spread = [np.repeat(coarser[axis].pressure, 2, axis=axis) for axis in (0, 1)]
    fine = _found(pressing, grid, tolerance, (spread[0] + spread[1]) / 2)
    changes = np.stack([np.abs(other.values - fine.values) / fine.scales for other in coarser])
    area = GRID_QUANTITIES.index("contact_area")
    at_end: NDArray[np.bool_] = np.any(
        end_cells(fine.open_gap, 1) & (fine.pressure > 0), axis=(1, 2)
    )
    scatter = np.where(at_end & np.isfinite(pressing.ends), END_SCATTER, RIM_SCATTER)
    changes[:, area] = np.maximum(changes[:, area], scatter / fine.consecutive_cells)
    peak = GRID_QUANTITIES.index("peak_pressure")
    excess = _end_excess(fine)
    unresolved = np.where(excess > 0, np.maximum(excess, UNRESOLVED_END), 0.0)
    changes[:, peak] = np.maximum(changes[:, peak], unresolved)
    return MeshTrial(
        grid,
        fine.values,
        changes,
        excess,
        at_end,
        fine.consecutive_cells,
        fine.cells_across,
        grid.largest_at(fine.pressure),
    )


@dataclass(frozen=True, eq=False)
class _Found:
    """Solution on one mesh: values of `GRID_QUANTITIES`, and the scales of their errors."""

    open_gap: NDArray[np.float64]
    pressure: NDArray[np.float64]
    values: NDArray[np.float64]
    scales: NDArray[np.float64]
    consecutive_cells: NDArray[np.float64]
    cells_across: int


def _end_excess(found: _Found) -> NDArray[np.float64]:
    """Relative excess of the peak near the body's ends along x and along y [-]."""
    peak = max(float(found.pressure.max()), TINY)
    farther = [
        float(np.where(near, 0.0, found.pressure).max())
        for near in end_cells(found.open_gap, END_DEPTH)
    ]
    return 1 - np.array(farther) / peak


def _found(
    pressing: ElasticContact,
    grid: Grid,
    tolerance: float,
    start: NDArray[np.float64] | None = None,
) -> _Found:
    """Solve a contact on one mesh, starting from a pressure [Pa] if one is given."""
    indenter, point = pressing.indenter, pressing.point
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
        response=pressing.response,
        tolerance=tolerance,
        mirrored=mirrored_axes(grid, open_gap, even),
        start=start,
    )
    contact = found.pressure > 0
    rim = trace_rim(grid, contact, found.gap, trace_outline(indenter, grid))
    values = np.array([found.peak_pressure, rim.area, found.approach])
    # A body that mostly tilts has a small approach: its error is relative to the displacement.
    scales = np.maximum(values, [TINY, TINY, found.largest_displacement])
    chords = mean_chords(contact)
    return _Found(open_gap, found.pressure, values, scales, chords, rim.cells_across)
