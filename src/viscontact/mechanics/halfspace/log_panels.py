"""Gauss's rule on panels of the logarithm, for functions that are smooth over many decades."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.polynomial.legendre import legder, leggauss, legvander

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass

#: Gauss nodes in each panel.
NODES = 10

#: Gauss nodes on each part of a panel beside the logarithm of K_0, and ends of these parts: on the
#: panel that holds it, and on the panels beside, as parts of the length from it to the panel's end.
SUBNODES = 16
ON_PANEL, BESIDE = (
    np.append(0.0, ratio ** np.arange(n)[::-1]) for ratio, n in ((0.15, 12), (0.5, 6))
)

_T, _W = leggauss(NODES)
_COEFFICIENTS = np.linalg.inv(legvander(_T, NODES - 1))  # Legendre's, from values at the nodes


@dataclass(frozen=True, eq=False)
class LogPanels:
    """Panels between `edges` of ln X, all of one length."""

    edges: Floats

    @classmethod
    def over(cls, lowest: float, highest: float, ratio: float) -> LogPanels:
        """Panels from one place to another, with ends in about a ratio."""
        count = math.ceil(math.log(highest / lowest) / math.log(ratio))
        return cls(np.linspace(math.log(lowest), math.log(highest), count + 1))

    @cached_property
    def logarithms(self) -> Floats:
        """Ln X of the nodes, panel by panel."""
        middle, half = (self.edges[1:] + self.edges[:-1]) / 2, np.diff(self.edges) / 2
        return (middle[:, None] + half[:, None] * _T).ravel()

    @cached_property
    def places(self) -> Floats:
        """X of the nodes."""
        return np.exp(self.logarithms)

    @cached_property
    def weights(self) -> Floats:
        """Weights of the nodes in an integral over X."""
        return (np.diff(self.edges)[:, None] / 2 * _W).ravel() * self.places

    def integrals_from_zero(self, values: Floats) -> Floats:
        """∫ f dX from X = 0 to each node, of values at the nodes, shape (nodes, ...)."""
        return np.asarray(self.integrals_until(values) + np.exp(self.edges[0]) * values[0])

    def integrals_until(self, values: Floats) -> Floats:
        """∫ f dX from the first edge to each node, of values at the nodes, shape (nodes, ...)."""
        panels = (values.T * self.places).T.reshape(len(self.edges) - 1, NODES, -1)
        half = np.diff(self.edges)[:, None, None] / 2
        whole = (_W @ panels) * half[:, 0]
        before = np.concatenate([np.zeros_like(whole[:1]), np.cumsum(whole, axis=0)[:-1]])
        inside = (_PARTIAL @ panels) * half
        return np.asarray((before[:, None] + inside).reshape(values.shape))

    def weights_until(self, ends: Floats) -> Floats:
        """Weights of ∫ f dX from X = 0 to ends within the panels; shape (ends, nodes).

        Nearer than the first panel f counts as at the first node.
        """
        panel, last = self._last_panel(ends)
        found = np.where(np.arange(len(self.places)) < panel[:, None] * NODES, self.weights, 0.0)
        columns = panel[:, None] * NODES + np.arange(NODES)
        found[np.arange(len(ends))[:, None], columns] = last
        found[:, 0] += np.minimum(ends, np.exp(self.edges[0]))
        return np.asarray(found)

    def weights_of_steps(self, borders: Floats, steps: Floats) -> Floats:
        """Weights of ∫ f s dX, of s that is constant between borders; shape (lines, nodes).

        Each line has borders of its own within the panels, shape (lines, steps + 1).
        """
        # A sum over the borders of what s falls by there times the weights until there.
        falls = -np.diff(steps, axis=1, prepend=0.0, append=0.0).ravel()
        panel, last = self._last_panel(borders.ravel())
        lines, count = len(borders), len(self.edges) - 1
        place = np.repeat(np.arange(lines) * count, borders.shape[1]) + panel
        size = lines * count
        ending = np.bincount(place, falls, size).reshape(lines, count)
        beyond = np.cumsum(ending[:, ::-1], axis=1)[:, ::-1] - ending
        found = beyond[..., None] * self.weights.reshape(count, NODES)
        for node, weights in enumerate((last * falls[:, None]).T):
            found[..., node] += np.bincount(place, weights, size).reshape(lines, count)
        before = np.minimum(borders, np.exp(self.edges[0]))
        found[:, 0, 0] += np.einsum("lb,lb->l", falls.reshape(borders.shape), before)
        return np.asarray(found.reshape(lines, -1))

    def _last_panel(self, ends: Floats) -> tuple[Integers, Floats]:
        """Panels in which ends lie, and weights of ∫ f dX over the parts of these up to there."""
        logarithms = np.log(np.maximum(ends, np.exp(self.edges[0])))
        panel = np.searchsorted(self.edges, logarithms, side="left") - 1
        panel = np.clip(panel, 0, len(self.edges) - 2)
        begin, length = self.edges[panel], np.diff(self.edges)[panel]
        parts = (logarithms - begin)[:, None] / 2 * (_T + 1)
        weights = (logarithms - begin)[:, None] / 2 * _W * np.exp(begin[:, None] + parts)
        inside = interpolation(2 * parts / length[:, None] - 1)
        return panel, np.einsum("eq,eqn->en", weights, inside)

    def weights_of_logarithm(self, kernel: Callable[[Floats], Floats]) -> Floats:
        """Weights of ∫ k(|X - X'|) f(X') dX' at the nodes X, for a kernel with a logarithm at 0."""
        found = np.zeros((len(self.places),) * 2)
        upper = np.triu_indices(len(self.places), 1)
        far = kernel(self.places[upper[1]] - self.places[upper[0]])
        found[upper] = found.T[upper] = far
        found *= self.weights
        panels = np.arange(len(self.edges) - 1)
        for node in range(NODES):
            for side in (-1, 0, 1):
                near = panels[(panels + side >= 0) & (panels + side < len(panels))] + side
                rows = (near - side) * NODES + node
                columns = near[:, None] * NODES + np.arange(NODES)
                found[rows[:, None], columns] = self._near_weights(kernel, rows, node, side)
        return found

    def _near_weights(
        self, kernel: Callable[[Floats], Floats], rows: Integers, node: int, side: int
    ) -> Floats:
        """Weights of rows that are one node of their panels, on these or on those beside."""
        # Panels are of one length, so that nodes lie alike about each row.
        length = float(self.edges[1] - self.edges[0])
        begin = (side - (1 + _T[node]) / 2) * length
        end = begin + length
        nearest = min(max(0.0, begin), end)
        parts = ON_PANEL if nearest == 0.0 else BESIDE
        ends = [nearest + (each - nearest) * parts for each in (begin, end) if each != nearest]
        low, high = (np.concatenate([each[k : len(each) - 1 + k] for each in ends]) for k in (0, 1))
        half = np.abs(high - low)[:, None] / 2
        beyond = ((low + high)[:, None] / 2 + (high - low)[:, None] / 2 * _SUB_T).ravel()
        # Differences of places near to each other, without cancellation.
        distance = np.multiply.outer(self.places[rows], np.abs(np.expm1(beyond)))
        weights = np.multiply.outer(self.places[rows], (half * _SUB_W).ravel() * np.exp(beyond))
        polynomials = legvander((2 * beyond - begin - end) / length, NODES - 1) @ _COEFFICIENTS
        return np.asarray((weights * kernel(distance)) @ polynomials)


def interpolation(places: Floats) -> Floats:
    """Values at places from -1 to 1 in a panel, of values at its nodes; shape (..., nodes)."""
    return np.asarray(legvander(places, NODES - 1) @ _COEFFICIENTS)


def slopes(places: Floats) -> Floats:
    """Slopes at places from -1 to 1 in a panel, of values at its nodes; shape (..., nodes)."""
    return np.asarray(legvander(places, NODES - 2) @ legder(_COEFFICIENTS))


def _partial_integrals() -> Floats:
    """Integrals over [-1, 1] from -1 to each node, of values at the nodes."""
    half = (_T + 1) / 2
    points = half[:, None] * (_T + 1) - 1
    powers = legvander(points, NODES - 1) @ _COEFFICIENTS
    return np.asarray(half[:, None] * np.einsum("n,mnk->mk", _W, powers))


_PARTIAL = _partial_integrals()
_SUB_T, _SUB_W = leggauss(SUBNODES)
