"""How fine a mesh has to be: the same elastic contact on cells of twice the length."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from viscontact.balance import Support
from viscontact.contact import solve_contact
from viscontact.contact_problem import ContactProblem, Guess
from viscontact.grid import GRID_QUANTITIES, Grid, is_even
from viscontact.half_space import HalfSpace
from viscontact.indenters import Indenter
from viscontact.load import LoadPoint
from viscontact.outline import trace_outline
from viscontact.rim import trace_rim

#: A trial solve converges to this part of the tolerance, and at least to this.
EXACT, EXACT_ENOUGH = 0.01, 1e-4

#: A strip, a ring or a spot has so many cells in a row, whatever the error estimate says.
CELLS_IN_A_ROW = 6.0

#: Orders that an error is taken to fall with, to foretell the next trial; below the lowest there
#: is no limit to be expected. Nor is more than so much refined at once, along an axis.
USUAL_ORDER, LOWEST_ORDER = 1.7, 0.5
LEAST_AT_ONCE, MOST_AT_ONCE = 1.1, 2.0

#: A pressure that seems to have no limit is given up at so many times the cells of the first trial:
#: a rounded edge seems sharp until it is resolved.
PATIENCE = 16

#: Where the rim crosses a row of cells is known to this part of a cell. The area's error goes to
#: and fro by it with the place of the rim among the cells, so that two meshes may agree by chance;
#: measured on Hertz's ellipses.
RIM_SCATTER = 0.07

#: What may be singular.
PEAK = "peak_pressure"

TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class Pressing:
    """An elastic contact that is tried on several meshes.

    Attributes
    ----------
    indenter : Indenter
        Shape of the pressed body.
    compliance : float
        Contact compliance of an elastic body [1/Pa].
    point : LoadPoint
        Force or approach, eccentricities and prescribed tilts.
    size : tuple of float
        Extents of the grid [m].
    """

    indenter: Indenter
    compliance: float
    point: LoadPoint
    size: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Trial:
    """What a mesh finds, and how that changes when cells are twice as long.

    Attributes
    ----------
    shape : tuple of int
        Cells along x and y.
    values : ndarray, shape (3,)
        `GRID_QUANTITIES` [Pa, m², m].
    changes : ndarray, shape (2, 3)
        Relative changes of `GRID_QUANTITIES` for cells twice as long along x, and along y [-].
    in_a_row : ndarray, shape (2,)
        Mean number of cells in a row within the contact, along x and along y.
    """

    shape: tuple[int, int]
    values: NDArray[np.float64]
    changes: NDArray[np.float64]
    in_a_row: NDArray[np.float64]

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.shape[0] * self.shape[1]

    @cached_property
    def errors(self) -> dict[str, float]:
        """Expected relative errors: what falls at least as fast as the cells is below them [-]."""
        return dict(zip(GRID_QUANTITIES, self.changes.sum(axis=0).tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class Resolution:
    """A mesh that was found fine enough, or the finest that was tried.

    Attributes
    ----------
    trial : Trial
        The mesh.
    quantities : tuple of str
        What it was refined for: the peak pressure is left out where it has no limit.
    cells_needed : float
        How many cells the tolerance takes, about, where it is not met.
    is_enough : bool
        Whether it is met.
    at_finest : bool
        Whether it is the finest mesh that makes sense.
    """

    trial: Trial
    quantities: tuple[str, ...]
    cells_needed: float
    is_enough: bool = True
    at_finest: bool = False


def resolve(
    pressing: Pressing,
    quantities: Sequence[str],
    tolerance: float,
    *,
    fewest: ArrayLike,
    finest: ArrayLike = math.inf,
    most_cells: float = math.inf,
) -> Resolution:
    """Refine the mesh of an elastic contact, each way as needed, until it is as exact as asked.

    Parameters
    ----------
    pressing : Pressing
        The contact.
    quantities : sequence of str
        Those of `GRID_QUANTITIES` that count.
    tolerance : float
        Their relative error [-].
    fewest, finest : array_like, shape (2,)
        Cells along x and y to begin with, and of which more make no sense.
    most_cells : float
        Number of cells that is not exceeded.

    Returns
    -------
    Resolution
        Not fine enough if it would need more cells than are allowed.

    Examples
    --------
    >>> from viscontact.indenters import Sphere
    >>> from viscontact.load import step
    >>> ball = Pressing(Sphere(0.01), 1e-6, step(0.1).at(0.0), (2.4e-3, 2.4e-3))
    >>> found = resolve(ball, GRID_QUANTITIES, 0.01, fewest=(24, 24))
    >>> found.is_enough, found.trial.shape
    (True, (24, 24))
    """
    exact = min(EXACT_ENOUGH, EXACT * tolerance)
    names, shape = tuple(quantities), _good_shape(fewest, finest)
    trials: list[Trial] = []
    while True:
        trial = _tried(pressing, shape, exact)
        trials.append(trial)
        at_finest = _refined(trial, names, tolerance, finest) == shape
        too_many = math.prod(_refined(trial, names, tolerance, finest)) > most_cells
        is_exact = PEAK not in names or (_factors(trial, (PEAK,), tolerance) == 1).all()
        if not is_exact and _has_no_limit(trials, patient=not (at_finest or too_many)):
            names = tuple(name for name in names if name != PEAK)
        # What is left may have been as exact before, and not by chance.
        enough = [
            each
            for each in trials
            if (_factors(each, names, tolerance) == 1).all()
            and _agree(each, trial, names, tolerance)
        ]
        if enough:
            return Resolution(enough[0], names, enough[0].cells)
        following = _refined(trial, names, tolerance, finest)
        if following == shape or math.prod(following) > most_cells:
            needed = trial.cells * float(_factors(trial, names, tolerance).prod())
            return Resolution(trial, names, needed, is_enough=False, at_finest=following == shape)
        shape = following


def _agree(trial: Trial, finer: Trial, names: Sequence[str], tolerance: float) -> bool:
    which = [GRID_QUANTITIES.index(name) for name in names]
    return np.allclose(trial.values[which], finer.values[which], rtol=tolerance, atol=0.0)


def _refined(
    trial: Trial, names: Sequence[str], tolerance: float, finest: ArrayLike
) -> tuple[int, int]:
    """The mesh to be tried next: something of what is needed, not all at once."""
    factors = _factors(trial, names, tolerance)
    step = np.where(factors > 1, np.clip(factors, LEAST_AT_ONCE, MOST_AT_ONCE), 1.0)
    return _good_shape(trial.shape * step, finest)


def _factors(trial: Trial, names: Sequence[str], tolerance: float) -> NDArray[np.float64]:
    """How many times as many cells are needed along x and y; 1 if there are enough."""
    changes = trial.changes[:, [GRID_QUANTITIES.index(name) for name in names]] / tolerance
    # The error is shared by both ways; where one has little, the other may not have more.
    changes = np.where(changes.sum(axis=0) > 1, 2 * changes, 0.0)
    factors = changes.max(axis=1, initial=0.0) ** (1 / USUAL_ORDER)
    return np.asarray(np.maximum(1.0, np.maximum(factors, CELLS_IN_A_ROW / trial.in_a_row)))


def _has_no_limit(trials: Sequence[Trial], *, patient: bool) -> bool:
    """Whether the peak pressure changes as much on smaller cells as it did on larger ones."""
    telling = [trial for trial in trials if (trial.in_a_row >= CELLS_IN_A_ROW).all()]
    if len(telling) < 2:
        return False
    before, now = telling[-2:]
    peak = GRID_QUANTITIES.index(PEAK)
    along = int(now.changes[:, peak].argmax())
    fall = before.changes[along, peak] / now.changes[along, peak]
    refined = now.shape[along] / before.shape[along]
    is_endless = refined > 1 and fall < refined**LOWEST_ORDER
    return is_endless and not (patient and now.cells < PATIENCE * telling[0].cells)


def _tried(pressing: Pressing, shape: tuple[int, int], tolerance: float) -> Trial:
    nx, ny = shape
    coarser = [_found(pressing, coarse, tolerance) for coarse in ((nx // 2, ny), (nx, ny // 2))]
    # A cell twice as long is two cells.
    spread = [np.repeat(coarser[axis].pressure, 2, axis=axis) for axis in (0, 1)]
    fine = _found(pressing, shape, tolerance, (spread[0] + spread[1]) / 2)
    changes = np.stack([np.abs(other.values - fine.values) / fine.scales for other in coarser])
    area = GRID_QUANTITIES.index("contact_area")
    changes[:, area] = np.maximum(changes[:, area], RIM_SCATTER / fine.in_a_row)
    return Trial(shape, fine.values, changes, fine.in_a_row)


@dataclass(frozen=True, eq=False)
class _Found:
    """What a solve found: values of `GRID_QUANTITIES`, and what their errors are relative to."""

    pressure: NDArray[np.float64]
    values: NDArray[np.float64]
    scales: NDArray[np.float64]
    in_a_row: NDArray[np.float64]


def _found(
    pressing: Pressing,
    shape: tuple[int, int],
    tolerance: float,
    start: NDArray[np.float64] | None = None,
) -> _Found:
    grid, indenter, point = Grid(shape, pressing.size), pressing.indenter, pressing.point
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    half_space = HalfSpace(grid, mirrored=_mirrored(open_gap, point))
    problem = ContactProblem(
        half_space.fold(open_gap),
        pressing.compliance,
        half_space.share(Support.of(point)),
        1e-12 * max(grid.cell_size),
    )
    guess = None
    if start is not None and start.any():
        folded = half_space.fold(np.where(np.isfinite(open_gap), start, 0.0))
        guess = Guess(folded, half_space.convolution.apply(folded), np.zeros(3))
    solution = solve_contact(problem, half_space, guess, tolerance=tolerance)
    pressure = half_space.unfold(solution.found.pressure)
    contact = pressure > 0
    outline = trace_outline(indenter, grid)
    area = trace_rim(grid, contact, half_space.unfold(solution.gap), outline).area
    values = np.array([pressure.max(), area, solution.found.motion[0]])
    # Where the body mostly turns, its approach is no measure of its motion.
    sinks = pressing.compliance * float(solution.found.deflection.max())
    scales = np.maximum(values, [TINY, TINY, sinks])
    return _Found(pressure, values, scales, _cells_in_a_row(contact))


def _cells_in_a_row(contact: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Mean lengths of the rows of cells that a contact consists of, along x and along y."""
    begun = [
        int(line[0].sum()) + int((line[1:] & ~line[:-1]).sum()) for line in (contact, contact.T)
    ]
    return np.asarray(int(contact.sum()) / np.maximum(begun, 1))


def _mirrored(open_gap: NDArray[np.float64], point: LoadPoint) -> tuple[bool, bool]:
    uneven = (point.eccentricity_x or point.tilt_x, point.eccentricity_y or point.tilt_y)
    along_x, along_y = (not uneven[axis] and is_even(open_gap, axis) for axis in (0, 1))
    return along_x, along_y


def _good_shape(fewest: ArrayLike, finest: ArrayLike) -> tuple[int, int]:
    """Numbers of cells of which half is even, too, and that are good to transform."""
    quarters = np.maximum(2, np.ceil(np.minimum(fewest, finest) / 4)).astype(int).tolist()
    counts = [4 * int(fft.next_fast_len(quarter, real=True)) for quarter in quarters]
    return counts[0], counts[1]
