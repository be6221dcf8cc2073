"""One march in time for ∫ f(t - t') dg(t') = r(t): product integration on a given grid.

Only the unknown is approximated, so that f may have kinks and its own scale of time (Hopkins &
Hamming 1957, J. Appl. Phys. 28, 906). The obvious unknown, g straight on each step, is sound but
where f grows steeply: there errors come back with the opposite sign and ring (Linz 1985,
Analytical and Numerical Methods for Volterra Equations, chapter 9); and where f falls within a
step the order drops to one. Hence the form in which the kernel falls,

    f falls:   ∫ f(t - t') g'(t') dt' + f(t) g(0) = 1,                 unknown g,
    f grows:   f(0) k'(t) + ∫ f'(t - t') k'(t') dt' = r(t),  k' = g,   unknown k,

whose unknown is straight on all past steps and a parabola through its last three values on the
step in progress. Where the kernel is all at lag 0 this is the second-order backward difference
formula, which damps. A step reaches back over all earlier ones: the work grows with their number
squared.

A function that begins like a power, f = c t^m with f(0) = 0 or inf, has an inverse that begins
like sin(πm)/(πm) t^-m / c, which starts the march.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]
Mean = Callable[[Floats, Floats], Floats]

# Lags so much longer than their interval see it as a point: an error of its square / 24.
_POINT = 1e-4
# The derivative of f is taken over this part of its lag at least, with the same error.
_WIDE = 3e-4


class Load(NamedTuple):
    """The right-hand side r(t), with its mean over intervals."""

    at: Function
    mean: Mean


_ONE = Load(np.ones_like, lambda start, end: np.ones_like(start))


def march(function: Function, mean: Mean, nodes: Floats, load: Load | None) -> tuple[float, Floats]:
    """Return g at once, 0 or inf where it begins as a power, and at the nodes (or but the last)."""
    ends = function(nodes[[0, -1]])
    if ends[-1] < ends[0]:
        at_once, values = _under_falling(function, mean, nodes)
    else:
        at_once, values = _under_growing(function, mean, nodes, load or _ONE)
    return at_once, values


def _under_falling(function: Function, mean: Mean, nodes: Floats) -> tuple[float, Floats]:
    """Return g, growing, at once and at the nodes, from a function that falls."""
    times = np.append(0.0, nodes)
    steps = np.diff(times)
    at_once = 1.0 / float(function(np.zeros(1))[0])  # 0 if f begins infinite
    g = np.full(times.size, at_once)
    if at_once == 0:
        g[1] = _power_share(function, nodes[0]) / function(nodes[:1])[0]
    # ∫ f(l) (h - 2 l) dl over the lags of the step in progress, per h: what its curvature meets.
    curved = mean(np.zeros(nodes.size), steps) - 2 * _first_moment(mean, steps)
    for i in range(2 if at_once == 0 else 1, times.size):
        lags = times[i] - times[: i + 1]
        weights = _means(function, mean, lags[1:], lags[:-1])
        owed = 1.0 - at_once * function(times[i : i + 1])[0] - weights[:-1] @ np.diff(g[:i])
        h, before, rate = steps[i - 1], 0.0, 0.0
        if i > 1:
            before, rate = steps[i - 2], (g[i - 1] - g[i - 2]) / steps[i - 2]
        bend = h * curved[i - 1] / (h + before) if i > 1 else 0.0
        g[i] = g[i - 1] + (owed + bend * h * rate) / (weights[-1] + bend)
    return at_once, g[1:]


def _under_growing(
    function: Function, mean: Mean, nodes: Floats, load: Load
) -> tuple[float, Floats]:
    """Return g at once and at the nodes but the last, from a function that grows."""
    times = np.append(0.0, nodes)
    steps = np.diff(times)
    instant, first = float(function(np.zeros(1))[0]), float(function(nodes[:1])[0])
    k = np.zeros(times.size)
    if instant > 0:
        at_once = float(load.at(np.zeros(1))[0]) / instant
        k[1] = nodes[0] * load.mean(np.zeros(1), nodes[:1])[0] / first
    else:
        at_once = math.inf
        begun = _power_share(function, nodes[0]) / first
        k[1] = nodes[0] * begun / (1 - first_exponent(function, nodes[0]))
    loads = load.at(nodes)
    curved = 2 * mean(np.zeros(nodes.size), steps) - function(steps)
    for i in range(2, times.size):
        weights = _growths(function, times[i] - times[: i + 1], steps[:i])
        weights[-1] += instant
        h, before = steps[i - 1], steps[i - 2]
        rates = np.diff(k[:i]) / steps[: i - 1]
        bend = h * curved[i - 1] / (h + before)
        owed = loads[i - 1] - weights[:-1] @ rates
        k[i] = k[i - 1] + h * (owed + bend * rates[-1]) / (weights[-1] + bend)
    slopes = _slopes(times, k)
    # No parabola goes through a power's beginning; up to the first node all is quasi-elastic.
    slopes[0] = begun if instant == 0 else loads[0] / first
    return at_once, slopes


def _growths(function: Function, lags: Floats, steps: Floats) -> Floats:
    """Return by how much f grows over each interval of lag."""
    middle = lags[1:] + steps / 2
    # Over an interval that is nothing to its lag the difference would cancel, and old values can
    # be so large that this counts: f' there comes from an interval that is wide enough.
    half = np.maximum(steps, _WIDE * middle) / 2
    apart = function(middle + half) - function(np.maximum(middle - half, 0.0))
    return np.asarray(apart * (steps / (2 * half)))


def _slopes(times: Floats, k: Floats) -> Floats:
    """Return k' at all nodes but the outer two, by the parabola through the nodes around."""
    steps = np.diff(times)
    rates = np.diff(k) / steps
    return np.asarray((rates[:-1] * steps[1:] + rates[1:] * steps[:-1]) / (steps[:-1] + steps[1:]))


def _power_share(function: Function, first: float) -> float:
    """Return f g where f begins like t^m: sin(πm)/(πm)."""
    exponent = first_exponent(function, first)
    if not abs(exponent) < 0.99:
        raise ValueError(
            f"a function that begins like t^{exponent:.3g} has no inverse without a Dirac "
            "impulse: it needs an instant compliance, or must begin like a power below 1"
        )
    return math.sin(math.pi * exponent) / (math.pi * exponent) if exponent else 1.0


def first_exponent(function: Function, first: float) -> float:
    """Return the exponent of the power of time as which f begins, from two times there."""
    low, high = function(np.array([first, 2 * first]))
    return math.log2(float(high / low))


def _means(function: Function, mean: Mean, start: Floats, end: Floats) -> Floats:
    means = function(start + (end - start) / 2)
    near = end - start > _POINT * end
    means[near] = mean(start[near], end[near])
    return means


def _first_moment(mean: Mean, ends: Floats) -> Floats:
    """Return ∫ f(l) l dl from 0 to h, per h², of ends h [s].

    By parts it is F(h)/h - ∫ F(l) dl / h² with F(l) = l mean(0, l), which is smooth enough for
    Gauss-Legendre quadrature on panels that shrink towards 0.
    """
    nodes, weights = np.polynomial.legendre.leggauss(5)
    edges = np.append(0.0, 4.0 ** -np.arange(14.0)[::-1])
    x = (edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2).ravel()
    w = (np.diff(edges)[:, None] * weights / 2).ravel()
    lags = np.outer(ends, x)
    return np.asarray(mean(0 * ends, ends) - (mean(0 * lags, lags) * x) @ w)
