"""Parsimonious spectrum: the fewest exponential terms that fit measured values.

The first step is the best fit with any number of terms: non-negative least squares over a dense
series of candidate times, which is convex and needs no starting values. Its few non-zero strengths
form clusters of neighbours, since the true times lie between the candidates. So neighbours are
merged, and the remaining times are optimised: a bounded least squares in ln τ alone, since for
given times the strengths are again non-negative least squares (variable projection, [1]_).

References
----------
.. [1] G. H. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413-432; L. Kaufman, BIT 15
   (1975) 49-57, whose shorter Jacobian is used.
.. [2] M. Baumgaertel, H. H. Winter, J. Non-Newton. Fluid Mech. 44 (1992) 15-36: parsimonious
   spectra.

"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.responses import Response

# Ten per decade: fits any other times to far below the scatter of a measurement.
CANDIDATES_PER_DECADE = 10
# Relative gain at which a descent ends: while the number of terms is sought, and finally.
_COARSE, _FINE = 1e-4, 1e-12
_FEW = 8  # terms up to which a second start is tried


@dataclass(frozen=True, eq=False)
class Observed:
    """Positive measured values and the weights of their relative residuals, shape (rows,)."""

    response: Response
    values: Floats
    weights: Floats

    def relative(self, rows: Floats) -> Floats:
        """Rows relative to the measured values, weighted."""
        return rows * (self.weights / self.values)[:, None]

    def columns(self, times: Floats) -> Floats:
        """Columns of the linear fit: the constants, then the terms."""
        return self.relative(
            np.concatenate([self.response.constants, self.response.terms(times)], axis=1)
        )

    def residuals(self, spectrum: Spectrum) -> Floats:
        """Relative residuals of a spectrum, without weights [-]."""
        constants = self.response.constants @ spectrum.constants
        terms = self.response.terms(spectrum.times) @ spectrum.strengths
        return np.asarray((constants + terms) / self.values - 1.0)


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Strengths and times of a sum of exponential terms, and its residual."""

    constants: Floats  # strengths of the columns without a time: instant and flow, or equilibrium
    # strengths > 0 and times ascending [s], shape (n,)
    strengths: Floats
    times: Floats
    residual: float  # root mean square of the weighted relative residuals [-]


def unweighted(response: Response, values: Floats) -> Observed:
    """Measured values with equal weights: each row counts by its relative residual."""
    return Observed(response, values, np.ones_like(values))


def parsimonious_spectrum(observed: Observed, *, excess: float, tolerance: float) -> Spectrum:
    """Spectrum of fewest terms with a residual up to `tolerance` or `excess` times the best."""
    dense = dense_spectrum(observed)
    enough = max(excess * dense.residual, tolerance)
    # More terms never fit worse, so the fewest are found by bisection. The number of terms of the
    # dense fit is sufficient.
    too_few, many = -1, dense.times.size
    best = dense
    while many - too_few > 1:
        middle = (too_few + many) // 2
        tried = _nearby_fit(observed, middle, dense)
        if tried.residual <= enough:
            many, best = middle, tried
        else:
            too_few = middle
    return _descend(observed, np.log(best.times), _FINE)


def dense_spectrum(observed: Observed) -> Spectrum:
    """Non-negative least-squares fit over a dense series of fixed times."""
    first, last = observed.response.reach
    count = 1 + round(CANDIDATES_PER_DECADE * np.log10(last / first))
    return strengths_at(observed, np.geomspace(first, last, max(count, 3)))[0]


def spectrum_of(observed: Observed, count: int) -> Spectrum:
    """Best fit found with at most `count` terms."""
    # It descends from the merged neighbours of the dense fit; for few terms also from times spread
    # evenly over the span of the data.
    near = _nearby_fit(observed, count, dense_spectrum(observed))
    return _descend(observed, np.log(near.times), _FINE)


def _nearby_fit(observed: Observed, count: int, dense: Spectrum) -> Spectrum:
    lowest, highest = np.log(observed.response.reach)
    starts = []
    if count <= dense.times.size:
        starts.append(merged_neighbours(observed, dense, count))
    if not starts or count <= _FEW:  # few terms may end in a local minimum
        starts.append(lowest + (highest - lowest) * (np.arange(count) + 0.5) / max(count, 1))
    found = [_descend(observed, start, _COARSE) for start in starts]
    return min(found, key=lambda spectrum: spectrum.residual)


def _descend(observed: Observed, start: Floats, gain: float) -> Spectrum:
    if start.size == 0:
        return strengths_at(observed, np.exp(start))[0]
    lowest, highest = np.log(observed.response.reach)
    ended = scipy.optimize.least_squares(
        lambda log_times: strengths_at(observed, np.exp(log_times))[1],
        start,
        jac=lambda log_times: _jacobian(observed, log_times),
        bounds=(lowest - 1e-9, highest + 1e-9),
        ftol=gain,
        xtol=1e-12,
        gtol=1e-14,
        max_nfev=100,
    )
    return strengths_at(observed, np.sort(np.exp(ended.x)))[0]


def strengths_at(observed: Observed, times: Floats) -> tuple[Spectrum, Floats]:
    """Spectrum of the best non-negative strengths at given times, and the residuals."""
    columns = observed.columns(times)
    lengths = np.maximum(np.linalg.norm(columns, axis=0), np.finfo(np.float64).tiny)
    # NNLS refuses a matrix without columns, that of a fluid without terms.
    solved = (
        scipy.optimize.nnls(columns / lengths, observed.weights)[0] if lengths.size else lengths
    )
    strengths = solved / lengths
    residuals = columns @ strengths - observed.weights
    fixed, free = np.split(strengths, [columns.shape[1] - times.size])
    rms = float(np.sqrt(np.mean(residuals**2)))
    return Spectrum(fixed, free[free > 0], times[free > 0], rms), residuals


def _jacobian(observed: Observed, log_times: Floats) -> Floats:
    """Kaufman's Jacobian: the effect of moving a time, orthogonal to that of the strengths."""
    times = np.exp(log_times)
    spectrum, _ = strengths_at(observed, times)
    present = np.isin(times, spectrum.times)
    strengths = np.zeros(times.size)
    strengths[present] = spectrum.strengths
    kept = observed.columns(times)[:, np.concatenate([spectrum.constants > 0, present])]
    slopes = observed.relative(observed.response.slopes(times) * strengths)
    across, _ = np.linalg.qr(kept)
    return np.asarray(slopes - across @ (across.T @ slopes))


def merged_neighbours(observed: Observed, dense: Spectrum, count: int) -> Floats:
    """Logarithms ln τ of the dense fit's terms, neighbours merged until `count` are left."""
    # Ward's criterion: the pair with the least w1 w2/(w1 + w2) times the squared distance is merged
    # first, where a weight is the contribution of the term to the fit.
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
