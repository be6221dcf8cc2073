"""Choice of a run's mesh: large enough for its contacts, and fine enough for the tolerance.

1. Estimate the contacts under the loads of the history at the largest compliance
   (`contact_extent`); the grid's size is their largest reach with a margin from its centre, which
   is the origin unless they are far away (`contact_place`).
2. Start from the number of cells that the rule for the first trial gives the largest contact.
3. Refine for the smallest contact under the largest load, if it is smaller than the largest one, on
   a grid of its own size; the cells over the whole grid follow in proportion.
4. Refine for the largest contact on the whole grid (`refinement`).
5. On a body that relaxes, refine for the peak pressure at the edge of the growing contact
   (`edge_ring`).
6. State the expected errors, no smaller than the error of a height map's facets.
7. Make cells smaller that are larger than a requested limit (`cell_limit`), or than the ring that
   slips under friction allows (`slip_ring`).

Bodies that adhere have a grid of their own (`adhesive_mesh`).
"""

from __future__ import annotations

import logging
import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cell_borders import refined_to_borders
from viscontact.bodies.grid import MIN_CELLS_ACROSS, AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.rounding import rounding_remedy
from viscontact.bodies.indenters.textures import CELLS_OF_A_WAVE
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.adhesive_mesh import adhesive_grid
from viscontact.simulation.meshing.body_fit import straight_ends
from viscontact.simulation.meshing.cell_limit import with_small_cells
from viscontact.simulation.meshing.contact_extent import (
    MAX_CELLS,
    PointContact,
    contacts_of_history,
    largest_compliance,
    smallest_contact,
)
from viscontact.simulation.meshing.contact_place import grid_centre
from viscontact.simulation.meshing.creeping_peak import contact_growth
from viscontact.simulation.meshing.edge_ring import resolve_ring
from viscontact.simulation.meshing.end_cells import cell_for_ends
from viscontact.simulation.meshing.full_contact_warning import whole_map_warning
from viscontact.simulation.meshing.height_map_error import facet_error
from viscontact.simulation.meshing.line_contacts import grid_of_line
from viscontact.simulation.meshing.line_grid import line_axis
from viscontact.simulation.meshing.mesh_warnings import (
    EARLY_WARNING,
    EXTENT_WARNING,
    PEAK_WARNING,
    facet_warning,
    ring_warning,
    spacing_warning,
)
from viscontact.simulation.meshing.refinement import USUAL_ORDER, Resolution, refine_mesh
from viscontact.simulation.meshing.slip_ring import cell_for_ring
from viscontact.simulation.meshing.trial_mesh import PEAK, RIM_SCATTER, ElasticContact, MeshTrial
from viscontact.units.formatting import format_quantity

_LOG = logging.getLogger("viscontact")

#: Upper limit on cells for a contact that is small at first only.
MAX_CELLS_EARLY = 2**18

#: Size of the grid over twice the reach of the contact.
MARGIN = 1.3

#: Cells across the contact in the first trial: the least, and those times sqrt(tolerance).
MIN_ACROSS, ACROSS = 20.0, 3.0

#: A smaller contact is resolved by itself if its extents are below this part of the largest one's.
SMALLER = 0.95


@dataclass(frozen=True, eq=False)
class Mesh:
    """A chosen grid, and the errors expected on it."""

    grid: Grid
    #: Expected relative errors of the requested quantities under the largest load; that of the
    #: peak pressure also over its largest value, at any instant [-].
    errors: dict[str, float]
    warnings: dict[str, str]  # sentences by kind of warning


