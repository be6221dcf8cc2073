"""Preparation of steady contacts: law, and a grid for each speed."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.compiled import NUMPY
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import fastest_transforms, transforms_by
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.mechanics.contact.mirror_symmetry import even_axes
from viscontact.simulation.checks.ends import (
    check_ends,
    check_grid_of_ends,
    check_tilt_of_ends,
    error_of_ends,
    tilts_from_datum,
)
from viscontact.simulation.checks.periodicity import check_endless, check_period, refuse_approach
from viscontact.simulation.meshing.contact_place import locate_contact
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate
from viscontact.simulation.meshing.line_grid import line_axis, line_estimate, line_grid
from viscontact.simulation.steady_motion.contact import SteadySolver, gap_on
from viscontact.simulation.steady_motion.coupled import CoupledSolver
from viscontact.simulation.steady_motion.moving_law import (
    MovingLaws,
    ShearLaw,
    moving_laws,
    shear_laws,
)
from viscontact.simulation.steady_motion.problem import SteadyProblem
from viscontact.simulation.steady_motion.region import (
    SEARCH_CELLS,
    Lattice,
    Region,
    common_grid,
    find_region,
    lattice_for,
    lattice_with_ends,
)
from viscontact.simulation.steady_motion.traction import TractionSolver
from viscontact.units.formatting import format_quantity

#: Cells across the smallest contact, times the square root of the grid's tolerance; at least some.
ACROSS, LEAST_ACROSS = 6.0, 20.0

#: Cells on the thickness of the thinnest layer, along the motion, and the most by which cells are
#: made shorter for them.
CELLS_OF_LAYER, MOST_REFINEMENT = 2.0, 2.0

#: Part of these cells that may be lacking.
LITTLE_LESS = 0.01

#: Samples along each axis by which a body is found to be even.
EVEN_SAMPLES = 48

#: Cells of a given grid that its contact is assumed to have, for the shortest times of a law.
CELLS_OF_GIVEN = 1000

#: Rounds in which the compliance of a contact and the time in which it is passed are matched.
ROUNDS = 4


@dataclass(frozen=True, eq=False)
class SteadySetup:
    """Checked and complete setup of a run over speed: its solver, and the grid of each speed."""

    solver: SteadySolver
    grids: tuple[Grid, ...]
    threads: int
    transforms: str  # library of the transforms
    shear: tuple[ShearLaw, ...] = ()  # laws under shear, of a body that rolls with traction
    #: Convolutions of the search for regions, in those of the grids.
    work: float = 0.0
    #: Tolerance of a chosen grid, if its cells are too large for the requested one.
    tolerance_reached: float | None = None

    @property
    def problem(self) -> SteadyProblem:
        """The problem."""
        return self.solver.problem

    @property
    def tractions(self) -> TractionSolver | None:
        """Solver of the tractions; None of a body without creepages."""
        if not self.shear:
            return None
        return TractionSolver(self.problem, self.shear, self.solver.transforms)

    @property
    def coupled(self) -> CoupledSolver | None:
        """Solver of contact and tractions together; None of bodies that are not coupled."""
        tractions = self.tractions
        if tractions is None or not self.problem.contact.is_coupled:
            return None
        return CoupledSolver(self.solver, tractions)

    @cached_property
    def tilts_from_datum(self) -> bool:
        """True if the tilt along x has a datum: not if a body that bends has two free ends."""
        open_gap = gap_on(self.problem, self.grids[0])
        return tilts_from_datum(self.problem.contact, self.grids[0], open_gap)

    @cached_property
    def ends_error(self) -> float:
        """Part of the displacement by free ends that their operator may miss; 0 without [-]."""
        contact, grid = self.problem.contact, self.grids[0]
        even = bool(contact.ended_bodies) and self.solver.is_even_across(
            grid, gap_on(self.problem, grid)
        )
        return error_of_ends(contact, even=even)

    @property
    def grid(self) -> Grid:
        """Smallest grid that holds the grids of all speeds."""
        return common_grid(self.grids)

    @property
    def inner_loops(self) -> str:
        """Inner loops: those of NumPy."""
        return NUMPY

    def with_libraries(self, transforms: str, inner_loops: str) -> SteadySetup:
        """Return the run with other transforms; ValueError if not installed."""
        solver = replace(self.solver, transforms=transforms_by(transforms, self.threads))
        return replace(self, solver=solver, transforms=transforms)


def prepare(problem: SteadyProblem, threads: int = 1) -> SteadySetup:
    """Find the law and the grids of a problem; refuse a body that does not touch."""
    problem = _with_line_grid(problem)
    library = fastest_transforms()
    transforms = transforms_by(library, threads)
    given, axis, contact = problem.contact.grid, problem.axis, problem.contact
    if problem.motion.spin and isinstance(given, Grid) and any(given.periodic):
        raise ValueError(
            "spin: a body without end does not turn over the surface; leave spin out, or give a "
            "body that ends and a grid without a period"
        )
    check_ends(contact)
    check_endless(contact.cut_indenter, given if isinstance(given, Grid) else None)
    if isinstance(given, Grid):
        supported = contact.surface.is_supported
        check_grid_of_ends(contact, given)
        open_gap = gap_on(problem, given)
        check_tilt_of_ends(contact, [problem.point], given, open_gap)
        check_period(contact.indenter, open_gap, given, contact.load, supported=supported)
    _refuse_apart(problem)
    if isinstance(given, Grid):
        extents = CELLS_OF_GIVEN * given.cell_size[axis], given.size[axis]
        laws, shear = moving_laws(problem, extents), _shear_laws(problem, extents)
        _refuse_flow(laws, given, twice=contact.ends_twice)
        _refuse_long_grid(laws, given, axis)
        solver = SteadySolver(problem, laws, transforms)
        return SteadySetup(solver, (given,) * len(problem.speeds), threads, library, shear)
    speeds = problem.speeds
    fast, slow = (estimate_at(problem, float(speed)) for speed in (speeds.max(), speeds.min()))
    extents = fast.extents[axis], slow.extents[axis]
    solver = SteadySolver(problem, moving_laws(problem, extents), transforms)
    if contact.ended_bodies:
        _refuse_flow(solver.laws, None, twice=contact.ends_twice)
    setup = SteadySetup(solver, (), threads, library, _shear_laws(problem, extents))
    setup = _on_chosen_grids(setup, fast)
    check_tilt_of_ends(contact, [problem.point], setup.grids[0], gap_on(problem, setup.grids[0]))
    return setup


def _shear_laws(problem: SteadyProblem, extents: tuple[float, float]) -> tuple[ShearLaw, ...]:
    """Laws under shear, of a body that rolls with traction."""
    return shear_laws(problem, extents) if problem.motion.creepages else ()


def _with_line_grid(problem: SteadyProblem) -> SteadyProblem:
    """The problem with a grid of its own for a body without end across the motion."""
    contact, axis = problem.contact, line_axis(problem.contact.indenter)
    if isinstance(contact.grid, Grid) or axis is None:
        return problem
    if axis == problem.axis:
        raise ValueError(
            f"motion.along: the body continues along {problem.motion.along} without end, and "
            "nothing would change by a motion along it; let it move across"
        )
    if not contact.surface.is_supported:
        refuse_approach(contact.load)
    found = []
    for speed in (problem.speeds.max(), problem.speeds.min()):
        time = 1.0
        for _ in range(ROUNDS + 1):
            compliance, response = contact.compliance(time), contact.surface.response_at(time)
            estimate = line_estimate(contact.indenter, float(compliance), problem.point, response)
            time = estimate.extents[problem.axis] / (2 * float(speed))
        found.append(estimate)
    grid = line_grid(found, contact.automatic_grid or AutomaticGrid(), axis)
    return replace(problem, contact=replace(contact, grid=grid))


def _on_chosen_grids(setup: SteadySetup, estimate: ContactEstimate) -> SteadySetup:
    """Setup on grids of one lattice; regions are found from the fastest speed, each by the last."""
    problem, solver = setup.problem, setup.solver
    request = problem.contact.automatic_grid
    assert request is not None
    centre, half = np.array(estimate.centre), np.array(estimate.extents) / 2
    centred = _centred(problem, np.abs(centre) + half)
    last = Region(centre - half, centre + half)
    regions: dict[float, Region] = {}
    searches: dict[float, float] = {}
    for speed in sorted(problem.speeds.tolist(), reverse=True):
        last, searches[speed] = find_region(solver, speed, last, centred=centred)
        regions[speed] = last
    across = max(ACROSS / request.tolerance**0.5, LEAST_ACROSS)
    lattice = lattice_for(list(regions.values()), across)
    lattice = _on_layers(lattice, problem.contact.thinnest_layer, problem.axis)
    if request.largest_cell is not None:
        lattice = Lattice(np.minimum(lattice.cell_size, request.largest_cell))
    lattice = lattice_with_ends(lattice, problem.contact.planes)
    grids = [
        lattice.grid_over(regions[speed], centred=centred) for speed in problem.speeds.tolist()
    ]
    work = sum(
        searches[speed] * SEARCH_CELLS**2 / np.prod(grid.shape)
        for speed, grid in zip(problem.speeds.tolist(), grids, strict=True)
    )
    reached = _cells_across(list(regions.values()), lattice)
    coarse = (ACROSS / reached) ** 2 if reached < (1 - LITTLE_LESS) * across else None
    return replace(setup, grids=tuple(grids), work=float(work), tolerance_reached=coarse)


def _on_layers(lattice: Lattice, thickness: float, axis: int) -> Lattice:
    """Lattice with shorter cells along the motion where they are long against a layer [m]."""
    cell = lattice.cell_size[axis]
    wanted = np.clip(thickness / CELLS_OF_LAYER, cell / MOST_REFINEMENT, cell)
    return Lattice(np.where(np.arange(2) == axis, wanted, lattice.cell_size))


def _cells_across(regions: list[Region], lattice: Lattice) -> float:
    """Cells across the smallest contact, along the axis along which it has fewer."""
    return min(float((region.extents / lattice.cell_size).min()) for region in regions)


def estimate_at(problem: SteadyProblem, speed: float) -> ContactEstimate:
    """Elastic contact with the compliance of the time in which half of it is passed."""
    contact = problem.contact
    time = 1.0
    for _ in range(ROUNDS + 1):
        compliance, response = float(contact.compliance(time)), contact.surface.response_at(time)
        found = locate_contact(contact.cut_indenter, compliance, problem.point, response=response)
        time = found.extents[problem.axis] / (2 * speed)
    return found


def _centred(problem: SteadyProblem, reach: Floats) -> tuple[bool, bool]:
    """True across the motion if body and load are even there: the grid is centred on its axis."""
    across, load = 1 - problem.axis, problem.contact.load
    around = Grid((EVEN_SAMPLES, EVEN_SAMPLES), (2 * float(reach[0]), 2 * float(reach[1])))
    alike = all(body.is_even for body in problem.contact.ended_bodies.values())
    both = (alike and load.is_even(0), load.is_even(1))
    even = even_axes(around, gap_on(problem, around), both)[across]
    return across == 0 and even, across == 1 and even


def _refuse_flow(laws: MovingLaws, grid: Grid | None, *, twice: bool) -> None:
    """Refuse a fluid under a line contact, which drags ever more of it along (Stokes' paradox)."""
    if laws.sinks and twice:
        raise ValueError(
            "material: the material flows, and the resistance of a fluid between two ends grows "
            "without limit with the distance travelled, so that there is no steady state; use a "
            "solid, such as a Zener law, or one end at most"
        )
    if laws.sinks and grid is not None and not grid.has_datum:
        raise ValueError(
            "material: the material flows, and on a grid that is periodic across the motion the "
            "resistance of a fluid grows without limit with the distance travelled, so "
            "that there is no steady state; use a solid, such as a Zener law, or a grid that is "
            "not periodic"
        )


def _refuse_long_grid(laws: MovingLaws, grid: Grid, axis: int) -> None:
    """Refuse a grid longer than half the circumference of a roller whose material returns."""
    half, length = laws.shortest_period / 2, grid.size[axis]
    if length - grid.cell_size[axis] >= half:
        raise ValueError(
            f"grid.size: the grid is {format_quantity(length, 'm', 3)} long along the motion, and "
            "under a body that rolls it must be shorter than half its circumference, "
            f"{format_quantity(half, 'm', 3)}: beyond it the surfaces have turned away from each "
            "other"
        )


def _refuse_apart(problem: SteadyProblem) -> None:
    """Refuse a prescribed approach at which the body does not touch the surface."""
    point, given = problem.point, problem.contact.grid
    if point.approach is None:
        return
    touches = point.approach > 0
    if isinstance(given, Grid):
        if point.tilt_x is None or point.tilt_y is None:
            return  # found by solving
        slopes = point.tilt_x * given.x[:, None] + point.tilt_y * given.y[None, :]
        touches = bool((gap_on(problem, given) < point.approach + slopes).any())
    if not touches:
        raise ValueError(
            f"load: at an approach of {format_quantity(point.approach, 'm')} the body does not "
            "touch the surface, so there is no contact in steady motion; press it on"
        )
