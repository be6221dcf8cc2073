"""Refinement levels: the scalars of a run and its coarser runs at the run's times."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History

#: Error over the difference from quarters of the steps: 16/15 at second order, 4/3 at first, more
#: where a law creeps within the first quarter.
DIVIDED_STEP_FACTOR = 1.3

#: Part of an estimated time error of the pressure, above a large one, by which the scalars err at
#: least: halved steps may change little where all of them are long. The estimate is usually several
#: times too large. At instants that coarser runs leave out, such as the last one before the contact
#: is lost, it counts in full.
LARGE_TIME_ERROR, PART_OF_LARGE = 0.2, 0.3

#: Part of the differences of a grid that counts at times that it has left out: errors are a matter
#: of the rim's place among the cells, and rarely as large in between.
CARRIED = 0.6

#: Scalars of a moving contact that keep an error once it is made.
CUMULATIVE = ("work", "motion_work", "heat")


@dataclass(frozen=True, eq=False)
class RefinementLevels:
    """One scalar on each grid at the run's times."""

    spacings: tuple[float, ...]  # cell size of each grid, in cells of the run; the run's own first
    values: Floats  # NaN where a grid has none; shape (grids, times)
    by_steps: Floats  # estimated error of the time steps
    #: Instants at which a third run has shown that error: it has divided the steps that the others
    #: take as the run does.
    steps_shown: Bools

    @classmethod
    def of(cls, name: str, history: History, results: list[CoarserResult]) -> RefinementLevels:
        """Collect a scalar of a run and of its coarser runs."""
        times, own = history["time"], history[name]
        grids = [each for each in results if not each.divides_steps]
        rows = np.stack([own, *(aligned(name, times, each) for each in grids)])
        by_steps, shown = np.zeros(len(times)), np.zeros(len(times), dtype=bool)
        for divided in (each for each in results if each.divides_steps):
            for grid, row in zip(grids, rows[1:], strict=True):
                if grid.spacing == divided.spacing:
                    by_steps = DIVIDED_STEP_FACTOR * np.abs(row - aligned(name, times, divided))
                    shown = ~np.isnan(by_steps)
        large = np.fmax(history["time_error"] - LARGE_TIME_ERROR, 0.0) * np.abs(own)
        known = np.maximum(by_steps, PART_OF_LARGE * large)
        if name in CUMULATIVE and "heat" in history:
            known = np.where(np.isnan(known), between_known(known), known)
        left_out = np.fmax(_interpolated(times, known), large)
        by_steps = np.where(np.isnan(known), left_out, known)
        return cls((1.0, *(each.spacing for each in grids)), rows, by_steps, shown)

    @property
    def left_out(self) -> Bools:
        """Times that no coarser run has."""
        return np.asarray(np.isnan(self.values[1:]).all(axis=0))

    def carried(self, scale: Floats, cells: Floats, *, remembers: bool) -> RefinementLevels:
        """Levels whose grids differ as at their nearest times where they have left out one.

        Each grid for itself: at the only time near it that one has, it may agree by chance. The
        differences are relative to `scale` and fall with the number of `cells` in contact. What
        remembers no load before differs as much at the times of the next smaller and larger one.
        """
        own, count = self.values[0], np.maximum(cells, 1.0)
        by_size = np.argsort(cells, kind="stable")
        rows = []
        for row in self.values[1:]:
            apart = quotient(row - own, scale)
            missing = np.where(cells > 0, mean_nearest(count * apart) / count, mean_nearest(apart))
            if not remembers:
                alike = np.empty(len(own))
                alike[by_size] = mean_nearest((count * apart)[by_size])
                larger = (cells > 0) & (np.abs(alike / count) > np.abs(missing))
                missing = np.where(larger, alike / count, missing)
            rows.append(np.where(np.isnan(row), own + CARRIED * scale * missing, row))
        return replace(self, values=np.stack([own, *rows]))

    def by_cells(self, order: float) -> Floats:
        """Error from the cells at an order of convergence: the largest over the pairs of grids."""
        found = np.full(self.values.shape[1], np.nan)
        for i, j in itertools.combinations(range(len(self.spacings)), 2):
            apart = abs(self.spacings[j] ** order - self.spacings[i] ** order)
            found = np.fmax(found, np.abs(self.values[j] - self.values[i]) / apart)
        return found


def end_flags(times: Floats, results: list[CoarserResult]) -> Floats:
    """1 at times at which any coarser run has reached the end of the body, else 0."""
    # Between two of its instants, a coarser run is there where it is at one of them.
    flags = np.zeros(len(times))
    for result in results:
        theirs = result.scalars["time"]
        own = np.full(len(times), np.nan)
        own[np.isin(times, theirs)] = result.at_end[np.isin(theirs, times)]
        flags = np.fmax(flags, between_known(own))
    return flags


