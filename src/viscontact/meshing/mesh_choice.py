"""The mesh of a run: large enough for its contacts, and fine enough for what is asked of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.grid import AutomaticGrid, Grid
from viscontact.indenters import Indenter
from viscontact.indenters.textures import CELLS_OF_A_WAVE
from viscontact.meshing.contact_extent import (
    MAX_CELLS,
    PointContact,
    contacts_of_history,
    largest_compliance,
    smallest_contact,
)
from viscontact.meshing.height_map_error import facet_error
from viscontact.meshing.refinement import PEAK, USUAL_ORDER, Resolution, refine_mesh
from viscontact.meshing.trial_mesh import RIM_SCATTER, ElasticContact
from viscontact.problem.problem import Problem
from viscontact.units.formatting import format_quantity

#: No more cells are spent on a contact that is small at first and large for most of the run.
MAX_CELLS_EARLY = 2**18

#: Room around the contact in the grid that is returned.
MARGIN = 1.3

#: Cells across the contact to begin with: at least so many, and more for small tolerances.
MIN_ACROSS, ACROSS = 20.0, 3.0

#: A contact is looked at besides the largest if its extents are less than this part of those.
SMALLER = 0.95

#: What is said where the pressure grows on with smaller cells, and where a run begins with a
#: contact too small for its grid.
PEAK_WARNING = {
    "peak": (
        "the peak pressure depends on the mesh here: at a sharp edge or tip it grows on as cells "
        "get smaller, and the grid was not chosen for it"
    )
}
EARLY_WARNING = {
    "early": (
        "the contact is much smaller when the load is first largest than it becomes: the grid does "
        "not keep the tolerance until it has grown; give a grid, or make the run shorter"
    )
}


@dataclass(frozen=True, eq=False)
class Mesh:
    """A grid that was chosen, and what is expected of it.

    Attributes
    ----------
    grid : Grid
        The grid.
    errors : dict of str to float
        Expected relative errors of the quantities that it was chosen for, under the largest load
        [-].
    warnings : dict of str to str
        Sentences by kind of doubt: what it was not, or could not be, chosen for.
    """

    grid: Grid
    errors: dict[str, float]
    warnings: dict[str, str]


def choose_mesh(problem: Problem, end: float | None) -> Mesh:
    """Choose a grid for a contact problem.

    Parameters
    ----------
    problem : Problem
        The contact problem, with its requirements on the grid.
    end : float or None
        Last time of the run [s]; the load's last point, or the end of all creep, when None.

    Returns
    -------
    Mesh
        The grid, and what is expected of it.

    Raises
    ------
    ValueError
        If no end of the creep is known, no grid fits, or the tolerance would need millions of
        cells.
    """
    indenter, load, compliance = problem.indenter, problem.load, problem.compliance
    wish = problem.automatic_grid or AutomaticGrid()
    largest = largest_compliance(compliance, end)
    found = contacts_of_history(indenter, largest, load, end)
    highest = max(each.point.level for each in found)
    late = next(each for each in found if each.point.level == highest)
    reach = np.array([each.estimate.reach for each in found], dtype=np.float64).max(axis=0)
    size = 2 * MARGIN * reach
    choice = _begun(indenter, wish, late, size)
    early = smallest_contact(indenter, compliance, load, end, found)
    if min(np.divide(early.estimate.extents, late.estimate.extents)) < SMALLER:
        choice = _refined_early(indenter, wish, early, size, choice)
    return _as_the_map_allows(
        indenter, late, _refined_in_the_end(indenter, wish, late, size, choice)
    )


@dataclass(frozen=True, eq=False)
class _MeshChoice:
    """So many cells over the whole grid, for these quantities, with these errors and warnings."""

    cells: NDArray[np.float64]
    quantities: tuple[str, ...]
    errors: dict[str, float]
    warnings: dict[str, str]

    def after(self, found: Resolution, cells: NDArray[np.float64]) -> _MeshChoice:
        """What is chosen after a contact has been resolved by so many cells."""
        errors = {
            name: max(found.trial.errors[name], self.errors.get(name, 0.0))
            for name in found.quantities
        }
        left_out = set(self.quantities) - set(found.quantities)
        warnings = self.warnings | PEAK_WARNING if left_out else self.warnings
        return _MeshChoice(cells, found.quantities, errors, warnings)


def _begun(
    indenter: Indenter, wish: AutomaticGrid, late: PointContact, size: NDArray[np.float64]
) -> _MeshChoice:
    """The cells that the largest contact needs at least."""
    cells, across = _fewest(indenter, wish, late, size), _across(wish)
    if not float(np.prod(cells)) <= MAX_CELLS:
        length, width = late.estimate.extents
        had = across * math.sqrt(MAX_CELLS / float(np.prod(cells)))
        # By the rule for the first trial, or by what is known of the rim.
        reachable = max((ACROSS / had) ** 2, 4 * RIM_SCATTER / had)
        remedy = "give a grid"
        if had > MIN_ACROSS:
            remedy = f"ask for a tolerance of {reachable:.2g} or more, or give a grid"
        raise ValueError(
            f"grid: a contact of {format_quantity(length, 'm', 3)} x "
            f"{format_quantity(width, 'm', 3)} within {format_quantity(size[0], 'm', 3)} x "
            f"{format_quantity(size[1], 'm', 3)} needs {float(np.prod(cells)):.2g} cells for a "
            f"relative error of {wish.tolerance:.2g}, more than an automatic grid has; {remedy}"
        )
    return _MeshChoice(cells, tuple(wish.quantities), {}, {})


def _fewest(
    indenter: Indenter, wish: AutomaticGrid, contact: PointContact, size: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Cells along x and y that a contact on a grid of this size begins with."""
    across = size / contact.estimate.extents
    steps = np.array(indenter.sample_spacing)
    points = np.divide(size, steps, out=np.full(2, math.inf), where=steps > 0)
    cells = np.minimum(_across(wish) * across, np.maximum(MIN_ACROSS * across, points))
    return np.asarray(np.maximum(cells, CELLS_OF_A_WAVE * size / indenter.period))


