"""Quadrature of hereditary integrals with kernels given as callables.

Creep and relaxation are smooth on a logarithmic scale of time: each relaxation time, however
short, has its own decade. So intervals are halved repeatedly towards the end where the functions
vary fast, with polynomials of degree 16 on each panel. Algebraic singularities at such an end (a
square-root start, a power law) are resolved by the same halving.

"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.polynomial import chebyshev, legendre
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats

TimeFunction: TypeAlias = Callable[[Floats], ArrayLike]
"""A function of time, called with a one-dimensional array of times [s]."""

_DEGREE = 16
_NODES: Floats = np.sin(np.linspace(-0.5, 0.5, _DEGREE + 1) * np.pi)
_FIT = np.linalg.inv(chebyshev.chebvander(_NODES, _DEGREE))
_GAUSS, _WEIGHTS = legendre.leggauss(_DEGREE)


def _stieltjes_matrix() -> Floats:
    """Matrix B of a panel: integral of k ds = sum of k(Gauss node j) B_ji s(node i)."""
    # It does not depend on the panel's length, as the integral does not. Where k is constant it
    # gives k times the difference of s, whatever s does in between.
    slopes = chebyshev.chebval(_GAUSS, chebyshev.chebder(np.eye(_DEGREE + 1))).T
    matrix: Floats = _WEIGHTS[:, None] * (slopes @ _FIT)
    return matrix


def _panels(edges: Floats, nodes: Floats) -> Floats:
    """Map ``nodes``, given on [-1, 1], to every panel between ``edges``."""
    half = np.diff(edges)[:, None] / 2
    return edges[:-1, None] + half * (1 + nodes)


def _halved_edges(times: int) -> Floats:
    """Edges of panels on [0, 1], halved ``times`` times towards 0."""
    return np.concatenate([[0.0], 0.5 ** np.arange(times, -1, -1)])


_TO_ZERO = _halved_edges(48)  # down to the rounding of the interval's length
_STIELTJES = _stieltjes_matrix()
# A path is halved less often towards its end: over the innermost panel it is straight, and its
# increments over shorter ones would be rounding only. The kernel may still vary there, even
# be infinite at lag 0, and is averaged over it.
_PATH_EDGES = np.concatenate([_TO_ZERO / 2, 1 - _halved_edges(30)[-2::-1] / 2])
_PATH_FRACTIONS = _panels(_PATH_EDGES, _NODES)
# The same panels counted back from the end, so that the shortest lags keep their digits.
_LAG_EDGES = np.concatenate([_halved_edges(30) / 2, 1 - _TO_ZERO[-2::-1] / 2])
_LAG_FRACTIONS = _panels(_LAG_EDGES, _GAUSS)[::-1, ::-1]
_INNERMOST_FRACTIONS = _LAG_EDGES[1] * _panels(_TO_ZERO**3, _GAUSS)
_INNERMOST_WEIGHTS = np.diff(_TO_ZERO**3)[:, None] / 2 * _WEIGHTS


def evaluate(function: TimeFunction, times: ArrayLike) -> Floats:
    """Values of a function of time [s] at times of any shape; a constant may return a scalar."""
    times = np.asarray(times, dtype=np.float64)
    values = np.asarray(function(times.ravel()), dtype=np.float64)
    return np.broadcast_to(values, times.size).reshape(times.shape).copy()


def accumulated(function: TimeFunction, times: ArrayLike) -> Floats:
    """Integral from 0 to each time >= 0 [s] of a function smooth in log t and finite at 0."""
    times = np.asarray(times, dtype=np.float64)
    edges = max(float(times.max()), np.finfo(float).tiny) * _TO_ZERO
    half = np.diff(edges) / 2
    fitted = (evaluate(function, _panels(edges, _NODES)) @ _FIT.T).T
    coefficients = chebyshev.chebint(fitted, lbnd=-1) * half
    whole = coefficients.sum(axis=0)  # every Chebyshev polynomial is 1 at the panel's end
    before = np.cumsum(whole) - whole
    panel = np.clip(np.searchsorted(edges, times, side="right") - 1, 0, len(half) - 1)
    place = (times - edges[panel]) / half[panel] - 1
    integrals: Floats = before[panel] + chebyshev.chebval(
        place, coefficients[:, panel], tensor=False
    )
    return integrals


def averaged(function: TimeFunction, starts: Floats, ends: Floats) -> Floats:
    """Mean over intervals [s] that begin no earlier than their length; the value where it is 0."""
    times = starts[..., None] + (ends - starts)[..., None] / 2 * (1 + _GAUSS)
    average: Floats = evaluate(function, times) @ _WEIGHTS / 2
    return average


def superposed(
    kernel: TimeFunction,
    path: Callable[[Floats], Floats],
    start: Floats,
    end: Floats,
    now: Floats,
) -> Floats:
    """Hereditary integral of kernel(now - t') d path(t') from start to end, shape (n,).

    The kernel is smooth in log lag, at most integrably infinite at 0. The path is called with times
    of shape (n, panels, nodes); it is smooth but for an algebraic singularity at start <= end <=
    now [s].
    """
    width = (end - start)[:, None, None]
    lag_of_end = (now - end)[:, None, None]
    kernel_there = evaluate(kernel, lag_of_end + width * _LAG_FRACTIONS)
    innermost = evaluate(kernel, lag_of_end + width * _INNERMOST_FRACTIONS)
    kernel_there[:, -1] = np.sum(innermost * _INNERMOST_WEIGHTS, axis=(1, 2))[:, None]
    along_path = path(start[:, None, None] + width * _PATH_FRACTIONS)
    integral: Floats = np.sum((kernel_there @ _STIELTJES) * along_path, axis=(1, 2))
    return integral
