"""Scatter and curvature of each response, from the sets of the temperatures each alone.

A smooth curve is an integrated Wiener process (the prior of the cubic smoothing spline, Wahba, J.
R. Statist. Soc. B 40 (1978) 364-372) of roughness τ, measured with a noise of standard deviation σ.
Both follow from the restricted likelihood of all sets, which needs no shift factor.
"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.measured_sets import MeasuredSets

# Weak prior knowledge, which decides only for sets of two or three rows: noise of 1 %, as if from a
# tenth of a row, and a roughness of 0.1 that may be wrong by a factor of e^6.
_NOISE, _ROWS = 0.01, 0.1
_ROUGHNESS, _SPREAD = 0.1, 6.0
# Range of ln((τ/σ)²) that is searched.
_RATIOS = np.linspace(-12.0, 25.0, 75)
# Difference of -2 ln(likelihood) up to which all sets together are to decide.
_NEARLY = 30.0


@dataclass(frozen=True, eq=False)
class Scatter:
    """Noise and roughness of each response, shapes (columns,)."""

    noise: Floats  # standard deviation σ of ln(value) [-]
    roughness: Floats  # τ, standard deviation of the slope over a unit of ln(time)
    freedom: Floats  # degrees of freedom of the noise


def wiener_kernel(x: Floats) -> Floats:
    """Covariance of an integrated Wiener process at places x >= 0, shape (n, n)."""
    near, far = np.minimum(x[:, None], x), np.maximum(x[:, None], x)
    return np.asarray(near**2 * (3.0 * far - near) / 6.0)


def own_scatters(sets: MeasuredSets) -> tuple[Scatter, ...]:
    """Scatter of each response about smooth curves through each set alone, most likely first.

    Waves along a curve, such as those of a series of few terms, may be taken for noise. Where a
    rougher curve with less noise is nearly as likely, it is the second one.
    """
    found = [_of_column(sets, column) for column in range(sets.columns)]
    kinds = [[each[0] for each in found], [each[-1] for each in found]]
    scatters = [Scatter(*np.array(kind).T) for kind in kinds]
    return tuple(scatters[: 2 if any(len(each) > 1 for each in found) else 1])


def _of_column(sets: MeasuredSets, column: int) -> list[tuple[float, float, float]]:
    """Noise, roughness and freedom: the most likely ones, and of a rougher curve if likely."""
    parts = [_contrasts(sets.chosen(k), column) for k in range(sets.count)]
    kernel, squares = (np.concatenate(each) for each in zip(*parts, strict=True))
    rows = squares.size + _ROWS

    def variance(ratio: float) -> float:
        return float((np.sum(squares / (1.0 + ratio * kernel)) + _ROWS * _NOISE**2) / rows)

    def cost(log_ratio: float) -> float:
        ratio = np.exp(log_ratio)
        square = variance(ratio)
        surprise = (np.log(ratio * square) - 2 * np.log(_ROUGHNESS)) / _SPREAD
        return float(np.sum(np.log1p(ratio * kernel)) + rows * np.log(square) + surprise**2)

    costs = np.array([cost(each) for each in _RATIOS])
    padded = np.concatenate([[np.inf], costs, [np.inf]])
    lows: list[int] = np.flatnonzero((costs <= padded[:-2]) & (costs <= padded[2:])).tolist()
    best = lows[int(np.argmin(costs[lows]))]
    rougher = [k for k in lows if k > best and costs[k] < costs[best] + _NEARLY]
    found = []
    for low in (best, *rougher[:1]):
        around = _RATIOS[max(low - 1, 0)], _RATIOS[min(low + 1, _RATIOS.size - 1)]
        ratio = np.exp(scipy.optimize.minimize_scalar(cost, bounds=around, method="bounded").x)
        noise = np.sqrt(variance(ratio))
        freedom = np.sum(1 / (1 + ratio * kernel))
        found.append((float(noise), float(noise * np.sqrt(ratio)), float(freedom)))
    return found


def _contrasts(one: MeasuredSets, column: int) -> tuple[Floats, Floats]:
    """Eigenvalues of the kernel of a set, and squares of the values along its vectors."""
    # Level and slope are free: only what is orthogonal to both counts.
    x = one.log_times - one.log_times.min()
    root = np.sqrt(one.weights)
    across = scipy.linalg.null_space(np.stack([root, root * x]))
    kernel = across.T @ (root[:, None] * wiener_kernel(x) * root) @ across
    eigenvalues, vectors = np.linalg.eigh(kernel)
    along = vectors.T @ (across.T @ (root * one.log_columns[column]))
    return np.maximum(eigenvalues, 0.0), along**2
