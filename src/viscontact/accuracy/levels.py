"""A run and its companions side by side, at the run's instants."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.accuracy.coarser_runs import CoarserResult, History

Array = NDArray[np.float64]

#: What a difference between steps and halved ones counts: four thirds at second order, twice at
#: first.
HALVED_STEP_FACTOR = 1.5


@dataclass(frozen=True, eq=False)
class RefinementLevels:
    """A scalar on each grid at the run's instants.

    Attributes
    ----------
    spacings : tuple of float
        Cells of each grid, in cells of the run; the run's own first.
    values : ndarray, shape (grids, instants)
        The scalar, NaN where a grid has none.
    by_steps : ndarray
        What steps change, times what that counts.
    """

    spacings: tuple[float, ...]
    values: Array
    by_steps: Array

    @classmethod
    def of(cls, name: str, history: History, courses: list[CoarserResult]) -> RefinementLevels:
        """Put a scalar of a run beside those of its companions."""
        times, own = history["time"], history[name]
        twins = [course for course in courses if course.step_ratio < 1]
        grids = [course for course in courses if course.step_ratio >= 1]
        rows = np.stack([own, *(aligned(name, times, course) for course in grids)])
        by_steps = np.zeros(len(times))
        for twin in twins:
            like = [
                row for row, c in zip(rows[1:], grids, strict=True) if c.spacing == twin.spacing
            ]
            for row in like:
                by_steps = HALVED_STEP_FACTOR * np.abs(row - aligned(name, times, twin))
        return cls((1.0, *(course.spacing for course in grids)), rows, by_steps)

    def by_cells(self, order: float) -> Array:
        """Return what cells make, from the two grids that say most.

        Parameters
        ----------
        order : float
            With which power of the cells it falls [-].
        """
        found = np.full(self.values.shape[1], np.nan)
        for i, j in itertools.combinations(range(len(self.spacings)), 2):
            apart = abs(self.spacings[j] ** order - self.spacings[i] ** order)
            found = np.fmax(found, np.abs(self.values[j] - self.values[i]) / apart)
        return found


def end_flags(times: Array, courses: list[CoarserResult]) -> Array:
    """Return where any companion has reached the end of the body: 1, else 0."""
    flags = np.zeros(len(times))
    for course in courses:
        flags[np.isin(times, course.scalars["time"][course.at_end])] = 1.0
    return flags


def spots_across(times: Array, courses: list[CoarserResult]) -> Array:
    """Return cells across spots as the companions see them, the least; NaN without contact."""
    spots = np.full(len(times), np.nan)
    for course in courses:
        asked, known = (
            np.isin(times, course.scalars["time"]),
            np.isin(course.scalars["time"], times),
        )
        found = course.spots[known]
        spots[asked] = np.fmin(spots[asked], np.where(found > 0, found, np.nan))
    return spots


def aligned(name: str, times: Array, course: CoarserResult) -> Array:
    """Return a companion's scalar at the run's instants, NaN where it has none."""
    values, theirs = np.full(len(times), np.nan), course.scalars["time"]
    asked, known = np.isin(times, theirs), np.isin(theirs, times)
    values[asked] = course.scalars[name][known]
    return values


#: Instants on both sides.
WINDOW_STEPS = 3


def _windows(values: NDArray[Any], reach: int) -> Array:
    padded = np.pad(np.asarray(values, dtype=float), reach, constant_values=np.nan)
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1))


def moving_maximum(values: NDArray[Any], reach: int = WINDOW_STEPS) -> Array:
    """Return the largest value of the instants around each; NaN where none of them has one.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Over the instants.
    reach : int
        How many on both sides count.

    Examples
    --------
    >>> moving_maximum(np.array([1.0, np.nan, 5.0, 2.0, 0.0]), reach=1)
    array([1., 5., 5., 5., 2.])
    """
    return np.asarray(np.fmax.reduce(_windows(values, reach), axis=1))


def moving_minimum(values: NDArray[Any]) -> Array:
    """Return the least value of the instants around each; NaN where none of them has one.

    Examples
    --------
    >>> moving_minimum(np.array([1.0, np.nan, 5.0]))
    array([1., 1., 1.])
    """
    return np.asarray(np.fmin.reduce(_windows(values, WINDOW_STEPS), axis=1))


def moving_mean(values: Array) -> Array:
    """Return the mean of the instants around each that have a value; 0 where none has one.

    Examples
    --------
    >>> moving_mean(np.array([1.0, np.nan, 5.0]))
    array([3., 3., 3.])
    """
    windows = _windows(values, WINDOW_STEPS)
    known = np.isfinite(windows)
    return np.asarray(np.where(known, windows, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1))
