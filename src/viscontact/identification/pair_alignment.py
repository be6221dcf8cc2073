"""Alignment of two neighbouring sets: marginal likelihood of each possible step of ln a_T."""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.measured_sets import MeasuredSets
from viscontact.identification.scatter import Scatter, wiener_kernel
from viscontact.identification.vertical_shift import VerticalShift

# Steps that are tried: from one decade the wrong way, every twentieth of a decade.
_FIRST, _SPACING = -np.log(10.0), np.log(10.0) / 20
# Less noise would leave the best step between two of these; less vertical freedom hides a
# contradiction, which is looked for later.
_LEAST_NOISE, _LEAST_SPREAD = 0.01, 0.03
# Local maxima of the log likelihood that count as an alternative.
_RIVAL = 6.0


@dataclass(frozen=True, eq=False)
class Alignment:
    """Most likely decrease of ln a_T from one set to the next, and rivals of it."""

    step: float
    rivals: tuple[float, ...]


def aligned_pair(pair: MeasuredSets, scatter: Scatter, vertical: VerticalShift) -> Alignment:
    """Alignment of two sets, the colder one first."""
    last = np.max(pair.log_times[pair.owner == 0]) - np.min(pair.log_times[pair.owner == 1])
    steps = np.arange(_FIRST, max(last, 0.0) + _SPACING, _SPACING)
    logs = np.array([_log_likelihood(pair, scatter, vertical, step) for step in steps])
    padded = np.concatenate([[-np.inf], logs, [-np.inf]])
    peaks = np.flatnonzero((logs >= padded[:-2]) & (logs >= padded[2:]))
    best = int(np.argmax(logs))
    near = [k for k in peaks if k != best and logs[k] > logs[best] - _RIVAL]
    return Alignment(float(steps[best]), tuple(float(steps[k]) for k in near))


def _log_likelihood(
    pair: MeasuredSets, scatter: Scatter, vertical: VerticalShift, step: float
) -> float:
    """Log likelihood of a step; the curve and the vertical step are integrated out."""
    # The vertical step is normal, with this mean and this standard deviation.
    warmer = pair.owner == 1
    if vertical.given is None:
        spread = float(np.hypot(vertical.step_spreads[0], _LEAST_SPREAD))
        mean = float(vertical.expected_steps[0])
    else:
        spread, mean = _LEAST_SPREAD / 10, float(np.diff(vertical.given)[0])
    x = pair.log_times + step * warmer
    x = x - x.min()
    trend, kernel = np.stack([np.ones_like(x), x], axis=1), wiener_kernel(x)
    precision, linear, square = 1 / spread**2, mean / spread**2, (mean / spread) ** 2
    volume = 0.0
    for column, values in enumerate(pair.log_columns):
        noise = max(scatter.noise[column], _LEAST_NOISE) ** 2 / pair.weights
        covariance = scatter.roughness[column] ** 2 * kernel + np.diag(noise)
        factor = scipy.linalg.cho_factor(covariance, lower=True)
        sides = np.stack([pair.sign * warmer, values], axis=1)
        solved = scipy.linalg.cho_solve(factor, np.concatenate([trend, sides], axis=1))
        inner = trend.T @ solved[:, :2]
        removed = np.linalg.solve(inner, trend.T @ solved[:, 2:])
        left = sides.T @ solved[:, 2:] - sides.T @ solved[:, :2] @ removed
        precision, linear, square = (
            precision + left[0, 0],
            linear + left[0, 1],
            square + left[1, 1],
        )
        volume += 2 * np.sum(np.log(np.diag(factor[0]))) + np.linalg.slogdet(inner)[1]
    return float(-0.5 * (square - linear**2 / precision + np.log(precision) + volume))