def _across(wish: AutomaticGrid) -> float:
    if wish.quantities == ("approach",):  # which knows little of the rim and of the middle
        return MIN_ACROSS
    return max(MIN_ACROSS, ACROSS / math.sqrt(wish.tolerance))


def _refined_early(
    indenter: Indenter,
    wish: AutomaticGrid,
    early: PointContact,
    whole: NDArray[np.float64],
    choice: _MeshChoice,
) -> _MeshChoice:
    """Refine for a contact that is harder to resolve than the largest, as far as it pays."""
    size = np.minimum(2 * MARGIN * np.array(early.estimate.reach), whole)
    part = size / whole
    fewest = np.maximum(_fewest(indenter, wish, early, size), choice.cells * part)
    most = max(MAX_CELLS_EARLY, float(choice.cells.prod())) * float(part.prod())
    excess = float(fewest.prod()) / most
    if excess > 1:
        cells = np.maximum(fewest / math.sqrt(excess), choice.cells * part)
        return replace(choice, cells=cells / part, warnings=choice.warnings | EARLY_WARNING)
    found = _resolved(indenter, wish, early, size, choice.quantities, fewest, most)
    chosen = choice.after(found, np.array(found.trial.shape) / part)
    if found.is_enough or found.at_finest:
        return chosen
    return replace(chosen, errors=choice.errors, warnings=chosen.warnings | EARLY_WARNING)


def _refined_in_the_end(
    indenter: Indenter,
    wish: AutomaticGrid,
    late: PointContact,
    size: NDArray[np.float64],
    choice: _MeshChoice,
) -> Mesh:
    """The grid that resolves the largest contact, too."""
    found = _resolved(indenter, wish, late, size, choice.quantities, choice.cells, MAX_CELLS)
    chosen = choice.after(found, np.array(found.trial.shape))
    if not found.is_enough:
        worst = max(chosen.errors, key=chosen.errors.__getitem__)
        if not found.at_finest:
            shrinks = (found.trial.cells / MAX_CELLS) ** (USUAL_ORDER / 2)
            # Rounded, and on the safe side.
            reachable = 1.2 * chosen.errors[worst] * shrinks
            raise ValueError(
                f"grid: a relative error of {wish.tolerance:.2g} would need about "
                f"{found.cells_needed:.2g} cells, more than an automatic grid has; ask for a "
                f"tolerance of {reachable:.2g} or more, or give a grid"
            )
        chosen = replace(chosen, warnings=chosen.warnings | _map_doubt(worst, chosen.errors[worst]))
    grid = Grid(found.trial.shape, (float(size[0]), float(size[1])))
    return Mesh(grid, chosen.errors, chosen.warnings)


def _as_the_map_allows(indenter: Indenter, late: PointContact, mesh: Mesh) -> Mesh:
    """The same mesh, from which no smaller error is expected than the map's facets make."""
    facets = facet_error(indenter, late.estimate, late.compliance)
    if facets <= mesh.errors.get(PEAK, math.inf):
        return mesh
    warnings = mesh.warnings | _facet_doubt(facets)
    return replace(mesh, errors=mesh.errors | {PEAK: facets}, warnings=warnings)


def _resolved(
    indenter: Indenter,
    wish: AutomaticGrid,
    contact: PointContact,
    size: NDArray[np.float64],
    quantities: tuple[str, ...],
    fewest: NDArray[np.float64],
    most: float,
) -> Resolution:
    """Cells for one contact on a grid of this size; a map tells nothing between its points."""
    extents = (float(size[0]), float(size[1]))
    pressing = ElasticContact(indenter, contact.compliance, contact.point, extents)
    steps = np.array(indenter.sample_spacing)
    finest = np.divide(size, steps, out=np.full(2, math.inf), where=steps > 0)
    return refine_mesh(
        pressing,
        quantities,
        wish.tolerance,
        fewest=fewest,
        finest=np.maximum(fewest, finest),
        most_cells=most,
    )


def _map_doubt(name: str, error: float) -> dict[str, str]:
    return {
        "map spacing": (
            f"cells as small as the steps of the height map leave a relative error of about "
            f"{error:.1g} in the {name.replace('_', ' ')}; a map of smaller steps would tell more"
        )
    }


def _facet_doubt(error: float) -> dict[str, str]:
    return {
        "facets": (
            "between its points the height map is taken as straight, which leaves a relative error "
            f"of about {error:.1g} in the peak pressure however small the cells are; a map of "
            "smaller steps would tell more"
        )
    }
