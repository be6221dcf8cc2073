"""Elastic contact on one grid, and coarse estimates of a contact's size by it."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cell_borders import with_borders_at
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadPoint
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.contact.rim import Rim, trace_rim
from viscontact.mechanics.halfspace.ended_response import planes_in
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.units.formatting import format_quantity

#: Cells of a coarse solve along each axis; on a periodic grid, which may hold many waves, at most.
COARSE_CELLS, MAX_PERIOD_CELLS = 48, 128

#: Relative error of gap and balances in a coarse solve.
COARSE_TOLERANCE = 1e-4

#: The coarse grid fits if the contact reaches to between these parts of its half size.
MIN_REACH, MAX_REACH = 0.5, 0.85

#: Part of the half size that the next grid aims at.
TARGET_REACH = 0.68

#: Grids that are tried before the estimate is given up.
MAX_TRIES = 60

#: Points between the body's axis and the force at which its end is looked for.
SAMPLES = 1001


@dataclass(frozen=True, eq=False)
class ContactEstimate:
    """Solution of an elastic contact, with its fields on the whole grid."""

    grid: Grid
    open_gap: Floats  # initial gap, +inf outside the body [m]
    pressure: Floats  # [Pa]
    gap: Floats  # gap under load [m]
    in_contact: Bools
    largest_displacement: float  # of the surface [m]
    motion: Floats  # approach [m] and tilts along x and y [rad]
    converged: bool

    @cached_property
    def rim(self) -> Rim:
        """Rim of the contact between the cell centres."""
        return trace_rim(self.grid, self.in_contact, self.gap)

    @property
    def length(self) -> float:
        """Extent of the contact along x, at least one cell [m]."""
        return max(self.rim.length, self.grid.cell_size[0])

    @property
    def width(self) -> float:
        """Extent of the contact along y, at least one cell [m]."""
        return max(self.rim.width, self.grid.cell_size[1])

    @property
    def extents(self) -> tuple[float, float]:
        """Length and width of the contact [m]."""
        return self.length, self.width

    @property
    def approach(self) -> float:
        """Approach of the bodies [m]."""
        return float(self.motion[0])

    @property
    def peak_pressure(self) -> float:
        """Largest pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def peak_place(self) -> tuple[float, float]:
        """Position of the largest pressure [m]."""
        return self.grid.largest_at(self.pressure)

    @property
    def force(self) -> float:
        """Integral of the pressure [N]."""
        return float(self.pressure.sum()) * self.grid.cell_area

    @cached_property
    def centre(self) -> tuple[float, float]:
        """Middle of the contact [m]; that of the grid along an axis whose period it fills."""
        return self._middle(0), self._middle(1)

    def _middle(self, axis: int) -> float:
        """Middle of the contact along an axis [m]."""
        lines, extents = (self.grid.x, self.grid.y)[axis], (self.rim.length, self.rim.width)
        if self.grid.periodic[axis]:
            inside = (self.rim.rows, self.rim.columns)[axis]
            filled = extents[axis] >= self.grid.size[axis]
            return self.grid.centre[axis] if filled else float(np.median(lines[inside]))
        touched = np.flatnonzero(self.in_contact.any(axis=1 - axis))
        return float(lines[touched[[0, -1]]].mean())

    @property
    def centre_x(self) -> float:
        """Middle of the contact along x [m]."""
        return self.centre[0]

    @property
    def centre_y(self) -> float:
        """Middle of the contact along y [m]."""
        return self.centre[1]

    @property
    def reach(self) -> tuple[float, float]:
        """Farthest distances of the contact from the origin along x and y [m]."""
        return self.reach_from((0.0, 0.0))

    def reach_from(self, place: tuple[float, float]) -> tuple[float, float]:
        """Farthest distances of the contact from a place along x and y [m]."""
        x, y = (abs(own - at) for own, at in zip(self.centre, place, strict=True))
        return x + self.length / 2, y + self.width / 2


def elastic_contact(
    open_gap: Floats,
    compliance: float,
    point: LoadPoint,
    domain: ContactDomain,
    *,
    tolerance: float = COARSE_TOLERANCE,
    start: Floats | None = None,
) -> ContactEstimate:
    """Solve an elastic contact on a domain; `compliance` [1/Pa], `start` a pressure [Pa]."""
    grid = domain.grid
    problem = ContactProblem(
        domain.reduce_by_symmetry(open_gap),
        compliance,
        domain.reduced_constraints(Constraints.of(point)),
        1e-12 * max(grid.cell_size),
    )
    guess = None
    if start is not None and start.any():
        pressure = domain.reduce_by_symmetry(np.where(np.isfinite(open_gap), start, 0.0))
        guess = Guess.of(pressure, domain.convolution.apply(pressure), np.zeros(3))
    solution = solve_contact(problem, domain, guess, tolerance=tolerance)
    return ContactEstimate(
        grid,
        open_gap,
        domain.expand_by_symmetry(solution.found.pressure),
        domain.expand_by_symmetry(solution.gap),
        domain.expand_by_symmetry(solution.in_contact),
        compliance * float(solution.found.unit_displacement.max()),
        solution.motion,
        solution.converged,
    )


