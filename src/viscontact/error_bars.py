"""How far each scalar of a run is off, estimated from coarser companions.

Between grids of cells h the values differ by c (h2^p - h1^p); any two of them tell c, and the
largest one counts, since rims between cells scatter and a single difference may be small by
accident. Steps tell their error in the same way on one grid. What a difference is, relative to the
value, is as good for the instants around it.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.companions import FEWEST_ACROSS, Course, History, companions_of, marched
from viscontact.richardson import richardson
from viscontact.run import Run

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Trust:
    """How differences between grids are taken for errors.

    Attributes
    ----------
    order : float
        With which power of the cells the error falls [-].
    factor : float
        By which the largest difference, so reduced, is multiplied: calibrated on exact solutions
        (tests/verification/test_error_bars.py), so that 95 of 100 errors are smaller [-].
    """

    order: float
    factor: float


_BULK, _AREA, _EXTENT, _PEAK = Trust(2.0, 1.5), Trust(2.0, 2.0), Trust(1.0, 0.75), Trust(2.0, 3.0)

#: Scalars that have a bar. Pressure is smooth but for the rim, which lies somewhere between cells.
TRUSTS = {
    "force": _BULK,
    "eccentricity_x": _BULK,
    "eccentricity_y": _BULK,
    "approach": _BULK,
    "tilt_x": _BULK,
    "tilt_y": _BULK,
    "contact_area": _AREA,
    "contact_length": _EXTENT,
    "contact_width": _EXTENT,
    "peak_pressure": _PEAK,
    "mean_pressure": _AREA,
    "work": _BULK,
    "loss_per_cycle": _BULK,
}

#: Approach, force and work where a contact reaches the end of a body: pressure is singular there,
#: and cells make a staircase of the end.
AT_END = Trust(0.7, 1.2)

#: What a difference between steps and halved ones counts: four thirds at second order, twice at
#: first.
HALVED = 1.5

#: Instants on both sides whose differences count as well.
AROUND = 3

#: The solver's tolerance is met by the gap; what follows from it is off by some times that.
SOLVER = 3.0

#: Scalars that are exactly zero without contact.
ZERO_APART = (
    *("force", "contact_area", "contact_length", "contact_width"),
    *("peak_pressure", "mean_pressure"),
)

#: What has no limit grows by at least this part of the mean pressure as cells shrink by a factor e:
#: under a wedge it is 0.64, under a cone 1.
ENDLESS_GROWTH = 0.3

#: What is said where a peak has no limit.
SINGULAR = (
    "the peak pressure has no limit as cells become smaller: it depends on the mesh, at a sharp "
    "edge, a point or a ridge of the body or at roughness that the grid does not resolve, and its "
    "error is given as infinite; resultants converge"
)


@dataclass(frozen=True, eq=False)
class ErrorBars:
    """Estimated errors of a run's scalars.

    Attributes
    ----------
    values : dict of str to ndarray
        Half widths of the bars by the scalar's name, in its unit, over the run's instants: inf
        where the scalar has no limit, NaN where nothing is known.
    warnings : tuple of str
        Doubts that the companions have raised.
    """

    values: dict[str, Array]
    warnings: tuple[str, ...]


def error_bars(run: Run, history: History, on_step: Callable[[], None] | None = None) -> ErrorBars:
    """Estimate how far the scalars of a run are off, from companions that are marched for it.

    Parameters
    ----------
    run : Run
        The run, which is over.
    history : mapping of str to ndarray
        What it has come to: its scalars by name and ``time``, ``cells_across``.
    on_step : callable, optional
        Called after each step of a companion; what it raises ends the estimate.

    Returns
    -------
    ErrorBars
        For each scalar an error that 95 of 100 true ones do not exceed.

    Examples
    --------
    >>> import viscontact as vc
    >>> from viscontact.companions import history_of
    >>> from viscontact.marching import march_run
    >>> from viscontact.run import prepare_run
    >>> rubber = vc.Material(vc.Elastic(1e6 / 3), poisson_ratio=0.5)
    >>> grid = vc.Grid((40, 40), (0.26, 0.26))
    >>> run = prepare_run(vc.Paraboloid(0.75, 0.75), rubber, vc.step(2370.0), grid, [0.0])
    >>> history = history_of(list(march_run(run)))
    >>> bar = error_bars(run, history).values["approach"][0]
    >>> bool(abs(history["approach"][0] - (0.75 * 2370 / (4e6 / 3) / 0.75**0.5)**(2 / 3)) < bar)
    True
    >>> bool(bar / history["approach"][0] < 2e-3)
    True
    """
    courses = [course for each in companions_of(run, history) if (course := marched(each, on_step))]
    return bars_from(run, history, courses)


def bars_from(run: Run, history: History, courses: Iterable[Course]) -> ErrorBars:
    """Estimate errors from companions that have been marched.

    Parameters
    ----------
    run, history
        As in `error_bars`.
    courses : iterable of Course
        The companions.

    Returns
    -------
    ErrorBars
        NaN everywhere if there is no companion.
    """
    found = list(courses)
    if not found:
        return unknown_bars(len(history["time"]))
    at_end = _around(_flags_at(history["time"], found)) > 0
    values = {name: _bar(run, name, _Levels.of(name, history, found), at_end) for name in TRUSTS}
    apart = _surely_apart(run, history)
    for name in ZERO_APART:
        values[name][apart] = 0.0
    endless = _endless(history, found, at_end)
    values["peak_pressure"][endless] = np.inf
    return ErrorBars(values, (SINGULAR,) if endless.any() else ())


def unknown_bars(count: int) -> ErrorBars:
    """Return errors that are not known, of so many instants.

    Parameters
    ----------
    count : int
        How many.

    Examples
    --------
    >>> unknown_bars(2).values["force"]
    array([nan, nan])
    """
    return ErrorBars({name: np.full(count, np.nan) for name in TRUSTS}, ())


@dataclass(frozen=True, eq=False)
class _Levels:
    """A scalar on each grid at the run's instants, NaN where a grid has none.

    `values` has a row for each of `spacings`, the run's own first; `by_steps` is what steps change,
    times what that counts.
    """

    spacings: tuple[float, ...]
    values: Array
    by_steps: Array

    @classmethod
    def of(cls, name: str, history: History, courses: list[Course]) -> _Levels:
        times, own = history["time"], history[name]
        twins = [course for course in courses if course.pace < 1]
        grids = [course for course in courses if course.pace >= 1]
        rows = np.stack([own, *(_aligned(name, times, course) for course in grids)])
        by_steps = np.zeros(len(times))
        for twin in twins:
            like = [
                row for row, c in zip(rows[1:], grids, strict=True) if c.spacing == twin.spacing
            ]
            for row in like:
                by_steps = HALVED * np.abs(row - _aligned(name, times, twin))
        return cls((1.0, *(course.spacing for course in grids)), rows, by_steps)

    def by_cells(self, trust: Trust) -> Array:
        """What cells make, from the two grids that say most."""
        found = np.full(self.values.shape[1], np.nan)
        for i, j in itertools.combinations(range(len(self.spacings)), 2):
            apart = abs(self.spacings[j] ** trust.order - self.spacings[i] ** trust.order)
            found = np.fmax(found, np.abs(self.values[j] - self.values[i]) / apart)
        return trust.factor * found


def _bar(run: Run, name: str, levels: _Levels, at_end: NDArray[np.bool_]) -> Array:
    own = np.abs(levels.values[0])
    scale = _around(own)
    by_cells = levels.by_cells(TRUSTS[name])
    if TRUSTS[name] is _BULK:
        by_cells = np.where(at_end, levels.by_cells(AT_END), by_cells)
    nothing = np.where(np.isnan(by_cells), np.nan, 0.0)
    parts = [
        _around(np.divide(part, scale, out=nothing.copy(), where=scale > 0))
        for part in (by_cells, levels.by_steps)
    ]
    solver = SOLVER * run.tolerance + run.memory.error + run.compliance.inversion_error
    bar = (parts[0] + np.nan_to_num(parts[1]) + solver) * scale
    return np.where(np.isnan(own), np.nan, bar)


def _endless(
    history: History, courses: list[Course], at_end: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Where the largest pressure has no limit: by the body's shape, or by what the grids show."""
    contact = np.asarray(history["peak_pressure"] > 0)
    if any(course.is_sharp for course in courses):
        return contact
    levels = _Levels.of("peak_pressure", history, courses)
    order = np.argsort(levels.spacings)
    if len(order) < 3:
        return np.asarray(contact & at_end)
    three = order[[0, 1, -1]]
    peaks = levels.values[three]
    spacings = np.array(levels.spacings)[three]
    known = np.isfinite(peaks).all(axis=0)
    verdict = richardson(np.where(known, peaks, 1.0), spacings)
    growth = (peaks[0] - peaks[-1]) / np.log(spacings[-1])
    grows = growth > ENDLESS_GROWTH * history["mean_pressure"]
    # A contact of few cells is no contact on the coarsest grid.
    fine = history["cells_across"] >= FEWEST_ACROSS * spacings[-1]
    endless = np.where(known, ~verdict.converges & grows & fine, np.nan)
    return np.asarray(contact & (at_end | (_mean_around(endless) > 0.5)))


