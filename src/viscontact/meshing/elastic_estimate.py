"""One contact, estimated: a coarse elastic solve on a grid that is fitted to it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.domain import ContactDomain
from viscontact.contact.equilibrium import solve_contact
from viscontact.contact.problem import ContactProblem
from viscontact.contact.rigid_balance import Constraints
from viscontact.contact.rim import Rim, trace_rim
from viscontact.grid import Grid
from viscontact.indenters import Indenter
from viscontact.loads import LoadPoint

#: Cells of a coarse solve along each axis, and how far it has to converge.
COARSE_CELLS, COARSE_TOLERANCE = 48, 1e-4

#: The coarse grid fits when the contact's reach is this part of its half size.
TIGHTEST, LOOSEST = 0.85, 0.5

MAX_TRIES = 60


class _Misfit(Enum):
    """What to multiply the grid's size with, along x and y, where a contact does not fit on it."""

    BOTH = (2.0, 2.0)
    ALONG = (2.0, 1.0)
    ACROSS = (1.0, 2.0)
    FINER_ALONG = (0.5, 1.0)
    FINER_ACROSS = (1.0, 0.5)


@dataclass(frozen=True, eq=False)
class ContactEstimate:
    """A coarse elastic answer.

    Attributes
    ----------
    length, width : float
        Extents of the contact along x and y [m].
    approach : float
        Approach [m].
    peak_pressure : float
        Largest pressure [Pa].
    peak_place : tuple of float
        Where it is [m].
    centre_x, centre_y : float
        Middle of the contact [m].
    force : float
        Integral of the pressure [N].
    rim : Rim
        The contact on the coarse grid that was fitted to it.
    open_gap : ndarray
        Initial gap on that grid [m].
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].
    """

    length: float
    width: float
    approach: float
    peak_pressure: float
    peak_place: tuple[float, float]
    centre_x: float
    centre_y: float
    force: float
    rim: Rim
    open_gap: NDArray[np.float64]
    motion: NDArray[np.float64]

    @property
    def extents(self) -> tuple[float, float]:
        """Length and width of the contact [m]."""
        return self.length, self.width

    @property
    def reach(self) -> tuple[float, float]:
        """Farthest distances of the contact from the origin along x and y [m]."""
        return abs(self.centre_x) + self.length / 2, abs(self.centre_y) + self.width / 2


def estimate_contact(
    indenter: Indenter, contact_compliance: float, point: LoadPoint
) -> ContactEstimate:
    """Solve an elastic contact coarsely, on a grid that is fitted to it.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    contact_compliance : float
        J of an elastic body in its place [1/Pa].
    point : LoadPoint
        Force, eccentricities and prescribed tilts.

    Returns
    -------
    ContactEstimate
        To a few per cent.

    Raises
    ------
    ValueError
        If no grid can be fitted: the force acts outside what can touch, say.

    Examples
    --------
    >>> from viscontact.indenters import Sphere
    >>> from viscontact.loads import step
    >>> found = estimate_contact(Sphere(0.01), 1e-9, step(100.0).at(0.0))
    >>> round(found.length / 2 * 1e3, 1)  # Hertz: (3 * 100 * 0.01 * 1e-9 / 4)**(1/3) = 0.909 mm
    0.9
    """
    size = np.full(2, _first_size(indenter, contact_compliance, point))
    for _ in range(MAX_TRIES):
        grid = Grid((COARSE_CELLS, COARSE_CELLS), (float(size[0]), float(size[1])))
        found = _coarse_contact(indenter, contact_compliance, point, grid)
        if isinstance(found, _Misfit):
            size = size * found.value
            continue
        part = np.array(found.reach) / (size / 2)
        if ((part >= LOOSEST) & (part <= TIGHTEST)).all():
            return found
        # A contact of a few cells says little about its size: do not trust it beyond a factor 4.
        size = size * np.clip(part / 0.68, 0.25, 2.0)
    raise ValueError(
        "grid: no fitting grid was found for this load; the force may be too large for so soft a "
        "material, or act outside what can touch, or the contact runs on without end. Press less, "
        "move the force in, or give a grid, a periodic one for waves without end"
    )


def _first_size(indenter: Indenter, compliance: float, point: LoadPoint) -> float:
    radius = indenter.radius_of_curvature
    level, is_round = point.level, math.isfinite(radius) and radius > 0
    if point.force is None:
        scale = math.sqrt(radius * level) if is_round else level
    else:
        scale = math.sqrt(level * compliance)
        if is_round:
            scale = (0.75 * level * radius * compliance) ** (1 / 3)
    return 4 * max(scale, abs(point.eccentricity_x), abs(point.eccentricity_y))