def rises_to_ends(times: Floats, results: list[CoarserResult]) -> Bools:
    """Times at which pressure rises to both ends of the contact; along x, y; shape (2, times)."""
    found = np.full((2, len(times)), np.nan)
    for result in results:
        theirs = result.scalars["time"]
        shared, known = np.isin(times, theirs), np.isin(theirs, times)
        found[:, shared] = np.fmin(found[:, shared], result.rises_to_ends[known].T)
    return np.array([moving_minimum(each) == 1 for each in found])


def spots_across(times: Floats, results: list[CoarserResult]) -> Floats:
    """Least number of cells across spots in the coarser runs; NaN without contact."""
    spots = np.full(len(times), np.nan)
    for result in results:
        theirs = result.scalars["time"]
        shared, known = np.isin(times, theirs), np.isin(theirs, times)
        found = result.spots[known]
        spots[shared] = np.fmin(spots[shared], np.where(found > 0, found, np.nan))
    return spots


def beside_peak(times: Floats, results: list[CoarserResult]) -> tuple[Floats, Floats, Floats]:
    """Largest drops beside the peak on the finest coarser grid, apex exponents, and bends there.

    All are NaN where they are not known. The bends are those within the cells of the run.
    """
    drops, exponents, bends = np.full((3, len(times)), np.nan)
    grids = [each for each in results if not each.divides_steps]
    if grids:
        finest = min(grids, key=lambda each: each.spacing)
        theirs = finest.scalars["time"]
        shared, known = np.isin(times, theirs), np.isin(theirs, times)
        drops[shared], exponents[shared] = finest.peak_drops[known], finest.apex_exponents[known]
        bends[shared] = finest.near_bend_growth[known] / finest.spacing
    return moving_maximum(drops), -moving_maximum(-exponents), moving_maximum(bends)


def aligned(name: str, times: Floats, result: CoarserResult) -> Floats:
    """A coarser run's scalar at the run's times, NaN where it has none."""
    theirs = result.scalars["time"]
    if not theirs.size:
        return np.full(len(times), np.nan)
    places = np.minimum(np.searchsorted(theirs, times), len(theirs) - 1)
    return np.where(theirs[places] == times, result.scalars[name][places], np.nan)


def _interpolated(times: Floats, values: Floats) -> Floats:
    """Values at all times from the known ones, linearly."""
    known = ~np.isnan(values)
    return np.interp(times, times[known], values[known]) if known.any() else values


#: Times on both sides of the window.
WINDOW_STEPS = 3


def _moving(choice: np.ufunc, values: Numbers, reach: int) -> Floats:
    """Choice among the values in the window around each time."""
    # Shift by shift, in half the time of a view of windows: it is done 80 times in a run.
    given = np.asarray(values, dtype=float)
    found = given.copy()
    for shift in range(1, reach + 1):
        choice(found[shift:], given[:-shift], out=found[shift:])
        choice(found[:-shift], given[shift:], out=found[:-shift])
    return found


def moving_maximum(values: Numbers, reach: int = WINDOW_STEPS) -> Floats:
    """Maximum over a window of `reach` times on both sides; NaN where all are NaN."""
    return _moving(np.fmax, values, reach)


def between_known(values: Floats) -> Floats:
    """Larger one of the nearest known values on both sides; NaN where one of them is unknown."""
    return np.asarray(np.maximum(*_nearest_known(values)))


def mean_nearest(values: Floats) -> Floats:
    """Mean magnitude of the nearest known values on both sides, with the sign of the larger one."""
    before, after = _nearest_known(values)
    before = np.where(np.isnan(before), after, before)
    after = np.where(np.isnan(after), before, after)
    larger = np.where(np.abs(after) > np.abs(before), after, before)
    return np.asarray(np.sign(larger) * (np.abs(before) + np.abs(after)) / 2)


def _nearest_known(values: Floats) -> tuple[Floats, Floats]:
    """Nearest known values before and after each time, or at it; NaN where there is none."""
    places = np.arange(len(values))
    known = ~np.isnan(values)
    before = np.maximum.accumulate(np.where(known, places, 0))
    after = np.minimum.accumulate(np.where(known, places, len(values) - 1)[::-1])[::-1]
    return values[before], values[after]


def quotient(error: Floats, scale: Floats) -> Floats:
    """Error over a scale; 0 where that is zero, NaN where the error is unknown."""
    nothing = np.where(np.isnan(error), np.nan, 0.0)
    return np.divide(error, scale, out=nothing, where=scale > 0)


def moving_minimum(values: Numbers) -> Floats:
    """Minimum over a window of times; NaN where all are NaN."""
    return _moving(np.fmin, values, WINDOW_STEPS)


def moving_mean(values: Floats) -> Floats:
    """Mean over a window of times without NaN; NaN where all are NaN."""
    padded = np.pad(np.asarray(values, dtype=float), WINDOW_STEPS, constant_values=np.nan)
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * WINDOW_STEPS + 1)
    known = np.isfinite(windows)
    count = known.sum(axis=1)
    return np.where(
        count > 0, np.where(known, windows, 0.0).sum(axis=1) / np.maximum(count, 1), np.nan
    )
