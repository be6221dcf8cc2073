"""How large a grid has to be: coarse elastic solves at the largest compliance and load."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.balance import Support
from viscontact.compliance import ContactCompliance, SeriesCompliance
from viscontact.contact import solve_contact
from viscontact.contact_problem import ContactProblem
from viscontact.grid import Grid
from viscontact.half_space import HalfSpace
from viscontact.indenters import Indenter
from viscontact.load import LoadHistory, LoadPoint
from viscontact.material import Material
from viscontact.rim import trace_rim

#: Cells of a coarse solve along each axis, and how far it has to converge.
COARSE_CELLS, COARSE_TOLERANCE = 48, 1e-4

#: The coarse grid fits when the contact's reach is this part of its half size.
TIGHTEST, LOOSEST = 0.85, 0.5

#: Room around the contact in the grid that is returned.
MARGIN = 1.3

MAX_TRIES = 60

#: A load that swings shows its crest within so many of its longest steps.
SWING_STEPS = 128


@dataclass(frozen=True)
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
    centre_x, centre_y : float
        Middle of the contact [m].
    force : float
        Integral of the pressure [N].
    """

    length: float
    width: float
    approach: float
    peak_pressure: float
    centre_x: float
    centre_y: float
    force: float

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
    >>> from viscontact.load import step
    >>> found = estimate_contact(Sphere(0.01), 1e-9, step(100.0).at(0.0))
    >>> round(found.length / 2 * 1e3, 1)  # Hertz: (3 * 100 * 0.01 * 1e-9 / 4)**(1/3) = 0.909 mm
    0.9
    """
    size = np.full(2, _first_size(indenter, contact_compliance, point))
    for _ in range(MAX_TRIES):
        grid = Grid((COARSE_CELLS, COARSE_CELLS), (float(size[0]), float(size[1])))
        found = _coarse_contact(indenter, contact_compliance, point, grid)
        if found is None:
            size = size * 2
            continue
        part = np.array(found.reach) / (size / 2)
        if ((part >= LOOSEST) & (part <= TIGHTEST)).all():
            return found
        # A contact of a few cells says little about its size: do not trust it beyond a factor 4.
        size = size * np.clip(part / 0.68, 0.25, 2.0)
    raise ValueError(
        "grid: no fitting grid was found for this load; the force may act outside what can "
        "touch, or the contact runs on without end. Give a grid, or move the force in"
    )


def auto_grid(
    indenter: Indenter,
    material: Material,
    load: LoadHistory,
    tolerance: float = 0.01,
    *,
    end: float | None = None,
    indenter_material: Material | None = None,
) -> Grid:
    """Choose a grid for a run.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material
        Material of the half-space.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    tolerance : float
        Aimed-at relative error of peak pressure, area and approach.
    end : float, optional
        Last instant of the run [s]; the load's last point, or the end of all creep, when left
        out.
    indenter_material : Material, optional
        Material of the indenter; rigid when left out.

    Returns
    -------
    Grid
        Holds the contact at the largest compliance under every corner of the load's history,
        with a margin. The number of cells is a rule of thumb, not yet an error estimate.

    Raises
    ------
    ValueError
        If the tolerance makes no sense, no end of the creep is known, or no grid fits.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> vc.auto_grid(vc.Sphere(0.01), rubber, vc.step(1.0)).shape
    (54, 54)
    """
    if not 1e-4 <= tolerance <= 0.5:
        raise ValueError(f"tolerance must lie between 1e-4 and 0.5, got {tolerance!r}")
    compliance = material.contact_compliance()
    if indenter_material is not None:
        compliance = compliance + indenter_material.contact_compliance()
    largest = _largest_compliance(compliance, load, end)
    reach, extents = _reach_of_history(indenter, largest, load, end)
    size = 2 * MARGIN * reach
    # Cells across the contact, then over the grid: errors are at worst of second order.
    cells = (4 / math.sqrt(tolerance)) * size / extents
    shape = [max(16, fft.next_fast_len(math.ceil(count), real=True)) for count in cells]
    return Grid((shape[0], shape[1]), (float(size[0]), float(size[1])))


def _reach_of_history(
    indenter: Indenter, compliance: float, load: LoadHistory, end: float | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Farthest reach over the history, and the extents of the contact under the largest force."""
    points = _corners(load, end)
    if not points:
        raise ValueError(
            f"load: the {load.control} is never above zero, so no grid can be fitted to a contact; "
            "give a grid"
        )
    found = [estimate_contact(indenter, compliance, point) for point in points]
    reach = np.array([estimate.reach for estimate in found], dtype=np.float64).max(axis=0)
    largest = found[int(np.argmax([level_of(point) for point in points]))]
    return reach, np.array([largest.length, largest.width])