def choose_mesh(problem: Problem, end: float | None) -> Mesh:
    """Choose the grid of a contact problem, up to `end` [s]; ValueError if none is suitable."""
    if problem.adhesion is not None:
        return Mesh(adhesive_grid(problem, end), {}, {})
    indenter, load, compliance = problem.cut_indenter, problem.contact_load, problem.compliance
    request = _with_datum(problem.automatic_grid or AutomaticGrid(), problem)
    if line_axis(indenter) is not None:
        return Mesh(grid_of_line(problem, end), {}, {})
    # Step 1: the contacts of the history, and the size of the grid.
    response = problem.surface.response_at(math.inf if end is None else end)
    found = contacts_of_history(
        indenter, largest_compliance(compliance, end), load, end, response=response
    )
    highest = max(each.point.level for each in found)
    largest = next(each for each in found if each.point.level == highest)
    if largest.point.approach is not None:
        # The approach itself is exact there: what follows from it is the force.
        names = ["force" if name == "approach" else name for name in request.quantities]
        request = replace(request, quantities=names)
    found += _contacts_before_creep(problem, end)
    centre = grid_centre([each.estimate for each in found])
    reach = np.array([each.estimate.reach_from(centre) for each in found]).max(axis=0)
    size = 2 * MARGIN * reach
    # Steps 2 to 7.
    choice = _first_choice(indenter, request, largest, size, centre)
    smallest = smallest_contact(indenter, compliance, load, end, found)
    if min(np.divide(smallest.estimate.extents, largest.estimate.extents)) < SMALLER:
        choice = _refined_for_smallest(indenter, request, smallest, size, choice)
    mesh = _refined_for_largest(indenter, request, largest, size, choice)
    mesh = _refined_for_ring(problem, end, largest, choice, mesh)
    mesh = _limited_by_map(indenter, largest, mesh)
    mesh = replace(mesh, warnings=mesh.warnings | whole_map_warning(indenter, largest, mesh.grid))
    _log(mesh)
    ring = cell_for_ring(problem, largest, end, mesh.grid, request.tolerance)
    for cell in (request.largest_cell, ring, cell_for_ends(problem, largest, request.tolerance)):
        if cell is not None:
            grid, reached = mesh.grid, largest.estimate.reach_from(centre)
            ends = straight_ends(indenter, grid.size, reached, centre)
            mesh = replace(mesh, grid=with_small_cells(grid, cell, ends))
    return replace(mesh, grid=refined_to_borders(mesh.grid, problem.planes))


def _with_datum(request: AutomaticGrid, problem: Problem) -> AutomaticGrid:
    """Requirements without the approach where it has no datum, between two ends."""
    if not problem.ends_twice or problem.surface.is_supported:
        return request
    kept = [name for name in request.quantities if name != "approach"]
    return replace(request, quantities=kept or ["contact_area"])


def _log(mesh: Mesh) -> None:
    errors = ", ".join(f"{name} {error:.2g}" for name, error in mesh.errors.items())
    (nx, ny), (length, width) = mesh.grid.shape, mesh.grid.size
    _LOG.info(
        "automatic grid: %d x %d cells over %.4g x %.4g m; expected errors: %s",
        *(nx, ny, length, width, errors or "unknown"),
    )


def _contacts_before_creep(problem: Problem, end: float | None) -> list[PointContact]:
    """Contacts of layers that creep differently under an approach, before they creep."""
    # Such layers do not keep the contact: it shrinks if a coating becomes the stiffer part.
    compliance = float(problem.compliance(0.0))
    if problem.load.control != "approach" or len(problem.surface.terms) == 1 or compliance == 0:
        return []
    response = problem.surface.response_at(0.0)
    load = problem.contact_load
    return contacts_of_history(problem.cut_indenter, compliance, load, end, response=response)


@dataclass(frozen=True, eq=False)
class _MeshChoice:
    """Cells over the whole grid for some quantities, with expected errors and warnings."""

    cells: Floats
    quantities: tuple[str, ...]
    errors: dict[str, float]
    warnings: dict[str, str]
    remedy: str  # for a singular peak pressure
    centre: tuple[float, float]  # of the grid [m]

    def after(self, found: Resolution, cells: Floats) -> _MeshChoice:
        """The choice after a contact has been resolved by some cells on the whole grid."""
        errors = {
            name: max(found.trial.errors[name], self.errors.get(name, 0.0))
            for name in found.quantities
        }
        left_out = set(self.quantities) - set(found.quantities)
        warnings = self.warnings
        if PEAK in left_out:
            warnings = warnings | {"peak": PEAK_WARNING + self.remedy}
        for name in sorted(left_out - {PEAK}):
            text = EXTENT_WARNING.format(extent=name.replace("_", " "))
            warnings = warnings | {name: text + self.remedy}
        return replace(
            self, cells=cells, quantities=found.quantities, errors=errors, warnings=warnings
        )


