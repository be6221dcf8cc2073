"""Scatter and curvature of each response, from the sets of the temperatures each alone.

A smooth curve is an integrated Wiener process (the prior of the cubic smoothing spline, Wahba, J.
R. Statist. Soc. B 40 (1978) 364-372) of roughness τ, measured with a noise of standard deviation σ.
Both follow from the restricted likelihood of all sets, which needs no shift factor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.identification.measured_sets import MeasuredSets

# Weak prior knowledge, which decides only for sets of two or three rows: noise of 1 %, as if from a
# tenth of a row, and a roughness of 0.1 that may be wrong by a factor of e^6.
_NOISE, _ROWS = 0.01, 0.1
_ROUGHNESS, _SPREAD = 0.1, 6.0
# Range of ln((τ/σ)²) that is searched.
_RATIOS = np.linspace(-12.0, 25.0, 75)


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


def own_scatter(sets: MeasuredSets) -> Scatter:
    """Scatter of each response about smooth curves through each set alone."""
    found = np.array([_of_column(sets, column) for column in range(sets.columns)])
    return Scatter(*found.T)


def _of_column(sets: MeasuredSets, column: int) -> tuple[float, float, float]:
    parts = [_contrasts(sets.chosen(k), column) for k in range(sets.count)]
    kernel, squares = (np.concatenate(each) for each in zip(*parts, strict=True))

    def variance(ratio: float) -> float:
        total = np.sum(squares / (1.0 + ratio * kernel)) + _ROWS * _NOISE**2
        return float(total / (squares.size + _ROWS))

    def cost(log_ratio: float) -> float:
        ratio = np.exp(log_ratio)
        square = variance(ratio)
        surprise = (np.log(ratio * square) - 2 * np.log(_ROUGHNESS)) / _SPREAD
        rows = squares.size + _ROWS
        return float(np.sum(np.log1p(ratio * kernel)) + rows * np.log(square) + surprise**2)

    best = int(np.argmin([cost(each) for each in _RATIOS]))
    around = _RATIOS[max(best - 1, 0)], _RATIOS[min(best + 1, _RATIOS.size - 1)]
    ratio = np.exp(scipy.optimize.minimize_scalar(cost, bounds=around, method="bounded").x)
    noise = np.sqrt(variance(ratio))
    return float(noise), float(noise * np.sqrt(ratio)), float(np.sum(1 / (1 + ratio * kernel)))


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
