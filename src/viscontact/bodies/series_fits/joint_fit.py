"""Joint fit of a shift rule and of a law to a record under a temperature that varies.

The unknowns of the rule and the logarithms of the law's times are found together; the strengths
are non-negative least squares for each (variable projection, see `spectrum`). A law of any number
of terms over a dense series of times begins it, so that no shape of the law is preferred: its
clusters of terms are the terms of the joint fit. They are more than a law needs, since a law of too
few terms would bend the clock.
"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.residual_noise import Noise, noise_of
from viscontact.bodies.series_fits.shift_rules import ENERGIES, ShiftRule
from viscontact.bodies.series_fits.spectrum import (
    CANDIDATES_PER_DECADE,
    Observed,
    Spectrum,
    dense_spectrum,
    merged_neighbours,
    strengths_at,
)
from viscontact.bodies.series_fits.thermal_record import DIFFERENCE, ThermalRecord, log_rates

#: Distance of neighbours of one cluster, in steps of the dense series of times.
_NEIGHBOURS = 1.6
#: Residual that the dense series of times leaves of an exact record [-].
_DENSE = 3e-5
#: Least effect of an unknown on all residuals together, and least singular value of the effects.
_LEAST_EFFECT, _LEAST_SINGULAR = 1e-12, 1e-12
#: Rounds of a dense fit and a joint one, and farthest a time moves beyond the dense series [ln].
_ROUNDS, _BEYOND = 3, 3.0


@dataclass(frozen=True, eq=False)
class JointFit:
    """Unknowns of a rule, with their covariance, and the law that goes with them."""

    rule: ShiftRule
    free: Floats
    covariance: Floats  # of the unknowns of the rule
    spectrum: Spectrum
    expansion: float  # strength of the thermal strain [per K]
    expansion_error: float  # its standard error
    noise: Noise
    rows: int
    unknowns: int  # of the rule, and the thermal strain
    dense_residual: float  # with a law of any number of terms [-]
    widening: float  # largest ratio of a standard error to that under white noise

    @property
    def criterion(self) -> float:
        """Information criterion of Schwarz; the smallest of several rules is chosen."""
        # By the law of any number of terms, which has the same freedom with each rule.
        squares = self.dense_residual**2 + _DENSE**2
        return float(self.rows * np.log(squares) + self.unknowns * np.log(self.rows))

    def reach(self, confidence: float) -> Floats:
        """Half widths of the intervals of the unknowns."""
        quantile = scipy.special.stdtrit(self.noise.freedom, 0.5 + confidence / 2)
        return np.asarray(quantile * np.sqrt(np.diag(self.covariance)))


def joint_fit(record: ThermalRecord, rule: ShiftRule) -> JointFit:
    """Best joint fit that is found from the best activation energy."""
    free = rule.start(_best_energy(record, rule))
    best = _refined(record, rule, free)
    for _ in range(_ROUNDS - 1):
        again = _refined(record, rule, best.free)
        if not again.spectrum.residual < best.spectrum.residual * (1 - 1e-6):
            break
        best = again
    return best


def _best_energy(record: ThermalRecord, rule: ShiftRule) -> float:
    """Activation energy [J/mol] with which a law of any number of terms fits best."""
    low, high = rule.bounds
    starts = {energy: rule.start(energy) for energy in ENERGIES.tolist()}
    residuals = {
        energy: dense_spectrum(record.observed(rule.shift(free))).residual
        for energy, free in starts.items()
        if np.all((free > low) & (free < high))
    }
    return float(min(residuals, key=residuals.__getitem__))


@dataclass(frozen=True, eq=False)
class _Projection:
    """Residuals over the unknowns of a rule and the logarithms of times, without strengths."""

    record: ThermalRecord
    rule: ShiftRule
    count: int  # unknowns of the rule

    def observed(self, unknowns: Floats) -> tuple[Observed, Floats]:
        """The rows over the reduced time, and the times of the terms [s]."""
        shift = self.rule.shift(unknowns[: self.count])
        return self.record.observed(shift), np.exp(unknowns[self.count :])

    def residuals(self, unknowns: Floats) -> Floats:
        """Relative residuals with the best strengths [-]."""
        observed, times = self.observed(unknowns)
        return strengths_at(observed, times)[1]

    def columns(self, unknowns: Floats) -> tuple[Floats, Floats]:
        """Effects of the unknowns and of the strengths above 0 on the relative residuals."""
        observed, times = self.observed(unknowns)
        spectrum, _ = strengths_at(observed, times)
        present = np.isin(times, spectrum.times)
        strengths = np.zeros(times.size)
        strengths[present] = spectrum.strengths
        # A term depends on ξ/τ: its slopes with ln ξ and with ln τ are opposite.
        by_time = observed.response.slopes(times) * strengths
        by_clock = -by_time.sum(axis=1)
        if self.record.fluid and self.record.rises:
            by_clock = by_clock + spectrum.constants[1] * observed.response.constants[:, 1]
        free = unknowns[: self.count]
        steps = DIFFERENCE * np.eye(self.count)
        shifts = [(self.rule.shift(free - each), self.rule.shift(free + each)) for each in steps]
        by_rule = by_clock[:, None] * log_rates(self.record, shifts)
        kept = observed.columns(times)[:, np.concatenate([spectrum.constants > 0, present])]
        return observed.relative(np.concatenate([by_rule, by_time], axis=1)), kept

    def jacobian(self, unknowns: Floats) -> Floats:
        """Effects of the unknowns, orthogonal to those of the strengths (Kaufman 1975)."""
        moved, kept = self.columns(unknowns)
        across, _ = np.linalg.qr(kept)
        return np.asarray(moved - across @ (across.T @ moved))


def _refined(record: ThermalRecord, rule: ShiftRule, free: Floats) -> JointFit:
    """Joint fit from unknowns of the rule, with a term for each cluster of the dense fit."""
    observed = record.observed(rule.shift(free))
    dense = dense_spectrum(observed)
    gaps = np.diff(np.log(dense.times)) * CANDIDATES_PER_DECADE / np.log(10.0)
    clusters = 0 if not dense.times.size else 1 + int(np.count_nonzero(gaps > _NEIGHBOURS))
    start = np.concatenate([free, merged_neighbours(observed, dense, clusters)])
    projection = _Projection(record, rule, free.size)
    ended = scipy.optimize.least_squares(
        projection.residuals,
        start,
        jac=projection.jacobian,
        bounds=_bounds(rule, observed, clusters),
        x_scale="jac",
        ftol=1e-12,
        xtol=1e-12,
        gtol=1e-14,
        max_nfev=100,
    )
    return _with_covariance(projection, ended.x)


def _bounds(rule: ShiftRule, observed: Observed, clusters: int) -> tuple[Floats, Floats]:
    first, last = np.log(observed.response.reach)
    low, high = rule.bounds
    return (
        np.append(low, np.full(clusters, first - _BEYOND)),
        np.append(high, np.full(clusters, last + _BEYOND)),
    )


def _inverse(slopes: Floats) -> Floats:
    """Pseudoinverse, without a limit of the rank: undetermined unknowns have large errors."""
    lengths = np.maximum(np.linalg.norm(slopes, axis=0), _LEAST_EFFECT)
    left, singular, right = np.linalg.svd(slopes / lengths, full_matrices=False)
    inverse = (right.T / np.maximum(singular, _LEAST_SINGULAR)) @ left.T
    return np.asarray(inverse / lengths[:, None])


def _with_covariance(projection: _Projection, unknowns: Floats) -> JointFit:
    """The fit at its unknowns, with the covariance of those of the rule by linearisation."""
    record, count = projection.record, projection.count
    observed, times = projection.observed(unknowns)
    spectrum, residuals = strengths_at(observed, times)
    moved, kept = projection.columns(unknowns)
    # A term without strength moves nothing.
    moving = np.append(np.ones(count, bool), np.isin(times, spectrum.times))
    slopes = np.concatenate([moved[:, moving], kept], axis=1)
    influence = _inverse(slopes)
    noise = noise_of(residuals, len(influence))
    covariance = noise.covariance(influence)
    error = 0.0
    if record.expands:  # one of the two columns of the thermal strain is among those kept
        warm = int(np.count_nonzero(spectrum.constants[:-2] > 0)) + int(np.count_nonzero(moving))
        present = bool(np.any(spectrum.constants[-2:] > 0))
        error = float(np.sqrt(covariance[warm, warm])) if present else 0.0
    return JointFit(
        rule=projection.rule,
        free=unknowns[:count],
        covariance=covariance[:count, :count],
        spectrum=spectrum,
        expansion=record.expansion_of(spectrum),
        expansion_error=error,
        noise=noise,
        rows=residuals.size,
        unknowns=count + int(record.expands),
        dense_residual=dense_spectrum(observed).residual,
        widening=noise.widening(influence[:count]),
    )
