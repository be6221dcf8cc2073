"""Numerical interconversion of any creep or relaxation function, over many decades of time.

Creep and relaxation are inverse under the Boltzmann integral: the response g to f obeys

    ∫ f(t - t') dg(t') = 1    for every t > 0,

the jump g(0) = 1/f(0) included. It is integrated in time (`product_integration`) on three grids
even in ln t, each with half the step of the one before, and extrapolated to a vanishing step.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws.interconversion.log_curve import Before, LogCurve
from viscontact.bodies.laws.interconversion.product_integration import (
    Forcing,
    Function,
    Mean,
    first_exponent,
    march,
)

#: Steps in a decade of time on the coarsest of three grids; the finest has four times as many.
STEPS = 20
# f may change by this part before the first node; the inverse is straight in t up to there.
_FIRST_CHANGE = 1e-5
# A power law starts this far before the first requested instant: errors of its first steps have
# then decayed.
_AHEAD = 1e-5
_MOST_DECADES = 60


class Extrapolated(NamedTuple):
    """Extrapolated solution on the fine grid; nodes of the coarse one [s], errors there [-]."""

    curve: LogCurve
    nodes: Floats
    node_errors: Floats

    def error(self, start: float, end: float) -> float:
        """Return the largest estimated error between two times [s]."""
        within = (self.nodes >= start) & (self.nodes <= end * 1.5)  # a step further
        return float(np.max(self.node_errors[within], initial=0.0))


def invert(function: Function, mean: Mean, instants: ArrayLike) -> tuple[Floats, float]:
    """Return the inverse g of a creep or relaxation function f at instants [s], and its error.

    `function` is f(t), positive and monotone for t > 0; f(0) may be 0 or inf if f begins like a
    power of time between t^-1 and t^1; `mean` its mean over start..end [s]. The error [-], relative
    to 1/f if g falls, is of second order in the step of ln t: g is extrapolated to step 0
    (Richardson) from three grids, whose last change is the error. ValueError if f begins like a
    dashpot or vanishes, since its inverse holds a Dirac impulse.
    """
    instants = np.asarray(instants, np.float64)
    late = float(instants.max(initial=0.0))
    if late == 0:
        return 1.0 / function(instants), 0.0
    early = float(instants[instants > 0].min())
    found = respond(function, mean, late, first=_first_node(function, early, late), since=early)
    trend = 1 if found.curve.values[-1] > found.curve.values[0] else -1
    found = steadied(found, trend, function)
    return found.curve(instants), found.error(early, late)


def respond(
    function: Function,
    mean: Mean,
    end: float,
    *,
    first: float,
    since: float = 0.0,
    kinks: Sequence[float] = (),
    load: Forcing | None = None,
) -> Extrapolated:
    """Solve ∫ f(t - t') dg(t') = r(t) for g up to `end` [s]; a later end changes no value.

    Before the node `first` [s] g is straight in t, or a power if f is one up to `since` [s];
    `kinks` [s] are made nodes; r is `load` for a growing f with f(0) > 0, and 1 if left out.
    """
    coarse = _nodes(first, end, kinks)
    middle = _halved_grid(coarse)
    fine = _halved_grid(middle)
    at_once, rough = march(function, mean, coarse, load)
    _, better = march(function, mean, middle, load)
    _, best = march(function, mean, fine, load)
    better, best = better[: 2 * rough.size - 1], best[: 4 * rough.size - 3]
    values = _extrapolated(better, best)
    scale = np.abs(values[::4])
    if load is None and values[-1] < values[0]:
        scale = 1.0 / function(coarse[: rough.size])
    node_errors = np.abs(values[::4] - _extrapolated(rough, better)[::2]) / scale
    coarse, fine = coarse[: rough.size], fine[: values.size]
    if at_once not in (0.0, math.inf) or load is not None:
        return Extrapolated(_curve(fine, at_once, values), coarse, node_errors)
    # The beginning as a power leaves this, on any grid; up to there it is known better.
    settled = np.searchsorted(fine, since / 2)  # clear of the kink there
    curve = LogCurve(
        fine[settled:],
        values[settled:],
        before=-first_exponent(function, first),
        beyond="power",
    )
    return Extrapolated(curve, coarse, node_errors + first / np.maximum(coarse, first))


def _extrapolated(rough: Floats, better: Floats) -> Floats:
    """Return the Richardson limit of a vanishing step from the steps h and h/2."""
    change = better[::2] - rough
    # Where a rest has all but relaxed, the rough solution is no guide to the better one.
    change[np.abs(change) > np.abs(better[::2]) / 2] = 0.0
    at_nodes = np.arange(better.size)
    # What the extrapolation adds is smooth: half-way between the nodes it is interpolated.
    return np.asarray(better + np.interp(at_nodes, at_nodes[::2], change / 3))


def steadied(found: Extrapolated, trend: int, function: Function | None) -> Extrapolated:
    """Return a solution made monotone: growing (trend 1) or falling (-1), with its node errors."""
    # Rounding and extrapolation cause small oscillations. A function that no body of springs and
    # dashpots has, such as a table with kinks, has an inverse that truly oscillates: what is
    # removed counts as error. With `function` f and r = 1, g is at most 1/f where it falls.
    times, values, known = found.curve.times, found.curve.values, found.curve.at_once is not None
    if found.curve.at_once is not None:
        times, values = np.append(0.0, times), np.append(found.curve.at_once, values)
    if function is not None:
        # A function that has relaxed to zero gives no bound.
        with np.errstate(divide="ignore", over="ignore"):
            values = np.fmin(values, 1.0 / function(times))
    # From the end backwards: an oscillation then changes the earlier, larger values by its own
    # size at most.
    values = np.maximum(values, np.finfo(np.float64).tiny)
    running = np.minimum if trend > 0 else np.maximum
    steady = running.accumulate(values[::-1])[::-1]
    before: Before = "value" if known else found.curve.exponent
    curve = LogCurve(times, steady, before=before, beyond="power")
    at_nodes = curve(found.nodes)
    falls = trend < 0 and function is not None
    scale = 1.0 / function(found.nodes) if falls and function is not None else at_nodes
    taken_off = np.nan_to_num(np.abs(at_nodes - found.curve(found.nodes)) / scale, nan=np.inf)
    node_errors = np.nan_to_num(found.node_errors, nan=np.inf) + taken_off
    return Extrapolated(curve, found.nodes, np.minimum(node_errors, 1.0) if falls else node_errors)


def onset(function: Function, change: float = _FIRST_CHANGE) -> float:
    """Return a time [s] up to which a function hardly changes, by a fraction of its value at 0."""
    at_once = float(function(np.zeros(1))[0])

    def changed(decade: float) -> bool:
        return bool(abs(float(function(np.array([10.0**decade]))[0]) / at_once - 1) > change)

    # Outward from 1 s: far times may be costly to evaluate; a double holds 280 decades.
    low = next((d for d in np.arange(0.0, -280.0, -5.0) if not changed(d)), -280.0)
    high = next((d for d in np.arange(low + 5.0, 280.0, 5.0) if changed(d)), None)
    if high is None:
        return 1.0  # it never changes: any time will do
    low = high - 5.0
    while high - low > 0.25:
        middle = (low + high) / 2
        low, high = (low, middle) if changed(middle) else (middle, high)
    return float(10.0**low)


def first_node(curve: LogCurve) -> float:
    """Return the first time of the grid for the inverse of a curve [s]."""
    if curve.at_once is None:
        # A constant up to the first point has a constant inverse up to there.
        return float(curve.times[0]) * (1.0 if curve.exponent == 0 else _AHEAD)
    return min(onset(curve), float(curve.times[0])) if curve.at_once > 0 else math.nan


def _first_node(function: Function, early: float, late: float) -> float:
    at_once = float(function(np.zeros(1))[0])
    if not 0 < at_once < np.inf:
        return early * _AHEAD
    return max(min(onset(function), late), late * 10.0**-_MOST_DECADES)


def _nodes(first: float, end: float, kinks: Sequence[float]) -> Floats:
    """Return a grid even in ln t from the first node past the end, with each kink as a node."""
    # Differentiation loses the last nodes, so the grid ends after them.
    decades = max(1, math.floor(math.log10(end / first) + 1.5 / STEPS) + 1)
    # Whole decades from the first node on: a later end adds nodes and moves none.
    marks = first * 10.0 ** np.arange(decades + 1)
    within = [kink for kink in kinks if first < kink < marks[-1]]
    edges = np.unique(np.concatenate([marks, within]))
    edges = edges[np.append(True, edges[1:] > edges[:-1] * (1 + 1e-6))]
    parts = [np.array([first])]
    for low, high in itertools.pairwise(edges):
        ratio = high / low
        count = max(1, math.ceil(STEPS * math.log10(ratio) - 1e-6))
        parts.append(np.append(low * ratio ** (np.arange(1, count) / count), high))
    return np.concatenate(parts)


def _halved_grid(nodes: Floats) -> Floats:
    """Return the grid of half the step in ln t; every other node is one of the old grid."""
    fine = np.empty(2 * nodes.size - 1)
    fine[::2] = nodes
    fine[1::2] = np.sqrt(nodes[:-1]) * np.sqrt(nodes[1:])
    return fine


def _curve(nodes: Floats, at_once: float, values: Floats) -> LogCurve:
    if at_once == 0:
        return LogCurve(nodes, values, before="power", beyond="power")
    return LogCurve(np.append(0.0, nodes), np.append(at_once, values), beyond="power")
