"""Coarser companions of a run, whose differences from it tell how far it is off."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.accuracy.looser_load import LooserLoad
from viscontact.checks.mesh import cells_across_spots
from viscontact.checks.singularities import is_sharp, strain_of, touches_end
from viscontact.errors import ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.materials.compliance import ContactCompliance
from viscontact.simulation.march import March
from viscontact.simulation.setup import RunSetup
from viscontact.state import ContactState
from viscontact.time_integration.fixed_steps import FixedSteps
from viscontact.time_integration.plan import plan_hereditary_integral

#: Cells of the companions, in cells of the run, and whether they lie about the origin as the run's
#: do: where a cell's centre was, there may be an edge between two.
SPACINGS = ((1.5, False), (2.4, True))

#: Their steps, in steps of the run, and how many steps the run must have for that.
PACES = ((16, (2, 4)), (7, (2, 2)), (0, (1, 1)))

#: Cells that the coarsest companion has across the largest contact; fewer are no contact.
FEWEST_ACROSS = 4.5

#: The least difference that is worth a run.
LEAST_COARSENING = 1.6

#: Scalars of a history by name, each over its instants, among them ``time``.
History = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Companion:
    """A run beside a run.

    Attributes
    ----------
    spacing : float
        Its cells, in cells of the run.
    pace : float
        Its steps, in steps of the run: 2 for every second one, 0.5 for halves.
    run : RunSetup
        What is marched.
    """

    spacing: float
    pace: float
    run: RunSetup


@dataclass(frozen=True, eq=False)
class Course:
    """What a companion has come to.

    Attributes
    ----------
    spacing, pace : float
        As of the companion.
    scalars : mapping of str to ndarray
        The scalars over its instants, ``time`` among them.
    at_end : ndarray of bool
        Where contact reaches the end of the body.
    spots : ndarray
        Cells of the run across the spots of which contact consists, in the mean.
    is_sharp : bool
        Whether the largest pressure lies on a point or a ridge of the body.
    """

    spacing: float
    pace: float
    scalars: History
    at_end: NDArray[np.bool_]
    spots: NDArray[np.float64]
    is_sharp: bool


def companions_of(run: RunSetup, history: History) -> Iterator[Companion]:
    """Yield the companions of a run that is over, the cheapest first.

    Parameters
    ----------
    run : RunSetup
        The run.
    history : mapping of str to ndarray
        Its ``time`` [s] and its ``cells_across``.

    Yields
    ------
    Companion
        Two that are coarser in cells and in steps. Where steps are so few that none can be left
        out, and the bodies creep, one more with halved steps on the coarsest grid.
    """
    times = history["time"]
    paces = _paces(len(FixedSteps(times, run.load).steps))
    spacings = _spacings(float(history["cells_across"].max(initial=0.0)))
    for (spacing, alike), pace in zip(reversed(spacings), reversed(paces), strict=True):
        kept = times[::-1][::pace][::-1]
        yield _companion(run, spacing, alike, float(pace), kept)
    if paces[-1] == 1 and _creeps(run.compliance, times):
        instants = np.unique(np.append(0.0, FixedSteps(times, run.load).instants))
        middles = (instants[1:] + instants[:-1]) / 2
        yield _companion(run, *spacings[-1], 0.5, np.union1d(times, middles))


def usual_companions(steps: int) -> tuple[tuple[float, int], ...]:
    """Return spacings and paces of the companions that a run of so many steps has.

    Parameters
    ----------
    steps : int
        Its steps.

    Examples
    --------
    >>> usual_companions(60)
    ((1.5, 2), (2.4, 4))
    """
    paces = _paces(steps)
    return tuple((spacing, pace) for (spacing, _), pace in zip(SPACINGS, paces, strict=True))


def _paces(steps: int) -> tuple[int, int]:
    return next(paces for least, paces in PACES if steps >= least)


def coarser_grid(grid: Grid, spacing: float, alike: bool) -> Grid:
    """Return a grid of larger cells over the same region and a little more.

    Parameters
    ----------
    grid : Grid
        The finer one.
    spacing : float
        Cells of the coarser one, in its cells.
    alike : bool
        Whether numbers of cells stay even or odd.

    Returns
    -------
    Grid
        A cell larger than the other at least, lest the contact touch its rim; of the same size if
        periodic.

    Examples
    --------
    >>> coarser_grid(Grid((30, 31), (30.0, 31.0)), 2.0, alike=True)
    Grid(shape=(16, 17), size=(32.0, 34.0), periodic=False)
    """
    if grid.periodic:
        counts = [max(4, round(count / spacing)) for count in grid.shape]
        return replace(grid, shape=(counts[0], counts[1]))
    shape = []
    for count in grid.shape:
        coarse = max(4, int(np.ceil(count / spacing - 1e-9)) + 1)
        shape.append(coarse + ((coarse - count) % 2 == alike))
    cells = [spacing * cell for cell in grid.cell_size]
    size = (shape[0] * cells[0], shape[1] * cells[1])
    return replace(grid, shape=(shape[0], shape[1]), size=size)


def marched(companion: Companion, on_step: Callable[[], None] | None = None) -> Course | None:
    """March a companion.

    Parameters
    ----------
    companion : Companion
        What to march.
    on_step : callable, optional
        Called after each of its steps; what it raises ends the march.

    Returns
    -------
    Course or None
        None if it could not be marched to its end: it tells nothing then.
    """
    run, states, ends, spots = companion.run, [], [], []
    peak = 0.0
    sharp = False
    try:
        for taken in March(run):
            if on_step is not None:
                on_step()
            if taken.state is None:
                continue
            states.append(taken.state.without_fields())
            contact = taken.state.pressure > 0
            ends.append(touches_end(run.open_gap, contact))
            spots.append(cells_across_spots(contact, periodic=run.grid.periodic))
            if taken.state.peak_pressure > 1.1 * peak:
                peak = taken.state.peak_pressure
                sharp = sharp or _peaks_at_point(companion, taken.state)
    except (ConvergenceError, DomainError):
        return None
    return Course(
        companion.spacing,
        companion.pace,
        history_of(states),
        np.array(ends, dtype=bool),
        companion.spacing * np.array(spots, dtype=float),
        sharp,
    )


#: What of a state tells how far it is off.
SCALARS = (
    "time",
    "force",
    "eccentricity_x",
    "eccentricity_y",
    "approach",
    "tilt_x",
    "tilt_y",
    "contact_area",
    "contact_length",
    "contact_width",
    "peak_pressure",
    "mean_pressure",
    "work",
    "loss_per_cycle",
    "cells_across",
)


def history_of(states: Sequence[ContactState]) -> History:
    """Return the scalars of states over their instants."""
    return {name: np.array([getattr(state, name) for state in states], float) for name in SCALARS}


def _spacings(across: float) -> tuple[tuple[float, bool], ...]:
    """The spacings, closer together where the run has few cells across its contact."""
    coarsest = SPACINGS[-1][0]
    most = min(coarsest, max(across / FEWEST_ACROSS, LEAST_COARSENING))
    closer = (most - 1) / (coarsest - 1)
    return tuple((1 + (spacing - 1) * closer, alike) for spacing, alike in SPACINGS)


def _creeps(compliance: ContactCompliance, times: NDArray[np.float64]) -> bool:
    return bool(compliance(float(times[-1])) != compliance.instant)


def _companion(
    run: RunSetup, spacing: float, alike: bool, pace: float, times: NDArray[np.float64]
) -> Companion:
    grid = coarser_grid(run.grid, spacing, alike)
    load = run.load if pace <= 1 else LooserLoad(run.load, pace)
    coarse = replace(run.on(grid), times=times, load=load, adaptive=None, automatic=None)
    numbers = 2 * coarse.open_gap.size // 2 ** sum(coarse.mirrored)
    memory = plan_hereditary_integral(run.compliance, FixedSteps(times, load).instants, numbers)
    return Companion(spacing, pace, replace(coarse, memory=memory))


def _peaks_at_point(companion: Companion, state: ContactState) -> bool:
    """Whether its largest pressure lies at what is sharp to the cells of the run beside it."""
    run = companion.run
    place = run.grid.largest_at(state.pressure)
    dx, dy = run.grid.cell_size
    cell = (dx / companion.spacing, dy / companion.spacing)
    strain = strain_of(state.peak_pressure, float(run.compliance(state.time)))
    return is_sharp(run.indenter, place, (1.5 * dx, 1.5 * dy), cell, strain)