def _first_choice(
    indenter: Indenter,
    request: AutomaticGrid,
    largest: PointContact,
    size: Floats,
    centre: tuple[float, float],
) -> _MeshChoice:
    """Step 2: the fewest cells for the largest contact."""
    cells, across = _first_cells(indenter, request, largest, size), _first_across(request)
    if not float(np.prod(cells)) <= MAX_CELLS:
        length, width = largest.estimate.extents
        had = across * math.sqrt(MAX_CELLS / float(np.prod(cells)))
        # The tolerance in reach by the rule for the first trial, or by the scatter of the rim.
        reachable = max((ACROSS / had) ** 2, 4 * RIM_SCATTER / had)
        remedy = "give a grid"
        if had > MIN_ACROSS:
            remedy = f"ask for a tolerance of {reachable:.2g} or more, or give a grid"
        raise ValueError(
            f"grid: a contact of {format_quantity(length, 'm', 3)} x "
            f"{format_quantity(width, 'm', 3)} within {format_quantity(size[0], 'm', 3)} x "
            f"{format_quantity(size[1], 'm', 3)} needs {float(np.prod(cells)):.2g} cells for a "
            f"relative error of {request.tolerance:.2g}, more than an automatic grid has; {remedy}"
        )
    return _MeshChoice(cells, tuple(request.quantities), {}, {}, rounding_remedy(indenter), centre)


def _first_cells(
    indenter: Indenter, request: AutomaticGrid, contact: PointContact, size: Floats
) -> Floats:
    """Cells along x and y that the first trial of a contact has."""
    across = size / contact.estimate.extents
    steps = np.array(indenter.sample_spacing)
    points = np.divide(size, steps, out=np.full(2, math.inf), where=steps > 0)
    cells = np.minimum(_first_across(request) * across, np.maximum(MIN_ACROSS * across, points))
    return np.asarray(np.maximum(cells, CELLS_OF_A_WAVE * size / indenter.periods))


def _first_across(request: AutomaticGrid) -> float:
    """Cells across the contact in the first trial."""
    if request.quantities in (("approach",), ("force",)):  # hardly affected by the rim and the peak
        return MIN_ACROSS
    return max(MIN_ACROSS, ACROSS / math.sqrt(request.tolerance))


def _refined_for_smallest(
    indenter: Indenter,
    request: AutomaticGrid,
    smallest: PointContact,
    whole: Floats,
    choice: _MeshChoice,
) -> _MeshChoice:
    """Step 3: refine for a contact smaller than the largest, within a limit on the cells."""
    reach = np.array(smallest.estimate.reach_from(choice.centre))
    size = np.minimum(2 * MARGIN * reach, whole)
    part = size / whole
    fewest = np.maximum(_first_cells(indenter, request, smallest, size), choice.cells * part)
    most = max(MAX_CELLS_EARLY, float(choice.cells.prod())) * float(part.prod())
    excess = float(fewest.prod()) / most
    if excess > 1:
        cells = np.maximum(fewest / math.sqrt(excess), choice.cells * part)
        return replace(choice, cells=cells / part, warnings=choice.warnings | EARLY_WARNING)
    found = _refine(indenter, request, smallest, size, choice, fewest, most)
    chosen = choice.after(found, np.array(found.trial.shape) / part)
    if found.is_enough or found.at_finest:
        return chosen
    return replace(chosen, errors=choice.errors, warnings=chosen.warnings | EARLY_WARNING)


def _refined_for_largest(
    indenter: Indenter,
    request: AutomaticGrid,
    largest: PointContact,
    size: Floats,
    choice: _MeshChoice,
) -> Mesh:
    """Step 4: refine for the largest contact, or refuse the tolerance with the one in reach."""
    found = _refine(indenter, request, largest, size, choice, choice.cells, MAX_CELLS)
    chosen = choice.after(found, np.array(found.trial.shape))
    if not found.is_enough:
        worst = max(chosen.errors, key=chosen.errors.__getitem__)
        if not found.at_finest:
            shrinks = (found.trial.cells / MAX_CELLS) ** (USUAL_ORDER / 2)
            # With a margin, as it is rounded.
            reachable = 1.2 * chosen.errors[worst] * shrinks
            raise ValueError(
                f"grid: a relative error of {request.tolerance:.2g} would need about "
                f"{found.cells_needed:.2g} cells, more than an automatic grid has; ask for a "
                f"tolerance of {reachable:.2g} or more, or give a grid"
            )
        chosen = replace(
            chosen,
            warnings=chosen.warnings
            | spacing_warning(worst, chosen.errors[worst], _points(indenter, largest)),
        )
    _refuse_few_cells(found.trial)
    return Mesh(found.trial.grid, chosen.errors, chosen.warnings)


