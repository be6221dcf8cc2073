"""Straight edge of a contact on a grid, by the method of Wiener and Hopf.

Next to the rim a contact that consists of cells differs from the exact one, in the same way in all
contacts: only the direction of the rim, the shape of the cells and the influence coefficients
matter.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Normals (m, n) of edges: m steps across the edge for a cell along the line, n for one beside it.
NORMALS = ((1, 0), (10, 1), (5, 1), (3, 1), (2, 1), (3, 2), (4, 3), (5, 4), (10, 9), (1, 1))

#: Wave numbers per half a reciprocal cell, aliases on both sides of each, positions of the edge.
WAVES, ALIASES, POSITIONS = 16, 5, 32

#: Largest curvature of the gap that three cells resolve, per cell.
MAX_CURVATURE = 0.3

#: Largest distance of the first open centre from the threshold, in cells; 1 beside a smooth rim.
MAX_DISTANCE = 1.5


@dataclass(frozen=True, eq=False)
class EdgeLaw:
    """Gaps or pressures of the cells next to a smooth rim, along lines of the grid that cross it.

    Notes
    -----
    Far from a straight edge, gap and pressure are those of a half-plane in contact, s^(3/2) and
    (-s)^(1/2) with the distance s from the edge. On an infinite grid, both are functions of a
    centre's s alone; the lattice planes parallel to the edge have a spacing u. The influence
    coefficients K(k), at wave numbers k across the edge, are split as K = K₊ K₋ into
    factors with powers l >= 0 of z = exp(iku), K₊ = Σ b_l z^l, and of 1/z. The solution without
    singular pressure, ĝ = K₊/k² and p̂ = 1/(k² K₋), is piecewise linear,

        g(s) = Σ b_l max(s - c - l u, 0),   b_0 = 1,

    and a cell is in contact if s < c. With K |2 sin(ku/2)|/u = exp(Σ c_l z^l), ĝ has the phase of
    s^(3/2) at small k if c = u/4 - u Σ_{l>0} l c_l.

    Across an edge along the grid, the first gaps are t, 1 + (1 + b_1) t, ... for s = c + t: their
    ratio gives t without error, where gap^(2/3), which is linear in s further out, is off by up
    to 0.17 cells. To the next order the gap has a part in K₊/k³, s^(5/2) further out: curved rims
    and contacts of finite size. A third gap determines it. Across an oblique edge, the result
    has a small mean error over the positions of the edge between the centres, the offset.

    The pressures inside follow from 1/K₋ in the same way: distances from the edge inwards, the
    threshold -c, and growth by the coefficients of the reciprocal power series.

    References
    ----------
    B. Noble, Methods Based on the Wiener-Hopf Technique, Pergamon (1958).
    """

    threshold: float  # c, or -c: least distance of the centres on this side of the edge [cells]
    growth: tuple[float, float]  # b_1 and b_2, or those of the reciprocal series
    slopes: tuple[float, ...] = (0.0,)  # slopes of the edge, in cells
    offsets: tuple[float, ...] = (0.0,)  # mean errors of the distance at these slopes [cells]

    def distance(self, first: Floats, second: Floats, third: Floats) -> Floats:
        """Distance of the rim from the first of three centres on a line, in cells, by their values.

        The values are gaps outwards, or pressures inwards; the third is NaN where it is not known.
        """
        b, c = self.growth
        slack = second - (1 + b) * first
        t = np.full_like(first, MAX_DISTANCE)
        np.divide(first, slack, out=t, where=first < MAX_DISTANCE * slack)
        # Change of t with the curvature, and second and third gap over the slope of the first: by
        # the law, and what a unit curvature adds.
        shift = -t * (1 + t) / 2
        second_gap, third_gap = 1 + (1 + b) * t, 2 + b + (1 + b + c) * t
        second_bend = ((1 + t) ** 2 + b * t**2) / 2 - (1 + b) * shift
        third_bend = ((2 + t) ** 2 + b * (1 + t) ** 2 + c * t**2) / 2 - (1 + b + c) * shift
        ratio = np.where(np.isnan(third), third_gap / second_gap, third / second)
        curvature = (ratio * second_gap - third_gap) / (third_bend - ratio * second_bend)
        curvature = np.minimum(np.maximum(curvature, -MAX_CURVATURE), MAX_CURVATURE)
        return np.asarray(self.threshold + t - curvature * shift)

    def offset(self, slope: Floats) -> Floats:
        """Mean error of the distance where the rim moves by `slope` cells per line, in cells."""
        return np.interp(np.abs(slope), self.slopes, self.offsets)


@lru_cache(maxsize=256)
def edge_laws(cell_ratio: float, *, periodic: bool) -> tuple[EdgeLaw, EdgeLaw]:
    """Laws of the gaps outside an edge and of the pressures inside, along lines of a grid.

    The ratio is that of a cell's breadth over its length along the line.
    """
    normals = ((1, 0), *NORMALS)
    edges = [_straight_edge(*normal, cell_ratio, periodic=periodic) for normal in normals]
    return _law(edges), _law([each.reversed() for each in edges])


def _law(edges: Sequence[_StraightEdge]) -> EdgeLaw:
    """Law of an edge along the grid, with its mean errors across those of `NORMALS`."""
    straight, *others = edges
    growth = float(straight.growth[1]), float(straight.growth[2])
    law = EdgeLaw(straight.threshold, growth)
    offsets = (_mean_error(law, each, m) for each, (m, _) in zip(others, NORMALS, strict=True))
    return EdgeLaw(law.threshold, growth, tuple(n / m for m, n in NORMALS), tuple(offsets))


@dataclass(frozen=True, eq=False)
class _StraightEdge:
    """Solution for an edge of any direction, in cells along the line."""

    spacing: float  # of lattice planes parallel to the edge
    threshold: float
    growth: Floats  # b_l

    def gaps(self, beyond: Floats) -> Floats:
        """Gaps at distances from the threshold, over their first slope."""
        steps = np.arange(len(self.growth))[:, None] * self.spacing
        return np.asarray(self.growth @ np.maximum(beyond - steps, 0.0))

    def reversed(self) -> _StraightEdge:
        """The same edge from within: its pressures take the place of the gaps."""
        reciprocal = np.zeros_like(self.growth)
        reciprocal[0] = 1.0
        for each in range(1, len(reciprocal)):
            reciprocal[each] = -self.growth[1 : each + 1] @ reciprocal[each - 1 :: -1][:each]
        return _StraightEdge(self.spacing, -self.threshold, reciprocal)


def _mean_error(law: EdgeLaw, edge: _StraightEdge, m: int) -> float:
    """Mean error of a law over the positions of an edge of normal (m, n), in cells."""
    cell = m * edge.spacing
    beyond = (np.arange(POSITIONS) + 0.5) / POSITIONS * cell
    gaps = [edge.gaps(beyond + each * cell) for each in range(3)]
    found = law.distance(*gaps)
    return float(np.mean(found - (beyond + edge.threshold) / cell))


@lru_cache(maxsize=256)
def _straight_edge(m: int, n: int, cell_ratio: float, *, periodic: bool) -> _StraightEdge:
    """Factors of the influence coefficients at wave numbers along the normal (m, n)."""
    spacing = 1 / np.hypot(m, n / cell_ratio)
    count = WAVES * (m + n)
    phase = (np.arange(count) + 0.5) * np.pi / count  # the symbol is even
    symbol = _symbol(phase * m, phase * n, cell_ratio, periodic=periodic)
    logarithm = np.log(symbol * np.abs(2 * np.sin(phase / 2)) / spacing)
    # The sum of l c_l, with Σ l cos(l x) = -1/(4 sin²(x/2)).
    threshold = spacing / 4 * (1 + np.mean(logarithm / np.sin(phase / 2) ** 2))
    # Exponential of a power series: log K₊ has c_l + 1/(2l), as |2 sin(x/2)| = |1 - z|.
    order = np.arange(3 * m)
    series = np.cos(np.outer(order, phase)) @ logarithm / count
    series[1:] += 0.5 / order[1:]
    growth = np.ones(3 * m)
    for each in order[1:]:
        lower = order[1 : each + 1]
        growth[each] = (lower * series[lower]) @ growth[each - lower] / each
    return _StraightEdge(float(spacing), float(threshold), growth)


def _symbol(phase_x: Floats, phase_y: Floats, cell_ratio: float, *, periodic: bool) -> Floats:
    """1/|q| of the half-space on cells of unit length at phases per cell along both axes."""
    # On a periodic grid the coefficients have the exact symbol. Elsewhere they belong to rectangles
    # of uniform pressure: means over a cell, with all aliases of the sampled displacement.
    phases = [(each + np.pi) % (2 * np.pi) - np.pi for each in (phase_x, phase_y)]
    if periodic:
        return np.asarray(1 / np.hypot(phases[0], phases[1] / cell_ratio))
    # The sum over aliases alternates: its partial sums are averaged twice.
    alias = np.arange(-ALIASES, ALIASES + 1)
    weights = 1 - 0.25 * (np.abs(alias) >= ALIASES - 1) - 0.5 * (np.abs(alias) == ALIASES)
    x, y = (each[:, None] + 2 * np.pi * alias for each in phases)
    mean_x, mean_y = (weights * np.sinc(each / (2 * np.pi)) for each in (x, y))
    inverse = 1 / np.hypot(x[:, :, None], y[:, None, :] / cell_ratio)
    return np.asarray(np.einsum("ij,ik,ijk->i", mean_x, mean_y, inverse))
