"""Product integration of ∫ f(t - t') dg(t') = r(t) on a given grid of times.

Only the unknown is approximated, so f may have kinks and its own time scale (Hopkins & Hamming
1957, J. Appl. Phys. 28, 906). The simplest unknown, g straight on each step, fails where f grows
steeply: errors return there with the opposite sign and oscillate (Linz 1985, Analytical and
Numerical Methods for Volterra Equations, chapter 9); and where f falls within a step the order
drops to one. Hence the form in which the kernel falls,

    f falls:   ∫ f(t - t') g'(t') dt' + f(t) g(0) = 1,                 unknown g,
    f grows:   f(0) k'(t) + ∫ f'(t - t') k'(t') dt' = r(t),  k' = g,   unknown k,

whose unknown is a parabola on each step, through its value there and the two before. For a kernel
concentrated at lag 0 this is the second-order backward difference formula, which damps; a
straight line would lose an order there, and on past steps too where the kernel is singular. Each
step sums over all earlier ones: the work grows with the square of their number.

A function that begins like a power, f = c t^m with f(0) = 0 or inf, has an inverse that begins
like sin(πm)/(πm) t^-m / c, which is the initial value.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from viscontact.backend.arrays import Floats

Function = Callable[[Floats], Floats]
Mean = Callable[[Floats, Floats], Floats]

# Steps so much shorter than their lag see it as a point: an error of its square / 24. Differences
# of f are taken over that part of the lag at least.
_POINT = 3e-4

# Nodes whose weights are computed in one call.
_AT_ONCE = 16


class Forcing(NamedTuple):
    """Right-hand side r(t), with its mean over intervals."""

    at: Function
    mean: Mean


_ONE = Forcing(np.ones_like, lambda start, end: np.ones_like(start))


class Kernel(NamedTuple):
    """Weights of a falling kernel κ for the rate of the unknown on each step.

    `past`, from lags with a row a node: ∫ κ dl over each step, and ∫ κ (h - 2 (l - a)) dl from its
    beginning a, the weight of the curvature. `whole`, `bent`: the same over the current step.
    """

    past: Callable[[Floats, Floats], tuple[Floats, Floats]]
    whole: Floats
    bent: Floats


def march(
    function: Function, mean: Mean, nodes: Floats, load: Forcing | None
) -> tuple[float, Floats]:
    """Return g(0), 0 or inf where g begins as a power, and g at the nodes (or all but the last)."""
    begin, end = function(nodes[[0, -1]])
    steps = np.diff(nodes, prepend=0.0)
    instant = float(function(np.zeros(1))[0])
    if end < begin:
        kernel = _falling(function, mean, steps)
        if not math.isinf(instant):
            rates = _rates(kernel, nodes, 1.0 - function(nodes) / instant, None)
            return 1.0 / instant, 1.0 / instant + np.cumsum(rates * steps)
        begun = _power_share(function, nodes[0]) / begin
        rates = _rates(kernel, nodes, np.ones_like(nodes), begun / nodes[0])
        return 0.0, np.cumsum(rates * steps)
    load = load or _ONE
    loads, kernel = load.at(nodes), _growing(function, mean, steps)
    if instant > 0:
        at_once, begun = float(load.at(np.zeros(1))[0]) / instant, loads[0] / begin
        average = load.mean(np.zeros(1), nodes[:1])[0] / begin
    else:
        at_once, begun = math.inf, _power_share(function, nodes[0]) / begin
        average = begun / (1 - first_exponent(function, nodes[0]))
    rates = _rates(kernel, nodes, loads, average)
    # Up to the first node all is quasi-elastic, or a power: no parabola goes through that.
    return at_once, np.append(begun, _at_nodes(rates, steps)[1:])


def _rates(kernel: Kernel, nodes: Floats, target: Floats, first: float | None) -> Floats:
    """Return the mean rates of the unknown on all steps, the first of which may be known."""
    begins, steps = np.append(0.0, nodes[:-1]), np.diff(nodes, prepend=0.0)
    rates, bends = np.zeros(nodes.size), np.zeros(nodes.size)
    rates[0] = target[0] / kernel.whole[0] if first is None else first
    for i, (whole, bent) in enumerate(_pasts(kernel, nodes, begins, steps), start=1):
        rest = target[i] - whole @ rates[:i] - bent @ bends[:i]
        if i == 1:  # the first step is long and may hide a power: no parabola rests on it
            rates[i] = rest / kernel.whole[i]
            continue
        apart = steps[i] + steps[i - 1]
        bending = kernel.bent[i] / apart
        rates[i] = (rest + bending * rates[i - 1]) / (kernel.whole[i] + bending)
        bends[i] = (rates[i] - rates[i - 1]) / apart
    return rates


def _pasts(
    kernel: Kernel, nodes: Floats, begins: Floats, steps: Floats
) -> Iterator[tuple[Floats, Floats]]:
    """Yield the weights of all steps before each node but the first."""
    # Many nodes at once, since calls for single nodes would take longer than the arithmetic.
    for low in range(1, nodes.size, _AT_ONCE):
        high = min(low + _AT_ONCE, nodes.size)
        lags = nodes[low:high, None] - begins[: high - 1]
        # A step that is not past yet is evaluated from its end, and discarded.
        whole, bent = kernel.past(np.maximum(lags, steps[: high - 1]), steps[: high - 1])
        for i in range(low, high):
            yield whole[i - low, :i], bent[i - low, :i]


def _falling(function: Function, mean: Mean, steps: Floats) -> Kernel:
    """Return the kernel κ = f of a function that falls."""

    def past(lags: Floats, steps: Floats) -> tuple[Floats, Floats]:
        middle = lags - steps / 2
        values = function(middle)
        bent = np.zeros(values.shape)
        near = steps > _POINT * middle
        a, b, c = (lags - steps)[near], middle[near], lags[near]
        early, late = mean(a, b), mean(b, c)
        values[near] = (early + late) / 2
        bent[near] = (early - late) / 3  # exact for a straight f
        return values * steps, bent * steps**2

    none = np.zeros(steps.size)
    bent = mean(none, steps) - 2 * _first_moment(mean, steps)
    return Kernel(past, mean(none, steps) * steps, bent * steps**2)


def _growing(function: Function, mean: Mean, steps: Floats) -> Kernel:
    """Return the kernel κ = f(0) δ + f' of a function that grows, from its values f."""

    def past(lags: Floats, steps: Floats) -> tuple[Floats, Floats]:
        middle = lags - steps / 2
        # Over a step that is nothing to its lag the difference would cancel, and old rates can
        # be so large that this counts: f' there comes from an interval that is wide enough.
        half = np.maximum(steps, _POINT * middle) / 2
        at = function(middle)
        early, late = at - function(np.maximum(middle - half, 0.0)), function(middle + half) - at
        share = steps / (2 * half)
        return (early + late) * share, (early - late) * share**2 * steps * (2 / 3)

    at_end = function(steps)
    curved = 2 * mean(np.zeros(steps.size), steps) - at_end
    return Kernel(past, at_end, curved * steps)


def _at_nodes(rates: Floats, steps: Floats) -> Floats:
    """Return the rate at each node but the last, by the parabola through adjacent nodes."""
    before, after = steps[:-1], steps[1:]
    return np.asarray((rates[:-1] * after + rates[1:] * before) / (before + after))


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
    """Return the exponent of the power of time as which f begins, from two early times."""
    low, high = function(np.array([first, 2 * first]))
    return math.log2(float(high / low))


def _first_moment(mean: Mean, ends: Floats) -> Floats:
    """Return ∫ f(l) l dl from 0 to h, per h², of ends h [s]."""
    # By parts F(h)/h - ∫ F(l) dl / h² with F(l) = l mean(0, l), which is smooth enough for
    # Gauss-Legendre quadrature on panels that shrink towards 0.
    nodes, weights = np.polynomial.legendre.leggauss(5)
    edges = np.append(0.0, 4.0 ** -np.arange(14.0)[::-1])
    x = (edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2).ravel()
    w = (np.diff(edges)[:, None] * weights / 2).ravel()
    lags = np.outer(ends, x)
    return np.asarray(mean(0 * ends, ends) - (mean(0 * lags, lags) * x) @ w)
