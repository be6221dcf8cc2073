"""Run setup: a contact problem, checked and complete, before its first step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from numbers import Integral

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.compiled import core_by, fastest_inner_loops
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.backend.transforms import fastest_transforms, transforms_by
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter, PlacedIndenter
from viscontact.bodies.indenters.periodic_body import PeriodicBody
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.contact.mirror_symmetry import even_axes, mirrored_axes
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.time_integration.extrapolation import shifted
from viscontact.mechanics.time_integration.fixed_steps import step_ends
from viscontact.mechanics.time_integration.plan import HereditaryPlan, plan_hereditary_integral
from viscontact.simulation import meshing, transient
from viscontact.simulation.checks.adhesion import check_adhesion, law_on
from viscontact.simulation.checks.ends import (
    check_ends,
    check_grid_of_ends,
    check_tilt_of_ends,
    error_of_ends,
    stress_left_on_ends,
    tilts_from_datum,
)
from viscontact.simulation.checks.friction import check_friction, check_grid_of_friction
from viscontact.simulation.checks.motion import check_motion, check_path
from viscontact.simulation.checks.periodicity import check_endless, check_period
from viscontact.simulation.checks.problem_checks import (
    check_balance,
    check_creep,
    check_jumps,
    check_magnitudes,
    check_mixed,
    check_times,
    check_touch,
    points_under_load,
)

#: Adaptive steps that the hereditary integral is planned for: at least this many, and this many
#: times the expected ones. More are possible.
ADAPTIVE_STEPS, STEP_COUNT_SAFETY = 500, 3.0


@dataclass(frozen=True, eq=False)
class RunSetup:
    """Checked and complete setup of a run."""

    problem: Problem
    grid: Grid
    open_gap: Floats  # on the grid [m], at time 0; +inf outside the body
    hereditary: HereditaryPlan  # of the first term of the surface
    mesh: meshing.Mesh | None  # None for a given grid
    threads: int
    transforms: str  # library, which a run keeps, as rounding differs
    inner_loops: str  # compiled ones or those of NumPy, which a run keeps, too
    other_terms: tuple[HereditaryPlan, ...] = ()  # of layers that creep differently
    law: CohesiveLaw | None = None  # attraction of bodies that adhere
    #: Stress that the pressure at the end leaves on free ends, over its peak, once it is known [-].
    end_stress_left: float = 0.0

    @property
    def plans(self) -> tuple[HereditaryPlan, ...]:
        """Methods of the hereditary integrals of all terms of the surface."""
        return (self.hereditary, *self.other_terms)

    @property
    def shear_plans(self) -> tuple[HereditaryPlan, ...]:
        """Methods of the hereditary integrals of tractions, of all terms under shear."""
        terms = self.problem.shear.terms
        numbers = 2 * self.open_gap.size
        return tuple(_planned(self.problem, [term.compliance for term in terms], numbers))

    @property
    def grows(self) -> bool:
        """True if the grid is automatic, and may be enlarged when the contact outgrows it."""
        return self.problem.automatic_grid is not None

    @cached_property
    def mirrored(self) -> tuple[bool, bool]:
        """True for x = 0 and for y = 0 if shape and load are even: one half is computed."""
        return mirrored_axes(self.grid, self.even)

    @cached_property
    def even(self) -> tuple[bool, bool]:
        """True for x = 0 and for y = 0 if shape and load are even, also on odd numbers of cells."""
        return _even(self.problem, self.open_gap, self.grid)

    @cached_property
    def tilts_from_datum(self) -> bool:
        """True if the tilt along x has a datum: not if a body that bends has two free ends."""
        return tilts_from_datum(self.problem, self.grid, self.open_gap)

    @cached_property
    def ends_error(self) -> float:
        """Part of the displacement by free ends that their operator may miss; 0 without [-]."""
        return error_of_ends(self.problem, even=self.even[0])

    @property
    def error_of_ends(self) -> float:
        """Relative error by free ends: of their operator, and by stress that is left on them."""
        return self.ends_error + float(np.nan_to_num(self.end_stress_left))

    def with_stress_left(self, pressure: Floats | None) -> RunSetup:
        """Return the run with what a pressure on its grid leaves on free ends."""
        left = stress_left_on_ends(self.problem, self.grid, pressure)
        return replace(self, end_stress_left=left)

    def on(self, grid: Grid) -> RunSetup:
        """Return the same run on another grid."""
        return replace(self, grid=grid, open_gap=_gap_on(self.problem, grid))

    def with_libraries(self, transforms: str, inner_loops: str) -> RunSetup:
        """Return the run with other transforms and inner loops; ValueError if not installed."""
        transforms_by(transforms)
        core_by(inner_loops)
        return replace(self, transforms=transforms, inner_loops=inner_loops)

    @cached_property
    def has_datum(self) -> bool:
        """True if the approach has a datum on the grid."""
        return self.problem.has_datum(self.grid)

    @property
    def team(self) -> Team:
        """Threads and inner loops that work on fields of the whole grid."""
        return Team(self.threads, core_by(self.inner_loops))

    def position_at(self, time: float) -> tuple[float, float]:
        """Position of the body's axis at a time [m]."""
        return self._start if self.problem.motion.stands else _position(self.problem, time)

    @cached_property
    def _start(self) -> tuple[float, float]:
        return _position(self.problem, 0.0)

    def gap_at(self, time: float) -> Floats:
        """The indenter's gap on the grid at a time [m]."""
        if self.position_at(time) == self._start:
            return self.open_gap
        return _gap(self.indenter_at(time), self.grid)

    def moved(self, fields: Floats, begin: float, end: float) -> Floats:
        """Fields moved by whole cells as the body moves between two times [s]."""
        way = np.subtract(self.position_at(end), self.position_at(begin))
        cells = np.rint(way / self.grid.cell_size).astype(int)
        periodic = self.grid.periodic[0], self.grid.periodic[1]
        return shifted(fields, (cells[0], cells[1]), periodic=periodic)

    def indenter_at(self, time: float) -> Indenter:
        """The indenter at its position at a time."""
        return _placed(self._body, self.position_at(time))

    @cached_property
    def _body(self) -> Indenter:
        return _body(self.problem, self.grid)