def _corners(load: LoadHistory, end: float | None) -> list[LoadPoint]:
    """Distinct loads at the history's points, and within its pieces: there the force may move."""
    corners = load.kinks if end is None else np.append(load.kinks[load.kinks < end], end)
    within = [corners[:-1] + part * np.diff(corners) for part in (0.25, 0.5, 0.75)]
    crest, _ = largest_load(load, float(corners[-1]))
    instants = np.unique(np.concatenate([corners, *within, [crest]])).tolist()
    points = [load.at(time, side=side) for time in instants for side in ("left", "right")]
    return list(dict.fromkeys(point for point in points if level_of(point) > 0))


def _largest_compliance(
    compliance: ContactCompliance, load: LoadHistory, end: float | None
) -> float:
    if end is not None:
        return float(compliance(end))
    latest = compliance.settled_after
    if math.isinf(latest) or (isinstance(compliance, SeriesCompliance) and compliance.fluidity > 0):
        raise ValueError(
            "end: the law does not say when its creep is over (or flows without end); give end=, "
            "when the run ends, in s"
        )
    if isinstance(compliance, SeriesCompliance):
        return compliance.instant + float(np.sum(compliance.amplitudes))
    return float(compliance(latest))


def largest_load(load: LoadHistory, end: float) -> tuple[float, LoadPoint]:
    """Return when a load is largest, and what it prescribes there.

    Parameters
    ----------
    load : LoadHistory
        The load.
    end : float
        Later instants do not count [s].

    Returns
    -------
    time : float
        One of its kinks, the end, or a step within its first swings [s].
    point : LoadPoint
        What is prescribed there, on the side of a jump where it is more.

    Examples
    --------
    >>> from viscontact.load import harmonic
    >>> largest_load(harmonic(mean=2.0, amplitude=1.0, period=4.0, cycles=4), end=16.0)[0]
    1.0
    """
    instants = [*load.kinks[load.kinks <= end].tolist(), end]
    if math.isfinite(load.longest_step):
        steps = np.arange(1, SWING_STEPS + 1) * load.longest_step
        instants += steps[steps < end].tolist()
    points = [(time, load.at(time, side=side)) for time in instants for side in ("left", "right")]
    return max(points, key=lambda timed: level_of(timed[1]))


def level_of(point: LoadPoint) -> float:
    """Return what presses: the force [N] or, where that is prescribed, the approach [m].

    Examples
    --------
    >>> level_of(LoadPoint(None, 0.0, 0.0, None, None, approach=1e-6))
    1e-06
    """
    level = point.approach if point.force is None else point.force
    assert level is not None  # one of the two is given
    return level


def _first_size(indenter: Indenter, compliance: float, point: LoadPoint) -> float:
    radius = indenter.radius_of_curvature
    level, is_round = level_of(point), math.isfinite(radius) and radius > 0
    if point.force is None:
        scale = math.sqrt(radius * level) if is_round else level
    else:
        scale = math.sqrt(level * compliance)
        if is_round:
            scale = (0.75 * level * radius * compliance) ** (1 / 3)
    return 4 * max(scale, abs(point.eccentricity_x), abs(point.eccentricity_y))


def _coarse_contact(
    indenter: Indenter, compliance: float, point: LoadPoint, grid: Grid
) -> ContactEstimate | None:
    """Contact on this grid; None if it does not fit on it."""
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    if not np.isfinite(open_gap).any():
        return None
    problem = ContactProblem(open_gap, compliance, Support.of(point), 1e-12 * max(grid.size))
    solution = solve_contact(problem, HalfSpace(grid), tolerance=COARSE_TOLERANCE)
    contact = solution.found.pressure > 0
    touching_rim = contact[[0, -1]].any() or contact[:, [0, -1]].any()
    if touching_rim or not solution.converged:
        return None
    rim = trace_rim(grid, contact, solution.gap)
    rows, columns = np.flatnonzero(contact.any(axis=1)), np.flatnonzero(contact.any(axis=0))
    return ContactEstimate(
        max(rim.length, grid.cell_size[0]),
        max(rim.width, grid.cell_size[1]),
        float(solution.found.motion[0]),
        float(solution.found.pressure.max()),
        float(grid.x[rows[[0, -1]]].mean()),
        float(grid.y[columns[[0, -1]]].mean()),
        float(solution.found.pressure.sum()) * grid.cell_area,
    )