def _surely_apart(run: Run, history: History) -> NDArray[np.bool_]:
    """Where there is no contact, and none that is lost or made between two instants."""
    apart = np.asarray(history["peak_pressure"] == 0)
    if run.load.control == "force":
        return apart
    return np.asarray(apart & ~(_around(~apart, 1) > 0))


def _flags_at(times: Array, courses: list[Course]) -> Array:
    """Where any companion has reached the end of the body."""
    flags = np.zeros(len(times))
    for course in courses:
        flags[np.isin(times, course.scalars["time"][course.at_end])] = 1.0
    return flags


def _aligned(name: str, times: Array, course: Course) -> Array:
    """A companion's scalar at the run's instants, NaN where it has none."""
    values, theirs = np.full(len(times), np.nan), course.scalars["time"]
    asked, known = np.isin(times, theirs), np.isin(theirs, times)
    values[asked] = course.scalars[name][known]
    return values


def _windows(values: NDArray[Any], reach: int) -> Array:
    padded = np.pad(np.asarray(values, dtype=float), reach, constant_values=np.nan)
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1))


def _around(values: NDArray[Any], reach: int = AROUND) -> Array:
    """Largest value of the instants around each; NaN where none of them has one."""
    return np.asarray(np.fmax.reduce(_windows(values, reach), axis=1))


def _mean_around(values: Array) -> Array:
    """Mean of the instants around each that have a value; 0 where none has one."""
    windows = _windows(values, AROUND)
    known = np.isfinite(windows)
    return np.asarray(np.where(known, windows, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1))