def prepare_run(problem: Problem, threads: int = 1) -> RunSetup:
    """Check a contact problem and complete it to a run; ValueError for invalid input."""
    if not (isinstance(threads, Integral) and 1 <= int(threads) <= 1024):
        raise ValueError(f"threads must be a whole number >= 1, and at most 1024, got {threads!r}")
    _check_parts(problem)
    # 1. Refuse what can be refused without a grid: times, magnitudes, creep law, jumps.
    check_times(problem)
    check_magnitudes(problem)
    check_mixed(problem)
    check_creep(problem)
    check_jumps(problem)
    given = problem.grid if isinstance(problem.grid, Grid) else None
    check_endless(problem.cut_indenter, given)
    points = points_under_load(problem)
    # 2. Take the given grid, or choose one by elastic trial contacts.
    if given is not None:
        mesh, grid = None, given
    else:
        mesh = _mesh_over_path(problem)
        grid = mesh.grid
        if problem.awaits_cells:
            problem = replace(problem, times=problem.times_at_cells(grid.cell_size))
    # 3. Refuse what the body on this grid cannot carry.
    check_grid_of_ends(problem, grid)
    open_gap = _gap_on(problem, grid)
    about_body = _about_body(problem, grid)
    check_tilt_of_ends(problem, [point for _, point in points], grid, open_gap)
    check_touch(problem, points[0][1], open_gap, about_body)
    supported = problem.surface.is_supported
    check_period(problem.indenter, open_gap, grid, problem.contact_load, supported=supported)
    check_balance(points[1:], open_gap, about_body)
    check_path(problem, grid)
    check_grid_of_friction(problem, grid)
    law = None if problem.adhesion is None else law_on(problem, grid)
    # 4. Plan the hereditary integral: internal variables, or the whole history.
    plan, *others = plan_history(problem, open_gap, grid)
    libraries = int(threads), fastest_transforms(), fastest_inner_loops()
    return RunSetup(problem, grid, open_gap, plan, mesh, *libraries, tuple(others), law)


