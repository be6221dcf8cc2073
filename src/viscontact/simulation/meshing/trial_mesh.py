"""Mesh trial: an elastic contact on a mesh, and on cells twice as long along x and along y."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import MESH_QUANTITIES, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadPoint
from viscontact.mechanics.contact.body_edge import END_DEPTH, end_cells, trace_outline
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.line_load import line_load, peak_line_load
from viscontact.mechanics.contact.mirror_symmetry import even_axes, mirrored_axes
from viscontact.mechanics.contact.rim import Rim, trace_rim
from viscontact.mechanics.contact.rim_extent import mean_chords
from viscontact.mechanics.halfspace.ended_response import has_even_ends, planes_in
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.simulation.meshing.body_fit import fitted_extents, grid_with_ends
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate, elastic_contact

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

#: Error of the extents in cells: at a smooth rim; where the contact becomes wider at a straight end
#: of the body along the other axis; and where its largest pressure lies there, at a sharp end.
RIM_CELLS, END_RIM_CELLS, SHARP_RIM_CELLS = 0.1, 1.5, 3.5

#: An eccentricity smaller than this part of the contact's extent, and a tilt smaller than this part
#: of the displacement over that extent, count as so large: they may be zero.
LEAST_LEVER = 0.01

#: The quantity that may be singular; area and mean pressure; and the extents along x and y.
PEAK, AREAS = "peak_pressure", ("contact_area", "mean_pressure")
EXTENTS = ("contact_length", "contact_width")

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
        """Grid with these numbers of cells, which end where the body ends, also joined in pairs."""
        planes = planes_in(self.response)
        if planes:
            return grid_with_ends(Grid(shape, self.size, centre=self.centre), planes, self.ends[0])
        return Grid(shape, fitted_extents(self.size, shape, self.ends), centre=self.centre)


@dataclass(frozen=True, eq=False)
class MeshTrial:
    """Values on a mesh, and their changes when cells are twice as long."""

    grid: Grid
    values: Floats  # `MESH_QUANTITIES` in SI units
    least_scales: Floats  # to which a smaller value's change is relative; may be 0
    #: Relative changes for cells twice as long along x, and along y [-]; shape (2, quantities).
    #: That of a peak pressure at the body's end is no smaller than `end_excess` and UNRESOLVED_END.
    changes: Floats
    #: Relative excess of the peak over the largest pressure farther from the body's ends along x,
    #: and along y, than END_DEPTH cells [-].
    end_excess: Floats
    at_end: Bools  # the contact reaches the body's end along x, and along y
    #: Mean chords of the contact along x and along y, in cells.
    consecutive_cells: Floats
    cells_across: int  # cells over the shorter extent of the contact
    peak_place: tuple[float, float]  # position of the largest pressure [m]

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of cells along x and y."""
        return self.grid.shape

    @property
    def unlimited(self) -> tuple[str, ...]:
        """Quantities that have no limit if the peak pressure has none: widths at a sharp end."""
        widens = self.at_end & (self.end_excess > 0)
        return (PEAK, *(name for axis, name in enumerate(EXTENTS) if widens[1 - axis]))

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.shape[0] * self.shape[1]

    @cached_property
    def errors(self) -> dict[str, float]:
        """Estimated relative errors: upper bounds for convergence of first order or better [-]."""
        return dict(zip(MESH_QUANTITIES, self.changes.sum(axis=0).tolist(), strict=True))


