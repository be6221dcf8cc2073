"""Any compliance as a sum of exponentials, with the error that this makes."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

from viscontact.materials.compliance import ContactCompliance, SeriesCompliance

#: Candidate retardation times in each decade: more of them until the fit is good enough. A law
#: with a smooth spectrum needs few; one of a few sharp times is hit better by a finer comb, from
#: which few are then taken.
TIMES_PER_DECADE = (4, 8, 16, 32)

#: Relative deviation that is good enough, and samples of J in each decade.
TARGET_DEVIATION, SAMPLES_PER_DECADE = 1e-6, 24

#: Decades that the candidates reach beyond the times asked for, to either side.
MARGIN_DECADES = 2.0

#: Decades from the shortest time on, in which means from 0 are fitted besides: what a step meets
#: of its own change. Later means are those of the values fitted.
MEAN_DECADES = 1.0


def as_exponentials(
    compliance: ContactCompliance, first: float, last: float
) -> tuple[SeriesCompliance, float]:
    """Approximate a contact compliance by a sum of exponentials.

    Parameters
    ----------
    compliance : ContactCompliance
        J(t).
    first, last : float
        Shortest and longest time of interest [s], 0 < first < last.

    Returns
    -------
    series : SeriesCompliance
        With the same J(0), and no amplitude negative.
    error : float
        Largest deviation from J between the two times, and from its means from 0 to them,
        relative [-]. The Boltzmann integral of a field that grows linearly over each step, none
        shorter than `first`, is off by no more, relative to itself.

    Notes
    -----
    Non-negative least squares (Lawson & Hanson 1974) over a dense set of retardation times, with
    weights 1/J. Before `first` no single value counts, but their mean does: a step meets its own
    change by it, and a power of time has crept most of what it does there. A law without a
    completely monotone rate, such as a table with scatter, cannot be matched by positive terms
    any better than its scatter, and the error says so.

    Examples
    --------
    >>> law = SeriesCompliance(1.0, [1.0, 2.0], [3.0, 500.0])
    >>> series, error = as_exponentials(law, 0.1, 1e4)
    >>> error < 1e-3
    True
    """
    best = None
    for density in TIMES_PER_DECADE:
        series = _fitted(compliance, first, last, density)
        error = _deviation(compliance, series, first, last)
        if best is None or error < best[1]:
            best = series, error
        if best[1] <= TARGET_DEVIATION:
            break
    assert best is not None  # there is at least one density
    return best


def _fitted(
    compliance: ContactCompliance, first: float, last: float, density: int
) -> SeriesCompliance:
    begin, end = first / 10**MARGIN_DECADES, last * 10**MARGIN_DECADES
    times = np.geomspace(begin, end, int(np.ceil(np.log10(end / begin) * density)) + 1)
    samples = _log_spaced(first, last)
    early = samples[samples <= first * 10**MEAN_DECADES]
    creep = np.append(compliance(samples), compliance.mean(0.0 * early, early))
    weight = 1.0 / creep
    terms = np.vstack([_terms(samples, times, last), _mean_terms(early, times, last)])
    delayed = np.maximum(creep - compliance.instant, 0.0)
    # Scaled to amplitudes of order one, which is what the solver's tolerance takes them for.
    size = float(creep[-1])
    found, _ = scipy.optimize.nnls(
        terms * (size * weight)[:, None], delayed * weight, maxiter=50 * len(times)
    )
    return SeriesCompliance(
        compliance.instant, found[:-1] * size, times, float(found[-1]) * size / last
    )


def _terms(t: NDArray[np.float64], times: NDArray[np.float64], last: float) -> NDArray[np.float64]:
    """Return what each term has crept at some times, a column each, the last one of flow."""
    return np.column_stack([-np.expm1(-t[:, None] / times), t / last])


def _mean_terms(
    t: NDArray[np.float64], times: NDArray[np.float64], last: float
) -> NDArray[np.float64]:
    """Return the means of the terms from 0 to some times."""
    passed = t[:, None] / times
    return np.column_stack([1.0 + np.expm1(-passed) / passed, t / (2 * last)])


def _log_spaced(first: float, last: float, finer: int = 1) -> NDArray[np.float64]:
    decades = np.log10(last / first)
    return np.geomspace(first, last, int(np.ceil(decades * SAMPLES_PER_DECADE * finer)) + 2)


def _deviation(
    compliance: ContactCompliance, series: SeriesCompliance, first: float, last: float
) -> float:
    between = _log_spaced(first, last, finer=7)
    at_once = np.zeros(between.shape)
    values = series(between) / compliance(between)
    means = series.mean(at_once, between) / compliance.mean(at_once, between)
    return float(np.abs(np.append(values, means) - 1.0).max())
