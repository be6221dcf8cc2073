"""How much each measured row counts in a fit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.identification.responses import Response
from viscontact.identification.spectrum import Observed, dense_spectrum

_WEIGHINGS, _LARGEST_RATIO = 3, 30.0


def alike(response: Response, values: NDArray[np.float64]) -> Observed:
    """Let each row count by its relative residual.

    Parameters
    ----------
    response : Response
        The kind of test, and where it was measured.
    values : ndarray, shape (rows,)
        What was measured, positive.

    Returns
    -------
    Observed
        The values with equal weights.
    """
    return Observed(response, values, np.ones_like(values))


def by_scatter(observed: Observed, tolerance: float) -> Observed:
    """Let each half of the rows, storage and loss, count by the inverse of its scatter.

    Feasible weighted least squares: the scatter is estimated from a fit in which it has been
    taken into account already, three times over.

    Parameters
    ----------
    observed : Observed
        An oscillation: the rows of G', then those of G''.
    tolerance : float
        Scatter below which nothing is told apart [-].

    Returns
    -------
    Observed
        The same with weights, whose root mean square is 1.
    """
    for _ in range(_WEIGHINGS):
        dense = dense_spectrum(observed)
        strengths = np.concatenate([dense.constants, dense.strengths])
        relative = observed.columns(dense.times) @ strengths / observed.weights - 1.0
        scatter = np.sqrt(np.mean(relative.reshape(2, -1) ** 2, axis=1))
        # What is good enough is not told apart, nor is a column ever silenced.
        scatter = np.maximum(scatter, max(tolerance, scatter.max() / _LARGEST_RATIO, 1e-12))
        weights = np.repeat(1 / scatter, relative.size // 2)
        weights /= np.sqrt(np.mean(weights**2))
        observed = Observed(observed.response, observed.values, weights)
    return observed