def try_mesh(pressing: ElasticContact, shape: tuple[int, int], tolerance: float) -> MeshTrial:
    """Solve a contact on a mesh (even shape), and on cells twice as long along x and along y."""
    (nx, ny), grid = shape, pressing.grid(shape)
    coarser = [
        _solve_on(pressing, replace(grid, shape=coarse), tolerance)
        for coarse in ((nx // 2, ny), (nx, ny // 2))
    ]
    # Start from the mean of both coarse pressures, each spread to two cells.
    spread = [np.repeat(coarser[axis].pressure, 2, axis=axis) for axis in (0, 1)]
    fine = _solve_on(pressing, grid, tolerance, (spread[0] + spread[1]) / 2)
    changes = np.stack([np.abs(other.values - fine.values) / fine.scales for other in coarser])
    at_end: Bools = np.any(end_cells(fine.open_gap, 1) & fine.in_contact, axis=(1, 2))
    excess = _end_excess(fine)
    straight = at_end & np.isfinite(pressing.ends)
    changes = np.maximum(changes, _least_changes(fine, straight, excess))
    return MeshTrial(
        grid,
        fine.values,
        fine.least_scales,
        changes,
        excess,
        at_end,
        fine.consecutive_cells,
        fine.cells_across,
        grid.largest_at(fine.pressure),
    )


@dataclass(frozen=True, eq=False)
class _TrialSolution:
    """Solution on one mesh: values of `MESH_QUANTITIES`, and the scales of their errors."""

    open_gap: Floats
    pressure: Floats
    in_contact: Bools
    values: Floats
    scales: Floats
    least_scales: Floats
    extents: Floats  # of the contact along x and y, in cells
    consecutive_cells: Floats
    cells_across: int


def _least_changes(found: _TrialSolution, at_straight_end: Bools, end_excess: Floats) -> Floats:
    """Smallest changes that count, however well two meshes agree by chance; (2, quantities)."""
    least = np.zeros((2, len(MESH_QUANTITIES)))
    scatter = np.where(at_straight_end, END_SCATTER, RIM_SCATTER)
    for name in AREAS:
        least[:, MESH_QUANTITIES.index(name)] = scatter / found.consecutive_cells
    for axis, name in enumerate(EXTENTS):
        cells = RIM_CELLS
        if at_straight_end[1 - axis]:
            cells = SHARP_RIM_CELLS if end_excess[1 - axis] > 0 else END_RIM_CELLS
        least[axis, MESH_QUANTITIES.index(name)] = cells / found.extents[axis]
    unresolved = np.where(end_excess > 0, np.maximum(end_excess, UNRESOLVED_END), 0.0)
    least[:, MESH_QUANTITIES.index(PEAK)] = unresolved
    return least


def _end_excess(found: _TrialSolution) -> Floats:
    """Relative excess of the peak near the body's ends along x and along y [-]."""
    peak = max(float(found.pressure.max()), TINY)
    farther = [
        float(np.where(near, 0.0, found.pressure).max())
        for near in end_cells(found.open_gap, END_DEPTH)
    ]
    return 1 - np.array(farther) / peak


def _domain_on(pressing: ElasticContact, grid: Grid, open_gap: Floats) -> ContactDomain:
    """Domain of a contact on one mesh, of what shape and load leave independent."""
    point = pressing.point
    even_load = (
        has_even_ends(pressing.response) and not (point.eccentricity_x or point.tilt_x),
        not (point.eccentricity_y or point.tilt_y),
    )
    even = even_axes(grid, open_gap, even_load)
    mirrored = mirrored_axes(grid, even)
    return ContactDomain(grid, response=pressing.response, mirrored=mirrored, even_rows=even[0])


def _solve_on(
    pressing: ElasticContact,
    grid: Grid,
    tolerance: float,
    start: Floats | None = None,
) -> _TrialSolution:
    """Solve a contact on one mesh, starting from a pressure [Pa] if one is given."""
    indenter, point = pressing.indenter, pressing.point
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    domain = _domain_on(pressing, grid, open_gap)
    found = elastic_contact(
        *(open_gap, pressing.compliance, point, domain), tolerance=tolerance, start=start
    )
    rim = trace_rim(grid, found.in_contact, found.gap, trace_outline(indenter, grid))
    extents, tiny = np.array([rim.length, rim.width]), np.full(len(MESH_QUANTITIES), TINY)
    values = _values(found, rim)
    # A body that mostly tilts has a small approach: its error is relative to the displacement.
    least, displacement = np.zeros_like(values), found.largest_displacement
    for names, scales in (
        (("eccentricity_x", "eccentricity_y"), extents),
        (("tilt_x", "tilt_y"), displacement / np.maximum(extents, TINY)),
    ):
        least[[MESH_QUANTITIES.index(name) for name in names]] = LEAST_LEVER * scales
    tiny[MESH_QUANTITIES.index("approach")] = displacement
    return _TrialSolution(
        open_gap,
        found.pressure,
        found.in_contact,
        values,
        np.maximum(np.abs(values), np.maximum(least, tiny)),
        least,
        np.maximum(extents / grid.cell_size, 1.0),
        mean_chords(found.in_contact),
        rim.cells_across,
    )


def _values(found: ContactEstimate, rim: Rim) -> Floats:
    """`MESH_QUANTITIES` of a contact."""
    grid, force = found.grid, found.force
    weight = found.pressure * grid.cell_area / max(force, TINY)
    values = {
        "peak_pressure": found.peak_pressure,
        "contact_area": rim.area,
        "approach": found.approach,
        "mean_pressure": force / max(rim.area, TINY),
        "contact_length": rim.length,
        "contact_width": rim.width,
        "peak_line_load": peak_line_load(line_load(found.pressure, grid), grid, rim.length),
        "force": force,
        "eccentricity_x": float(weight.sum(axis=1) @ grid.x),
        "eccentricity_y": float(weight.sum(axis=0) @ grid.y),
        "tilt_x": float(found.motion[1]),
        "tilt_y": float(found.motion[2]),
    }
    return np.array([values[name] for name in MESH_QUANTITIES])
