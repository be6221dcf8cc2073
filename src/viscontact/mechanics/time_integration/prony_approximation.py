"""Prony series of any creep compliance, with the error of the approximation."""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance

#: Candidate retardation times in each decade, increased until the fit is good enough. A law with a
#: smooth spectrum needs few; a line spectrum is matched better by a finer set, of which the fit
#: selects few.
TIMES_PER_DECADE = (4, 8, 16, 32)

#: Relative deviation that ends the refinement, and samples of J in each decade.
TARGET_DEVIATION, SAMPLES_PER_DECADE = 1e-6, 24

#: Decades by which the candidates extend beyond the times of interest, on both sides.
MARGIN_DECADES = 2.0

#: Decades from the shortest time on in which means from 0 are fitted, too: they weight the new
#: value of a step. Later means follow from the fitted values.
MEAN_DECADES = 1.0


def as_exponentials(
    compliance: ContactCompliance, first: float, last: float
) -> tuple[SeriesCompliance, float]:
    """Approximate a contact compliance by a Prony series; return it with its relative error.

    The series has the same J(0), and no negative amplitude. The error is the largest deviation from
    J between `first` and `last` [s], and from its means from 0 to these times. The hereditary
    integral of a field that is linear over each step, none shorter than `first`, has no larger
    relative error.

    Non-negative least squares (Lawson & Hanson 1974) over a dense set of retardation times, with
    weights 1/J. Before `first` only the mean of J matters: it weights the change within a step, and
    a power of time has crept most there. A law without a completely monotone rate, such as a table
    with scatter, is matched no better than its scatter.
    """
    best = None
    for density in TIMES_PER_DECADE:
        series = _fit_series(compliance, first, last, density)
        error = deviation_between(compliance, series, first, last)
        if best is None or error < best[1]:
            best = series, error
        if best[1] <= TARGET_DEVIATION:
            break
    assert best is not None  # there is at least one density
    return best


def _fit_series(
    compliance: ContactCompliance, first: float, last: float, density: int
) -> SeriesCompliance:
    """Series of least squares with retardation times at a density a decade."""
    begin, end = first / 10**MARGIN_DECADES, last * 10**MARGIN_DECADES
    times = np.geomspace(begin, end, int(np.ceil(np.log10(end / begin) * density)) + 1)
    samples = _log_spaced(first, last)
    early = samples[samples <= first * 10**MEAN_DECADES]
    creep = np.append(compliance(samples), compliance.mean(0.0 * early, early))
    weight = 1.0 / creep
    terms = np.vstack([_terms(samples, times, last), _mean_terms(early, times, last)])
    delayed = np.maximum(creep - compliance.instant, 0.0)
    # Scaled so that each term alone contributes of order one, for which the tolerance of the solver
    # is made.
    weighted = terms * weight[:, None]
    size = 1.0 / weighted.max(axis=0)
    found, _ = scipy.optimize.nnls(weighted * size, delayed * weight, maxiter=50 * len(times))
    amplitudes = found * size
    return SeriesCompliance(
        compliance.instant, amplitudes[:-1], times, float(amplitudes[-1]) / last
    )


def _terms(t: Floats, times: Floats, last: float) -> Floats:
    """Creep of each term at some times, a column each, the last one of flow."""
    return np.column_stack([-np.expm1(-t[:, None] / times), t / last])


def _mean_terms(t: Floats, times: Floats, last: float) -> Floats:
    """Means of the terms from 0 to some times."""
    passed = t[:, None] / times
    return np.column_stack([1.0 + np.expm1(-passed) / passed, t / (2 * last)])


def _log_spaced(first: float, last: float, finer: int = 1) -> Floats:
    """Sample times from first to last, even in their logarithm [s]."""
    decades = np.log10(last / first)
    return np.geomspace(first, last, int(np.ceil(decades * SAMPLES_PER_DECADE * finer)) + 2)


def deviation_between(
    compliance: ContactCompliance, series: SeriesCompliance, first: float, last: float
) -> float:
    """Largest relative deviation of a series from J between two times, and from its means."""
    between = _log_spaced(first, last, finer=7)
    at_once = np.zeros(between.shape)
    values = series(between) / compliance(between)
    means = series.mean(at_once, between) / compliance.mean(at_once, between)
    return float(np.abs(np.append(values, means) - 1.0).max())
