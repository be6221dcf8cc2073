"""Boxes in cells: rectangles of one size, in which a pressure is sampled and fitted linearly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field, replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.given_pressure.patches import CORNERS

#: Values of a formula at points, of arrays that have one shape after broadcasting.
PointValues = Callable[[Floats, Floats], Floats]

#: Gauss' rule, and the places at which it is tried: corners, middles of sides and the middle, a
#: little inside, as a formula may have no value on a border, such as that of a cone at its tip.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(3)
INSIDE = 1 - 1e-9
TRIED = np.array([-INSIDE, 0.0, INSIDE])
SIMPSON = np.outer([1.0, 4.0, 1.0], [1.0, 4.0, 1.0]) / 36

#: Places along a side of a cell that are looked at before its inside is taken as smooth, so that no
#: corner of a loaded field reaches in unseen.
ALONG_SIDE = 128


@dataclass(frozen=True, eq=False)
class Boxes:
    """Boxes of the same size; places within one go from -1 to 1 along each axis."""

    values: PointValues
    middle: Floats  # x and y of the middle of each box's cell, shape (2, boxes) [m]
    cell: Integers  # number of the cell of each box
    place: Floats  # of the middle of each box from that of its cell, shape (2, boxes) [m]
    size: Floats  # edges of a cell [m]
    varies: tuple[bool, bool]  # along x and y; not along a strip
    parts: Floats = field(default_factory=lambda: np.ones(2))  # boxes along each edge of a cell

    @property
    def half(self) -> Floats:
        """Half edges of a box [m]."""
        return np.asarray(self.size / (2 * self.parts))

    @property
    def share(self) -> float:
        """Edge of a box over that of its cell, along the axis that is divided most."""
        return float(1 / self.parts.max())

    def chosen(self, which: Bools | Integers) -> Boxes:
        """Some of the boxes."""
        return replace(
            self,
            middle=self.middle[:, which],
            cell=self.cell[which],
            place=self.place[:, which],
        )

    def at(self, along: Floats, across: Floats) -> Floats:
        """Pressure at places in the boxes, arrays with the boxes in the last dimension."""
        x, y = self.middle + self.place
        return self.values(x + self.half[0] * along, y + self.half[1] * across)

    @cached_property
    def _sampled(self) -> Floats:
        """Values at Gauss' nodes and at those where they are tried, shape (2, 3, 3, boxes)."""
        return np.array([self.on(NODES), self.on(TRIED)])

    def on(self, nodes: Floats) -> Floats:
        """Pressure at a square of nodes in the boxes, shape (nodes, nodes, boxes) [Pa]."""
        shape = (nodes.size, nodes.size, self.cell.size)
        along, across = nodes[:, None, None], nodes[None, :, None]
        return self.at(np.broadcast_to(along, shape), np.broadcast_to(across, shape))

    @cached_property
    def fit(self) -> Floats:
        """Mean, and slopes over half edges, of the best linear pressure, shape (3, boxes) [Pa]."""
        weights = np.outer(WEIGHTS, WEIGHTS) / 4
        with_slopes = np.array(
            [weights, 3 * weights * NODES[:, None], 3 * weights * NODES[None, :]]
        )
        return np.asarray(np.tensordot(with_slopes, self._sampled[0], axes=([1, 2], [0, 1])))

    @cached_property
    def misfit(self) -> Floats:
        """Largest difference of the linear pressure from the samples, shape (boxes,) [Pa]."""
        mean, along, across = self.fit
        found = np.zeros(self.cell.size)
        for nodes, sampled in zip((NODES, TRIED), self._sampled, strict=True):
            fitted = mean + along * nodes[:, None, None] + across * nodes[None, :, None]
            found = np.maximum(found, np.abs(sampled - fitted).max(axis=(0, 1)))
        return found

    @property
    def error_of_mean(self) -> Floats:
        """Difference of the means by the rules of Gauss and Simpson, shape (boxes,) [Pa]."""
        return np.asarray(np.abs(self.fit[0] - np.tensordot(SIMPSON, self._sampled[1], axes=2)))

    def misfit_at_sides(self, fitted: Callable[[Floats, Floats], Floats]) -> Floats:
        """Largest difference of a fit from the pressure along the sides, shape (boxes,) [Pa]."""
        count = max(round(ALONG_SIDE * self.share), 2)
        places = ((2 * np.arange(count) + 1) / count - 1)[:, None]
        found = np.zeros(self.cell.size)
        for start, end in zip(INSIDE * CORNERS, INSIDE * np.roll(CORNERS, -1, axis=0), strict=True):
            middle, way = (start + end) / 2, (end - start) / 2
            shape = (count, self.cell.size)
            along, across = (
                np.broadcast_to(m + w * places, shape) for m, w in zip(middle, way, strict=True)
            )
            apart = np.abs(self.at(along, across) - fitted(along, across)).max(axis=0)
            found = np.maximum(found, apart)
        return found

    def linear(self, along: Floats, across: Floats) -> Floats:
        """Linear pressure at places in the boxes [Pa]."""
        mean, by_along, by_across = self.fit
        return np.asarray(mean + by_along * along + by_across * across)

    def quarters(self) -> Boxes:
        """Quarters of the boxes, or halves of those of a strip: all first ones, all second ones."""
        parts = self.parts * np.where(self.varies, 2, 1)
        sides = [[-0.5, 0.5] if each else [0.0] for each in self.varies]
        ways = [self.half * np.array([along, across]) for along in sides[0] for across in sides[1]]
        return replace(
            self,
            middle=np.tile(self.middle, len(ways)),
            cell=np.tile(self.cell, len(ways)),
            place=np.concatenate([self.place + way[:, None] for way in ways], axis=1),
            parts=parts,
        )

    @property
    def nearness(self) -> Floats:
        """Share of a box in the distance to the middle of its cell, at most 1, shape (boxes,)."""
        distance = np.hypot(*(self.place / self.size[:, None])) - 0.7 * self.share
        return np.asarray(np.minimum(1.0, self.share / np.maximum(distance, self.share)))