def _refined_for_ring(
    problem: Problem, end: float | None, largest: PointContact, choice: _MeshChoice, mesh: Mesh
) -> Mesh:
    """Step 5: refine for the peak pressure while the contact grows, within a limit on the cells."""
    if PEAK not in mesh.errors:
        return mesh
    indenter, request = problem.cut_indenter, problem.automatic_grid or AutomaticGrid()
    growth = contact_growth(indenter, problem.compliance, problem.contact_load, end, largest)
    if growth is None:
        return mesh
    shape, size = np.array(mesh.grid.shape), np.array(mesh.grid.size)
    steps = np.array(indenter.sample_spacing)
    finest = np.divide(size, steps, out=np.full(2, math.inf), where=steps > 0) / shape
    most = np.append(finest, MAX_CELLS_EARLY / shape.prod())
    across = np.divide(largest.estimate.extents, mesh.grid.cell_size)
    ring = resolve_ring(growth, across, request.tolerance, most)
    if (ring.factors > 1).any():
        choice = replace(choice, cells=ring.factors * shape)
        mesh = _refined_for_largest(indenter, request, largest, size, choice)
    warnings = ring_warning(ring.error) if ring.error > request.tolerance else {}
    errors = mesh.errors | {PEAK: max(mesh.errors[PEAK], ring.error)}
    return replace(mesh, errors=errors, warnings=mesh.warnings | warnings)


def _refuse_few_cells(trial: MeshTrial) -> None:
    """Refuse a mesh whose run would be refused: contacts far smaller than their distances."""
    if trial.cells_across >= MIN_CELLS_ACROSS:
        return
    x, y = (format_quantity(each, "m", 3) for each in trial.peak_place)
    raise ValueError(
        f"grid: only {trial.cells_across} cells of the finest automatic grid, which is as fine as "
        f"the height map, lie across the contact at x = {x}, y = {y}: the body rests on peaks far "
        "apart; keep one of them only, prescribe the tilts if they are free, or give a grid"
    )


def _limited_by_map(indenter: Indenter, largest: PointContact, mesh: Mesh) -> Mesh:
    """Step 6: raise the expected error of the peak pressure to that of the map's facets."""
    facets = facet_error(indenter, largest.estimate, largest.compliance)
    if facets <= mesh.errors.get(PEAK, math.inf):
        return mesh
    warnings = mesh.warnings | facet_warning(facets, _points(indenter, largest))
    return replace(mesh, errors=mesh.errors | {PEAK: facets}, warnings=warnings)


def _points(indenter: Indenter, contact: PointContact) -> tuple[float, float]:
    """Points of a height map along and across a contact."""
    (length, width), (dx, dy) = contact.estimate.extents, indenter.sample_spacing
    return length / dx, width / dy


def _refine(
    indenter: Indenter,
    request: AutomaticGrid,
    contact: PointContact,
    size: Floats,
    choice: _MeshChoice,
    fewest: Floats,
    most: float,
) -> Resolution:
    """Refine for one contact on a grid of this size, not beyond the spacing of a height map."""
    extents = (float(size[0]), float(size[1]))
    centre = choice.centre
    ends = straight_ends(indenter, extents, contact.estimate.reach_from(centre), centre)
    pressing = ElasticContact(
        *(indenter, contact.compliance, contact.point, extents, ends, centre, contact.response)
    )
    steps = np.array(indenter.sample_spacing)
    finest = np.divide(size, steps, out=np.full(2, math.inf), where=steps > 0)
    return refine_mesh(
        pressing,
        choice.quantities,
        request.tolerance,
        fewest=fewest,
        finest=np.maximum(fewest, finest),
        most_cells=most,
    )
