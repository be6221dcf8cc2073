"""Measured sets of all temperatures as rows of one table, for their joint superposition."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.overlap import TemperatureCurve

# Rows of a set that are kept; of more, those near to each other in ln(time) are averaged.
_MOST_ROWS = 60


@dataclass(frozen=True, eq=False)
class MeasuredSets:
    """Rows of several sets, one set after the other, from cold to warm."""

    temperatures: Floats  # shape (sets,) [K]
    log_times: Floats  # ln(time), or -ln(ω), shape (rows,)
    log_columns: Floats  # shape (columns, rows)
    weights: Floats  # measured values that a row is the mean of, shape (rows,)
    owner: Integers  # index of the set of each row, shape (rows,)
    sign: float  # +1 for moduli, which the vertical factor multiplies, -1 for compliances

    @property
    def count(self) -> int:
        """Number of sets."""
        return self.temperatures.size

    @property
    def columns(self) -> int:
        """Number of measured columns."""
        return len(self.log_columns)

    @property
    def spacing(self) -> float:
        """Median distance of neighbouring rows in ln(time)."""
        steps = np.diff(self.log_times)[np.diff(self.owner) == 0]
        return float(np.median(steps))

    def chosen(self, *which: int) -> MeasuredSets:
        """Return some of the sets, in the given order."""
        rows = np.concatenate([np.flatnonzero(self.owner == k) for k in which])
        owner = np.concatenate([np.full(np.sum(self.owner == k), i) for i, k in enumerate(which)])
        return replace(
            self,
            temperatures=self.temperatures[list(which)],
            log_times=self.log_times[rows],
            log_columns=self.log_columns[:, rows],
            weights=self.weights[rows],
            owner=owner,
        )


def measured_sets(
    temperatures: Floats, curves: Sequence[TemperatureCurve], sign: float
) -> MeasuredSets:
    """Rows of the curves of all temperatures."""
    thinned = [_thinned(curve) for curve in curves]
    return MeasuredSets(
        temperatures,
        np.concatenate([times for times, _, _ in thinned]),
        np.concatenate([columns for _, columns, _ in thinned], axis=1),
        np.concatenate([weights for _, _, weights in thinned]),
        np.repeat(np.arange(len(thinned)), [times.size for times, _, _ in thinned]),
        sign,
    )


def _thinned(curve: TemperatureCurve) -> tuple[Floats, Floats, Floats]:
    """Rows of a set with their weights; means over bins of equal width where there are many."""
    times = curve.log_times
    if times.size <= _MOST_ROWS:
        return times, curve.log_columns, np.ones(times.size)
    share = (times - times[0]) / (times[-1] - times[0])
    _, bins = np.unique(
        np.minimum(_MOST_ROWS * share, _MOST_ROWS - 1).astype(int), return_inverse=True
    )
    weights = np.bincount(bins).astype(np.float64)
    columns = np.array([np.bincount(bins, column) / weights for column in curve.log_columns])
    return np.bincount(bins, times) / weights, columns, weights
