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
class Observed:
    """Measured values, and how much each of them counts.

    Parameters
    ----------
    response : Response
        The kind of test, and where it was measured.
    values : ndarray, shape (rows,)
        Positive values; residuals are relative to them.
    weights : ndarray, shape (rows,)
        What the relative residuals are multiplied with [-].
    """

    response: Response
    values: Array
    weights: Array

    def relative(self, rows: Array) -> Array:
        """Return columns of rows as shares of the measured values, weighted."""
        return rows * (self.weights / self.values)[:, None]

    def columns(self, times: Array) -> Array:
        """Return the columns of the linear fit: what has no time, then the terms."""
        return self.relative(
            np.concatenate([self.response.constants, self.response.terms(times)], axis=1)
        )


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
        Root mean square of the weighted relative residuals [-].
    """

    constants: Array
    strengths: Array
    times: Array
    residual: float


def parsimonious_spectrum(observed: Observed, *, excess: float, tolerance: float) -> Spectrum:
    """Return the spectrum of fewest terms that fits about as well as any can.

    Parameters
    ----------
    observed : Observed
        The measured values, the kind of test, and how much each row counts.
    excess : float
        How many times the residual of the dense fit is accepted, above 1.
    tolerance : float
        A relative residual that is good enough whatever the dense fit reaches.

    Returns
    -------
    Spectrum
        The one with fewest terms whose residual is at most the larger of the two.
    """
    dense = dense_spectrum(observed)
    enough = max(excess * dense.residual, tolerance)
    # More terms never fit worse, so the fewest are found by halving. As many as the dense fit
    # has are enough: they start from its times.
    too_few, many = -1, dense.times.size
    best = dense
    while many - too_few > 1:
        middle = (too_few + many) // 2
        tried = _near(observed, middle, dense)
        if tried.residual <= enough:
            many, best = middle, tried
        else:
            too_few = middle
    return _descended(observed, np.log(best.times), _FINE)


def dense_spectrum(observed: Observed) -> Spectrum:
    """Return the best fit by a dense row of fixed times.

    Parameters
    ----------
    observed
        As in `parsimonious_spectrum`.

    Returns
    -------
    Spectrum
        Only what has a strength.
    """
    first, last = observed.response.reach
    count = 1 + round(_CANDIDATES_PER_DECADE * np.log10(last / first))
    return _strengths(observed, np.geomspace(first, last, max(count, 3)))[0]


def spectrum_of(observed: Observed, count: int) -> Spectrum:
    """Return the best fit found with so many terms.

    Parameters
    ----------
    observed
        As in `parsimonious_spectrum`.
    count : int
        How many terms, at most: one that gets no strength is left out.

    Returns
    -------
    Spectrum
        Where the merged neighbours of the dense fit descend to; for few terms the better of
        this and a descent from times spread evenly over the span of the data.
    """
    near = _near(observed, count, dense_spectrum(observed))
    return _descended(observed, np.log(near.times), _FINE)


def _near(observed: Observed, count: int, dense: Spectrum) -> Spectrum:
    lowest, highest = np.log(observed.response.reach)
    starts = []
    if count <= dense.times.size:
        starts.append(_merged_neighbours(observed, dense, count))
    if not starts or count <= _FEW:  # few terms can be caught in a wrong order of the clusters
        starts.append(lowest + (highest - lowest) * (np.arange(count) + 0.5) / max(count, 1))
    found = [_descended(observed, start, _COARSE) for start in starts]
    return min(found, key=lambda spectrum: spectrum.residual)


def _descended(observed: Observed, start: Array, gain: float) -> Spectrum:
    if start.size == 0:
        return _strengths(observed, np.exp(start))[0]
    lowest, highest = np.log(observed.response.reach)
    ended = least_squares(
        lambda log_times: _strengths(observed, np.exp(log_times))[1],
        start,
        jac=lambda log_times: _jacobian(observed, log_times),
        bounds=(lowest - 1e-9, highest + 1e-9),
        ftol=gain,
        xtol=1e-12,
        gtol=1e-14,
        max_nfev=100,
    )
    return _strengths(observed, np.sort(np.exp(ended.x)))[0]


def _strengths(observed: Observed, times: Array) -> tuple[Spectrum, Array]:
    """Return the non-negative strengths that fit best at given times, and the residuals."""
    columns = observed.columns(times)
    lengths = np.maximum(np.linalg.norm(columns, axis=0), np.finfo(np.float64).tiny)
    # NNLS refuses a matrix without columns, which is a fluid without terms.
    solved = nnls(columns / lengths, observed.weights)[0] if lengths.size else lengths
    strengths = solved / lengths
    residuals = columns @ strengths - observed.weights
    fixed, free = np.split(strengths, [columns.shape[1] - times.size])
    rms = float(np.sqrt(np.mean(residuals**2)))
    return Spectrum(fixed, free[free > 0], times[free > 0], rms), residuals


def _jacobian(observed: Observed, log_times: Array) -> Array:
    """Return Kaufman's Jacobian: what moving a time does that no change of strengths can undo."""
    times = np.exp(log_times)
    spectrum, _ = _strengths(observed, times)
    present = np.isin(times, spectrum.times)
    strengths = np.zeros(times.size)
    strengths[present] = spectrum.strengths
    kept = observed.columns(times)[:, np.concatenate([spectrum.constants > 0, present])]
    slopes = observed.relative(observed.response.slopes(times) * strengths)
    across, _ = np.linalg.qr(kept)
    return np.asarray(slopes - across @ (across.T @ slopes))


def _merged_neighbours(observed: Observed, dense: Spectrum, count: int) -> Array:
    """Return ln τ of the dense fit's terms, neighbours merged until so many are left.

    Merged first are those whose merging displaces least, after Ward: w1 w2/(w1 + w2) times the
    squared distance, where a weight is what the term contributes to the fit.
    """
    shown = observed.relative(observed.response.terms(dense.times) * dense.strengths)
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