def _between_points(open_gap: NDArray[np.float64]) -> _Misfit:
    """Which way is too coarse where a body that is pressed in touches none of the points."""
    i, j = divmod(int(open_gap.argmin()), open_gap.shape[1])
    # The lowest point may be the last of its line; gaps are even enough for the one before it.
    besides = (max(i - 1, 0), j), (i, max(j - 1, 0))
    along, across = (float(open_gap[place]) for place in besides)
    return _Misfit.FINER_ALONG if along > across else _Misfit.FINER_ACROSS


def _coarse_contact(
    indenter: Indenter, compliance: float, point: LoadPoint, grid: Grid
) -> ContactEstimate | _Misfit:
    """Contact on this grid, or why it does not fit on it."""
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    if not np.isfinite(open_gap).any():
        return _Misfit.BOTH
    problem = ContactProblem(open_gap, compliance, Constraints.of(point), 1e-12 * max(grid.size))
    solution = solve_contact(problem, ContactDomain(grid), tolerance=COARSE_TOLERANCE)
    contact = solution.found.pressure > 0
    if not contact.any():
        return _between_points(open_gap)
    along, across = contact[[0, -1]].any(), contact[:, [0, -1]].any()
    if along and not across:
        return _Misfit.ALONG
    if across and not along:
        return _Misfit.ACROSS
    if along or not solution.converged:
        return _Misfit.BOTH
    rim = trace_rim(grid, contact, solution.gap)
    rows, columns = np.flatnonzero(contact.any(axis=1)), np.flatnonzero(contact.any(axis=0))
    return ContactEstimate(
        max(rim.length, grid.cell_size[0]),
        max(rim.width, grid.cell_size[1]),
        float(solution.found.motion[0]),
        float(solution.found.pressure.max()),
        grid.largest_at(solution.found.pressure),
        float(grid.x[rows[[0, -1]]].mean()),
        float(grid.y[columns[[0, -1]]].mean()),
        float(solution.found.pressure.sum()) * grid.cell_area,
        rim,
        open_gap,
        solution.found.motion,
    )


#: Cells of the coarse solve along each axis, at most: a period may hold many waves.
MAX_PERIOD_CELLS = 128


def estimate_period(
    indenter: Indenter, contact_compliance: float, point: LoadPoint, grid: Grid
) -> ContactEstimate:
    """Solve an elastic contact on a periodic grid coarsely.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    contact_compliance : float
        J of an elastic body in its place [1/Pa].
    point : LoadPoint
        Force or approach.
    grid : Grid
        The period; a finer one is made coarser.

    Returns
    -------
    ContactEstimate
        To a few per cent.

    Raises
    ------
    ValueError
        If the solve does not converge.

    Examples
    --------
    Under half of its pressure of full contact a wave's strip is half as wide as the wave is long:

    >>> import viscontact as vc
    >>> period = Grid((64, 4), (1e-3, 1e-3), periodic=True)
    >>> waves, load = vc.Waviness(1e-6, wavelength_x=1e-3), vc.step(0.5 * 3.1416e6 * period.area)
    >>> round(estimate_period(waves, 1e-9, load.at(0.0), period).length * 1e3, 2)
    0.5
    """
    nx, ny = (min(count, MAX_PERIOD_CELLS) for count in grid.shape)
    coarse = Grid((nx, ny), grid.size, periodic=True)
    open_gap = indenter.gap(coarse.x[:, None], coarse.y[None, :])
    half_space = ContactDomain(coarse)
    constraints = half_space.reduced_constraints(Constraints.of(point))
    problem = ContactProblem(open_gap, contact_compliance, constraints, 1e-12 * max(grid.size))
    solution = solve_contact(problem, half_space, tolerance=COARSE_TOLERANCE)
    if not solution.converged:
        raise ValueError("grid: the contact on this period could not be estimated; use more cells")
    pressure = solution.found.pressure
    rim = trace_rim(coarse, pressure > 0, solution.gap)
    x, y = coarse.x[rim.rows], coarse.y[rim.columns]
    return ContactEstimate(
        length=max(rim.length, coarse.cell_size[0]),
        width=max(rim.width, coarse.cell_size[1]),
        approach=float(solution.found.motion[0]),
        peak_pressure=float(pressure.max()),
        peak_place=coarse.largest_at(pressure),
        centre_x=float(np.median(x)) if rim.length < grid.size[0] else 0.0,
        centre_y=float(np.median(y)) if rim.width < grid.size[1] else 0.0,
        force=float(pressure.sum()) * coarse.cell_area,
        rim=rim,
        open_gap=open_gap,
        motion=solution.found.motion,
    )
