"""The fewest exponential terms that say what measured values say.

First the best that any number of terms can do: non-negative least squares over a dense row of
candidate times, which is convex and needs no starting values. Its few non-zero strengths sit in
clusters of neighbours, since the true times lie between the candidates. So neighbours are
merged, and the times that remain are moved to where they fit best: a bounded least squares in
ln τ alone, since for given times the strengths are again non-negative least squares (variable
projection, [1]_).

References
----------
.. [1] G. H. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413-432; L. Kaufman, BIT 15
   (1975) 49-57, whose shorter Jacobian is used.
.. [2] M. Baumgaertel, H. H. Winter, J. Non-Newton. Fluid Mech. 44 (1992) 15-36: parsimonious
   spectra.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, nnls

from viscontact.identification.responses import Response

Array = NDArray[np.float64]

# Ten a decade: the best sum of terms at other times is met to far below any measurement.
_CANDIDATES_PER_DECADE = 10
# While the number of terms is sought, a descent ends where a step gains less than this; the
# number found is then descended to the bottom.
_COARSE, _FINE = 1e-4, 1e-12
_FEW = 8  # terms up to which a second start is worth its time


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Strengths and times of a sum of exponential terms, and how well it fits.

    Attributes
    ----------
    constants : ndarray
        Strengths of the columns without a time: instant and flow, or what stays.
    strengths, times : ndarray, shape (n,)
        Strengths > 0 and times ascending [s].
    residual : float
        Root mean square of the relative residuals [-].
    """

    constants: Array
    strengths: Array
    times: Array
    residual: float


def parsimonious_spectrum(
    response: Response, measured: Array, *, excess: float, tolerance: float
) -> Spectrum:
    """Return the spectrum of fewest terms that fits about as well as any can.

    Parameters
    ----------
    response : Response
        The kind of test, and where it was measured.
    measured : ndarray, shape (rows,)
        Positive values; residuals are relative to them.
    excess : float
        How many times the residual of the dense fit is accepted, above 1.
    tolerance : float
        A relative residual that is good enough whatever the dense fit reaches.

    Returns
    -------
    Spectrum
        The one with fewest terms whose residual is at most the larger of the two.
    """
    dense = dense_spectrum(response, measured)
    enough = max(excess * dense.residual, tolerance)
    # More terms never fit worse, so the fewest are found by halving. As many as the dense fit
    # has are enough: they start from its times.
    too_few, many = -1, dense.times.size
    best = dense
    while many - too_few > 1:
        middle = (too_few + many) // 2
        tried = _near(response, measured, middle, dense)
        if tried.residual <= enough:
            many, best = middle, tried
        else:
            too_few = middle
    return _descended(response, measured, np.log(best.times), _FINE)


def dense_spectrum(response: Response, measured: Array) -> Spectrum:
    """Return the best fit by a dense row of fixed times.

    Parameters
    ----------
    response, measured
        As in `parsimonious_spectrum`.

    Returns
    -------
    Spectrum
        Only what has a strength.
    """
    first, last = response.reach
    count = 1 + round(_CANDIDATES_PER_DECADE * np.log10(last / first))
    return _strengths(response, measured, np.geomspace(first, last, max(count, 3)))[0]


def spectrum_of(response: Response, measured: Array, count: int) -> Spectrum:
    """Return the best fit found with so many terms.

    Parameters
    ----------
    response, measured
        As in `parsimonious_spectrum`.
    count : int
        How many terms, at most: one that gets no strength is left out.

    Returns
    -------
    Spectrum
        Where the merged neighbours of the dense fit descend to; for few terms the better of
        this and a descent from times spread evenly over the span of the data.
    """
    near = _near(response, measured, count, dense_spectrum(response, measured))
    return _descended(response, measured, np.log(near.times), _FINE)


def _near(response: Response, measured: Array, count: int, dense: Spectrum) -> Spectrum:
    lowest, highest = np.log(response.reach)
    starts = []
    if count <= dense.times.size:
        starts.append(_merged_neighbours(response, measured, dense, count))
    if not starts or count <= _FEW:  # few terms can be caught in a wrong order of the clusters
        starts.append(lowest + (highest - lowest) * (np.arange(count) + 0.5) / max(count, 1))
    found = [_descended(response, measured, start, _COARSE) for start in starts]
    return min(found, key=lambda spectrum: spectrum.residual)


def _descended(response: Response, measured: Array, start: Array, gain: float) -> Spectrum:
    if start.size == 0:
        return _strengths(response, measured, np.exp(start))[0]
    lowest, highest = np.log(response.reach)
    ended = least_squares(
        lambda log_times: _strengths(response, measured, np.exp(log_times))[1],
        start,
        jac=lambda log_times: _jacobian(response, measured, log_times),
        bounds=(lowest - 1e-9, highest + 1e-9),
        ftol=gain,
        xtol=1e-12,
        gtol=1e-14,
        max_nfev=100,
    )
    return _strengths(response, measured, np.sort(np.exp(ended.x)))[0]


def _strengths(response: Response, measured: Array, times: Array) -> tuple[Spectrum, Array]:
    """Return the non-negative strengths that fit best at given times, and the residuals."""
    constants = response.constants
    columns = np.concatenate([constants, response.terms(times)], axis=1) / measured[:, None]
    if columns.shape[1] == 0:
        strengths = np.zeros(0)
    else:
        lengths = np.maximum(np.linalg.norm(columns, axis=0), np.finfo(np.float64).tiny)
        solved, _ = nnls(columns / lengths, np.ones(measured.size), maxiter=30 * lengths.size)
        strengths = solved / lengths
    residuals = columns @ strengths - 1.0
    fixed, free = np.split(strengths, [constants.shape[1]])
    rms = float(np.sqrt(np.mean(residuals**2)))
    return Spectrum(fixed, free[free > 0], times[free > 0], rms), residuals


def _jacobian(response: Response, measured: Array, log_times: Array) -> Array:
    """Return Kaufman's Jacobian: what moving a time does that no change of strengths can undo."""
    times = np.exp(log_times)
    constants = response.constants
    columns = np.concatenate([constants, response.terms(times)], axis=1) / measured[:, None]
    spectrum, _ = _strengths(response, measured, times)
    strengths = np.zeros(times.size)
    present = np.isin(times, spectrum.times)
    strengths[present] = spectrum.strengths
    kept = columns[:, np.concatenate([spectrum.constants > 0, present])]
    slopes = response.slopes(times) * strengths / measured[:, None]
    across, _ = np.linalg.qr(kept)
    return np.asarray(slopes - across @ (across.T @ slopes))


def _merged_neighbours(response: Response, measured: Array, dense: Spectrum, count: int) -> Array:
    """Return ln τ of the dense fit's terms, neighbours merged until so many are left.

    Merged first are those whose merging displaces least, after Ward: w1 w2/(w1 + w2) times the
    squared distance, where a weight is what the term contributes to the fit.
    """
    shown = response.terms(dense.times) * dense.strengths / measured[:, None]
    weights, places = list(np.linalg.norm(shown, axis=0)), list(np.log(dense.times))
    while len(places) > count:
        costs = [
            w1 * w2 / (w1 + w2) * (p2 - p1) ** 2
            for w1, w2, p1, p2 in zip(weights, weights[1:], places, places[1:], strict=False)
        ]
        if not costs:
            return np.zeros(0)
        i = int(np.argmin(costs))
        total = weights[i] + weights[i + 1]
        places[i] = (weights[i] * places[i] + weights[i + 1] * places[i + 1]) / total
        weights[i] = total
        del places[i + 1], weights[i + 1]
    return np.array(places)
