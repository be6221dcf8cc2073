"""Variance of the outputs over samples: Sobol' indices with intervals, and percentiles."""

from __future__ import annotations

import numpy as np
from scipy.stats import bootstrap, sobol_indices

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass

#: Resamples of the bootstrap, and the level of its intervals.
RESAMPLES, LEVEL = 999, 0.95
#: Standard deviation, relative to the mean, below which an output does not vary.
CONSTANT = 1e-9


@dataclass(frozen=True, eq=False)
class Indices:
    """Sobol' indices, first order and total: value, lower and upper end, shape (3, inputs)."""

    # NaN if a sample has no result, or the output does not vary.

    first_order: Floats
    total_order: Floats


def indices_of(values: Floats, seed: int) -> Indices:
    """Sobol' indices from values of an output, shape (2 + inputs, points) of `Samples.labels`."""
    # Estimators of Saltelli and others (2010), with the percentile bootstrap over the points.
    inputs, count = len(values) - 2, values.shape[1]
    unknown = np.full((3, inputs), np.nan)
    spread, mean = np.std(values[:2]), abs(np.mean(values[:2]))
    if not np.isfinite(values).all() or spread <= CONSTANT * mean:
        return Indices(unknown, unknown)
    if inputs == 1:  # which causes all; SciPy needs two
        return Indices(np.ones((3, 1)), np.ones((3, 1)))

    def estimated(chosen: Integers) -> Floats:
        first, second, exchanged = values[0], values[1], values[2:]
        by_sample = {"f_A": first[None, chosen], "f_B": second[None, chosen]}
        by_sample["f_AB"] = exchanged[:, None, chosen]
        found = sobol_indices(func=by_sample, n=count)
        return np.stack([np.atleast_1d(found.first_order), np.atleast_1d(found.total_order)])

    own, points = estimated(np.arange(count)), np.arange(count)
    interval = bootstrap(
        (points,),
        estimated,
        n_resamples=RESAMPLES,
        confidence_level=LEVEL,
        method="percentile",
        vectorized=False,
        rng=np.random.default_rng(seed),
    ).confidence_interval
    found = np.stack([own, interval.low, interval.high])
    return Indices(found[:, 0], found[:, 1])


def percentiles_of(values: Floats, percents: Floats) -> Floats:
    """Percentiles [%] over the first axis of values (samples, ...), of those that are known."""
    known = values[np.isfinite(values).any(axis=tuple(range(1, values.ndim)))]
    if not known.size:
        return np.full((len(percents), *values.shape[1:]), np.nan)
    return np.asarray(np.nanpercentile(known, percents, axis=0))