def estimate_contact(
    indenter: Indenter,
    contact_compliance: float,
    point: LoadPoint,
    around: tuple[float, float] | None = None,
    *,
    response: SurfaceResponse = HALF_SPACE,
) -> ContactEstimate:
    """Solve an elastic contact to a few per cent, at the origin or `around` [m]."""
    # ValueError if no grid fits, for example because the force acts outside the body.
    scale, centre = _first_scale(indenter, contact_compliance, point), around or (0.0, 0.0)
    lever = max(abs(point.eccentricity_x), abs(point.eccentricity_y)) if around is None else 0.0
    size = np.full(2, 4 * max(scale, lever))
    for _ in range(MAX_TRIES):
        cells, extents = (COARSE_CELLS, COARSE_CELLS), (float(size[0]), float(size[1]))
        grid = with_borders_at(Grid(cells, extents, centre=centre), planes_in(response))
        open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
        if not np.isfinite(open_gap).any():
            # A height map may be smaller than the cells, and lie between their centres.
            is_small = min(indenter.sample_spacing) > 0 and np.isfinite(indenter.gap(*centre))
            size = (0.5 if is_small else 2.0) * size
            continue
        found = elastic_contact(
            open_gap, contact_compliance, point, ContactDomain(grid, response=response)
        )
        factors = _size_factors(found, follows=around is not None)
        if factors is None:
            return found
        size = size * factors
        if around is not None and found.in_contact.any():
            centre = found.centre
    raise ValueError(f"grid: no fitting grid was found: {_misfit(indenter, point, scale)}")


def estimate_period(
    indenter: Indenter,
    contact_compliance: float,
    point: LoadPoint,
    grid: Grid,
    *,
    response: SurfaceResponse = HALF_SPACE,
) -> ContactEstimate:
    """Solve an elastic contact to a few per cent on a periodic grid, coarsened where it is fine."""
    nx, ny = (min(count, MAX_PERIOD_CELLS) for count in grid.shape)
    if planes_in(response):  # which must stay borders of cells
        nx = grid.shape[0]
    coarse = replace(grid, shape=(nx, ny))
    open_gap = indenter.gap(coarse.x[:, None], coarse.y[None, :])
    found = elastic_contact(
        open_gap, contact_compliance, point, ContactDomain(coarse, response=response)
    )
    if not found.converged:
        raise ValueError("grid: the contact on this period could not be estimated; use more cells")
    return found


def _first_scale(indenter: Indenter, compliance: float, point: LoadPoint) -> float:
    """Length from Hertz's theory or from the load, a quarter of the first grid's [m]."""
    radius = indenter.radius_of_curvature
    level, is_round = point.level, math.isfinite(radius) and radius > 0
    if point.force is None:
        scale = math.sqrt(radius * level) if is_round else level
    else:
        scale = math.sqrt(level * compliance)
        if is_round:
            scale = (0.75 * level * radius * compliance) ** (1 / 3)
    return scale


def _misfit(indenter: Indenter, point: LoadPoint, scale: float) -> str:
    """Why no grid fits a contact of which a length is expected [m]."""
    place = (point.eccentricity_x, point.eccentricity_y)
    axis = int(np.abs(place).argmax())
    lines = np.linspace(0.0, place[axis], SAMPLES)
    ends = np.isinf(indenter.gap(*((lines, 0.0) if axis == 0 else (0.0, lines))))
    if ends[-1]:
        end, force = (
            format_quantity(float(at), "m", 3) for at in (lines[ends.argmax()], place[axis])
        )
        return (
            f"the force acts at {'xy'[axis]} = {force}, and the body ends at about {end}; reduce "
            f"eccentricity_{'xy'[axis]}"
        )
    radius = indenter.radius_of_curvature
    if math.isfinite(radius) and scale > radius > 0:
        return (
            f"a contact of about {format_quantity(2 * scale, 'm', 2)} is expected under a body of "
            f"radius {format_quantity(radius, 'm', 2)}; press less, or use a stiffer material"
        )
    return (
        "the contact reaches the border of each, however large; press less, or give a grid, a "
        "periodic one under a body without end"
    )


def _size_factors(found: ContactEstimate, *, follows: bool) -> Floats | None:
    """Factors that make a grid fit the contact, or None; the grid may `follow` the contact."""
    touched = found.in_contact
    if not touched.any():
        return _refining_factors(found.open_gap)
    at_edge = bool(touched[[0, -1]].any()), bool(touched[:, [0, -1]].any())
    if any(at_edge) or not found.converged:
        return np.where(at_edge if any(at_edge) else (True, True), 2.0, 1.0)
    reach = np.array(found.extents) / 2 if follows else np.array(found.reach)
    part = reach / (np.array(found.grid.size) / 2)
    if ((part >= MIN_REACH) & (part <= MAX_REACH)).all():
        return None
    # The size of a contact of a few cells is inaccurate: correct it by a factor of 4 at most.
    return np.asarray(np.clip(part / TARGET_REACH, 0.25, 2.0))


def _refining_factors(open_gap: Floats) -> Floats:
    """Factors for a body that touches between the cell centres: finer along its steeper axis."""
    i, j = divmod(int(open_gap.argmin()), open_gap.shape[1])
    # The lowest point may be the last of its line, but its neighbour before it shows the slope.
    along, across = float(open_gap[max(i - 1, 0), j]), float(open_gap[i, max(j - 1, 0)])
    return np.array([0.5, 1.0] if along > across else [1.0, 0.5])
