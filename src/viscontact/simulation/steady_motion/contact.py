"""Contact of a body at one speed on one grid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import Transforms
from viscontact.bodies.cell_borders import with_borders_at
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.mirror_symmetry import even_axes, mirrored_axes
from viscontact.mechanics.contact.moving_domain import MovingDomain
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.contact.steady_equilibrium import SteadySolution, solve_steady_contact
from viscontact.mechanics.rolling_traction import RollingTraction
from viscontact.simulation.steady_motion.moving_law import MovingLaws
from viscontact.simulation.steady_motion.problem import SteadyProblem

#: Cells along an axis that can be halved.
FEWEST_TO_HALVE = 12

#: Smallest displacement that errors are relative to, over a prescribed approach.
LEAST_DISPLACEMENT = 1e-14


@dataclass(frozen=True, eq=False)
class Neighbour:
    """Contact at a similar speed or on other cells, from which the guess of the next is taken."""

    speed: float  # [m/s]
    grid: Grid
    pressure: Floats  # on the whole grid [Pa]
    motion: Floats  # approach [m] and tilts [rad]


@dataclass(frozen=True, eq=False)
class SteadyContact:
    """Solution at one speed, and the operators that it belongs to."""

    speed: float  # [m/s]
    domain: MovingDomain
    solution: SteadySolution
    #: Displacement into the surface by tractions of coupled bodies [m], and these tractions.
    lift: Floats | None = None
    traction: RollingTraction | None = None
    #: Displacement along the surface by their pressure [m], (2, nx, ny).
    along: Floats | None = None

    @property
    def grid(self) -> Grid:
        """The cells."""
        return self.domain.grid

    @property
    def neighbour(self) -> Neighbour:
        """Data for the initial guess of a similar contact."""
        return Neighbour(self.speed, self.grid, self.pressure, self.solution.motion)

    @property
    def pressure(self) -> Floats:
        """Pressure on the whole grid [Pa]."""
        return self.domain.expand_by_symmetry(self.solution.found.pressure)

    @property
    def in_contact(self) -> Bools:
        """Cells in contact on the whole grid."""
        return self.domain.expand_by_symmetry(self.solution.in_contact)

    @property
    def gap(self) -> Floats:
        """Gap on the whole grid [m]."""
        return self.domain.expand_by_symmetry(self.solution.gap)

    def stretch_over(self, axis: int) -> Floats:
        """Displacement along the surface by the pressure, less that a cell ahead [m]."""
        assert self.along is not None  # of coupled bodies
        return np.asarray(self.along - np.roll(self.along, -1, axis=1 + axis))

    @property
    def displacement(self) -> Floats:
        """Displacement on the whole grid [m]."""
        unit = self.domain.expand_by_symmetry(self.solution.found.unit_displacement)
        under_pressure = self.domain.compliance * unit
        return under_pressure if self.lift is None else under_pressure + self.lift


@dataclass(frozen=True, eq=False)
class SteadySolver:
    """Solver of a problem on any grid and at any speed."""

    problem: SteadyProblem
    laws: MovingLaws
    transforms: Transforms

    def solve(
        self,
        speed: float,
        grid: Grid,
        tolerance: float,
        near: Neighbour | None = None,
        *,
        lift: Floats | None = None,
    ) -> SteadyContact:
        """Solve at a speed [m/s], from a contact on other cells at a similar speed if given.

        Tractions displace the surface into itself by `lift` [m].
        """
        open_gap = gap_on(self.problem, grid)
        axis = self.problem.axis
        even = self.is_even_across(grid, open_gap)
        if lift is not None:
            open_gap = open_gap + lift
        extent = max(grid.size_about_origin)
        domain = MovingDomain(
            grid, self.laws.at(speed, extent), axis, mirrored=even, transforms=self.transforms
        )
        point = self.problem.point
        posed = ContactProblem(
            domain.reduce_by_symmetry(open_gap),
            domain.compliance,
            domain.reduced_constraints(Constraints.of(point)),
            max(LEAST_DISPLACEMENT * abs(point.approach or 0.0), np.finfo(float).tiny),
        )
        guess = None if near is None else _guess(near, domain)
        solution = solve_steady_contact(posed, domain, guess, tolerance=tolerance)
        return SteadyContact(speed, domain, solution, lift)

    def is_even_across(self, grid: Grid, open_gap: Floats) -> bool:
        """True if gap, load and ends are even across the motion."""
        contact = self.problem.contact
        alike = all(body.is_even for body in contact.ended_bodies.values())
        loads = alike and contact.load.is_even(0), contact.load.is_even(1)
        return mirrored_axes(grid, even_axes(grid, open_gap, loads))[1 - self.problem.axis]

    def coarser_grid(self, grid: Grid) -> Grid | None:
        """Half the cells along each axis; None where there are few.

        They are kept along a period in which nothing varies.
        """
        kept = [self._is_uniform(grid, axis) for axis in (0, 1)]
        pairs = list(zip(grid.shape, kept, strict=True))
        if any(cells < FEWEST_TO_HALVE and not keeps for cells, keeps in pairs):
            return None
        nx, ny = (cells if keeps else (cells + 1) // 2 for cells, keeps in pairs)
        coarse = replace(grid, shape=(nx, ny))
        return with_borders_at(coarse, self.problem.contact.planes)

    def _is_uniform(self, grid: Grid, axis: int) -> bool:
        """True for a periodic axis along which the body is a cylinder."""
        gap = gap_on(self.problem, grid)
        return grid.shape[axis] == 1 or (
            grid.periodic[axis] and bool((gap == np.take(gap, [0], axis)).all())
        )


def gap_on(problem: SteadyProblem, grid: Grid) -> Floats:
    """Gap of the indenter on a grid [m]."""
    return problem.contact.cut_indenter.gap(grid.x[:, None], grid.y[None, :])


def _guess(near: Neighbour, domain: MovingDomain) -> Guess | None:
    """Pressure of a contact by the nearest cell of a domain, scaled to the same force, or None."""
    old, new = near.grid, domain.grid
    rows, columns = (
        np.rint((to - start[0]) / (start[1] - start[0])).astype(int)
        if len(start) > 1
        else np.zeros(len(to), int)
        for to, start in ((new.x, old.x), (new.y, old.y))
    )
    inside = np.logical_and.outer(
        (rows >= 0) & (rows < old.shape[0]), (columns >= 0) & (columns < old.shape[1])
    )
    clipped = np.ix_(rows.clip(0, old.shape[0] - 1), columns.clip(0, old.shape[1] - 1))
    pressure = domain.reduce_by_symmetry(np.where(inside, near.pressure[clipped], 0.0))
    if not pressure.any():
        return None
    return Guess.of(pressure, pressure, near.motion)