def _check_parts(problem: Problem) -> None:
    """Refuse parts of a problem that do not go together."""
    check_ends(problem)
    check_motion(problem)
    check_friction(problem)
    check_adhesion(problem)


def _mesh_over_path(problem: Problem) -> meshing.Mesh:
    """Automatic mesh, of a moving body over its whole path."""
    mesh = meshing.choose_mesh(problem, problem.end)
    return replace(mesh, grid=meshing.grid_over_path(mesh.grid, problem.motion))


def _about_body(problem: Problem, grid: Grid) -> Grid:
    """The grid in positions from the body's axis at time 0."""
    x, y = (middle - at for middle, at in zip(grid.centre, _position(problem, 0.0), strict=True))
    return replace(grid, centre=(x, y))


def _position(problem: Problem, time: float) -> tuple[float, float]:
    x, y = problem.motion.position_at(time).tolist()
    return x, y


def _body(problem: Problem, grid: Grid) -> Indenter:
    """The body at the origin, on a grid that repeats itself with its next periods if it moves.

    What lies beyond the ends of the bodies is cut off.
    """
    repeats = any(grid.periodic) and not problem.motion.stands
    if repeats:
        return PeriodicBody(problem.indenter, grid)
    return problem.cut_indenter


def _placed(body: Indenter, position: tuple[float, float]) -> Indenter:
    x, y = position
    return body if x == y == 0 else PlacedIndenter(body, x=x, y=y)


def _gap_on(problem: Problem, grid: Grid) -> Floats:
    """Gap at time 0 on the cells of a grid [m]."""
    return _gap(_placed(_body(problem, grid), _position(problem, 0.0)), grid)


def _gap(indenter: Indenter, grid: Grid) -> Floats:
    return indenter.gap(grid.x[:, None], grid.y[None, :])


def _even(problem: Problem, open_gap: Floats, grid: Grid) -> tuple[bool, bool]:
    ends_alike = all(body.is_even for body in problem.ended_bodies.values())
    loads = (ends_alike and problem.load.is_even(0), problem.load.is_even(1))
    if problem.is_coupled and problem.shear_load is not None:
        # A force along the surface tilts the pressure its way, a torque makes it even about the
        # axis only.
        along_x, along_y, turning = problem.shear_load.acts
        loads = loads[0] and not along_x and not turning, loads[1] and not along_y and not turning
    if problem.motion.stands:
        return even_axes(grid, open_gap, loads)
    # Across the motion only, on the axis, and with all of the body that the grid comes to see.
    seen = transient.cells_seen(grid, problem.motion)
    even = even_axes(
        grid,
        problem.indenter.gap(seen[0][:, None], seen[1]),
        loads,
    )
    along_x, along_y = (
        each and limits == (0.0, 0.0)
        for each, limits in zip(even, problem.motion.reach, strict=True)
    )
    return along_x, along_y


def plan_history(problem: Problem, open_gap: Floats, grid: Grid) -> list[HereditaryPlan]:
    """Hereditary integrals for the terms of a problem's surface on a grid; open gap [m]."""
    # Pressure and unit displacement are kept, of all cells that are computed.
    numbers = 2 * open_gap.size // 2 ** sum(mirrored_axes(grid, _even(problem, open_gap, grid)))
    return _planned(problem, [term.compliance for term in problem.surface.terms], numbers)


def _planned(
    problem: Problem, functions: Sequence[ContactCompliance], numbers: int
) -> list[HereditaryPlan]:
    """Hereditary integrals of creep functions over the steps, of so many numbers each."""
    chosen = problem.chosen_steps
    if chosen is None:
        ends = step_ends(problem.planned_steps)
    else:
        # The steps are not known yet: many are assumed, over all decades that may count.
        end = chosen.end
        count = max(ADAPTIVE_STEPS, round(STEP_COUNT_SAFETY * problem.step_count))
        ends = np.append(0.0, np.geomspace(1e-9 * end, end, count))
    plans = [plan_hereditary_integral(compliance, ends, numbers) for compliance in functions]
    if chosen is None:
        return plans
    return [replace(plan, instants=np.zeros(0)) for plan in plans]
