"""Grid enlargement: the next larger grid of a contact that outgrows its own, and its fields."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.backend.transforms import fast_length
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.rim_crossings import MARGIN
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse
from viscontact.simulation.meshing.contact_extent import MAX_CELLS
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution

#: Growth of the grid along an axis where the contact reaches its rim [-].
FACTOR = 1.5

#: Cells that stay free around a contact whose grid may grow; its rim is traced in them.
FREE = MARGIN


def overrun(in_contact: Bools, free: int = 1, team: Team | None = None) -> tuple[bool, bool]:
    """True for x and for y if contact has reached the `free` outermost cells of a side."""
    spans = (team or Team()).spans(in_contact)
    if spans is None:
        return False, False
    along, across = (
        lines.start < free or lines.stop > count - free
        for lines, count in zip(spans, in_contact.shape, strict=True)
    )
    return along, across


def next_grid(grid: Grid, along: bool, across: bool) -> Grid | None:
    """Grid of the same cells, half as long again along x, y or both; None if too large."""
    shape = (
        _longer(grid.shape[0], grid.cell_size[0]) if along else grid.shape[0],
        _longer(grid.shape[1], grid.cell_size[1]) if across else grid.shape[1],
    )
    return grid.widened(shape) if shape[0] * shape[1] <= MAX_CELLS else None


def _longer(cells: int, size: float) -> int:
    """A number of cells that suits the transforms and keeps the cell size to the bit."""
    wanted = math.ceil(FACTOR * cells)
    while True:
        count = fast_length(wanted)
        # Restarts and results then have the same cells, in however many enlargements.
        if (count - cells) % 2 == 0 and size * count / count == size:
            return count
        wanted = count + 1


@dataclass(frozen=True, eq=False)
class GridEnlargement:
    """Map of pressures and their unit displacements from a domain to a larger one."""

    small: ContactDomain
    large: ContactDomain
    run: RunSetup | None = None  # on the larger grid; without it no solution of a step is mapped

    def pressure(self, pressure: Floats) -> Floats:
        """Embed a pressure of the computed cells in those of the larger grid."""
        whole = self.small.expand_by_symmetry(pressure)
        return self.large.reduce_by_symmetry(self.small.grid.embed(whole, self.large.grid))

    def pairs(self, fields: Floats, response: SurfaceResponse | None = None) -> Floats:
        """Map pressures and unit displacements, (..., 2, nx, ny), of the surface or a response."""
        is_part = response is not None and response != self.large.response
        grown = np.empty((*fields.shape[:-2], *self.large.shape))
        for index in np.ndindex(fields.shape[:-3]):
            pressure, unit_displacement = grown[index]
            pressure[:] = self.pressure(fields[index][0])
            if is_part and response is not None:
                unit_displacement[:] = self.large.unit_displacement(pressure, response)
            else:
                self.large.convolution.apply(pressure, into=unit_displacement)
        return grown

    def solution(self, before: StepSolution) -> StepSolution:
        """Map the solution of a step; its gap beyond the smaller grid is NaN."""
        small, large = self.small, self.large
        reference = self.pairs(before.reference)
        # Of several terms, the displacement is known on the smaller grid only.
        beyond = large.expand_by_symmetry(reference[1])
        known = small.grid.embed(before.displacement, large.grid, beyond=np.nan)
        displacement = np.where(np.isnan(known), beyond, known)
        attracted = self._energy_beyond(displacement, np.isnan(known), before.motion)
        return replace(
            before,
            pressure=small.grid.embed(before.pressure, large.grid),
            gap=small.grid.embed(before.gap, large.grid, beyond=np.nan),
            displacement=displacement,
            in_contact=small.grid.embed(before.in_contact, large.grid, beyond=False),
            reference=reference,
            adhesion_energy=before.adhesion_energy + attracted,
            work_beyond=before.work_beyond - attracted,
        )

    def _energy_beyond(self, displacement: Floats, beyond: Bools, motion: Floats) -> float:
        """Work that separating the surfaces in cells beyond the smaller grid would take [J]."""
        run = self.run
        if run is None or run.law is None:
            return 0.0
        approach, tilt_x, tilt_y = motion
        plane = approach + tilt_x * run.grid.x[:, None] + tilt_y * run.grid.y
        gap = run.gap_at(0.0) + displacement - plane  # bodies that adhere do not travel
        energy = run.law.energy(np.maximum(gap[beyond], 0.0))
        return float(energy.sum()) * run.grid.cell_area
